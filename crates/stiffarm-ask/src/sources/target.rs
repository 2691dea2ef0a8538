//! To which file does a name lead that is written, and is it one that is read?

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The file that is written under a name, which need not be there yet: links are followed, also one whose end is missing.
///
/// # Errors
/// Where its folder is missing or closed to us, or links lead in a circle.
pub fn target(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {}
        found => return found,
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match fs::read_link(path) {
        // No circle: that is an error of its own above.
        Ok(link) => target(&folder.join(link)),
        Err(_) => Ok(fs::canonicalize(folder)?.join(path.file_name().ok_or(io::ErrorKind::IsADirectory)?)),
    }
}

/// Is the file that is read under a name the one that is written as `target`, whatever either is called?
pub fn is_same(read: &Path, target: &Path) -> bool {
    // What cannot be found cannot be read either, and whoever reads it says so.
    fs::canonicalize(read).is_ok_and(|read| read == target || is_one_inode(&read, target))
}

#[cfg(unix)]
fn is_one_inode(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let inode = |path: &Path| fs::metadata(path).map(|found| (found.dev(), found.ino()));
    matches!((inode(a), inode(b)), (Ok(a), Ok(b)) if a == b)
}

/// Names of one file are distinguished by their paths alone.
#[cfg(not(unix))]
fn is_one_inode(_: &Path, _: &Path) -> bool {
    false
}
