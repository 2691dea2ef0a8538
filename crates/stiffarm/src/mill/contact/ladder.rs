//! Which nodes and edges of a ladder touch something? Those that a best path takes are looked at, and where one touches those about it; all
//! that touch are blocked, and the path is searched again, until it is clear. What was never the best is never looked at, and the path is
//! the best of all that are clear.

use std::collections::{BTreeMap, HashSet};
use std::hash::Hash;
use std::ops::Range;

use super::step::Between;
use super::touching::{Edge, OfRung, Touch};
use super::{Contact, Guard, Posed, deeper};
use crate::angle::wrapped;
use crate::clearance::{Link, Near, Obstacle};
use crate::inverse::Configuration;
use crate::mill::climb::{Climb, Goal, MOST_STEPS, Node};
use crate::mill::fault::MillError;
use crate::mill::follow::Arrangement;
use crate::mill::ladder::Ladder;
use crate::parallel;
use crate::watch::Watch;

impl Ladder<'_> {
    /// The best path, as [`Climb::path`] has it, of all that are clear; of all where nobody asked.
    pub(in crate::mill) fn clear_path(
        &mut self,
        guard: Option<&Guard>,
        (goal, most, is_wound): (Goal, f32, bool),
        watch: Watch,
    ) -> Result<Result<(Vec<Node>, f64), usize>, MillError> {
        loop {
            let found = Climb::new(self, goal, most, is_wound).path(watch)?;
            let (Some(guard), Ok((path, _))) = (guard, &found) else { return Ok(found) };
            if self.is_clear(guard, path, most)? {
                return Ok(found);
            }
            guard.has_forbidden();
            // No path needs to be searched for to know that there is none.
            if let Some(shut) =
                self.rungs.iter().position(|rung| rung.errors.iter().flatten().all(|error| most < *error))
            {
                return Ok(Err(shut));
            }
        }
    }

    /// What is touched at a station in every arrangement that holds it, where there is such a station: of the arrangement that touches least, at
    /// the station where that is deepest.
    pub(in crate::mill) fn never_clear(&self, guard: &Guard) -> Result<Option<Contact>, MillError> {
        let mut nodes: BTreeMap<usize, Vec<OfRung>> = BTreeMap::new();
        for (node, _) in &self.touching.nodes {
            nodes.entry(node.0).or_default().push(*node);
        }
        let is_shut = |k: &usize| self.rungs[*k].errors.iter().flatten().all(|error| error.is_infinite());
        let mut deepest: Option<Contact> = None;
        for (k, nodes) in nodes.into_iter().filter(|(k, _)| is_shut(k)) {
            let station = self.rungs[k].at;
            let near = |node: &OfRung| {
                let posed = guard.at(station, self.arrangement(*node))?;
                Ok::<_, MillError>(posed.and_then(|posed| guard.posed_arm(posed.theta, station).near))
            };
            let all = parallel::try_each(&nodes, near)?;
            // Where one meets nothing, all is clear.
            let Some(all) = all.into_iter().collect::<Option<Vec<Near>>>() else { continue };
            let Some(Near { distance, link, to }) = all.into_iter().max_by(|a, b| a.distance.total_cmp(&b.distance))
            else {
                continue;
            };
            deepest = deeper(deepest, Some(guard.contact(station, &Near { distance, link, to })));
        }
        Ok(deepest)
    }

    /// Takes back what was blocked.
    pub(in crate::mill) fn unblock(&mut self) {
        for ((k, held), error) in std::mem::take(&mut self.touching).nodes {
            *self.error_mut((k, held)) = error;
        }
    }

    /// Whether a path touches nothing; else what touches is blocked: its nodes, or where these are clear its edges.
    fn is_clear(&mut self, guard: &Guard, path: &[Node], most: f32) -> Result<bool, MillError> {
        let rolls = self.grid.len();
        let nodes: Vec<OfRung> =
            path.iter().enumerate().map(|(k, node)| (k, node.configuration * rolls + node.roll)).collect();
        let mut known = std::mem::take(&mut self.touching.known_nodes);
        let about = |node: &OfRung| self.about_node(*node, most);
        let touched = flood(nodes.clone(), &mut known, about, |node, beside| self.node_touch(guard, *node, beside))?;
        self.touching.known_nodes = known;
        if !touched.is_empty() {
            for node in touched {
                self.block(node);
            }
            return Ok(false);
        }
        let edges = (1..nodes.len()).filter(|k| !self.rungs[*k].is_fresh);
        let edges: Vec<Edge> = edges.map(|k| (k, nodes[k - 1].1, nodes[k].1)).collect();
        let mut known = std::mem::take(&mut self.touching.known_edges);
        let about = |edge: &Edge| self.about_edge(*edge, most);
        let touched = flood(edges, &mut known, about, |edge, _| self.edge_touch(guard, *edge))?;
        self.touching.known_edges = known;
        let is_clear = touched.is_empty();
        self.touching.edges.extend(touched);
        Ok(is_clear)
    }

    /// No path may take it any more.
    fn block(&mut self, node: OfRung) {
        let error = std::mem::replace(self.error_mut(node), f32::INFINITY);
        if error < f32::INFINITY {
            self.touching.nodes.push((node, error));
        }
    }

    fn error_mut(&mut self, (k, held): OfRung) -> &mut f32 {
        let rolls = self.grid.len();
        &mut self.rungs[k].errors[held / rolls][held % rolls]
    }

    fn may_be_taken(&self, (k, held): OfRung, most: f32) -> bool {
        let rolls = self.grid.len();
        self.rungs.get(k).is_some_and(|rung| rung.errors[held / rolls][held % rolls] <= most)
    }

    /// The node of the same configuration some steps of the roll aside.
    fn aside(&self, held: usize, steps: isize) -> usize {
        let rolls = self.grid.len();
        held - held % rolls + (held % rolls).wrapping_add_signed(steps + rolls as isize) % rolls
    }

    /// One step of the roll, or one rung, from a node.
    fn about_node(&self, (k, held): OfRung, most: f32) -> Vec<OfRung> {
        let beside = [1, -1].map(|step| (k, self.aside(held, step)));
        let mut found: Vec<OfRung> = beside.into_iter().chain([(k + 1, held), (k.wrapping_sub(1), held)]).collect();
        found.retain(|node| self.may_be_taken(*node, most));
        found
    }

    /// One step of the roll of either end, or one rung, from an edge.
    fn about_edge(&self, (k, from, to): Edge, most: f32) -> Vec<Edge> {
        let beside = [1, -1].map(|step| [(k, self.aside(from, step), to), (k, from, self.aside(to, step))]);
        let mut found: Vec<Edge> = beside.into_iter().flatten().chain([(k + 1, from, to), (k - 1, from, to)]).collect();
        found.retain(|edge| self.is_edge(*edge, most));
        found
    }

    /// A path may take it.
    fn is_edge(&self, (k, from, to): Edge, most: f32) -> bool {
        let rolls = self.grid.len();
        let apart = (from % rolls).abs_diff(to % rolls);
        0 < k
            && self.rungs.get(k).is_some_and(|rung| !rung.is_fresh)
            && apart.min(rolls - apart) <= MOST_STEPS
            && self.may_be_taken((k - 1, from), most)
            && self.may_be_taken((k, to), most)
    }

    fn arrangement(&self, (k, held): OfRung) -> Arrangement {
        let rolls = self.grid.len();
        let configuration = Configuration::ALL[held / rolls];
        Arrangement { configuration, roll: self.roll_of(&self.rungs[k], held % rolls) }
    }

    /// The stations at which the arm stands as at a node whatever nodes come before and after: the one that stands for the rung, and those from
    /// which on it is arranged anew.
    fn stations_of(&self, k: usize) -> Range<usize> {
        let rung = &self.rungs[k];
        let from = if k == 0 || rung.is_fresh { rung.samples.start } else { rung.at };
        let goes_on = self.rungs.get(k + 1).is_some_and(|next| !next.is_fresh);
        from..if goes_on { rung.at + 1 } else { rung.samples.end }
    }

    /// What a node touches, which may follow from what one beside it does.
    fn node_touch(&self, guard: &Guard, node: OfRung, beside: Option<&Touch>) -> Result<Option<Touch>, MillError> {
        let (at, stations) = (self.arrangement(node), self.stations_of(node.0));
        if let Some(beside) = beside {
            let station = if stations.contains(&beside.station) { beside.station } else { self.rungs[node.0].at };
            let found = guard.touch_beside(beside, station, at)?;
            if found.is_some() {
                return Ok(found);
            }
        }
        guard.touch_over(stations, |_| at)
    }

    fn edge_touch(&self, guard: &Guard, (k, from, to): Edge) -> Result<Option<Touch>, MillError> {
        self.touch_from(guard, k, self.arrangement((k - 1, from)), self.arrangement((k, to)))
    }

    /// What is touched at the stations of a rung that are arranged as it is, or between these.
    pub(in crate::mill) fn touch_within(
        &self,
        guard: &Guard,
        k: usize,
        at: Arrangement,
    ) -> Result<Option<Touch>, MillError> {
        guard.touch_over(self.stations_of(k), |_| at)
    }

    /// What is touched from the station that stands for the rung before to the one that stands for a rung.
    pub(in crate::mill) fn touch_from(
        &self,
        guard: &Guard,
        k: usize,
        from: Arrangement,
        mut to: Arrangement,
    ) -> Result<Option<Touch>, MillError> {
        to.roll += std::f64::consts::TAU * ((from.roll - to.roll) / std::f64::consts::TAU).round();
        let of_rung = |rung: usize| if rung < k { from } else { to };
        let stations = self.rungs[k - 1].at..self.rungs[k].at + 1;
        let rung_of = |i: usize| if i < self.rungs[k].samples.start { k - 1 } else { k };
        guard.touch_over(stations, |i| self.of_station(&of_rung, rung_of(i), i))
    }
}

