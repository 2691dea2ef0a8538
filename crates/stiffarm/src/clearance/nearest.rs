//! The nearest of many, and how far it is looked for.

use super::solid::Solid;
use super::stock::Ends;
use super::{Cutter, Link, Machined, Mesh, Near, Obstacle};
use crate::body::Capsule;
use crate::spatial::Pose;

/// How far it is looked for what is nearest, and of what.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Looked {
    /// Of what is nearer than this, m, anything does: nothing else is looked at.
    pub(crate) enough: f64,
    /// Nothing that is farther, m, is looked at.
    pub(crate) within: f64,
    /// What stands about the arm is looked at without the tool; the arm itself is not.
    pub(crate) is_tool_apart: bool,
}

impl Looked {
    pub(crate) const ALL: Self = Self { enough: f64::NEG_INFINITY, within: f64::INFINITY, is_tool_apart: false };
}

/// The nearest so far.
pub(super) struct Nearest {
    pub(super) near: Option<Near>,
    /// Nothing farther is looked at, m.
    pub(super) within: f64,
    /// What is nearer than this, m, is near enough: nothing else is looked at.
    enough: f64,
    pub(super) is_tool_apart: bool,
}

impl Nearest {
    pub(super) fn looked(Looked { enough, within, is_tool_apart }: Looked) -> Self {
        Self { near: None, within, enough, is_tool_apart }
    }

    pub(super) fn is_enough(&self) -> bool {
        self.within < self.enough
    }

    pub(super) fn take(&mut self, distance: f64, link: Link, to: Obstacle) {
        if distance < self.within {
            (self.near, self.within) = (Some(Near { distance, link, to }), distance);
        }
    }

    /// What is so far at least may be nearer than what is known.
    fn may_be(&self, at_least: f64) -> bool {
        !(self.within <= at_least)
    }

    /// Spindle and shank keep clear of all that is machined, the cutter of what holds it.
    pub(super) fn tool(&mut self, tool: &Capsule, cutter: &Cutter, about: &Machined, sample: usize) {
        let spindle = tool.cut_back(cutter.length);
        if let Some(spindle) = &spindle {
            self.machined(Link::Tool, (spindle, Ends::Flat), about, sample);
        }
        let out_of = spindle.map_or(tool.ends[0], |spindle| spindle.ends[1]);
        let cylinder = Capsule { ends: [out_of, tool.ends[1]], radius: cutter.radius };
        if let Some(shank) = cutter.thick_shank()
            && let Some(above) = cylinder.cut_back(shank.flute)
        {
            let shank = Capsule { radius: shank.diameter / 2.0, ..above };
            self.machined(Link::Shank, (&shank, Ends::Flat), about, sample);
        }
        self.fixture(Link::Cutter, (&cylinder, Ends::Flat), about);
    }

    /// As of a solid.
    pub(super) fn machined(&mut self, link: Link, (capsule, ends): (&Capsule, Ends), about: &Machined, sample: usize) {
        let Machined { pose, part, stock, .. } = about;
        if let Some(part) = part {
            self.mesh((link, capsule, ends), (part, pose), Obstacle::Part);
        }
        self.fixture(link, (capsule, ends), about);
        if let Some(stock) = stock
            && let Some(apart) = stock.apart_from((pose, sample), (capsule, ends), self.within)
        {
            self.take(apart, link, Obstacle::Stock);
        }
    }

    /// As of a solid.
    fn fixture(&mut self, link: Link, (capsule, ends): (&Capsule, Ends), about: &Machined) {
        if let Some(fixture) = &about.fixture {
            self.mesh((link, capsule, ends), (fixture, &about.pose), Obstacle::Fixture);
        }
    }

    /// As of a solid.
    fn mesh(&mut self, (link, capsule, ends): (Link, &Capsule, Ends), (mesh, pose): (&Mesh, &Pose), to: Obstacle) {
        if self.may_be(capsule.apart_from_ball(&mesh.ball(pose))) {
            let apart = match ends {
                Ends::Round => mesh.apart_from(pose, capsule),
                Ends::Flat => mesh.apart_from_cylinder(pose, capsule),
            };
            self.take(apart, link, to);
        }
    }

    /// Asks `parry` only where the ball and the box about it come nearer than what is known.
    pub(super) fn solid(&mut self, (link, capsule): (Link, &Capsule), to: Obstacle, solid: &Solid) {
        if self.may_be(capsule.apart_from_ball(&solid.ball())) && self.may_be(capsule.at_least_from(solid)) {
            self.take(capsule.apart_from_solid(solid), link, to);
        }
    }
}
