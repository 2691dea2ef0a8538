use stiffarm::place::place_in_space;
#[path = "../tests/questions/mod.rs"]
mod questions;
fn main() {
    for seed in std::env::args().skip(1).map(|w| w.parse::<u64>().unwrap()) {
        let q = questions::random_question(seed);
        let t = q.options.flange_from_tool.translation.vector;
        let z = q.options.flange_from_tool.rotation * nalgebra::Vector3::z();
        println!("== {seed} {} {:?} el {:.0} yaw {:.2}..{:.2} {:?} roll {:?} tool {:.2} {:.2} {:.2} axis {:.2} {:.2} {:.2} x {:.2}..{:.2} z {:.2}..{:.2}", q.robot.name, q.zone, q.options.elevation.to_degrees(), q.options.yaw.min(), q.options.yaw.max(), q.options.orientation, q.options.roll, t.x, t.y, t.z, z.x, z.y, z.z, q.options.within.x.min(), q.options.within.x.max(), q.options.within.z.min(), q.options.within.z.max());
        if std::env::var("RUN").is_ok() {
            let start = std::time::Instant::now();
            match place_in_space(&q.robot, q.zone, &q.options).unwrap() {
                stiffarm::place::SpatiallyPlaced::Feasible(b) => println!("   gap {:.3} value {:.4e} centre {:?} yaw {:.3} angle {:.3} roll {:.3} {:?} margin {:?} sing {:.4} boxes {} time {:.2}", 1.0 - b.lower_bound / b.deflection, b.deflection/q.options.force, b.centre, b.yaw, b.angle, b.roll, b.class, b.limit_margin, b.singular_margin, b.resolution.boxes, start.elapsed().as_secs_f64()),
                o => println!("   {o:?} {:.2}", start.elapsed().as_secs_f64()),
            }
        }
    }
}
