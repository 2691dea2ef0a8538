//! The fonts of figures and pages, unpacked when they are first asked for.

use std::io::Read;
use std::sync::OnceLock;

use flate2::read::GzDecoder;

/// What figures call the font.
pub const FONT: &str = "DejaVu Sans";

/// Upright letters.
pub fn plain() -> &'static [u8] {
    static FONT: OnceLock<Vec<u8>> = OnceLock::new();
    FONT.get_or_init(|| unpacked(include_bytes!(concat!(env!("OUT_DIR"), "/plain.ttf.gz"))))
}

/// Bold letters.
pub fn bold() -> &'static [u8] {
    static FONT: OnceLock<Vec<u8>> = OnceLock::new();
    FONT.get_or_init(|| unpacked(include_bytes!(concat!(env!("OUT_DIR"), "/bold.ttf.gz"))))
}

/// Letters that are all as wide.
pub fn mono() -> &'static [u8] {
    static FONT: OnceLock<Vec<u8>> = OnceLock::new();
    FONT.get_or_init(|| unpacked(include_bytes!(concat!(env!("OUT_DIR"), "/mono.ttf.gz"))))
}

fn unpacked(packed: &[u8]) -> Vec<u8> {
    let mut font = Vec::new();
    GzDecoder::new(packed).read_to_end(&mut font).expect("it was packed when this was built");
    font
}
