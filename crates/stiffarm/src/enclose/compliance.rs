//! How compliant is the tool point at least, at every pose of a node?

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::affine::{Affine, Vector};
use super::bounds::NodeBounds;
use super::links::{ArmView, Links};
use super::prepared::{ArmEnclosure, PushEnclosure};
use crate::batch::{Coupling, arm_columns};
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Shoulder};
use crate::load::{Component, Direction};
use crate::real::{cross, dot};
use crate::spatial::{eigenvalues, eigenvector};

/// The second softest direction is looked at as well where its compliance is this part of the largest.
const SECOND: f64 = 0.6;

impl ArmEnclosure {
    /// Adds lower bounds by drives 1, 2 and 3, each alone: its compliance times the squared distance of the tool point from the axis
    /// of its joint. They hold even for nodes in which the links could point anywhere.
    pub(super) fn add_distance_bounds<const N: usize>(
        &self,
        view: &ArmView<N>,
        branch: ArmBranch,
        bounds: &mut NodeBounds<N>,
    ) {
        let (geometry, k) = (&self.arm.geometry, self.arm.k);
        // A force of known direction need not turn any of these joints.
        if matches!(self.arm.coupling, Coupling::Any(_)) || !self.load.is_worst() || view.push.is_some() {
            return;
        }
        let [x, y, z] = view.point;
        bounds.values.push(squares(&[(Affine::point(k[0]), x), (Affine::point(k[0]), y)], |x| x.centre));
        // How far the tool point is from the wrist centre, forwards, across and up, and how far forwards from the joint-1 axis.
        let [ux, uy, uz] = view.wrist_to_tool;
        let most = |x: Affine<N>| x.min().abs().max(x.max().abs());
        let (far, aside) = (most(ux).hypot(most(uz)), most(uy) + geometry.b.abs());
        let across = Affine { remainder: aside * aside / 2.0, ..Affine::point(aside * aside / 2.0) };
        let Some(ahead) = (x.square() + y.square() - across).sqrt() else { return };
        let sign = if branch.shoulder == Shoulder::Back { -1.0 } else { 1.0 };
        if ((view.wrist[0] + geometry.a1) * sign).min() <= most(ux) {
            return; // it could be on either side of the axis
        }
        let (px, pz) = (ahead * sign + -geometry.a1, z + -geometry.c1);
        // From the elbow: as far as the links leave it.
        let from_elbow = geometry.l3() - far;
        let Some(from_2) = (px.square() + pz.square()).sqrt() else { return };
        let (near_2, far_2) = (from_2.min(), from_2.max());
        let from_elbow = from_elbow.max(near_2 - geometry.c2).max(geometry.c2 - far_2).max(0.0);
        bounds.values.push(Affine::point(k[2] * from_elbow * from_elbow));
        match self.arm.coupling {
            Coupling::Serial if self.arm.compensator.is_none() => {
                bounds.values.push(squares(&[(Affine::point(k[1]), px), (Affine::point(k[1]), pz)], |x| x.centre));
            }
            Coupling::QuasiSerial if self.arm.compensator.is_none() => {
                bounds.values.push(Affine::point(k[1] * geometry.c2 * geometry.c2));
            }
            _ => {}
        }
    }

    /// Adds lower bounds by all drives together: what they give under the force that does most in the middle of the node, along the
    /// direction that counts there.
    pub(super) fn add_compliance_bounds<const N: usize>(
        &self,
        view: &ArmView<N>,
        links: &Links<N>,
        axis_5: Option<Vector<N>>,
        bounds: &mut NodeBounds<N>,
    ) {
        let (drives, axes) = self.drives(view, links, axis_5);
        match (&view.push, view.work) {
            (Some(push), _) => add_push_bounds(push, &drives, &axes, bounds),
            (None, None) => add_worst_bounds(&drives, bounds),
            (None, Some(work)) => self.add_directed_bounds(view, &work, &drives, bounds),
        }
    }

