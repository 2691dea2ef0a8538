//! What does `rank` or `place` ask whose task is a toolpath? The same as `mill`: of several robots, or at the best place of one.

use super::setting::FILTERS;
use super::{Pair, Refusal, Request, Spelling, Verb, opt};
use stiffarm::toolpath::Format;

/// Whether the text of a task names a toolpath: a file with an ending that is known, or a built-in path that is no zone.
pub(super) fn is_path(text: &str) -> bool {
    let text = text.trim();
    text.starts_with("line:") || text.starts_with("raster:") || Format::of_name(text).is_some()
}

/// The pairs as `mill` is asked them, where their task is a toolpath.
///
/// # Errors
/// Where other tasks stand beside it, or the planar model is asked for, which knows no tool.
fn of_path(verb: Verb, pairs: &[Pair]) -> Result<Option<Vec<Pair>>, Refusal> {
    if !matches!(verb, Verb::Rank | Verb::Place) {
        return Ok(None);
    }
    let is = |pair: &Pair, name: &str| {
        let setting = verb.setting(name);
        pair.name == name || pair.at == Spelling::Keyword && setting.is_some_and(|row| row.keyword() == pair.name)
    };
    let mut tasks = pairs.iter().filter(|pair| is(pair, "task"));
    let Some(path) = tasks.clone().find(|pair| pair.text.split(',').any(is_path)) else { return Ok(None) };
    let refused = |pair: &Pair, name: &str, why: &str| {
        let name = verb.setting(name).map_or_else(|| pair.name.clone(), |setting| pair.at.name(setting));
        Refusal::Unanswered { at: pair.at.clone(), name, why: why.into() }
    };
    // A built-in raster has no comma in it, and a file with one in its name would be taken for two tasks.
    if 1 < tasks.clone().count() || tasks.any(|pair| pair.text.contains(',')) {
        return Err(refused(path, "task", "has a toolpath beside other tasks; expected the path alone"));
    }
    let model = pairs.iter().find(|pair| is(pair, "model"));
    if let Some(model) = model.filter(|model| model.text.trim() != "spatial") {
        return Err(refused(model, "model", "does not go with a toolpath, which is milled with all six drives"));
    }
    let of_zones = |pair: &Pair| {
        let row = verb.settings().find(|row| is(pair, row.name) && !["task", "model"].contains(&row.name))?;
        Verb::Mill.setting(row.name).is_none().then_some(row.name)
    };
    if let Some((pair, name)) = pairs.iter().find_map(|pair| Some((pair, of_zones(pair)?))) {
        return Err(refused(pair, name, "is asked of zones and parts; it does not go with a toolpath"));
    }
    let mut asked: Vec<Pair> = pairs
        .iter()
        .filter(|pair| !is(pair, "model"))
        .map(|pair| if is(pair, "task") { Pair { name: "path".into(), ..pair.clone() } } else { pair.clone() })
        .collect();
    if verb == Verb::Rank && !pairs.iter().any(|pair| is(pair, "robots")) {
        let is_chosen = |pair: &Pair| verb.settings().any(|row| row.heading == FILTERS && is(pair, row.name));
        let text = if pairs.iter().any(is_chosen) { "all" } else { "paper" };
        asked.push(Pair { name: "robots".into(), text: text.into(), at: path.at.clone() });
    }
    Ok(Some(asked))
}

impl Request {
    /// As [`Request::read`]; of a task that is a toolpath [`Verb::Mill`] is asked, for whoever tells the answers of both.
    ///
    /// # Errors
    /// As [`Request::read`].
    pub fn of_task(verb: Verb, pairs: &[Pair], reader: Spelling) -> Result<Self, Refusal> {
        match of_path(verb, pairs)? {
            Some(pairs) => Self::read(Verb::Mill, &pairs, reader),
            None => Self::read(verb, pairs, reader),
        }
    }

    /// Several robots are ranked on a path, rather than one that mills it.
    pub fn ranks_on_path(&self) -> bool {
        self.verb == Verb::Mill && (self.is_given(opt::ROBOTS) || self.filters().next().is_some())
    }

    /// What is asked of a path is what this verb asks of one: `rank` of several robots, `place` for the best place of one.
    pub fn is_of_path(&self, verb: Verb) -> bool {
        let is_of_mill = self.verb == Verb::Mill && !self.is_dry();
        match verb {
            Verb::Rank => is_of_mill && self.ranks_on_path(),
            Verb::Place => is_of_mill && !self.ranks_on_path() && !self.is_given(opt::AT),
            _ => false,
        }
    }

    /// What chooses among robots has no meaning for one, nor with what is asked of one alone.
    pub(super) fn check_filters(&self) -> Result<(), Refusal> {
        let is_of_one = |given: &&super::Given| given.setting.excludes.contains(&"robots");
        let of_one = self.given.iter().find(is_of_one).filter(|_| self.verb == Verb::Mill);
        match self.filters().next().zip(of_one) {
            Some((filter, of_one)) => Err(Refusal::Excludes {
                at: filter.at.clone(),
                name: filter.at.name(filter.setting),
                other: of_one.at.name(of_one.setting),
            }),
            None => Ok(()),
        }
    }

    fn filters(&self) -> impl Iterator<Item = &super::Given> {
        self.given.iter().filter(|given| given.setting.heading == FILTERS)
    }
}
