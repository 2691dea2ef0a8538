//! Is every text either rows of finite numbers, of which an identification says what it can without a panic, or a list of faults with reasons?

use std::sync::LazyLock;

use stiffarm::catalogue::find;
use stiffarm::catalogue::measurements::{Marker, Points, read, read_planned};
use stiffarm::identify::{Options, identify};
use stiffarm::prior::with_prior;
use stiffarm::robot::Robot;
use stiffarm::watch::Watch;

/// More rows say nothing new, and take long.
const MOST: usize = 40;

static ROBOT: LazyLock<Robot> = LazyLock::new(|| {
    let found = find("KR 210 R2700 extra").expect("in the catalogue").robot();
    with_prior(&found).expect("its size is known")
});

/// Panics where the promise is broken.
pub(crate) fn holds(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let named = |name: &str, at: [f64; 3]| Marker { name: Some(name.into()), at };
    let points = [
        Points::default(),
        Points {
            load: Some([0.0, 0.1, 0.2]),
            markers: vec![named("top", [0.1, 0.0, 0.2]), named("side", [0.0, 0.2, 0.1])],
        },
    ];
    for points in &points {
        for reader in [read, read_planned] {
            match reader(text, "fuzz.csv", points) {
                Ok(found) => {
                    assert!(!found.readings.is_empty(), "read without rows");
                    for reading in &found.readings {
                        let numbers = reading.q.iter().chain(reading.load.0.iter()).chain(reading.moved.iter());
                        assert!(numbers.chain(reading.sigma.iter()).all(|number| number.is_finite()), "{reading:?}");
                    }
                }
                Err(faults) => {
                    assert!(!faults.faults.is_empty(), "refused without a reason");
                    assert!(faults.faults.iter().all(|fault| !fault.message.is_empty()));
                }
            }
        }
        if let Ok(found) = read(text, "fuzz.csv", points)
            && found.readings.len() <= MOST
        {
            for with_prior in [false, true] {
                let options = Options { with_prior, ..Options::default() };
                if let Ok(found) = identify(&ROBOT, &found, &options, Watch::nobody()) {
                    let k = found.robot.drive_compliance();
                    assert!(k.iter().flatten().all(|k| k.is_finite() && 0.0 <= *k), "{k:?}");
                }
            }
        }
    }
}
