//! How far is a link from what is left of a block?

use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::distance;
use parry3d_f64::shape::{Cuboid, Shape};

use super::solid::parry;
use crate::body::Capsule;
use crate::spatial::Pose;
use crate::stock::{Remains, Square};

/// What is nearer by less, m, is not looked for: on a flat top all columns are as near.
const AS_NEAR: f64 = 1e-7;

/// What of a link is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    Round,
    Flat,
}

impl Remains {
    /// To a capsule, or to the cylinder about its line, before a sample, m, where that is less than `most`; negative or zero where they overlap: a
    /// capsule by no more than its radius, a cylinder by no more than the capsule, than it and the box about all that is left, and than the way
    /// back along its line.
    pub(super) fn apart_from(
        &self,
        (pose, sample): (&Pose, usize),
        (capsule, ends): (&Capsule, Ends),
        most: f64,
    ) -> Option<f64> {
        let here = pose.inverse();
        let capsule = Capsule { ends: capsule.ends.map(|end| here.transform_point(&end.into()).coords), ..*capsule };
        let found = self.nearest(sample, (&capsule, ends), most)?;
        if ends == Ends::Round || 0.0 <= found {
            return Some(found);
        }
        let left = self.left(self.whole(), sample)?.map(Vector3::from);
        let depth = capsule.depth_of_cylinder(&middle(&left), half(&left)).min(-found);
        let found = -capsule.way_back(depth, |drawn| self.nearest(sample, (drawn, ends), 0.0).is_none());
        (found < most).then_some(found)
    }

    /// The same of a link in the frame of the part, by its line where a flat one overlaps.
    fn nearest(&self, sample: usize, (capsule, ends): (&Capsule, Ends), most: f64) -> Option<f64> {
        let mut search = Search { remains: self, sample, link: Link::of(*capsule, ends), most };
        let whole = search.nearer(self.whole())?;
        search.descend(whole);
        (search.most < most).then_some(search.most)
    }
}

/// A link in the frame of the part.
struct Link {
    capsule: Capsule,
    /// The box about it: low and high corner, m.
    bounds: [Vector3<f64>; 2],
    shape: Box<dyn Shape>,
    at: Pose,
    ends: Ends,
}

/// A square in which something is left, and how far the box of that is from the link, m: what is left in its parts is no nearer.
struct Held {
    square: Square,
    apart: f64,
}

/// Down to the columns that may be nearer than `most`.
struct Search<'a> {
    remains: &'a Remains,
    sample: usize,
    link: Link,
    most: f64,
}

impl Link {
    fn of(capsule: Capsule, ends: Ends) -> Self {
        let [from, to] = capsule.ends;
        let bounds = [from.inf(&to).add_scalar(-capsule.radius), from.sup(&to).add_scalar(capsule.radius)];
        let (at, shape): (Pose, Box<dyn Shape>) = match ends {
            Ends::Round => (Pose::identity(), Box::new(capsule.segment())),
            Ends::Flat => {
                let (at, cylinder) = capsule.cylinder();
                (at, Box::new(cylinder))
            }
        };
        Self { capsule, bounds, shape, at, ends }
    }

    /// No more than its distance from a box, m, at little cost; nothing is known of boxes that overlap.
    fn at_least_from(&self, [low, high]: &[Vector3<f64>; 2]) -> f64 {
        let gap = (low - self.bounds[1]).sup(&(self.bounds[0] - high)).sup(&Vector3::zeros()).norm();
        if 0.0 < gap { gap } else { f64::NEG_INFINITY }
    }

    /// To a box, m.
    fn apart_from(&self, corners: &[Vector3<f64>; 2]) -> f64 {
        let (pose, cuboid) = (parry(&middle(corners)), Cuboid::new(half(corners)));
        let apart = |at: &Pose, shape: &dyn Shape| {
            distance(&parry(at), shape, &pose, &cuboid).expect("parry knows convex shapes").distance
        };
        let found = apart(&self.at, &*self.shape);
        match self.ends {
            Ends::Round => found - self.capsule.radius,
            Ends::Flat if 0.0 < found => found,
            // Its line gives how deep.
            Ends::Flat => found.min(apart(&Pose::identity(), &self.capsule.segment()) - self.capsule.radius),
        }
    }
}

/// Where a box stands.
fn middle([low, high]: &[Vector3<f64>; 2]) -> Pose {
    Pose::from_parts(((low + high) / 2.0).into(), nalgebra::UnitQuaternion::identity())
}

/// Of its sides.
fn half([low, high]: &[Vector3<f64>; 2]) -> Vector {
    Vector::from(<[f64; 3]>::from((high - low) / 2.0))
}

