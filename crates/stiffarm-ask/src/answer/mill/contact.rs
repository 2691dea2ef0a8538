//! What is reported of what the arm touches along a path.

use std::ops::Range;

use serde_json::json;

use super::super::words::{bodies, clearance_between, is_of_arm, links_are};
use super::super::{Datum, Line, Record, field, fixed, line, shape};
use super::MillAnswer;
use stiffarm::clearance::{Clearance, Link, LinksBy, Misplaced, Obstacle};
use stiffarm::mill::{ClearOf, Contact, PathClearance};

/// So many contacts are shown to people.
const MOST_SHOWN: usize = 6;
/// What overlaps, loud.
const COLLISION: &str = "COLLISION";

/// Work that stands where nothing may, in words.
fn reaches(Misplaced { what, into, depth }: &Misplaced) -> String {
    let depth = fixed(depth * 1e3, 0);
    match into {
        Obstacle::Floor => {
            format!("the {what} stands up to {depth} mm below the floor (--floor and --mount say where that is)")
        }
        _ => format!("the {what} reaches up to {depth} mm into {into}"),
    }
}

fn misplaced(Misplaced { what, into, depth }: &Misplaced) -> Record {
    let mut record = Record::of(&shape::MISPLACED);
    record.put(field::BODIES, format!("{what} to {into}")).put(field::CONTACT_DEPTH, *depth);
    record
}

impl MillAnswer {
    /// How near the arm comes to anything; `None` where the path is not followed, or nobody asked.
    pub fn clearance(&self) -> Option<&PathClearance> {
        self.followed()?.clearance.as_ref()
    }

    /// The deepest contact, where there is one.
    pub fn deepest(&self) -> Option<&Contact> {
        self.clearance()?.contacts.iter().max_by(|a, b| a.depth.total_cmp(&b.depth))
    }

    /// Stretches of the path that are nearer to something than was asked, as stations: each begins where the way to the first that is leaves the one before.
    pub fn touching(&self) -> Vec<Range<usize>> {
        let Some(found) = self.clearance() else { return Vec::new() };
        let touches = |i: &usize| found.at[*i].is_some_and(|near| near.distance < found.asked);
        let near: Vec<usize> = (0..found.at.len()).filter(touches).collect();
        near.chunk_by(|a, b| a + 1 == *b).map(|run| run[0].saturating_sub(1)..run[run.len() - 1] + 1).collect()
    }

    /// What such a stretch is called.
    pub fn touching_is_called(&self) -> String {
        match self.clearance().map_or(0.0, |found| found.asked) {
            0.0 => "touches".into(),
            asked => format!("nearer than {} mm", fixed(asked * 1e3, 1)),
        }
    }

    /// What of the work stands deepest where nothing may.
    fn misplaced(&self) -> Option<&Misplaced> {
        self.clearance()?.misplaced.iter().max_by(|a, b| a.depth.total_cmp(&b.depth))
    }

    /// Why no program is written, where that is because the work stands where it may not, or the arm touches something.
    pub(super) fn forbidding_contact(&self) -> Option<String> {
        if let Some(misplaced) = self.misplaced().filter(|_| !self.allows_contact) {
            let what = reaches(misplaced);
            return Some(format!("{what}; another place may keep clear, allow-contact takes it as it is"));
        }
        let deepest = self.deepest().filter(|_| !self.allows_contact)?;
        if let Some(unavoidable) = self.unavoidable_sentence() {
            return Some(format!("{unavoidable}; another place may keep clear, allow-contact takes it as it is"));
        }
        Some(format!(
            "{}; another place or roll may keep clear, allow-contact takes it as it is",
            self.sentence(deepest)
        ))
    }

    /// What a program says of contacts that are allowed, or that may be where bodies are estimated.
    pub(super) fn contact_remark(&self) -> Option<String> {
        let found = self.clearance()?;
        let touched = self.misplaced().map(reaches).or_else(|| self.deepest_sentence());
        if let Some(touched) = touched {
            return self.allows_contact.then(|| format!("WARNING: written although {touched}."));
        }
        let wide = found.nearest?.wide.filter(|wide| wide.distance < found.asked && is_of_arm(wide.link))?;
        let bodies = bodies(wide.link, wide.to);
        Some(format!("WARNING: links are estimated, and {bodies} may touch or come nearer than was asked."))
    }

