//! Do the joints get from the centre of a zone to its other poses without leaving their branch or their ranges?

use std::f64::consts::PI;

use super::affine::Affine;
use super::bounds::NodeBounds;
use super::links::{angle, turned_into};
use super::prepared::ArmEnclosure;
use crate::batch::AngularInterval;
use crate::interval::Interval;
use crate::tolerances;

/// Cosine and sine of theta 1, theta 4 and theta 6 at a pose, the last two times the sine of theta 5; the wrist not flipped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct JointDirections<const N: usize>(pub(super) [[Affine<N>; 2]; 3]);

/// How far joints 1, 4 and 6 turn for certain from their angles at the centre of a zone, over the poses that were added: up to at
/// least the first number, and down to at most the second, rad.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TurnExtent([[f64; 2]; 3]);

impl ArmEnclosure {
    /// Adds that joints 1, 4 and 6 turn by less than a quarter turn from the centre, by no more than their ranges are wide, and
    /// without leaving their ranges on the way; takes away the `wrists` for which they cannot.
    pub(super) fn stay_on_branch<const N: usize>(
        &self,
        directions: &JointDirections<N>,
        centre: &JointDirections<N>,
        extent: &mut TurnExtent,
        wrists: &mut [bool; 2],
        bounds: &mut NodeBounds<N>,
    ) -> Option<()> {
        for part in 0..3 {
            let ([c, s], [from_c, from_s]) = (directions.0[part], centre.0[part]);
            let ahead = c * from_c + s * from_s;
            bounds.require(ahead)?;
            let Some(turned) = angle(ahead, s * from_c - c * from_s) else { continue };
            let [most, least] = &mut extent.0[part];
            (*most, *least) = (most.max(turned.min()), least.min(turned.max()));
            if self.turns[part] + tolerances::PROOF < *most - *least {
                return None;
            }
            let Some(from) = angle(from_c, from_s).filter(|_| self.ranges[part].is_bounded()) else { continue };
            for (flip, wrist) in [0.0, PI].into_iter().zip(wrists.iter_mut()) {
                let flip = if part == 0 { 0.0 } else { flip };
                *wrist &= stays_within(self.ranges[part], from.affine(1.0, flip), turned);
            }
        }
        Some(())
    }

    /// Takes away the wrists that no placement of the node allows; sine and cosine of joint 5, the sine not negative.
    pub(super) fn exclude_wrists<const N: usize>(
        &self,
        directions: &JointDirections<N>,
        s5: Affine<N>,
        c5: Affine<N>,
        wrists: &mut [bool; 2],
    ) {
        let [.., fourth, fifth, sixth] = &self.arm.angular_limits.joints;
        let JointDirections([_, [forwards, across], [cos_6, sin_6]]) = *directions;
        let forbidden = |interval: &AngularInterval, cos: Affine<N>, sin: Affine<N>, length: Affine<N>| {
            interval.room(cos, sin, length).is_some_and(|room| room.max() < -tolerances::PROOF)
        };
        for (wrist, sign) in wrists.iter_mut().zip([1.0, -1.0]) {
            // A straight wrist, of which joints 4 and 6 may be split in many ways, has vectors of length zero: no room less.
            *wrist &= !forbidden(fifth, c5, s5 * sign, Affine::point(1.0))
                && !forbidden(fourth, forwards * sign, across * sign, s5)
                && !forbidden(sixth, cos_6 * sign, sin_6 * sign, s5);
        }
    }
}

/// Some angle of `from` may lie in the range and still do so after a turn by `turned`, without a change of whole turns.
fn stays_within(range: Interval, from: Interval, turned: Interval) -> bool {
    let wide = Interval::spanning(range.min() - tolerances::PROOF, range.max() + tolerances::PROOF);
    turned_into(range, from).any(|from| wide.intersect(from.plus(turned)).is_some())
}