impl Guard<'_> {
    /// What is touched at some stations in a row, or between them; that no posture holds one of them counts as that, too.
    fn touch_over(
        &self,
        stations: Range<usize>,
        of: impl Fn(usize) -> Arrangement,
    ) -> Result<Option<Touch>, MillError> {
        let mut before = None;
        let alone = |station| Some(Touch { station, theta: [0.0; 6], distance: f64::INFINITY });
        for i in stations {
            let at = of(i);
            let Some(posed) = self.at(i, at)? else { return Ok(alone(i)) };
            if self.grazes(&posed) {
                return Ok(Some(Touch { station: i, theta: posed.theta, distance: holds_beside(&posed) }));
            }
            if let Some((from, last)) = &before
                && !matches!(self.between((&self.straight(i, *from, at), i), [last, &posed])?, Between::Free)
            {
                return Ok(alone(i));
            }
            before = Some((at, posed));
        }
        Ok(None)
    }

    /// What touches so deep that no posture so near is clear of it, at a station.
    fn touch_beside(&self, touch: &Touch, station: usize, at: Arrangement) -> Result<Option<Touch>, MillError> {
        if self.clearance <= touch.distance {
            return Ok(None);
        }
        let sample = &self.stations[station].sample;
        let Some(theta) = self.theta(sample.line, &sample.pose, at)? else { return Ok(None) };
        let moved: f64 = (0..6).map(|i| wrapped(theta[i] - touch.theta[i]).abs() * self.farthest[i]).sum();
        let distance = touch.distance + moved;
        Ok((distance < self.clearance).then_some(Touch { station, theta, distance }))
    }
}