    /// Loud, as places tell it: what overlaps, and what is nearer than was asked.
    fn called(&self, contact: Option<&Contact>) -> &'static str {
        let asked = self.clearance().map_or(0.0, |found| found.asked);
        if contact.is_some_and(|contact| asked < contact.depth) { COLLISION } else { "TOO NEAR" }
    }

    /// One contact in words.
    fn sentence(&self, contact: &Contact) -> String {
        let sample = &self.stations[contact.station].sample;
        let at = if sample.line == 0 { String::new() } else { format!("line {}, ", sample.line) };
        let asked = self.clearance().map_or(0.0, |found| found.asked);
        let how = if asked < contact.depth {
            format!("they overlap by {} mm", fixed((contact.depth - asked) * 1e3, 1))
        } else if 0.0 < contact.depth {
            format!("{} mm apart, {} mm asked", fixed((asked - contact.depth) * 1e3, 1), fixed(asked * 1e3, 1))
        } else {
            let of = if asked == 0.0 { "a touch".into() } else { format!("less than {} mm", fixed(asked * 1e3, 1)) };
            format!("{} mm apart, which is not distinguished from {of}", fixed((asked - contact.depth) * 1e3, 1))
        };
        format!("{at}{} mm along the path, {}: {how}", fixed(sample.way * 1e3, 1), bodies(contact.link, contact.to))
    }

    /// What is touched whatever the roll, in words, where such a thing is known.
    fn unavoidable_sentence(&self) -> Option<String> {
        let unavoidable = self.clearance()?.unavoidable.as_ref()?;
        Some(format!("at every roll {}, at best", self.sentence(unavoidable)))
    }

    /// How near the arm comes, and what it touches; nothing of an answer that there is not.
    pub(super) fn put_clearance(answer: Option<&Self>, record: &mut Record) {
        let found = answer.and_then(Self::clearance);
        let contact = |contact: &Contact| answer.map(|answer| answer.contact(contact));
        let nearest = found.and_then(|found| found.nearest.as_ref());
        let wide = nearest.and_then(|nearest| nearest.wide);
        let by = nearest.map(|nearest| {
            let of_arm = match nearest {
                Clearance { link: Link::Cutter | Link::Shank, .. } => &["stated"][..],
                Clearance { links: LinksBy::Enclosing, is_estimated: false, .. } => &["enclosing"],
                // The tool.
                Clearance { links: LinksBy::Enclosing, .. } => &["enclosing", "estimated"],
                Clearance { is_estimated: true, .. } => &["estimated"],
                _ => &["stated"],
            };
            let other = match nearest.to {
                Obstacle::KeepOut(_) => Some("keep-out"),
                Obstacle::Part | Obstacle::Fixture => Some("mesh"),
                Obstacle::Stock => Some("stock"),
                _ => None,
            };
            json!(of_arm.iter().copied().chain(other).collect::<Vec<_>>())
        });
        record
            .put(field::CLEARANCE, nearest.map(|nearest| nearest.distance))
            .put(field::CLEARANCE_OF, nearest.map(|nearest| bodies(nearest.link, nearest.to)))
            .put(field::CLEARANCE_BY, by)
            .put(field::CLEARANCE_OUTSIDE, nearest.map(|nearest| nearest.outside))
            .put(field::CLEARANCE_WIDE, wide.map(|wide| wide.distance))
            .put(field::CLEARANCE_WIDE_OF, wide.map(|wide| bodies(wide.link, wide.to)))
            .put(field::ERROR_WITHOUT_WIDE, found.and_then(|found| found.without_wide))
            .put(field::ASKED_CLEARANCE, answer.and_then(|answer| Some(answer.options.clear_of.as_ref()?.clearance)))
            .put(field::CONTACTS, found.map(|found| found.contacts.iter().filter_map(contact).collect::<Datum>()))
            .put(field::UNAVOIDABLE, found.and_then(|found| found.unavoidable.as_ref()).and_then(contact))
            .put(field::MISPLACED, found.map(|found| found.misplaced.iter().map(misplaced).collect::<Datum>()));
    }

    fn contact(&self, contact: &Contact) -> Record {
        let sample = &self.stations[contact.station].sample;
        let mut record = Record::of(&shape::PATH_CONTACT);
        record
            .put(field::LINE, sample.line)
            .put(field::CONTACT_WAY, sample.way)
            .put(field::BODIES, bodies(contact.link, contact.to))
            .put(field::CONTACT_DEPTH, contact.depth);
        record
    }

    /// For people; loud where something is touched.
    pub(super) fn clearance_lines(&self) -> Vec<Line> {
        let Some(found) = self.clearance() else { return Vec::new() };
        let nearest = found.nearest.as_ref().map(|nearest| {
            let apart = fixed(nearest.distance * 1e3, 0);
            line(
                "clearance",
                format!("{apart} mm at {} samples and between them, {}", nearest.poses, clearance_between(nearest)),
            )
        });
        let without_wide = found.without_wide.map(|error| {
            let error = fixed(error * 1e3, 4);
            line("without that", format!("{error} mm, along a path on which bodies that hold nine arms in ten come nearer; measured links (the robot file) may allow it"))
        });
        let unavoidable =
            self.unavoidable_sentence().map(|sentence| line(self.called(found.unavoidable.as_ref()), sentence));
        let others = || found.contacts.iter().filter(|contact| Some(*contact) != found.unavoidable.as_ref());
        let contacts =
            others().take(MOST_SHOWN).map(|contact| line(self.called(Some(contact)), self.sentence(contact)));
        let more = others().count().saturating_sub(MOST_SHOWN);
        let more = (0 < more).then(|| line("", format!("and {more} more")));
        let misplaced = found.misplaced.iter().map(|misplaced| line(COLLISION, reaches(misplaced)));
        misplaced.chain(nearest).chain(without_wide).chain(unavoidable).chain(contacts).chain(more).collect()
    }

    /// Which collisions were looked for, and which were not.
    pub(super) fn looked_at(&self) -> String {
        let Some(clear_of) = &self.options.clear_of else {
            return "between samples nothing is looked at; collisions of the arm with part, floor and cell are not looked for".into();
        };
        let ClearOf { part, stock, fixture, cutter, .. } = clear_of;
        let named = |all: &[(&'static str, bool)]| {
            let named: Vec<&str> = all.iter().filter_map(|(name, is_named)| is_named.then_some(*name)).collect();
            named.join(" and ")
        };
        let (part, stock, fixture) = (part.is_some(), stock.is_some(), fixture.is_some());
        let is_bare = !part && !stock;
        let unknown =
            named(&[("part", is_bare), ("the block that is cut away", part && !stock), ("fixtures", !fixture)]);
        let mut notes = Vec::new();
        if cutter.is_none() && !(is_bare && !fixture) {
            notes.push(format!(
                "how far the cutter stands out of the spindle is not known (stick-out-mm), so that the tool is not compared with the {}",
                named(&[("part", part), ("stock", stock), ("fixture", fixture)])
            ));
        } else if !is_bare {
            notes.push(format!("the cutter may touch the {}", named(&[("part", part), ("stock", stock)])));
        }
        if fixture && cutter.is_some_and(|cutter| cutter.radius == 0.0) {
            notes.push(
                "how thick the cutter is is not known (process), so that its axis alone keeps clear of the fixture"
                    .into(),
            );
        }
        let unknown = match (unknown.is_empty(), fixture) {
            (true, _) => String::new(),
            (false, true) => format!("{unknown} is not known, and "),
            (false, false) => format!("{unknown} are not known, and "),
        };
        notes.push(format!("{unknown}the first move of a program, in joints, is checked by nobody"));
        let notes = notes.join("; ");
        format!("clearance: {}, at every sample and between them; {notes}", links_are(&self.robot))
    }

    /// What a manager would read of it.
    pub(in crate::answer) fn contact_sentence(&self) -> Option<String> {
        if let Some(misplaced) = self.misplaced() {
            return Some(format!("{COLLISION} of the work: {}.", reaches(misplaced)));
        }
        Some(format!("{} of {}: {}.", self.called(self.deepest()), self.robot.full_name(), self.deepest_sentence()?))
    }

    /// The deepest contact in words, where there is one.
    pub(crate) fn deepest_sentence(&self) -> Option<String> {
        self.deepest().map(|deepest| self.sentence(deepest))
    }
}
