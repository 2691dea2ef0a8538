//! STL files, binary or text, to triangles: what is wrong with one is cured and said, or refused with what to do.

use std::collections::HashMap;
use std::io::Cursor;

use nalgebra::Vector3;
use stl_io::create_stl_reader;

use crate::plain::on_one_line;

/// A file with more bytes is not read.
pub const MOST_STL_BYTES: usize = 100 << 20;
/// A file with more triangles is not read.
pub const MOST_TRIANGLES: usize = 2_000_000;
/// No part is wider, m: beyond it the unit is another one.
const WIDEST: f64 = 100.0;
/// Of a binary file: what stands before the triangles, and the bytes of one.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;

/// What a text begins with, and what editors put before it.
const SOLID: &[u8] = b"solid";
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A surface of triangles.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// m, each once.
    pub corners: Vec<[f64; 3]>,
    /// By the numbers of their corners, counter-clockwise seen from outside where the surface is closed.
    pub triangles: Vec<[u32; 3]>,
    /// Every edge is that of two triangles, so that there is an inside.
    pub is_closed: bool,
    /// What was cured, and what is odd.
    pub notes: Vec<String>,
}

/// An STL file that is not read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}: {why}")]
pub struct StlFault {
    /// As the user named it.
    pub file: String,
    /// Why.
    pub why: StlWhy,
}

/// Why an STL file is not read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StlWhy {
    /// Nothing in it.
    #[error("it is empty; expected an STL file")]
    Empty,
    /// More bytes than [`MOST_STL_BYTES`].
    #[error("it is larger than {} MiB; expected a coarser mesh", MOST_STL_BYTES >> 20)]
    Large,
    /// More triangles than [`MOST_TRIANGLES`].
    #[error("it has {0} triangles; expected at most {MOST_TRIANGLES}: a coarser mesh")]
    Many(usize),
    /// A pointer of Git LFS.
    #[error("it is a pointer of Git LFS, not the mesh; `git lfs pull` fetches the mesh")]
    Pointer,
    /// COLLADA, 3MF, OBJ or STEP under this name.
    #[error("it is {0}, not STL; export it as STL")]
    Other(&'static str),
    /// Neither binary nor text.
    #[error("it is no STL file: {0}")]
    NoStl(String),
    /// Fewer bytes than its triangles take.
    #[error("it is cut off: {triangles} triangles take {expected} bytes, and it has {found}; copy it again")]
    CutOff {
        /// As many as it says.
        triangles: u32,
        /// Bytes.
        expected: u64,
        /// Bytes.
        found: usize,
    },
    /// A coordinate that is no number.
    #[error("triangle {0} has a coordinate that is not finite")]
    NotFinite(usize),
    /// No triangle has an area.
    #[error("none of its {0} triangles has an area")]
    Flat(usize),
    /// The unit is another one.
    #[error("it is {0:.0} m wide; expected at most {WIDEST} m: is its unit another one (part-unit)?")]
    Wide(f64),
}

/// Reads an STL file whose unit is so many metres.
///
/// # Errors
/// What cannot be read, with what to do.
pub fn read_stl(bytes: &[u8], file: &str, metres: f64) -> Result<Surface, StlFault> {
    let read = corners(bytes).and_then(|(found, notes)| surface(&found, metres, notes));
    let named = |note: String| format!("{file}: {note}");
    match read {
        Ok(surface) => Ok(Surface { notes: surface.notes.into_iter().map(named).collect(), ..surface }),
        Err(why) => Err(StlFault { file: file.into(), why }),
    }
}

/// The corners of every triangle, in the unit of the file.
type Corners = Vec<[[f32; 3]; 3]>;