    /// The compliance of each drive and what turning it by 1 rad moves the tool point by; and the axis about which it turns the tool. All in
    /// the axes of the arm.
    fn drives<const N: usize>(
        &self,
        view: &ArmView<N>,
        links: &Links<N>,
        axis_5: Option<Vector<N>>,
    ) -> ([(Affine<N>, Vector<N>); 6], [Vector<N>; 6]) {
        let geometry = &self.arm.geometry;
        let zero = Affine::point(0.0);
        let [ux, uy, uz] = view.wrist_to_tool;
        let [ex, ez] = links.upper.map(|part| part * geometry.c2);
        let (px, pz) = (view.wrist[0] + ux, view.wrist[1] + uz);
        let along = [links.forearm[0], zero, links.forearm[1]];
        let unknown = Affine { remainder: f64::NAN, ..zero };
        let [column_1, column_2, column_3] = arm_columns(geometry, zero, uy, [px, pz], [px - ex, pz - ez]);
        let mut columns = [
            column_1,
            column_2,
            column_3,
            cross(along, view.wrist_to_tool),
            axis_5.map_or([unknown; 3], |axis_5| cross(axis_5, view.wrist_to_tool)),
            if self.arm.tool_is_on_axis_6() { [zero; 3] } else { cross(view.axis_6, view.wrist_to_tool) },
        ];
        let (one, none) = (Affine::point(1.0), [zero; 3]);
        let (up, left) = ([zero, zero, one], [zero, one, zero]);
        let mut axes = [up, left, left, along, axis_5.unwrap_or([unknown; 3]), view.axis_6];
        match &self.arm.coupling {
            Coupling::Serial => {}
            Coupling::QuasiSerial => (columns[1], axes[1]) = ([ez, zero, -ex], none),
            Coupling::Any(a) => {
                let mixed = |joints: [Vector<N>; 6]| -> [Vector<N>; 6] {
                    std::array::from_fn(|drive| {
                        (0..6).filter(|&joint| a[(joint, drive)] != 0.0).fold(none, |sum, joint| {
                            std::array::from_fn(|i| sum[i] + joints[joint][i] * a[(joint, drive)])
                        })
                    })
                };
                (columns, axes) = (mixed(columns), mixed(axes));
            }
        }
        let k = self.drive_compliances(links);
        (std::array::from_fn(|drive| (k[drive], columns[drive])), axes)
    }

    /// Under a force of known direction: for any force `f` that may act, and any `d` that may count, `d . C f` is a lower bound.
    fn add_directed_bounds<const N: usize>(
        &self,
        view: &ArmView<N>,
        work: &[Vector<N>; 3],
        drives: &[(Affine<N>, Vector<N>); 6],
        bounds: &mut NodeBounds<N>,
    ) {
        let parts = known(drives);
        // The axes in which the force is given, and the normal of the face: all of them turn with the arm.
        let is_base = matches!(self.load.direction(), Direction::Base(_) | Direction::InPlane(_));
        let [c1, s1] = view.first;
        let (zero, one) = (Affine::point(0.0), Affine::point(1.0));
        let axes = if is_base { [[c1, -s1, zero], [s1, c1, zero], [zero, zero, one]] } else { *work };
        let middle = |v: &Vector<N>| Vector3::from(v.map(|part| part.centre));
        let frame = Matrix3::from_columns(&axes.each_ref().map(middle));
        let normal = work[2];
        let across = Matrix3::from_columns(&[Vector3::zeros(), Vector3::zeros(), frame.transpose() * middle(&normal)]);
        let forces = self.load.forces(&if is_base { across } else { Matrix3::identity() });
        let most = forces.largest(&(frame.transpose() * at_middle(&parts) * frame));
        let force = combined(&axes, &most.force);
        let along: Vec<_> = parts.iter().map(|(k, column)| (*k, dot(**column, force))).collect();
        // What the force moves along itself is no more than all that it moves; each part of it is not negative.
        if self.load.component() != Component::Normal {
            add_squares(&along, bounds);
        }
        let counted = match self.load.component() {
            Component::Along => return,
            Component::Normal => {
                let sign = if 0.0 <= most.counted.dot(&(frame.transpose() * middle(&normal))) { 1.0 } else { -1.0 };
                normal.map(|part| part * sign)
            }
            // Fixed in the axes of the arm, and of length one whatever rounding and enclosure made of the frame.
            Component::Total => match (frame * most.counted).try_normalize(0.0) {
                Some(direction) => <[f64; 3]>::from(direction).map(Affine::point),
                None => return,
            },
        };
        // A product may be negative: of a drive of which nothing is known it says nothing of the sum.
        if parts.len() < drives.len() {
            return;
        }
        let products = along.iter().zip(&parts).map(|((k, x), (_, column))| times(*x * dot(**column, counted), k));
        bounds.values.push(products.fold(zero, |sum, product| sum + product));
    }

