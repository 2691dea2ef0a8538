//! What pushes on the tool, which way, and what part of the displacement counts?

mod forces;
mod in_plane;
mod push;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};

pub(crate) use forces::Forces;
pub use forces::Largest;
pub(crate) use in_plane::Sector;
pub use push::Push;

/// The largest force that is taken, N.
const MOST: f64 = 1e6;

/// A cutting force at the tool point: how large, which way as far as that is known, and what part of the displacement counts.
///
/// Checked when it is made, so that what takes a load need not check it again. All that is computed under it grows with its size
/// in proportion.
///
/// ```
/// use stiffarm::load::{Component, Load};
///
/// // 300 N along the feed, 100 N across, 50 N into the spindle; 20 degrees of doubt; the feed may go any way.
/// let load = Load::along_tool([300.0, 100.0, 50.0], None)?.with_cone(20_f64.to_radians())?.counting(Component::Normal);
/// assert!((load.newtons() - 320.2).abs() < 0.1);
/// # Ok::<(), stiffarm::load::LoadError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    newtons: f64,
    direction: Direction,
    cone: f64,
    component: Component,
}

/// Which way a force pushes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// At every point the way in which the tool gives way most.
    Worst,
    /// An angle in the arm plane, rad, counter-clockwise from straight ahead.
    InPlane(f64),
    /// N along the axes of the base: ahead, to the left, up.
    Base([f64; 3]),
    /// N on the tool along the axes of the work: the feed, across it (to the left of the feed, seen from the spindle), and away from the
    /// work, against the z axis of the tool.
    Tool {
        /// Along these three.
        force: [f64; 3],
        /// Of the feed in the work plane, rad, from the first side of the zone towards the second; where `None`, the feed may go any
        /// way, and the worst counts.
        feed: Option<f64>,
    },
}

/// What part of a displacement counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Component {
    /// The whole displacement, `|C n| F`: the paper's eq. (1) for one direction.
    Total,
    /// Its part along the tool axis, which meets the face at a right angle: too deep, or not deep enough.
    Normal,
    /// Its part along the force, `n^T C n F`.
    Along,
}

/// A force with which nothing can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// Outside `0 < force <= 1e6`.
    #[error("a force of {0} N; expected more than 0 and at most 1e6 N")]
    Force(f64),
    /// A direction that is not finite.
    #[error("a direction of {0} rad; expected a finite number")]
    Direction(f64),
    /// A cone that is none.
    #[error("a cone of {0} rad about the force; expected 0 to pi/2")]
    Cone(f64),
}

/// A load of which the arm plane knows nothing.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotInPlane {
    /// A part of the force across it.
    #[error("a force of {0} N across the arm plane; the planar model takes x,0,z, and the spatial model any")]
    Across(f64),
    /// There is no tool.
    #[error("a force along feed, across and axial needs the spatial model")]
    Tool,
    /// There is no face.
    #[error("a deflection normal to the face needs the spatial model")]
    Normal,
}

impl Component {
    /// As it is asked for.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Total => "total",
            Self::Normal => "normal",
            Self::Along => "along",
        }
    }
}

impl Load {
    /// The cutting force of the paper, 1 kN, in its worst direction.
    pub const PAPER: Self =
        Self { newtons: 1000.0, direction: Direction::Worst, cone: 0.0, component: Component::Total };

    /// One newton in its worst direction: deflections under it are compliances.
    pub const UNIT: Self = Self { newtons: 1.0, ..Self::PAPER };

    /// A force, N, in its worst direction.
    ///
    /// # Errors
    /// Where it is not positive, or above 1 MN.
    pub fn worst(newtons: f64) -> Result<Self, LoadError> {
        Self::new(newtons, Direction::Worst)
    }

    /// A force, N, at an angle in the arm plane, rad, counter-clockwise from straight ahead.
    ///
    /// # Errors
    /// Where the force is not positive or above 1 MN, or the angle is not finite.
    pub fn in_plane(newtons: f64, angle: f64, component: Component) -> Result<Self, LoadError> {
        if !angle.is_finite() {
            return Err(LoadError::Direction(angle));
        }
        Self::new(newtons, Direction::InPlane(angle)).map(|load| load.counting(component))
    }

    /// A force, N along the axes of the base: ahead, to the left, up.
    ///
    /// # Errors
    /// Where its size is not positive, or above 1 MN.
    pub fn along_base(force: [f64; 3]) -> Result<Self, LoadError> {
        Self::new(Vector3::from(force).norm(), Direction::Base(force))
    }

