//! How compliant is the tool point at least, at every pose of a node?

use nalgebra::{Matrix3, SymmetricEigen, Vector3};

use super::affine::{Affine, Vector};
use super::bounds::NodeBounds;
use super::links::{ArmView, Links};
use super::prepared::ArmEnclosure;
use crate::batch::{Coupling, arm_columns};
use crate::interval::Interval;
use crate::inverse::{ArmBranch, Shoulder};
use crate::real::cross;

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
        if matches!(self.arm.coupling, Coupling::Any(_)) {
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

    /// Adds lower bounds by all drives together: their compliance along the softest directions in the middle of the node.
    pub(super) fn add_compliance_bounds<const N: usize>(
        &self,
        view: &ArmView<N>,
        links: &Links<N>,
        axis_5: Option<Vector<N>>,
        bounds: &mut NodeBounds<N>,
    ) {
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
        match &self.arm.coupling {
            Coupling::Serial => {}
            Coupling::QuasiSerial => columns[1] = [ez, zero, -ex],
            Coupling::Any(a) => {
                let joints = columns;
                columns = std::array::from_fn(|drive| {
                    (0..6).filter(|&joint| a[(joint, drive)] != 0.0).fold([zero; 3], |sum, joint| {
                        std::array::from_fn(|i| sum[i] + joints[joint][i] * a[(joint, drive)])
                    })
                });
            }
        }
        let k = self.drive_compliances(links);
        // A drive of which nothing is known may be rigid: zero is a lower bound.
        let parts: Vec<(Affine<N>, &Vector<N>)> = k
            .into_iter()
            .zip(&columns)
            .filter(|(k, column)| !k.is_unknown() && !column.iter().any(Affine::is_unknown))
            .collect();
        let mut sum = Matrix3::zeros();
        for (k, column) in &parts {
            let v = Vector3::from(column.map(|part| part.centre));
            sum += v * v.transpose() * k.centre;
        }
        let eigen = SymmetricEigen::new(sum);
        let largest = eigen.eigenvalues.max();
        for (value, direction) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            if *value < SECOND * largest {
                continue;
            }
            let moved = parts.iter().map(|(k, column)| {
                (*k, column[0] * direction[0] + column[1] * direction[1] + column[2] * direction[2])
            });
            let moved: Vec<(Affine<N>, Affine<N>)> = moved.collect();
            // A square lies above its tangents: that in the middle, and the one that is greatest at the worse end.
            bounds.values.push(squares(&moved, |x| x.centre));
            bounds
                .values
                .push(squares(&moved, |x: &Affine<N>| (x.centre.abs() - x.radius()).max(0.0).copysign(x.centre)));
        }
    }

    /// The compliance of each drive, with the compensator's part; NaN where nothing is known of it.
    fn drive_compliances<const N: usize>(&self, links: &Links<N>) -> [Affine<N>; 6] {
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

/// A lower bound on the sum of `k x^2` over drives of compliance `k`: each square is replaced by its tangent.
fn squares<const N: usize>(moved: &[(Affine<N>, Affine<N>)], tangent: impl Fn(&Affine<N>) -> f64) -> Affine<N> {
    moved.iter().fold(Affine::point(0.0), |sum, (k, x)| {
        let at = tangent(x);
        let square = *x * (2.0 * at) + -(at * at);
        sum + if k.radius() == 0.0 { square * k.centre } else { square * *k }
    })
}
