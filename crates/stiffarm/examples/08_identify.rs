//! How stiff are the drives of a robot of which deflections were measured?
//!
//! `cargo run --example 08_identify`

use stiffarm::catalogue::measurements::{self, Points};
use stiffarm::catalogue::read;
use stiffarm::identify::{Options, identify};
use stiffarm::watch::Watch;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot = read(include_str!("../../../docs/examples/fanuc_r2000ic.toml"), "fanuc_r2000ic.toml")?;
    let table = include_str!("../../../docs/examples/fanuc_r2000ic.csv");
    let points = Points { load: Some([0.0069, 0.2453, 0.3193]), markers: Vec::new() };
    let measured = measurements::read(table, "fanuc_r2000ic.csv", &points)?;
    let found = identify(&robot, &measured, &Options::default(), Watch::nobody())?;
    for one in &found.estimates {
        let [k, error] = [one.compliance, one.standard_error].map(|x| 1e6 * x.unwrap_or(f64::NAN));
        let says = if one.unknown.is_none() { "identified" } else { "not identified" };
        println!("{}: {k:.2} +- {error:.2} urad/(N m), {says}", one.spring.name());
    }
    println!("explained {:.1} %, outliers {:?}", 100.0 * found.explained(), found.outliers);
    Ok(())
}