fn corners(bytes: &[u8]) -> Result<(Corners, Vec<String>), StlWhy> {
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes).trim_ascii_start();
    if text.is_empty() {
        return Err(StlWhy::Empty);
    }
    if MOST_STL_BYTES < bytes.len() {
        return Err(StlWhy::Large);
    }
    let stated = bytes.get(80..HEAD).map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    // What is as long as its triangles take is binary, even where it begins as text does.
    let takes = |count: u32| HEAD as u64 + u64::from(count) * TRIANGLE as u64;
    let is_binary = stated.is_some_and(|count| takes(count) == bytes.len() as u64);
    if !is_binary && text.get(..SOLID.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(SOLID)) {
        return Ok((as_text(text, bytes)?, Vec::new()));
    }
    for (begins, what) in [
        (&b"version https://git-lfs"[..], StlWhy::Pointer),
        (b"<?xml", StlWhy::Other("XML, such as COLLADA")),
        (b"<COLLADA", StlWhy::Other("COLLADA")),
        (b"PK\x03\x04", StlWhy::Other("an archive, such as 3MF")),
        (b"ISO-10303-21", StlWhy::Other("STEP")),
        (b"v ", StlWhy::Other("OBJ")),
    ] {
        if text.starts_with(begins) {
            return Err(what);
        }
    }
    let Some(count) = stated else {
        return Err(StlWhy::NoStl(
            "it neither begins with `solid` nor has the 84 bytes before binary triangles".into(),
        ));
    };
    if (bytes.len() as u64) < takes(count) {
        return Err(StlWhy::CutOff { triangles: count, expected: takes(count), found: bytes.len() });
    }
    let count = count as usize;
    if MOST_TRIANGLES < count {
        return Err(StlWhy::Many(count));
    }
    let more = bytes.len() - takes(count as u32) as usize;
    let notes = if more == 0 { Vec::new() } else { vec![format!("{more} bytes after its last triangle are left out")] };
    // The head is free text, but for the word that makes text of it.
    let mut plain = vec![b' '; 80];
    plain.extend_from_slice(&bytes[80..bytes.len() - more]);
    Ok((all(plain)?, notes))
}

/// The first line holds a name alone, and may be missing a space; words may be in capitals.
fn as_text(text: &[u8], file: &[u8]) -> Result<Corners, StlWhy> {
    let rest = text.iter().position(|byte| *byte == b'\n').map_or(&[][..], |end| &text[end..]);
    let mut plain = b"solid part".to_vec();
    plain.extend(rest.to_ascii_lowercase());
    all(plain).map_err(|why| match (why, odd_line(file)) {
        (StlWhy::NoStl(why), Some((line, found))) => StlWhy::NoStl(format!("line {line}, `{found}`: {why}")),
        (why, _) => why,
    })
}

/// The first line, from 1, that should hold three numbers and does not.
fn odd_line(text: &[u8]) -> Option<(usize, String)> {
    let is_odd = |line: &str| {
        let mut words = line.split_ascii_whitespace();
        let numbers = match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => words.collect::<Vec<_>>(),
            Some("facet") => words.skip(1).collect(),
            _ => return false,
        };
        numbers.len() != 3 || numbers.iter().any(|word| word.parse::<f32>().is_err())
    };
    let text = String::from_utf8_lossy(text);
    let (i, line) = text.lines().enumerate().find(|(_, line)| is_odd(line))?;
    Some((i + 1, on_one_line(line.trim()).into_owned()))
}

fn all(bytes: Vec<u8>) -> Result<Corners, StlWhy> {
    let no_stl = |error: std::io::Error| StlWhy::NoStl(on_one_line(&error.to_string()).into_owned());
    let mut found = Corners::new();
    let mut cursor = Cursor::new(bytes);
    for triangle in create_stl_reader(&mut cursor).map_err(no_stl)? {
        let vertices = triangle.map_err(no_stl)?.vertices;
        found.push(vertices.map(|vertex| vertex.0));
        if MOST_TRIANGLES < found.len() {
            return Err(StlWhy::Many(found.len()));
        }
    }
    Ok(found)
}

