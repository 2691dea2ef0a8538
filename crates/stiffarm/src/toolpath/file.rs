//! Where do the moves of a path come from: a file, or a text that stands for a path built in?

use std::io::BufReader;
use std::path::Path;

use super::{Builtin, Format, Move, PathFault, ReadOptions, Understood, read};
use crate::catalogue::files::{self, Unreadable};
use crate::watch::Stopped;

/// Of the buffer through which a path is read, bytes.
const BUFFER: usize = 1 << 16;

/// A path that is not read.
#[derive(Debug, thiserror::Error)]
pub enum ToolpathError {
    /// There is no such file, or none that can be read.
    #[error(transparent)]
    File(#[from] Unreadable),
    /// What is in it.
    #[error(transparent)]
    Path(#[from] PathFault),
}

/// Hands over the moves of a path in their order, and tells how many bytes of how many are read; what was understood besides, `None` of a
/// path built in.
///
/// # Errors
/// A file that cannot be read, the first word that is refused, with its line; what was stopped.
pub fn read_toolpath(
    name: &str,
    format: Format,
    options: &ReadOptions,
    each: &mut dyn FnMut(&Move),
    progress: &mut dyn FnMut(u64, u64) -> Result<(), Stopped>,
) -> Result<Option<Understood>, ToolpathError> {
    if Builtin::is_meant(name) {
        name.parse::<Builtin>()?.moves(options.feed).iter().for_each(each);
        return Ok(None);
    }
    let path = Path::new(name);
    let file = files::open(path)?;
    // What the system makes up has no length: then how much is left is not known.
    let length = file.metadata().map_or(0, |found| found.len());
    let mut input = BufReader::with_capacity(BUFFER, file);
    let found = read(&mut input, &files::shown(path), format, options, each, &mut |far| progress(far.bytes, length))?;
    Ok(Some(found))
}
