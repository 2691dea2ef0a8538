//! How stiff is an industrial robot where it machines, and where must the work stand?
//!
//! A [`Model`](model::Model) is made of a robot once, under one set of assumptions; each verb is one pure function over it:
//!
//! | verb | function | question |
//! |---|---|---|
//! | robots | [`catalogue::matching`] | which robots are there? |
//! | compliance | [`compliance::compliance`] | how compliant is one posture, all six drives? |
//! | modes | [`modes::modes`] | how does the arm swing at one posture, where masses are known? |
//! | chatter | [`chatter::chatter`] | does a cut swing with the arm, and how deep may it go? |
//! | map | [`map::map`] | how far is the tool pushed off, everywhere the arm reaches? |
//! | place | [`place::place`] | where must a zone stand, and who proves it? |
//! | rank | [`rank::rank`] | which robot holds the force best? |
//! | compare | [`place::place`] of both | which of two setups is better, and is that proved? |
//! | force | [`cutting::Process::force`] | with what force does a process push on its tool? |
//! | mill | [`mill::mill`] | how far is the tool pushed off along a toolpath? |
//! | identify | [`identify::identify`] | how stiff are the drives, by measured deflections? |
//! | calibrate | [`calibrate::calibrate`] | how does this very arm differ from its drawing, by measured points? |
//! | measure | [`measure::plan`] | which postures and loads must be measured? |
//! | study | [`study::study`] | which architecture suits which link ratio and size? |
//! | verify | [`verify::verify`] | does a robot file count the joints as the pendant does? |
//! | import | [`catalogue::import::import`] | which robot does a URDF describe? |
//! | validate | [`ledger::validate`] | does it agree with what is published? |
//!
//! SI units throughout: m, rad, N, N m; compliances in m/N and rad/(N m). Millimetres and degrees exist only at
//! the borders: [`catalogue`] reads robot and process files, [`toolpath`] paths, [`program`] writes those of controllers. What people ask and are
//! answered, with its words and units, is the crate `stiffarm-ask`.
//! The library reads no file but through [`catalogue::files`], prints nothing and keeps no state.
//!
//! The modules in reading order: [`plain`], [`palette`], [`watch`], `parallel`, `root`, `frontier`, [`interval`], `angle`, `tolerances`, `real`, [`spatial`], [`load`], [`cutting`], [`limits`],
//! [`geometry`], [`body`], [`mass`], [`drive`], [`plane`], [`calibration`], [`robot`], [`catalogue`], [`prior`], [`inverse`], [`chain`], [`compliance`], [`identify`], `registration`, [`verify`], [`calibrate`], [`batch`], [`zone`], [`part`], [`task`], [`toolpath`], [`program`], [`stock`], [`cell`], [`clearance`], [`work`], `enclose`, `follow`,
//! [`model`], [`map`], [`place`], [`rank`], [`uncertainty`], [`modes`], [`chatter`], [`advice`], [`mill`], [`measure`], [`study`], [`ledger`]. Each uses only those before it.
//!
//! # What is left out
//! In both models links, bearings and the base are rigid; the deflection is elastic and static, without the robot's own weight. The planar
//! model of the paper leaves out the drives 1, 4, 5 and 6 and the tool besides: its tool point is the wrist centre.
//!
//! # Sources
//! - **\[paper\]** A. Klimchik, E. Magid, A. Pashkevich, *Machining with serial and quasi-serial industrial robots:
//!   comparison analysis and architecture limitations*.
//! - **\[OPW\]** M. Brandstoetter, A. Angerer, M. Hofbaur, *An analytical solution of the inverse kinematics problem of
//!   industrial serial manipulators with an ortho-parallel basis and a spherical wrist*, 2014.
//! - **\[Altintas\]** Y. Altintas, *Manufacturing Automation: Metal Cutting Mechanics, Machine Tool Vibrations, and CNC Design*, 2nd ed.,
//!   2012, chapter 2.
//! - **\[Kienzle\]** O. Kienzle, *Die Bestimmung von Kraeften und Leistungen an spanenden Werkzeugen*, VDI-Z 94 (1952).
//! - **\[Pan\]** Z. Pan, H. Zhang, Z. Zhu, J. Wang, *Chatter analysis of robotic machining process*, Journal of Materials Processing
//!   Technology 173 (2006).
//! - **\[theory\]** `docs/theory.md` of this repository: the formulas with their derivation.

pub mod advice;
mod angle;
pub mod batch;
pub mod body;
pub mod calibrate;
pub mod calibration;
pub mod catalogue;
pub mod cell;
pub mod chain;
pub mod chatter;
pub mod clearance;
pub mod compliance;
pub mod cutting;
pub mod drive;
mod enclose;
mod follow;
mod frontier;
pub mod geometry;
pub mod identify;
pub mod interval;
pub mod inverse;
pub mod ledger;
pub mod limits;
pub mod load;
pub mod map;
pub mod mass;
pub mod measure;
pub mod mill;
pub mod model;
pub mod modes;
pub mod palette;
mod parallel;
pub mod part;
pub mod place;
pub mod plain;
pub mod plane;
pub mod prior;
pub mod program;
pub mod rank;
mod real;
mod registration;
pub mod robot;
mod root;
pub mod spatial;
pub mod stock;
pub mod study;
pub mod task;
mod tolerances;
pub mod toolpath;
pub mod uncertainty;
pub mod verify;
pub mod watch;
pub mod work;
pub mod zone;
