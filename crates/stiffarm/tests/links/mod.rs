//! The verbs on two links of which nothing else is known; positions count from the joint-2 axis.
#![allow(dead_code, reason = "not every test asks every verb")]

use stiffarm::load::Load;
use stiffarm::map::{Axis, Extent, Grid, MapError, MapOptions};
use stiffarm::model::Model;
use stiffarm::place::{PlaceError, PlaceOptions, Placed};
use stiffarm::plane::{Elbow, PlanarArm};
use stiffarm::task::Zone;
use stiffarm::watch::Watch;

pub(crate) fn place(arm: &PlanarArm, zone: Zone, options: &PlaceOptions) -> Result<Placed, PlaceError> {
    stiffarm::place::place(&Model::of_links(arm)?, &zone.into(), options, Watch::nobody())
}

pub(crate) fn map(arm: &PlanarArm, options: &MapOptions) -> Result<Grid, MapError> {
    Ok(stiffarm::map::map(&Model::of_links(arm)?, options)?.deflection)
}

pub(crate) fn over(x: Axis, z: Axis, load: Load, elbow: Option<Elbow>) -> MapOptions {
    MapOptions { extent: Extent::Grid { x, z }, load, elbow, held: None }
}
