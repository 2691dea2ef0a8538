//! How slow does an arm swing first, everywhere a map has a posture for it?

use rayon::prelude::*;

use super::{HeldTool, ModesError, SwingingArm};
use crate::map::{Grid, Map, MapOptions};
use crate::model::Model;

/// The first frequency at every point of a map in space, Hz, motors held still: in the configuration and at the roll that the map has there.
///
/// `options` are those with which `model` made the map. It does not depend on where joint 1 points.
///
/// # Errors
/// A robot without masses, a tool that makes no sense, a map of two links alone.
pub fn first_frequencies(model: &Model, map: &Map, options: &MapOptions, tool: &HeldTool) -> Result<Grid, ModesError> {
    let arm = SwingingArm::new(model.robot(), tool)?;
    let Model::Spatial(spatial) = model else { return Err(ModesError::NotInSpace) };
    let (x, z) = (map.deflection.x, map.deflection.z);
    let at = |cell: usize| {
        let Some(q) = map.joints(spatial, options, cell % x.count, cell / x.count) else { return Ok(f64::NAN) };
        let nothing = || ModesError::Nothing(model.robot().name.clone());
        arm.frequencies(&q)?.first().copied().ok_or_else(nothing)
    };
    let cells = (0..x.count * z.count).into_par_iter().map(at).collect::<Result<_, ModesError>>()?;
    Ok(Grid::of(x, z, cells))
}