    /// A force, N, and the direction of the feed, as [`Direction::Tool`] has them.
    ///
    /// # Errors
    /// Where its size is not positive, or above 1 MN, or the angle is not finite.
    pub fn along_tool(force: [f64; 3], feed: Option<f64>) -> Result<Self, LoadError> {
        if let Some(angle) = feed.filter(|angle| !angle.is_finite()) {
            return Err(LoadError::Direction(angle));
        }
        Self::new(Vector3::from(force).norm(), Direction::Tool { force, feed })
    }

    fn new(newtons: f64, direction: Direction) -> Result<Self, LoadError> {
        if !(0.0 < newtons && newtons <= MOST) {
            return Err(LoadError::Force(newtons));
        }
        Ok(Self { newtons, direction, ..Self::PAPER })
    }

    /// The same, where the force may point anywhere in a cone of this half angle, rad, about its direction.
    ///
    /// # Errors
    /// Where it is not between 0 and a quarter turn.
    pub fn with_cone(self, half_angle: f64) -> Result<Self, LoadError> {
        if (0.0..=FRAC_PI_2).contains(&half_angle) {
            Ok(Self { cone: half_angle, ..self })
        } else {
            Err(LoadError::Cone(half_angle))
        }
    }

    /// The same, where this part of the displacement counts.
    #[must_use]
    pub const fn counting(self, component: Component) -> Self {
        Self { component, ..self }
    }

    /// A force of the same size in its worst direction, where all of the displacement counts.
    #[must_use]
    pub const fn in_worst_direction(self) -> Self {
        Self { newtons: self.newtons, ..Self::PAPER }
    }

    /// Its size, N.
    pub const fn newtons(self) -> f64 {
        self.newtons
    }

    /// Which way it pushes.
    pub const fn direction(self) -> Direction {
        self.direction
    }

    /// How far off that it may point, rad.
    pub const fn cone(self) -> f64 {
        self.cone
    }

    /// What part of the displacement counts.
    pub const fn component(self) -> Component {
        self.component
    }

    /// What counts is the largest displacement of all directions: the largest eigenvalue of the compliance. (Along the softest
    /// direction, force and displacement are parallel.)
    pub fn is_worst(self) -> bool {
        self.direction == Direction::Worst && self.component != Component::Normal
    }

    /// It is fixed to the base, and not alike about the joint-1 axis.
    pub fn breaks_symmetry(self) -> bool {
        match self.direction {
            Direction::Worst | Direction::Tool { .. } => false,
            Direction::InPlane(_) => true,
            Direction::Base([x, y, _]) => x != 0.0 || y != 0.0,
        }
    }

    /// It turns with the work about the normal of its face.
    pub(crate) fn turns_with_work(self) -> bool {
        matches!(self.direction, Direction::Tool { force: [along, across, _], feed: Some(_) } if along != 0.0 || across != 0.0)
    }

    /// After what turn of the work about the normal of its face, rad, does a zone give way as before, where the turn maps it onto itself?
    ///
    /// Half a turn reverses the force along the feed and across it, and leaves that along the axis. Where it has both, it is another force;
    /// else the same or its opposite, which counts alike.
    pub(crate) fn period_of_turns(self) -> f64 {
        match self.direction {
            Direction::Tool { force: [.., axial], .. } if self.turns_with_work() && axial != 0.0 => TAU,
            _ => PI,
        }
    }

