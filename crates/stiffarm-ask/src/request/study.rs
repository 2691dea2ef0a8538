//! Which architectures are compared, over which tasks?

use super::opt::{self, Opt};
use super::{Refusal, Request};
use stiffarm::robot::Robot;
use stiffarm::study::{Contender, Mark, StudyOptions};
use stiffarm::task::Task;

impl Request {
    /// What a study compares; `robot` is that which is to be found among it, where one is asked for.
    ///
    /// # Errors
    /// Where two architectures or the range are missing, which have defaults; a robot without two links.
    pub fn study(&self, robot: Option<&Robot>) -> Result<StudyOptions, Refusal> {
        let compared = self.all(opt::COMPARE);
        let [first, second] = *compared.as_slice() else { return Err(self.missing(opt::COMPARE)) };
        let (k2, k3) = (self.for_both(opt::K2)?, self.for_both(opt::K3)?);
        let (mut tasks, mut mark) = (self.all(opt::TASKS), None);
        if let Some(Task { label, work: zone }) = self.get(opt::FLAT_TASK) {
            if !self.is_given(opt::TASKS) {
                tasks.clear();
            }
            let [side, _] = zone.sides();
            // Of one name two sizes may be meant: in these d multiplies what is written.
            let is_taken = tasks.iter().any(|task| task.label == label);
            let label = if is_taken { format!("{label} (--task)") } else { label };
            tasks.insert(0, Task { label, work: zone.scaled(1.0 / side) });
            let marked = robot.map(|robot| Mark::of(robot, zone)).transpose();
            mark = marked.map_err(|why| self.refused(opt::ROBOT, why.to_string()))?;
        }
        Ok(StudyOptions {
            mark,
            contenders: [
                Contender { architecture: first, k2: k2[0], k3: k3[0] },
                Contender { architecture: second, k2: k2[1], k3: k3[1] },
            ],
            tasks,
            sizes: self.all(opt::SIZES),
            ratios: self.all(opt::RATIOS),
            range: self.required(opt::RANGE)?,
        })
    }

    /// One number for both, or one each.
    fn for_both(&self, option: Opt<f64>) -> Result<[f64; 2], Refusal> {
        match *self.all(option).as_slice() {
            [both] => Ok([both, both]),
            [first, second] => Ok([first, second]),
            _ => Err(self.missing(option)),
        }
    }
}
