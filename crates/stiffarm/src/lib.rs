//! How stiff is an industrial robot where it machines, and where must the work stand?
//!
//! A robot and a task go in; each verb is one pure function over plain data:
//!
//! | verb | function | question |
//! |---|---|---|
//! | compliance | [`compliance::compliance`] | how compliant is one posture, all six drives? |
//! | map | [`map::map`] | how far is the tool pushed off, everywhere the arm reaches? |
//! | place | [`place::place`] | where must a zone stand, and who proves it? |
//! | rank | [`rank::rank`] | which robot holds the force best? |
//! | study | [`study::study`] | which architecture suits which link ratio and size? |
//! | import | [`catalogue::import::import`] | which robot does a URDF describe? |
//! | validate | [`ledger::validate`] | does it agree with what is published? |
//!
//! SI units throughout: m, rad, N, N m; compliances in m/N and rad/(N m). Millimetres and degrees exist only at
//! the borders: [`catalogue`] reads robot files, [`request`] what is asked, [`report`] tells the answers. The library reads no file but through [`catalogue::files`], prints nothing and keeps no state.
//!
//! The modules in reading order: [`interval`], [`limits`], [`spatial`], [`geometry`], [`drive`], [`plane`], [`robot`], [`compliance`], [`catalogue`], [`task`],
//! [`map`], [`place`], [`rank`], [`study`], [`request`], [`report`], [`ledger`]; [`plain`] keeps texts from outside on their line.
//!
//! # What is left out
//! The planar model of the paper, on which all verbs but `compliance` stand: drives 2 and 3 are compliant, links, bearings, the other drives and the base are
//! rigid; the tool point is the wrist centre; the deflection is elastic and static, without the robot's own weight.
//!
//! # Sources
//! - **\[paper\]** A. Klimchik, E. Magid, A. Pashkevich, *Machining with serial and quasi-serial industrial robots:
//!   comparison analysis and architecture limitations*.
//! - **\[OPW\]** M. Brandstoetter, A. Angerer, M. Hofbaur, *An analytical solution of the inverse kinematics problem of
//!   industrial serial manipulators with an ortho-parallel basis and a spherical wrist*, 2014.
//! - **\[theory\]** `docs/theory.md` of this repository: the formulas with their derivation.

pub mod catalogue;
pub mod compliance;
pub mod drive;
pub mod geometry;
pub mod interval;
pub mod inverse;
pub mod ledger;
pub mod limits;
pub mod map;
pub mod place;
pub mod plain;
pub mod plane;
pub mod rank;
pub mod report;
pub mod request;
pub mod robot;
mod root;
pub mod space;
pub mod spatial;
pub mod study;
pub mod task;