    /// The compliance of each drive, with the compensator's part; NaN where nothing is known of it.
    pub(super) fn drive_compliances<const N: usize>(&self, links: &Links<N>) -> [Affine<N>; 6] {
        let mut k = self.arm.k.map(Affine::point);
        if let Some(compensator) = &self.arm.compensator {
            let [s2, c2] = links.upper;
            let [bx, bz] = compensator.base;
            let [ax, az] = compensator.arm;
            let (u, v) = compensator.products(s2, c2);
            let square = u * -2.0 + (bx * bx + bz * bz + ax * ax + az * az);
            let held = (|| {
                let inverse = square.inverse(Interval::POSITIVE).filter(|_| 0.0 < square.min())?;
                // free / s, and with it the stiffness as in `GravityCompensator::stiffness`.
                let part = inverse.sqrt()? * compensator.free_length;
                let added = (u - part * u + part * inverse * v.square()) * compensator.stiffness;
                let held = added * k[1].centre + 1.0;
                held.inverse(Interval::POSITIVE).filter(|_| 0.0 < held.min())
            })();
            let unknown = Affine { remainder: f64::NAN, ..Affine::point(0.0) };
            k[1] = held.map_or(unknown, |held| held * k[1].centre);
        }
        k
    }
}

/// The drives of which something is known: any other may be rigid, and gives no less than nothing along the direction of the force.
fn known<const N: usize>(drives: &[(Affine<N>, Vector<N>); 6]) -> Vec<(Affine<N>, &Vector<N>)> {
    let is_known = |(k, column): &&(Affine<N>, Vector<N>)| !k.is_unknown() && !column.iter().any(Affine::is_unknown);
    drives.iter().filter(is_known).map(|(k, column)| (*k, column)).collect()
}

/// The compliance in the middle of the node.
fn at_middle<const N: usize>(parts: &[(Affine<N>, &Vector<N>)]) -> Matrix3<f64> {
    let mut sum = Matrix3::zeros();
    for (k, column) in parts {
        let v = Vector3::from(column.map(|part| part.centre));
        sum += v * v.transpose() * k.centre;
    }
    sum
}

/// Adds lower bounds for a force in its worst direction: the compliance along the softest directions in the middle of the node.
fn add_worst_bounds<const N: usize>(drives: &[(Affine<N>, Vector<N>); 6], bounds: &mut NodeBounds<N>) {
    let parts = known(drives);
    for direction in softest(&at_middle(&parts)) {
        let moved = parts
            .iter()
            .map(|(k, column)| (*k, column[0] * direction[0] + column[1] * direction[1] + column[2] * direction[2]));
        add_squares(&moved.collect::<Vec<_>>(), bounds);
    }
}

/// The softest directions.
fn softest(compliance: &Matrix3<f64>) -> Vec<Vector3<f64>> {
    let values = eigenvalues(compliance);
    let counted = values.iter().filter(|value| SECOND * values[0] <= **value);
    let directions: Option<_> = counted.map(|value| eigenvector(compliance, *value)).collect();
    directions.unwrap_or_else(|| {
        let eigen = SymmetricEigen::new(*compliance);
        let all = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
        all.filter(|(value, _)| SECOND * values[0] <= **value).map(|(_, direction)| direction.into_owned()).collect()
    })
}

/// Adds the sum of `k x^2`. A square lies above its tangents: that in the middle, and the one that is greatest at the worse end.
pub(crate) fn add_squares<const N: usize>(moved: &[(Affine<N>, Affine<N>)], bounds: &mut NodeBounds<N>) {
    bounds.values.push(squares(moved, |x| x.centre));
    bounds.values.push(squares(moved, |x: &Affine<N>| (x.centre.abs() - x.radius()).max(0.0).copysign(x.centre)));
}

