//! `stiffarm serve`, the real program on a free port, asked over HTTP.

mod answers;
mod hostile;
mod openapi;
pub(crate) mod served;
mod waiting;

const TWO_LINKS: &str =
    "name = \"two links\"\narchitecture = \"serial\"\nstatus = \"derived\"\n\n[planar]\nl2_mm = 1000\nl3_mm = 800\n";
