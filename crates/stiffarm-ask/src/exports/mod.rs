//! Answers for programs that show fields in space, such as ParaView: [VTK's XML files](https://docs.vtk.org/en/latest/vtk_file_formats/).
//!
//! Lengths in m from the robot's base: ahead, left, up. Numbers are written as the bytes of IEEE doubles, least first, in base 64, so that
//! none is rounded and NaN, which stands for what is not reached, is read by every reader.

mod image;
mod lines;

pub(crate) use image::image;
pub(crate) use lines::lines;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;

/// A file of one kind of data.
fn file(kind: &str, inside: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n{inside}</VTKFile>\n"
    )
}

/// What an array holds.
#[derive(Clone, Copy)]
enum Numbers<'a> {
    Float64(&'a [f64]),
    Int64(&'a [i64]),
}

/// An array: how many bytes follow, and the bytes.
fn array(name: &str, components: usize, numbers: Numbers) -> String {
    let (kind, bytes): (_, Vec<u8>) = match numbers {
        Numbers::Float64(numbers) => ("Float64", numbers.iter().flat_map(|number| number.to_le_bytes()).collect()),
        Numbers::Int64(numbers) => ("Int64", numbers.iter().flat_map(|number| number.to_le_bytes()).collect()),
    };
    let length = (bytes.len() as u64).to_le_bytes();
    let text = BASE64_STANDARD.encode([&length, bytes.as_slice()].concat());
    format!(
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">{text}</DataArray>\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decoded by hand: 8 bytes of the length 8, and 1.0 as 3FF0 0000 0000 0000.
    #[test]
    fn an_array_is_its_length_and_its_bytes() {
        let written = array("a", 1, Numbers::Float64(&[1.0]));
        assert_eq!(
            written,
            "<DataArray type=\"Float64\" Name=\"a\" NumberOfComponents=\"1\" format=\"binary\">CAAAAAAAAAAAAAAAAADwPw==</DataArray>\n"
        );
    }
}
