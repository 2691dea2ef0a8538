//! stub
use super::Report;
use crate::failure::Failure;
impl Report {
    /// stub
    pub(crate) fn pdf(&self) -> Result<Vec<u8>, Failure> {
        Ok(Vec::new())
    }
}