/// The surface in m: corners that are alike are one, triangles without an area are left out, and an inside that is turned out is turned back.
fn surface(found: &Corners, metres: f64, mut notes: Vec<String>) -> Result<Surface, StlWhy> {
    let mut known: HashMap<[u32; 3], u32> = HashMap::new();
    let (mut corners, mut triangles) = (Vec::new(), Vec::new());
    for (i, triangle) in found.iter().enumerate() {
        if !triangle.iter().flatten().all(|x| x.is_finite()) {
            return Err(StlWhy::NotFinite(i + 1));
        }
        let number = |corner: [f32; 3]| {
            // Zero has two signs.
            *known.entry(corner.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                corners.push(corner.map(|x| f64::from(x) * metres));
                corners.len() as u32 - 1
            })
        };
        triangles.push(triangle.map(number));
    }
    let at = |i: u32| Vector3::from(corners[i as usize]);
    let has_area = |[a, b, c]: &[u32; 3]| 0.0 < (at(*b) - at(*a)).cross(&(at(*c) - at(*a))).norm_squared();
    triangles.retain(has_area);
    let left_out = found.len() - triangles.len();
    if triangles.is_empty() {
        return Err(StlWhy::Flat(found.len()));
    }
    if 0 < left_out {
        notes.push(format!("{left_out} of its {} triangles have no area and are left out", found.len()));
    }
    let extent = (0..3).map(|i| {
        let along = || corners.iter().map(|corner| corner[i]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    });
    let widest = extent.fold(0.0, f64::max);
    if WIDEST < widest {
        return Err(StlWhy::Wide(widest));
    }
    let open = open_edges(&triangles);
    if 0 < open {
        notes.push(format!("its surface is not closed ({open} edges): what lies wholly inside is not noticed"));
    } else if triangles.iter().map(|[a, b, c]| at(*a).dot(&at(*b).cross(&at(*c)))).sum::<f64>() < 0.0 {
        notes.push("its surface is inside out, and was turned".into());
        for triangle in &mut triangles {
            triangle.swap(1, 2);
        }
    }
    Ok(Surface { corners, triangles, is_closed: open == 0, notes })
}