/// Adds lower bounds, m, for a known force and moment: what is moved along a direction that is fixed in the axes of the arm is no more than
/// all that is moved, and of what counts along a direction the sign is that in the middle of the node.
fn add_push_bounds<const N: usize>(
    push: &PushEnclosure<N>,
    drives: &[(Affine<N>, Vector<N>); 6],
    axes: &[Vector<N>; 6],
    bounds: &mut NodeBounds<N>,
) {
    if push.counted.is_none() {
        add_work_bound(push, drives, axes, bounds);
    }
    // A product may be negative: of a drive of which nothing is known it says nothing of the sum.
    if known(drives).len() < drives.len() || axes.iter().flatten().any(Affine::is_unknown) {
        return;
    }
    let turns: Vec<Affine<N>> = drives
        .iter()
        .zip(axes)
        .map(|((k, column), axis)| times(dot(*column, push.force) + dot(*axis, push.moment), k))
        .collect();
    let along = |direction: Vector<N>| {
        let parts = turns.iter().zip(drives).map(|(turn, (_, column))| *turn * dot(*column, direction));
        parts.fold(Affine::point(0.0), |sum, part| sum + part)
    };
    if let Some(counted) = push.counted {
        let value = along(counted);
        bounds.values.push(if value.centre < 0.0 { -value } else { value });
        return;
    }
    let middle = turns.iter().zip(drives).fold(Vector3::zeros(), |sum: Vector3<f64>, (turn, (_, column))| {
        sum + Vector3::from(column.map(|part| part.centre)) * turn.centre
    });
    if let Some(direction) = middle.try_normalize(0.0) {
        bounds.values.push(along(<[f64; 3]>::from(direction).map(Affine::point)));
    }
}

/// Adds that the work of the force is no more than its size times what is moved:
/// `|delta| |F| >= sum k x (x + y)` with `x = v . F` and `y = omega . M`. Of a drive of which nothing is known `x (x + y) >= -|M|^2 / 4`.
fn add_work_bound<const N: usize>(
    push: &PushEnclosure<N>,
    drives: &[(Affine<N>, Vector<N>); 6],
    axes: &[Vector<N>; 6],
    bounds: &mut NodeBounds<N>,
) {
    let [force, moment] = push.sizes;
    if force == 0.0 || drives.iter().any(|(k, _)| k.is_unknown()) {
        return;
    }
    let mut work = Affine::point(0.0);
    for ((k, column), axis) in drives.iter().zip(axes) {
        let (x, y) = (dot(*column, push.force), dot(*axis, push.moment));
        let is_known = !x.is_unknown() && (!y.is_unknown() || moment == 0.0);
        let part = match is_known {
            true if moment == 0.0 => x.square(),
            true => x.square() + x * y,
            false => Affine::point(-moment * moment / 4.0),
        };
        work = work + times(part, k);
    }
    bounds.values.push(work * (1.0 / force));
}

/// A product with a compliance, which mostly is a number.
fn times<const N: usize>(x: Affine<N>, k: &Affine<N>) -> Affine<N> {
    if k.radius() == 0.0 { x * k.centre } else { x * *k }
}

/// What has these parts along three vectors.
fn combined<const N: usize>(axes: &[Vector<N>; 3], parts: &Vector3<f64>) -> Vector<N> {
    std::array::from_fn(|i| axes[0][i] * parts.x + axes[1][i] * parts.y + axes[2][i] * parts.z)
}

/// A lower bound on the sum of `k x^2` over drives of compliance `k`: each square is replaced by its tangent.
fn squares<const N: usize>(moved: &[(Affine<N>, Affine<N>)], tangent: impl Fn(&Affine<N>) -> f64) -> Affine<N> {
    moved.iter().fold(Affine::point(0.0), |sum, (k, x)| {
        let at = tangent(x);
        let square = *x * (2.0 * at) + -(at * at);
        sum + times(square, k)
    })
}