/// The distance of what is nearest, m, where it says something of postures beside it: stock goes as it is cut, and of flat ends it is not known how
/// deep they are.
fn holds_beside(posed: &Posed) -> f64 {
    let of_tool = |link: Link| matches!(link, Link::Tool | Link::Cutter | Link::Shank);
    let near = posed.near.filter(|near| near.to != Obstacle::Stock && !of_tool(near.link));
    near.map_or(f64::INFINITY, |near| near.distance)
}

/// What touches of some places, and of all that lie about those that touch, as far as it was not known before.
fn flood<T: Copy + Eq + Hash + Send + Sync>(
    from: Vec<T>,
    known: &mut HashSet<T>,
    about: impl Fn(&T) -> Vec<T>,
    touch: impl Fn(&T, Option<&Touch>) -> Result<Option<Touch>, MillError> + Sync,
) -> Result<Vec<T>, MillError> {
    let mut found = Vec::new();
    let mut front: Vec<(T, Option<Touch>)> = from.into_iter().map(|place| (place, None)).collect();
    while !front.is_empty() {
        front.retain(|(place, _)| known.insert(*place));
        let of =
            |(place, beside): &(T, Option<Touch>)| touch(place, beside.as_ref()).map(|touch| Some((*place, touch?)));
        let all: Vec<(T, Touch)> = parallel::try_each(&front, of)?.into_iter().flatten().collect();
        front =
            all.iter().flat_map(|(place, touch)| about(place).into_iter().map(|next| (next, Some(*touch)))).collect();
        found.extend(all.into_iter().map(|(place, _)| place));
    }
    Ok(found)
}
