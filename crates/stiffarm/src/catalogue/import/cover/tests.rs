//! Does every triangle lie in a capsule, and are they tight?

use super::*;

fn number(rng: &mut fastrand::Rng) -> f64 {
    2.0 * rng.f64() - 1.0
}

/// Corner by corner of a box about zero, of half these sides.
fn block(half: [f64; 3]) -> Vec<Triangle> {
    let corner = |i: usize| Vec3::from_fn(|k, _| if i >> k & 1 == 0 { -half[k] } else { half[k] });
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|face| face.map(corner)).collect()
}

fn holds(capsule: &Capsule, point: &Vec3) -> bool {
    Axis::of(capsule).reach(&[*point; 3]) <= capsule.radius
}

/// Points of every triangle lie in one of the capsules, by a calculation of its own.
fn assert_encloses(capsules: &[Capsule], triangles: &[Triangle]) {
    let mut rng = fastrand::Rng::with_seed(3);
    for [a, b, c] in triangles {
        for i in 0..2000 {
            let (x, y) = if i < 3 { ([0.0, 0.0, 1.0][i], [0.0, 1.0, 0.0][i]) } else { (rng.f64(), rng.f64()) };
            let (x, y) = if 1.0 < x + y { (1.0 - x, 1.0 - y) } else { (x, y) };
            let point = a + (b - a) * x + (c - a) * y;
            let is_in = |capsule: &Capsule| {
                let [from, to] = capsule.ends;
                let along = (point - from).dot(&(to - from)) / (to - from).norm_squared().max(f64::MIN_POSITIVE);
                (point - from.lerp(&to, along.clamp(0.0, 1.0))).norm() <= capsule.radius
            };
            assert!(capsules.iter().any(is_in), "{point} in none of {capsules:?}");
        }
    }
}

/// By random points of a cube about zero, of half this side.
fn union(capsules: &[Capsule], half: f64) -> f64 {
    let mut rng = fastrand::Rng::with_seed(5);
    let inside = (0..200_000).filter(|_| {
        let point = Vec3::from_fn(|_, _| half * number(&mut rng));
        capsules.iter().any(|capsule| holds(capsule, &point))
    });
    inside.count() as f64 * 8.0 * half * half * half / 200_000.0
}

#[test]
fn a_box_is_enclosed_by_less_the_more_capsules_there_are() {
    let block = block([0.5, 0.3, 0.1]);
    let mut last = f64::INFINITY;
    for most in 1..=6 {
        let found = cover(&block, most);
        assert!((1..=most).contains(&found.len()));
        assert_eq!(found, cover(&block, most));
        assert_encloses(&found, &block);
        let volume = union(&found, 1.0);
        assert!(volume <= last * 1.01, "{volume} after {last}");
        last = volume;
    }
    assert!(last < 0.75 * union(&cover(&block, 1), 1.0), "{last}");
}

#[test]
fn a_capsule_is_found_again() {
    let mut rng = fastrand::Rng::with_seed(7);
    let (from, to) = (Vec3::new(0.1, -0.2, 0.3), Vec3::new(0.5, 0.3, -0.4));
    let points: Vec<Triangle> = (0..4000)
        .map(|i| {
            let away = Vec3::from_fn(|_, _| number(&mut rng)).normalize() * 0.15;
            [if i % 2 == 0 { from } else { to } + away; 3]
        })
        .collect();
    let [found] = cover(&points, 1)[..] else { panic!("one capsule") };
    assert!((found.radius / 0.15 - 1.0).abs() < 0.01, "{found:?}");
    let [a, b] = found.ends;
    let apart = f64::min((a - from).norm() + (b - to).norm(), (a - to).norm() + (b - from).norm());
    assert!(apart < 0.01 * (to - from).norm(), "{found:?}");
}

#[test]
fn what_has_no_volume_is_enclosed() {
    let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()];
    let flat = block([0.5, 0.3, 0.0]);
    let line = vec![[z, z * 2.0, z * 4.0], [z * 4.0, z * 5.0, z * 2.0]];
    for triangles in [vec![[x, y, z]], flat, line, vec![[x; 3]; 5], vec![[Vec3::zeros(); 3]]] {
        for most in [1, 6] {
            let found = cover(&triangles, most);
            assert!(found.iter().all(|capsule| capsule.radius.is_finite() && capsule.radius < 0.9), "{found:?}");
            assert_encloses(&found, &triangles);
        }
    }
    assert_eq!(cover(&[], 6), []);
}

/// Its corners lie in the capsules of two blobs, and the rest of it in neither.
#[test]
fn a_thin_triangle_between_two_blobs_is_held() {
    let at = |side: f64| block([0.1; 3]).into_iter().map(move |face| face.map(|corner| corner + Vec3::x() * side));
    let thin = [Vec3::new(-1.0, 0.0, 0.0), Vec3::new(1.0, 0.0, 0.0), Vec3::new(1.0, 0.01, 0.0)];
    let triangles: Vec<Triangle> = at(-1.0).chain(at(1.0)).chain([thin]).collect();
    for most in 1..=4 {
        assert_encloses(&cover(&triangles, most), &triangles);
    }
    assert_eq!(cover(&triangles, 3).len(), 3);
}
