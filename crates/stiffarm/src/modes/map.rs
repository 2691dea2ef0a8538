//! How slow does an arm swing first, everywhere a map has a posture for it?

use super::{HeldTool, ModesError, SwingingArm, modes};
use crate::map::{Grid, Map, MapOptions};
use crate::model::Model;
use crate::parallel;
use crate::uncertainty::Spread;

/// How slow an arm swings first over a map.
#[derive(Clone, Debug)]
pub struct FirstFrequencies {
    /// Hz.
    pub hertz: Grid,
    /// How far the least of them may be off with the stiffness of the drives, Hz; `None` where nothing says how far that may be.
    pub slowest: Option<Spread>,
}

/// The first frequency at every point of a map in space, Hz, motors held still: in the configuration and at the roll that the map has there.
///
/// `options` are those with which `model` made the map. It does not depend on where joint 1 points.
///
/// # Errors
/// A robot without masses, a tool that makes no sense, a map of two links alone.
pub fn first_frequencies(
    model: &Model,
    map: &Map,
    options: &MapOptions,
    tool: &HeldTool,
) -> Result<FirstFrequencies, ModesError> {
    let arm = SwingingArm::new(model.robot(), tool)?;
    let Model::Spatial(spatial) = model else { return Err(ModesError::NotInSpace) };
    let (x, z) = (map.deflection.x, map.deflection.z);
    let at = |cell: usize| {
        let Some(q) = map.joints(spatial, options, cell % x.count, cell / x.count) else { return Ok(f64::NAN) };
        let nothing = || ModesError::Nothing(model.robot().name.clone());
        arm.frequencies(&q)?.first().copied().ok_or_else(nothing)
    };
    let cells = parallel::try_each_of(x.count * z.count, at)?;
    let hertz = Grid::of(x, z, cells);
    let slowest = hertz.extremes().and_then(|[(_, i, j), _]| map.joints(spatial, options, i, j));
    let slowest = slowest.map(|q| modes(model.robot(), &q, tool, None)).transpose()?;
    Ok(FirstFrequencies { hertz, slowest: slowest.and_then(|swing| swing.modes.first()?.spread) })
}
