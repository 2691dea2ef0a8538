//! Where does a path that is followed touch anything, and how near does it come elsewhere?

use super::step::{Between, Way};
use super::{Contact, Guard, PLACES, PathClearance, Posed, nearer};
use crate::clearance::{Looked, Near};
use crate::mill::fault::MillError;
use crate::mill::follow::{Arrangement, Pushed};
use crate::parallel;
use crate::watch::Watch;

/// Stations that are looked at together: enough for all threads, and little memory.
const TOGETHER: usize = 4096;

/// Stations at which a path is looked at before it is followed.
const SOON: usize = 64;

/// What of the arm is nearest at a station and on the way to it.
struct AtStation {
    near: Option<Near>,
    /// It is nearer than was asked.
    touches: bool,
    /// The way leads straight, as the tool's does.
    is_straight: bool,
}

/// What was found so far.
#[derive(Default)]
struct Found {
    nearest: Option<Near>,
    at: Vec<Option<Near>>,
    contacts: Vec<Contact>,
    /// The last contact goes on.
    goes_on: bool,
}

impl Guard<'_> {
    /// Every station of a path that is followed, and the way to each; inner: the first station to which no straight way leads.
    ///
    /// # Errors
    /// What was stopped.
    pub(in crate::mill) fn along(
        &self,
        samples: &[Pushed],
        watch: Watch,
    ) -> Result<Result<PathClearance, usize>, MillError> {
        let tool = self.tool_along(watch)?;
        let (mut found, mut last) = (Found::default(), None);
        for (chunk, together) in samples.chunks(TOGETHER).enumerate() {
            watch.go_on()?;
            let first = chunk * TOGETHER;
            let posed = |i: usize| self.posed_arm(self.model_angles(&together[i]), first + i);
            let posed: Vec<Posed> = parallel::each_of(together.len(), posed);
            let of = |i: usize| {
                let before = if i == 0 { last } else { Some(posed[i - 1]) };
                self.at_station(samples, first + i, before.as_ref(), &posed[i])
            };
            let all = parallel::try_each_of(posed.len(), of)?;
            for (i, one) in all.into_iter().enumerate() {
                let Some(AtStation { near, touches, is_straight }) = one else { return Ok(Err(first + i)) };
                let of_tool = tool.as_ref().map(|tool| tool.near(first + i, is_straight, self.clearance));
                let (of_tool, tool_touches) = of_tool.unwrap_or_default();
                let folded = self.thick.folded(&self.model_angles(&together[i]));
                let touches = touches || tool_touches || folded.is_some();
                found.add(first + i, (nearer(nearer(near, of_tool), folded), touches), self.clearance);
            }
            last = posed.last().copied();
        }
        let Found { nearest, at, contacts, .. } = found;
        let nearest = nearest.map(|near| self.thick.clearance_of(near, None, samples.len()));
        let unavoidable = tool.and_then(|tool| tool.deepest(self));
        let misplaced = self.about.misplaced(&self.stand.base_from_part);
        let asked = self.clearance;
        Ok(Ok(PathClearance { asked, nearest, at, contacts, unavoidable, misplaced, without_wide: None }))
    }

    /// The arm touches nothing along a path that is followed: nothing is asked of what touches, as [`Self::along`] tells it. What a round tool
    /// touches it touches on every path.
    pub(in crate::mill) fn is_clear(&self, samples: &[Pushed], watch: Watch) -> Result<bool, MillError> {
        let mut last = None;
        for (chunk, together) in samples.chunks(TOGETHER).enumerate() {
            watch.go_on()?;
            let first = chunk * TOGETHER;
            let posed = |i: usize| self.posed_to_touch(self.model_angles(&together[i]), first + i, self.is_tool_round);
            let posed: Vec<Posed> = parallel::each_of(together.len(), posed);
            let touches = |i: usize| {
                let before = if i == 0 { last.as_ref() } else { Some(&posed[i - 1]) }?;
                let led = self.led(samples, first + i, [before, &posed[i]]);
                led.map_or_else(
                    |error| Some(Err(error)),
                    |(_, found)| (!matches!(found, Between::Free)).then_some(Ok(())),
                )
            };
            if posed.iter().any(|posed| self.grazes(posed)) {
                self.has_forbidden();
                return Ok(false);
            }
            if let Some(touched) = parallel::any_of(posed.len(), touches) {
                self.has_forbidden();
                return touched.map(|()| false);
            }
            last = posed.last().copied();
        }
        Ok(true)
    }

    /// Something is touched at one of some stations all over the path: a whole path need not be followed to know that.
    pub(in crate::mill) fn soon_touches(&self, of: impl Fn(usize) -> Arrangement) -> Result<bool, MillError> {
        let count = self.stations.len();
        for i in (0..count).step_by(count.div_ceil(SOON)) {
            if self.at(i, of(i))?.is_some_and(|posed| self.touches(&posed)) {
                self.has_forbidden();
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn model_angles(&self, one: &Pushed) -> [f64; 6] {
        self.arm.geometry.model_angles(&one.joints, self.arm.limits.third_axis)
    }

    /// `None` where no straight way leads to it from the station before.
    fn at_station(
        &self,
        samples: &[Pushed],
        i: usize,
        before: Option<&Posed>,
        posed: &Posed,
    ) -> Result<Option<AtStation>, MillError> {
        let touches = self.touches(posed);
        // Where an end touches that is said already.
        let Some(before) = before.filter(|before| !touches && !self.touches(before)) else {
            let is_straight = i == 0 || self.may_lead_straight(samples, i);
            return Ok(Some(AtStation { near: posed.near, touches, is_straight }));
        };
        let (way, found) = self.led(samples, i, [before, posed])?;
        let is_straight = matches!(way, Way::Straight { .. });
        Ok(match found {
            Between::Free => Some(AtStation { near: posed.near, touches: false, is_straight }),
            Between::Touch(distance, theta) => {
                let near = |near: Near| Near { distance: distance.min(near.distance), ..near };
                let on_way = self.nearest_on((&way, i), theta)?.map(near);
                Some(AtStation { near: nearer(on_way, posed.near), touches: true, is_straight })
            }
            Between::Lost => None,
        })
    }

    /// The nearest of many places of a way to a station and of one that is known, which is nearer than was asked, or hardly farther.
    fn nearest_on(&self, (way, i): (&Way, usize), known: [f64; 6]) -> Result<Option<Near>, MillError> {
        let looked = Looked { is_tool_apart: self.is_tool_apart(way), ..Looked::ALL };
        let near = |theta: [f64; 6]| self.posed_as_looked(theta, i, looked).near;
        let mut nearest = near(known);
        for place in 1..PLACES {
            let Some(theta) = way.at(self, place as f64 / PLACES as f64, &known)? else { continue };
            nearest = nearer(nearest, near(theta));
        }
        Ok(nearest)
    }

    /// Not where the arm is arranged anew in another configuration.
    fn may_lead_straight(&self, samples: &[Pushed], i: usize) -> bool {
        !self.stations[i].is_fresh || samples[i - 1].arrangement.configuration == samples[i].arrangement.configuration
    }

    /// The way to a station: straight as programs have it, and in joints where the arm is arranged anew and no straight one leads there.
    fn led(&self, samples: &[Pushed], i: usize, ends: [&Posed; 2]) -> Result<(Way, Between), MillError> {
        let [from, to] = [&samples[i - 1], &samples[i]].map(|one| one.arrangement);
        if self.may_lead_straight(samples, i) {
            let way = self.straight(i, from, to);
            let found = self.between((&way, i), ends)?;
            if !self.stations[i].is_fresh || !matches!(found, Between::Lost) {
                return Ok((way, found));
            }
        }
        let with_tool = ends.map(|end| self.posed_to_touch(end.theta, i, false));
        // Where the tool touches at an end that is said already.
        let is_tool_apart = with_tool.iter().any(|end| self.touches(end));
        let way = Way::Joints { ends: ends.map(|end| end.theta), is_tool_apart };
        let found = self.between((&way, i), if is_tool_apart { ends } else { with_tool.each_ref() })?;
        Ok((way, found))
    }

    /// From the station before to one, with the rolls of both.
    pub(super) fn straight(&self, i: usize, from: Arrangement, to: Arrangement) -> Way {
        let [before, sample] = [i - 1, i].map(|i| &self.stations[i].sample);
        let ends = [(before.pose, from.roll), (sample.pose, to.roll)];
        Way::Straight { line: sample.line, configuration: to.configuration, ends }
    }
}

impl Found {
    fn add(&mut self, station: usize, (near, touches): (Option<Near>, bool), asked: f64) {
        self.at.push(near);
        let Some(Near { distance, link, to }) = near else { return };
        if self.nearest.is_none_or(|nearest| distance < nearest.distance) {
            self.nearest = near;
        }
        let goes_on = std::mem::replace(&mut self.goes_on, touches);
        if !touches {
            return;
        }
        let contact = Contact { station, link, to, depth: asked - distance };
        match self.contacts.last_mut().filter(|last| goes_on && last.link == link && last.to == to) {
            Some(last) if contact.depth <= last.depth => {}
            Some(last) => *last = contact,
            None => self.contacts.push(contact),
        }
    }
}
