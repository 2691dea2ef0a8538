use super::*;

fn geometry() -> Geometry {
    Geometry {
        a1: 0.33,
        a2: -0.115,
        b: 0.02,
        c1: 0.645,
        c2: 1.15,
        c3: 1.22,
        c4: 0.215,
        offset: [0.0; 6],
        sign: [1.0; 6],
    }
}

/// Of three points: an inertia that a body has.
fn body(rng: &mut fastrand::Rng) -> RigidBody {
    let mut point = || RigidBody::point(7.0, Vector3::from_fn(|_, _| rng.f64() - 0.5));
    let (a, b, c) = (point(), point(), point());
    a.with(&b).with(&c)
}

/// Kinetic energy of a body that a function of the angles carries, by differences of its pose along `rate`.
fn energy(pose: &dyn Fn(&[f64; 6]) -> Pose, theta: &[f64; 6], rate: &[f64; 6], body: &RigidBody) -> f64 {
    let h = 1e-5;
    let at = |sign: f64| pose(&std::array::from_fn(|i| theta[i] + sign * h * rate[i]));
    let (before, after) = (at(-1.0), at(1.0));
    let speed = (body.seen_from(&after).centre - body.seen_from(&before).centre) / (2.0 * h);
    let turning = (after.rotation * before.rotation.inverse()).scaled_axis() / (2.0 * h);
    0.5 * (body.mass * speed.norm_squared() + turning.dot(&(body.seen_from(&at(0.0)).inertia * turning)))
}

/// How what turns about the joint-2 axis as the forearm does has moved from model zero: the crank of a parallelogram.
fn crank(geometry: &Geometry, theta: &[f64; 6]) -> Pose {
    let shoulder = geometry.shoulder_at_zero();
    Pose::rotation(Vector3::z() * theta[0])
        * Pose::from_parts(shoulder.into(), Pose::rotation(Vector3::y() * (theta[1] + theta[2])).rotation)
        * Pose::from_parts((-shoulder).into(), Pose::identity().rotation)
}

/// How a carrier has moved from model zero; the rod by the parallelogram: its end goes with the crank, and it keeps the direction of the upper arm.
fn pose(geometry: &Geometry, carrier: Carrier, theta: &[f64; 6]) -> Pose {
    match carrier {
        Carrier::Base => Pose::identity(),
        Carrier::Link(link) => geometry.links(theta)[link - 1],
        Carrier::Counterweight => crank(geometry, theta),
        Carrier::Rod { crank: [x, z] } => {
            let end = Point3::from(geometry.shoulder_at_zero() + Vector3::new(x, 0.0, z));
            let (moved, turn) = (crank(geometry, theta) * end, geometry.links(theta)[1].rotation);
            Pose::from_parts((moved.coords - turn * end.coords).into(), turn)
        }
    }
}

#[test]
fn the_mass_matrix_gives_the_kinetic_energy_of_every_body_by_differences_of_where_it_stands() {
    let (geometry, mut rng) = (geometry(), fastrand::Rng::with_seed(40));
    for _ in 0..30 {
        let special = [Carrier::Base, Carrier::Rod { crank: [-0.3, -0.1] }, Carrier::Counterweight];
        let carriers = special.into_iter().chain((1..=6).map(Carrier::Link));
        let masses: Vec<Mass> = carriers.map(|carrier| Mass { carrier, body: body(&mut rng) }).collect();
        let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
        let rate: [f64; 6] = std::array::from_fn(|_| 2.0 * (rng.f64() - 0.5));
        let of = |mass: &Mass| energy(&|theta| pose(&geometry, mass.carrier, theta), &theta, &rate, &mass.body);
        let expected: f64 = masses.iter().map(of).sum();
        let rates = nalgebra::Vector6::from(rate);
        let found = 0.5 * rates.dot(&(mass_matrix(&geometry, &theta, &masses) * rates));
        // Central differences of step 1e-5: 1e-10 of truncation, 1e-11 of rounding.
        assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
    }
}

#[test]
fn the_last_link_moves_as_the_flange_does() {
    let (geometry, mut rng) = (geometry(), fastrand::Rng::with_seed(6));
    for _ in 0..100 {
        let theta: [f64; 6] = std::array::from_fn(|_| 6.0 * (rng.f64() - 0.5));
        let moved = geometry.links(&theta)[5] * geometry.forward(&[0.0; 6]);
        let flange = geometry.forward(&theta);
        assert!((moved.translation.vector - flange.translation.vector).norm() < 1e-12);
        assert!(moved.rotation.angle_to(&flange.rotation) < 1e-7); // the root of a rounding
    }
}

#[test]
fn inertias_that_no_body_has_are_reported_and_those_of_rods_and_plates_are_not() {
    let with = |[x, y, z]: [f64; 3]| RigidBody::new(1.0, Vector3::zeros(), [x, 0.0, 0.0, y, 0.0, z]).inertia_fault();
    // A rod along x, a plate across z (I3 = I1 + I2), a point.
    assert_eq!([with([0.0, 1.0, 1.0]), with([1.0, 1.0, 2.0]), with([0.0; 3])], [None, None, None]);
    assert!(with([1.0, 1.0, 2.1]).unwrap().contains("at most the sum of the other two"));
    assert!(with([-0.1, 1.0, 1.0]).is_some() && with([f64::NAN, 1.0, 1.0]).is_some());
}

/// By hand: 100 kg at 0.1 m about each axis are 1 kg m^2; 0.1 kg with 5 kg m^2 turn as if they were 7.07 m away.
#[test]
fn an_inertia_in_another_unit_is_told_by_the_radius_of_gyration() {
    let with = |mass: f64, about: f64| {
        RigidBody::new(mass, Vector3::zeros(), [about, 0.0, 0.0, about, 0.0, about]).size_fault()
    };
    assert_eq!([with(100.0, 1.0), with(0.1, 1e-6), with(1.0, 2.5e-5)], [None, None, None]);
    assert!(with(100.0, 5e-6).unwrap().contains("a radius of gyration of 0.0002 m; expected 0.005 to 2 m"));
    assert!(with(0.1, 5.0).unwrap().contains("a radius of gyration of 7.0711 m"));
    assert!(with(100.0, 5000.0).is_some() && with(100.0, f64::NAN).is_some());
}

#[test]
fn two_points_as_one_body_have_the_reduced_mass_about_their_centre() {
    // 2 kg and 6 kg, 4 m apart along y: centre at 3 m, 2 x 6 / 8 x 16 = 24 kg m^2 across.
    let both = RigidBody::point(2.0, Vector3::zeros()).with(&RigidBody::point(6.0, Vector3::new(0.0, 4.0, 0.0)));
    assert_eq!((both.mass, both.centre.y, both.elements()), (8.0, 3.0, [24.0, 0.0, 0.0, 0.0, 0.0, 24.0]));
}