/// Edges along which as many triangles do not go forth as go back.
fn open_edges(triangles: &[[u32; 3]]) -> usize {
    let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
    for [a, b, c] in triangles {
        for (from, to) in [(*a, *b), (*b, *c), (*c, *a)] {
            *edges.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
        }
    }
    edges.values().filter(|sum| **sum != 0).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box from zero, of these sides: twelve triangles, their outsides outside.
    fn block([x, y, z]: [f32; 3]) -> Corners {
        let corner = |i: usize| [[0.0, x][i & 1], [0.0, y][i >> 1 & 1], [0.0, z][i >> 2]];
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|face| face.map(corner)).collect()
    }

    fn binary(head: &str, triangles: &Corners) -> Vec<u8> {
        let mut bytes = head.as_bytes().to_vec();
        bytes.resize(80, b' ');
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        bytes
    }

    fn text(head: &str, triangles: &Corners) -> Vec<u8> {
        let facet = |corners: &[[f32; 3]; 3]| {
            let vertices = corners.map(|[x, y, z]| format!("   vertex {x} {y} {z}\n")).concat();
            format!(" facet normal 0 0 0\n  outer loop\n{vertices}  endloop\n endfacet\n")
        };
        format!("{head}\n{}endsolid\n", triangles.iter().map(facet).collect::<String>()).into_bytes()
    }

    fn why(bytes: &[u8]) -> StlWhy {
        let fault = read_stl(bytes, "part.stl", 1e-3).unwrap_err();
        assert!(fault.to_string().starts_with("part.stl: "), "{fault}");
        fault.why
    }

    #[test]
    fn binary_and_text_are_one_surface_whatever_their_first_line_says() {
        let block = block([300.0, 200.0, 100.0]);
        let read = |bytes: &[u8]| read_stl(bytes, "part.stl", 1e-3).unwrap();
        let found = read(&binary("made by hand", &block));
        assert_eq!((found.corners.len(), found.triangles.len(), found.is_closed), (8, 12, true));
        assert!(found.notes.is_empty(), "{:?}", found.notes);
        let farthest = found.corners.iter().map(|corner| Vector3::from(*corner).norm()).fold(0.0, f64::max);
        // Single precision of mm.
        assert!((farthest - 0.14_f64.sqrt()).abs() < 1e-8, "{farthest}");
        for bytes in [
            binary("solid that is none", &block),
            text("solid", &block),
            text("  solid a name of words", &block),
            text("solid windows\r", &block),
            text("solid", &block).to_ascii_uppercase(),
            [b"\xef\xbb\xbf".to_vec(), text("solid", &block)].concat(),
        ] {
            assert_eq!(read(&bytes), found);
        }
        let longer = [binary("", &block), vec![1, 2, 3]].concat();
        assert_eq!(read(&longer).notes, ["part.stl: 3 bytes after its last triangle are left out"]);
    }

    #[test]
    fn what_is_odd_is_cured_and_said() {
        let mut turned = block([300.0, 200.0, 100.0]);
        let read = |triangles: &Corners| read_stl(&binary("", triangles), "part.stl", 1e-3).unwrap();
        let usual = read(&turned);
        for triangle in &mut turned {
            triangle.swap(1, 2);
        }
        let found = read(&turned);
        assert_eq!(found.notes, ["part.stl: its surface is inside out, and was turned"]);
        let volume = |surface: &Surface| {
            let at = |i: u32| Vector3::from(surface.corners[i as usize]);
            surface.triangles.iter().map(|[a, b, c]| at(*a).dot(&at(*b).cross(&at(*c))) / 6.0).sum::<f64>()
        };
        assert!((volume(&found) - 6e-3).abs() < 1e-9 && (volume(&usual) - 6e-3).abs() < 1e-9);
        let mut open = block([300.0, 200.0, 100.0]);
        open.pop();
        open.push([[1.0; 3]; 3]);
        let found = read(&open);
        assert!(!found.is_closed && found.triangles.len() == 11);
        assert!(found.notes[0].contains("1 of its 12 triangles have no area"), "{:?}", found.notes);
        assert!(found.notes[1].contains("not closed (3 edges)"), "{:?}", found.notes);
    }

    #[test]
    fn what_is_no_stl_is_refused_by_what_it_is() {
        let whole = binary("", &block([300.0, 200.0, 100.0]));
        assert_eq!(why(b" \n"), StlWhy::Empty);
        assert_eq!(why(b"version https://git-lfs.github.com/spec/v1\noid sha256:1\nsize 2\n"), StlWhy::Pointer);
        assert_eq!(why(b"<?xml version=\"1.0\"?><COLLADA/>"), StlWhy::Other("XML, such as COLLADA"));
        assert_eq!(why(&whole[..whole.len() - 1]), StlWhy::CutOff { triangles: 12, expected: 684, found: 683 });
        assert!(matches!(why(&binary("x", &Corners::new())[..50]), StlWhy::NoStl(_)));
        let mut bad = block([300.0, 200.0, 100.0]);
        bad[4][1][2] = f32::NAN;
        assert_eq!(why(&binary("", &bad)), StlWhy::NotFinite(5));
        assert_eq!(why(&binary("", &vec![[[1.0, 2.0, 3.0]; 3]; 7])), StlWhy::Flat(7));
        assert_eq!(why(&binary("", &Corners::new())), StlWhy::Flat(0));
        // Metres taken for millimetres are the other way round: a part of 300 mm in a file whose unit is the metre.
        let wide = read_stl(&whole, "part.stl", 1.0).unwrap_err();
        assert_eq!(wide.why, StlWhy::Wide(300.0));
        let cut = text("solid", &block([1.0; 3]));
        assert!(matches!(why(&cut[..cut.len() / 2]), StlWhy::NoStl(_)));
        let line = |bytes: &[u8]| why(bytes).to_string();
        assert!(line(b"solid\nfacet normal 0 0 x\n").contains("line 2, `facet normal 0 0 x`"));
        let odd = String::from_utf8(cut.clone()).unwrap().replacen("vertex 1 1 0", "vertex 1 1 zero", 1);
        let message = line(format!("\n{odd}").as_bytes());
        assert!(message.starts_with("it is no STL file: line 7, `vertex 1 1 zero`: "), "{message}");
        let many = [vec![b' '; 80], u32::MAX.to_le_bytes().to_vec(), vec![0; 100]].concat();
        assert!(matches!(why(&many), StlWhy::CutOff { .. }));
    }
}