impl Search<'_> {
    /// What is left in a square, where that is nearer than what is known.
    fn nearer(&self, square: Square) -> Option<Held> {
        let corners = self.remains.left(square, self.sample)?.map(Vector3::from);
        if self.most <= self.link.at_least_from(&corners) {
            return None;
        }
        let apart = self.link.apart_from(&corners);
        (apart < self.most - AS_NEAR).then_some(Held { square, apart })
    }

    fn descend(&mut self, Held { square, apart }: Held) {
        // Something nearer may have been found since.
        if self.most - AS_NEAR <= apart {
            return;
        }
        let Some(parts) = self.remains.parts(square, self.sample) else {
            self.most = apart;
            return;
        };
        let mut parts: Vec<Held> = parts.filter_map(|part| self.nearer(part)).collect();
        parts.sort_by(|a, b| a.apart.total_cmp(&b.apart));
        for part in parts {
            self.descend(part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::Stock;

    /// All columns one by one, by other routines of `parry` where the link is round; the flat one by many points of the cylinder.
    #[test]
    fn links_are_as_far_as_from_the_nearest_column() {
        let mut rng = fastrand::Rng::with_seed(39);
        let mut stock = Stock::block([0.0, 0.0, -0.06], [0.3, 0.2, 0.0], 1e-2).unwrap();
        let mut number = |low: f64, high: f64| low + rng.f64() * (high - low);
        for _ in 0..12 {
            let mut tip = || Vector3::new(number(0.0, 0.3), number(0.0, 0.2), number(-0.07, 0.0));
            stock.cut(&tip(), &tip(), 0.03);
        }
        let remains = Remains::of(&stock);
        let pose = Pose::new(Vector3::new(0.4, -0.2, 0.7), Vector3::new(0.3, -0.8, 0.5));
        let (mut overlaps, mut apart, mut nothing) = (0, 0, 0);
        for case in 0..300 {
            let sample = case % 13;
            let mut point = || Vector3::new(number(-0.2, 0.5), number(-0.2, 0.4), number(-0.2, 0.3));
            let (capsule, most) = (Capsule { ends: [point(), point()], radius: number(0.005, 0.05) }, number(0.0, 0.5));
            let boxes: Vec<[Vector3<f64>; 2]> = columns(&remains, sample);
            let stands = Capsule { ends: capsule.ends.map(|end| pose.transform_point(&end.into()).coords), ..capsule };
            let of = |ends| remains.apart_from((&pose, sample), (&stands, ends), most);
            let line = |[low, high]: &[Vector3<f64>; 2]| {
                let nearest = |t: f64| {
                    let at = capsule.ends[0].lerp(&capsule.ends[1], t);
                    (low - at).sup(&(at - high)).sup(&Vector3::zeros()).norm()
                };
                // Convex along the line.
                let (mut from, mut to) = (0.0, 1.0);
                for _ in 0..100 {
                    let [a, b] = [from + (to - from) / 3.0, to - (to - from) / 3.0];
                    (from, to) = if nearest(a) < nearest(b) { (from, b) } else { (a, to) };
                }
                nearest(f64::midpoint(from, to))
            };
            let round = boxes.iter().map(line).fold(f64::INFINITY, f64::min) - capsule.radius;
            match of(Ends::Round) {
                Some(found) => assert!((found - round).abs() < 1e-7, "{found} {round}"),
                None => assert!(most - 1e-7 < round, "{round} {most}"),
            }
            let flat = of(Ends::Flat);
            nothing += usize::from(flat.is_none());
            overlaps += usize::from(flat.is_some_and(|flat| flat <= 0.0));
            apart += usize::from(flat.is_some_and(|flat| 0.0 < flat));
            // What is thinner at its ends is no nearer; and no point of it is nearer than is reported.
            assert!(flat.unwrap_or(most) >= round.min(most) - 1e-7);
            let axis = (capsule.ends[1] - capsule.ends[0]).normalize();
            let across = axis.cross(&Vector3::new(0.3, 0.5, 0.8)).normalize();
            let mut sampled = f64::INFINITY;
            for (t, turn) in
                (0..=20).flat_map(|t| (0..24).map(move |turn| (f64::from(t) / 20.0, f64::from(turn) * 0.262)))
            {
                for part in [0.0, 0.5, 1.0] {
                    let aside = (across * turn.cos() + axis.cross(&across) * turn.sin()) * (capsule.radius * part);
                    let at = capsule.ends[0].lerp(&capsule.ends[1], t) + aside;
                    let of_box =
                        |[low, high]: &[Vector3<f64>; 2]| (low - at).sup(&(at - high)).sup(&Vector3::zeros()).norm();
                    sampled = boxes.iter().map(of_box).fold(sampled, f64::min);
                }
            }
            match flat {
                Some(flat) => assert!(flat <= sampled + 1e-6 && sampled - flat.max(0.0) < 0.04, "{flat} {sampled}"),
                None => assert!(most - 1e-6 < sampled, "{sampled} {most}"),
            }
        }
        assert!(50 < overlaps && 50 < apart && 20 < nothing, "{overlaps} {apart} {nothing}");
    }

    /// By hand: the left half is cut down by 40 mm, and a flat end is half a millimetre in what is left there.
    #[test]
    fn a_flat_end_in_a_low_step_is_no_deeper_than_its_way_back() {
        let mut stock = Stock::block([0.0, 0.0, -0.06], [0.4, 0.2, 0.0], 5e-3).unwrap();
        stock.cut(&Vector3::new(0.1, 0.1, -0.04), &Vector3::new(0.1, 0.1, -0.04), 0.15);
        let remains = Remains::of(&stock);
        let end = Vector3::new(0.1, 0.1, -0.0405);
        let spindle = Capsule { ends: [end + Vector3::z() * 0.3, end], radius: 0.03 };
        let found = remains.apart_from((&Pose::identity(), usize::MAX), (&spindle, Ends::Flat), 1.0).unwrap();
        assert!((found + 0.0005).abs() < 2e-5, "{found}");
    }

    fn columns(remains: &Remains, sample: usize) -> Vec<[Vector3<f64>; 2]> {
        let (mut found, mut queue) = (Vec::new(), vec![remains.whole()]);
        while let Some(square) = queue.pop() {
            match remains.parts(square, usize::MAX) {
                Some(parts) => queue.extend(parts),
                None => found.extend(remains.left(square, sample).map(|corners| corners.map(Vector3::from))),
            }
        }
        found
    }
}
