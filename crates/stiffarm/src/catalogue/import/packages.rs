//! Where on disk lies a mesh that a URDF names? In a package of ROS, or beside the URDF.

use std::path::{Component, Path, PathBuf};

use crate::catalogue::files::{bytes, shown};
use crate::catalogue::stl::MOST_STL_BYTES;

/// The file that makes a package of a folder.
const MARK: &str = "package.xml";

/// The folder of a URDF, and those of the packages that were named.
#[derive(Clone, Debug)]
pub struct Packages {
    urdf: PathBuf,
    known: Vec<(String, PathBuf)>,
}

impl Packages {
    /// For the meshes of the URDF at this path; packages by their names.
    pub fn of(urdf: &Path, known: Vec<(String, PathBuf)>) -> Self {
        let folder = urdf.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        Self { urdf: folder.into(), known }
    }

    /// The bytes of a mesh, by `package://NAME/PATH`, `file://PATH`, or a path from the URDF.
    ///
    /// # Errors
    /// Where there is none, in words, or where the path leads out of its folder.
    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, String> {
        let path = self.path(name)?;
        let found = bytes(&path, MOST_STL_BYTES).map_err(|error| error.to_string())?;
        if MOST_STL_BYTES < found.len() {
            return Err(format!(
                "{} is larger than {} MiB; expected a coarser mesh",
                shown(&path),
                MOST_STL_BYTES >> 20
            ));
        }
        Ok(found)
    }

    fn path(&self, name: &str) -> Result<PathBuf, String> {
        let (folder, rest) = if let Some(rest) = name.strip_prefix("package://") {
            let (package, rest) = rest.split_once('/').unwrap_or((rest, ""));
            (self.package(package)?, rest)
        } else {
            (self.urdf.clone(), name.strip_prefix("file://").unwrap_or(name))
        };
        let path = Path::new(rest);
        if path.components().any(|part| part == Component::ParentDir) {
            return Err("the path leads out of its folder by ..; expected a path in it".into());
        }
        Ok(folder.join(path))
    }

    /// The folder of a package: as it was named, else the nearest one of this name above the URDF, or beside what is above it.
    fn package(&self, name: &str) -> Result<PathBuf, String> {
        if let Some((_, folder)) = self.known.iter().find(|(known, _)| known == name) {
            return Ok(folder.clone());
        }
        let urdf = std::path::absolute(&self.urdf).map_err(|error| error.to_string())?;
        let is_package = |folder: &PathBuf| folder.join(MARK).is_file();
        let near = |above: &Path| {
            let is_named = above.file_name().is_some_and(|own| own == name);
            let own = Some(above.to_path_buf()).filter(|_| is_named);
            own.into_iter().chain([above.join(name)]).find(is_package)
        };
        urdf.ancestors().find_map(near).ok_or_else(|| {
            format!("package '{name}' is not found above the URDF; --package {name}=FOLDER says where it lies")
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn meshes_are_found_in_packages_above_and_beside_and_nowhere_else() {
        let folder = std::env::temp_dir().join(format!("stiffarm-packages-{}", std::process::id()));
        let (own, other) = (folder.join("arm_support"), folder.join("arm_meshes"));
        for package in [&own, &other] {
            fs::create_dir_all(package.join("urdf")).unwrap();
            fs::write(package.join(MARK), "<package/>").unwrap();
            fs::write(package.join("link.stl"), package.file_name().unwrap().to_string_lossy().as_bytes()).unwrap();
        }
        fs::write(folder.join("elsewhere"), "x").unwrap();
        let packages = Packages::of(&own.join("urdf/arm.urdf"), vec![("given".into(), other.clone())]);
        let text = |name: &str| packages.bytes(name).map(|bytes| String::from_utf8(bytes).unwrap());
        assert_eq!(text("package://arm_support/link.stl").unwrap(), "arm_support");
        assert_eq!(text("package://arm_meshes/link.stl").unwrap(), "arm_meshes");
        assert_eq!(text("package://given/link.stl").unwrap(), "arm_meshes");
        assert!(text("package://nobody/link.stl").unwrap_err().contains("--package nobody=FOLDER"));
        for name in ["package://arm_support/../elsewhere", "../link.stl", "file://../../elsewhere"] {
            assert!(text(name).unwrap_err().contains(".."), "{name}");
        }
        assert!(text("package://arm_support/none.stl").is_err() && text("link.stl").is_err());
        fs::remove_dir_all(folder).unwrap();
    }
}