    /// The unit forces that may act, in base axes, where the columns of `work` are the first side of the zone, its second side and the
    /// direction away from the work.
    ///
    /// A cone about a direction is a band of angles off it. Where the feed may go any way, only the angle to the tool axis is
    /// known, and that is a band of angles off that axis.
    pub(crate) fn forces(self, work: &Matrix3<f64>) -> Forces {
        let away: Vector3<f64> = work.column(2).into();
        let about = |axis: Vector3<f64>| (axis.normalize(), [0.0, self.cone]);
        let (axis, [from, to]) = match self.direction {
            Direction::Worst => (away, [0.0, PI]),
            Direction::InPlane(angle) => about(Vector3::new(angle.cos(), 0.0, angle.sin())),
            Direction::Base(force) => about(force.into()),
            Direction::Tool { force: [f, c, a], feed: Some(feed) } => {
                let (s, cos) = feed.sin_cos();
                about(work * Vector3::new(f * cos - c * s, f * s + c * cos, a))
            }
            Direction::Tool { force: [f, c, a], feed: None } => {
                let off = f.hypot(c).atan2(a);
                (away, [(off - self.cone).max(0.0), (off + self.cone).min(PI)])
            }
        };
        Forces::band(axis, [from, to], away, self.component)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_force_that_is_none_makes_no_load() {
        for nonsense in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.1e6] {
            assert!(matches!(Load::worst(nonsense), Err(LoadError::Force(_))), "{nonsense}");
        }
        assert!(matches!(Load::in_plane(1.0, f64::NAN, Component::Total), Err(LoadError::Direction(_))));
        assert!(matches!(Load::along_tool([1.0; 3], Some(f64::NAN)), Err(LoadError::Direction(_))));
        assert!(matches!(Load::along_base([0.0; 3]), Err(LoadError::Force(_))));
        assert!(matches!(Load::along_base([0.0, f64::NAN, 1.0]), Err(LoadError::Force(_))));
        for cone in [-0.1, 2.0, f64::NAN] {
            assert!(matches!(Load::PAPER.with_cone(cone), Err(LoadError::Cone(_))), "{cone}");
        }
        assert_eq!(Load::worst(1000.0), Ok(Load::PAPER));
        assert!((Load::along_base([300.0, 0.0, -400.0]).unwrap().newtons() - 500.0).abs() < 1e-12);
    }

    /// On a table the spindle stands above the work; the first side points ahead, the second to the left.
    #[test]
    fn feed_across_and_axial_point_where_a_machinist_says() {
        let work = Matrix3::identity();
        let axis =
            |force, feed_deg: f64| Load::along_tool(force, Some(feed_deg.to_radians())).unwrap().forces(&work).axis();
        let close = |a: Vector3<f64>, b: [f64; 3]| assert!((a - Vector3::from(b)).norm() < 1e-12, "{a} is not {b:?}");
        close(axis([5.0, 0.0, 0.0], 0.0), [1.0, 0.0, 0.0]);
        close(axis([0.0, 5.0, 0.0], 0.0), [0.0, 1.0, 0.0]);
        close(axis([0.0, 0.0, 5.0], 77.0), [0.0, 0.0, 1.0]);
        // Fed to the left, what is left of the feed lies back.
        close(axis([5.0, 0.0, 0.0], 90.0), [0.0, 1.0, 0.0]);
        close(axis([0.0, 5.0, 0.0], 90.0), [-1.0, 0.0, 0.0]);
    }

    /// On any compliance, whatever counts and however wide the cone.
    #[test]
    fn half_a_turn_of_the_work_is_reported_where_the_force_does_something_else() {
        let c = Matrix3::new(3.0, 0.4, -0.7, 0.4, 2.0, 0.5, -0.7, 0.5, 1.0);
        let half_turn = Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0));
        let cases: [([f64; 3], Option<f64>, f64); 6] = [
            ([3.0, 1.0, 2.0], Some(0.4), TAU),
            ([0.0, 1.0, -2.0], Some(0.4), TAU),
            ([3.0, 1.0, 0.0], Some(0.4), PI),
            ([0.0, 0.0, 2.0], Some(0.4), PI),
            ([3.0, 1.0, 2.0], None, PI),
            ([3.0, 0.0, 2.0], Some(0.0), TAU),
        ];
        for (force, feed, period) in cases {
            let load = Load::along_tool(force, feed).unwrap();
            assert_eq!(load.period_of_turns(), period, "{force:?} {feed:?}");
            for (component, cone) in
                [(Component::Total, 0.0), (Component::Along, 0.3), (Component::Normal, 0.0), (Component::Total, 0.5)]
            {
                let load = load.with_cone(cone).unwrap().counting(component);
                let [one, other] = [Matrix3::identity(), half_turn].map(|work| load.forces(&work).largest(&c).value);
                let is_same = (one - other).abs() < 1e-12;
                assert_eq!(is_same, period == PI, "{force:?} {feed:?} {component:?}: {one} {other}");
            }
        }
        assert_eq!(Load::PAPER.period_of_turns(), PI);
        assert_eq!(Load::along_base([1.0, 2.0, 3.0]).unwrap().period_of_turns(), PI);
    }

    #[test]
    fn only_a_force_along_the_base_that_points_aside_tells_one_bearing_from_another() {
        assert!(!Load::PAPER.breaks_symmetry() && !Load::along_tool([1.0, 2.0, 3.0], None).unwrap().breaks_symmetry());
        assert!(!Load::along_base([0.0, 0.0, -9.0]).unwrap().breaks_symmetry());
        assert!(Load::along_base([0.0, 1.0, -9.0]).unwrap().breaks_symmetry());
    }
}
