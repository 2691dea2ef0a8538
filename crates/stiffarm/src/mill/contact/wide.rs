//! Where nobody knows how thick the links of an arm are: how near do bodies come, inside of which nine known arms in ten lie, and on which path do
//! these touch nothing?

use super::{Bodies, Guard};
use crate::clearance::Clearance;
use crate::mill::fault::{Blocked, MillError, Why};
use crate::mill::follow::Stand;
use crate::mill::ladder::Ladder;
use crate::mill::solve::{Question, ROLLS};
use crate::mill::{Followed, Milled, PathClearance, worst};
use crate::watch::Watch;

impl Question<'_> {
    /// With how near wide bodies come; where these touch something, the best path over a ladder, or one that is made, on which they touch nothing, if
    /// there is one. What is proved of all paths holds for that one, too.
    pub(in crate::mill) fn clear_by_wide_bodies(
        &self,
        found: Followed,
        (stand, ladder): (&Stand, Option<Ladder>),
        watch: Watch,
    ) -> Result<Milled, MillError> {
        let [known, wide, all] = [Bodies::Known, Bodies::Wide, Bodies::All].map(|bodies| self.guard(stand, bodies));
        let (Some(known), Some(wide), Some(all)) = (known, wide, all) else { return Ok(Milled::Followed(found)) };
        let found = match self.with_wide(found, &wide, watch)? {
            Ok((found, may_touch)) if may_touch && !found.touches() => found,
            found => return Ok(found.map_or_else(Milled::Blocked, |(found, _)| Milled::Followed(found))),
        };
        let mut ladder = ladder.map_or_else(|| self.ladder(stand, ROLLS[0], watch), Ok)?;
        ladder.unblock();
        let Ok(samples) = self.over(&mut ladder, stand, Some(&all), watch)? else { return Ok(Milled::Followed(found)) };
        // What is followed clear of all bodies is so clear of some of them.
        let Ok(along) = known.along(&samples, watch)? else { return Ok(Milled::Followed(found)) };
        let without_wide = Some(found.worst.0).filter(|better| *better < worst(&samples).0);
        let along = PathClearance { without_wide, ..along };
        let clear = self.followed(samples, found.lower_bound, Some(along));
        let clear = self.with_wide(clear, &wide, watch)?;
        Ok(clear.map_or_else(Milled::Blocked, |(clear, _)| Milled::Followed(clear)))
    }

    /// Inner: whether they come nearer to something than was asked; where no straight way leads on.
    fn with_wide(
        &self,
        mut found: Followed,
        wide: &Guard,
        watch: Watch,
    ) -> Result<Result<(Followed, bool), Blocked>, MillError> {
        let PathClearance { nearest, contacts, .. } = match wide.along(&found.samples, watch)? {
            Ok(along) => along,
            Err(at) => return Ok(Err(wide.stand.blocked(&self.stations[at].sample, Why::Jump))),
        };
        if let Some(known) = found.clearance.as_mut().and_then(|known| known.nearest.as_mut()) {
            known.wide = nearest.as_ref().map(Clearance::near);
        }
        Ok(Ok((found, !contacts.is_empty())))
    }
}
