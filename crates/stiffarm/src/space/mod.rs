//! A robot and its tool, made ready for many postures and poses at once.

mod lanes;
