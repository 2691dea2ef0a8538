//! By how much may two computations of one fact differ? Every slack of the kinematics and of the verbs in space.
//!
//! A pose at the very limit is computed in several ways: by joint angles in closed form, by cosines in registers, by enclosures in
//! the proofs. A place that one of them grants must not be denied by the next, so each step down the proof allows a little
//! more than the step before; the assertions below hold that order.

/// What rounding may take from the cosine of an angle that lies at its limit, in the registers.
pub(crate) const COSINE: f64 = 1e-12;
/// A stretched or folded arm counts as reached within this much, relative, of the rim.
pub(crate) const RIM: f64 = 1e-12;
/// Below this sine (for the wrist) or this part of the upper arm (for joint 1) an angle is free, and one value stands for all.
pub(crate) const SINGULAR: f64 = 1e-9;
/// The same, squared.
pub(crate) const SINGULAR_SQUARE: f64 = 1e-18;
/// By how much a joint may overstep its limit, rad: rounding of a pose that was computed at the limit.
pub(crate) const LIMIT: f64 = 1e-9;
/// By how much a zone may stand outside its window, m: rounding.
pub(crate) const WINDOW: f64 = 1e-9;
/// What a window may be wider or narrower than a zone, m, that is meant to stand at one place.
pub(crate) const ONE_PLACE: f64 = 4.0 * WINDOW;
/// What of a zone may lie below the base or behind the joint-1 axis before it is reported, m: rounding.
pub(crate) const OUTSIDE: f64 = 1e-6;
/// Relative allowance for the rounding of a proved bound, which is computed without directed rounding.
pub(crate) const BOUND: f64 = 1e-9;
/// By how much a limit must be overstepped for certain before a proof calls a posture impossible; rad, or m of a window.
pub(crate) const PROOF: f64 = 2e-9;
/// By how much the least angle that is reported of a zone may lie below the true one, rad.
pub(crate) const FOLLOWED: f64 = 1e-6;
/// The same, as part of the value.
pub(crate) const FOLLOWED_PART: f64 = 1e-3;
/// How near to a singular posture a proof still looks, rad; as [`CLEARANCE`].
pub(crate) const PROOF_CLEARANCE: f64 = CLEARANCE * (1.0 - 1e-5);
/// How far the postures of a place stay from singular ones: the angle of a wrist or arm to a straight one, rad, and the
/// distance of the wrist centre from the joint-1 axis, as part of the upper arm. Nearer, joints turn a thousand times as
/// fast as the tool, and no machine follows.
pub(crate) const CLEARANCE: f64 = 1e-3;

const _: () = assert!(COSINE < LIMIT, "the registers' rounding is less than what a joint is granted");
const _: () = assert!(LIMIT < PROOF, "a posture that is granted is not proved impossible");
const _: () = assert!(WINDOW < PROOF, "a zone that is granted its place is not proved to stand outside");
const _: () = assert!(WINDOW < OUTSIDE, "a zone that keeps its window does not lie outside");
const _: () = assert!(LIMIT < FOLLOWED, "rounding is finer than what is reported of a zone");
const _: () = assert!(SINGULAR < PROOF_CLEARANCE, "no singular posture lies where the proofs look");
const _: () =
    assert!(PROOF_CLEARANCE < CLEARANCE - LIMIT, "a posture that is clear enough for a place is not proved away");
const _: () = assert!(FOLLOWED < CLEARANCE, "what is reported of a zone says whether it is clear of singular postures");
