//! What is asked of the places where work may stand, and of the work that is to stand there?

use super::cell::CellOptions;
use super::opt;
use super::{Angle, Given, PlaceRequest, Refusal, Request, Unsupported, Verb};
use stiffarm::cell::{Mount, Window};
use stiffarm::interval::Interval;
use stiffarm::load::Load;
use stiffarm::place::{Column, Margins, Orientation, PlaceOptions, Within};
use stiffarm::task::{Task, Work, Zone};
use stiffarm::work::{WorkPlacement, WorkPlane};

/// Of a zone that stands at one place on either side, m: for rounding.
const ROOM: f64 = 1e-9;

impl Request {
    /// The one task.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn task(&self) -> Result<Task, Refusal> {
        self.tasks().into_iter().next().ok_or_else(|| self.missing(opt::TASK))
    }

    /// The one task of a verb that knows flat zones alone.
    ///
    /// # Errors
    /// Where it is missing.
    pub fn flat_task(&self) -> Result<Task<Zone>, Refusal> {
        self.required(opt::FLAT_TASK)
    }

    /// What is machined, with the faces of parts that are asked for.
    ///
    /// # Panics
    /// Never: that parts have the faces that are asked for is checked when the request is read.
    pub fn tasks(&self) -> Vec<Task> {
        let faces = self.all(opt::FACES);
        let with_faces = |task: Task| match &task.work {
            Work::Part(part) if !faces.is_empty() => part.with_faces(&faces).expect("checked when it was read").into(),
            _ => task,
        };
        self.all(opt::TASK).into_iter().map(with_faces).collect()
    }

    /// The zone that a map places.
    pub fn zone(&self) -> Option<Task<Zone>> {
        self.get(opt::ZONE)
    }

    /// Of a rectangle.
    pub(super) fn angle(&self) -> Angle {
        self.get(opt::ANGLE).unwrap_or(Angle::Axes)
    }

    fn place_request(&self) -> PlaceRequest {
        let within = self.ahead();
        if self.is_the_papers() {
            return PlaceRequest {
                load: Load::PAPER,
                within: None,
                margins: Margins::NONE,
                angle: Angle::Axes,
                gap: None,
            };
        }
        let load = match self.verb {
            // A zone on a map of the arm plane is placed for the worst direction, whatever is mapped.
            Verb::Map => self.load().in_worst_direction(),
            // Held in the stiffest way, whatever pushes.
            Verb::Modes => Load::PAPER,
            _ => self.load(),
        };
        let within_or_anywhere = Some(within.unwrap_or(Within::ANYWHERE));
        let margins = self.margins(within);
        PlaceRequest { load, within: within_or_anywhere, margins, angle: self.angle(), gap: self.get(opt::GAP) }
    }

    /// The one window that lies ahead of the robot wherever that is turned to, where it is the only one.
    pub(super) fn ahead(&self) -> Option<Within> {
        match self.windows().as_slice() {
            [Window::Ring { ahead, z }] => Some(Within { x: *ahead, z: *z }),
            _ => None,
        }
    }

    /// What every place keeps: what was given, and what is usual.
    pub(super) fn margins(&self, within: Option<Within>) -> Margins {
        let usual = Margins::usual();
        let radians = |option, usual: f64| self.get(option).map_or(usual, f64::to_radians);
        // Whoever says where a zone may stand means it, below the base and behind the robot, too.
        // The middle alone says nothing of the floor.
        let is_low = within.is_some_and(|within| within.z.min().is_finite());
        Margins {
            limit: radians(opt::LIMIT_MARGIN_DEG, usual.limit),
            singular: radians(opt::SINGULAR_MARGIN_DEG, usual.singular),
            column: self.get(opt::CLEAR_OF_BASE_M).map_or(usual.column, Column::Radius),
            front: within.is_none() && !self.is_given(opt::AT),
            floor: self.get(opt::FLOOR).unwrap_or(usual.floor.filter(|_| !is_low)),
        }
    }

    /// What is asked of a placement of one zone, or of zones of any shape where there is none.
    ///
    /// # Errors
    /// Where the options together have no answer.
    ///
    /// # Panics
    /// Of a verb that places nothing.
    pub fn place_options(&self, zone: Option<Zone>) -> Result<PlaceOptions, Refusal> {
        self.check_process()?;
        let unanswered = |unsupported| self.unanswered(unsupported);
        let mut options = self.place_request().options(&self.model(), &self.tool_pose(), zone).map_err(unanswered)?;
        options.tool_weight = self.tool_weight();
        let windows = match *self.all(opt::AT).as_slice() {
            [x, z] => vec![self.only_place(&mut options, [x, z], zone).map_err(unanswered)?],
            _ => self.windows(),
        };
        self.cell(windows).of(&options, self.is_spatial()).map_err(unanswered)
    }

    /// Options under which the middle of a zone stands at one place, and the window that it fills there.
    fn only_place(&self, options: &mut PlaceOptions, at: [f64; 2], zone: Option<Zone>) -> Result<Window, Unsupported> {
        let zone = zone.ok_or(Unsupported::Middle)?;
        let angle = match options.orientation {
            Orientation::Axes => 0.0,
            Orientation::Fixed(angle) => angle,
            Orientation::Free => return Err(Unsupported::FreeAtOnePlace),
        };
        options.orientation = Orientation::Fixed(angle);
        let half: [f64; 2] = match &mut options.tool_orientation {
            None => zone.half_extents(angle).into(),
            Some(tool_orientation) => {
                if !tool_orientation.is_vertical() && self.tool_pose().yaw.is_none() {
                    tool_orientation.yaw = Interval::point(0.0);
                }
                if !tool_orientation.is_vertical() && 0.0 < tool_orientation.yaw.width() {
                    return Err(Unsupported::YawAtOnePlace);
                }
                let yaw = if tool_orientation.is_vertical() { 0.0 } else { tool_orientation.yaw.min() };
                let work = WorkPlacement { x: 0.0, y: 0.0, z: 0.0, yaw, angle, roll: 0.0 };
                let [x, _, z] = WorkPlane::of(tool_orientation.elevation, &work).half_extents(zone);
                [x, z]
            }
        };
        let [ahead, z] = [0, 1].map(|i| Interval::spanning(at[i] - half[i] - ROOM, at[i] + half[i] + ROOM));
        options.within = Some(Within { x: ahead, z });
        Ok(Window::Ring { ahead, z })
    }

    pub(super) fn windows(&self) -> Vec<Window> {
        self.all(opt::WITHIN)
    }

    /// How the base is mounted, where that is said.
    pub fn mount(&self) -> Option<Mount> {
        self.get(opt::MOUNT)
    }

    /// What is asked of the cell.
    pub(super) fn cell(&self, windows: Vec<Window>) -> CellOptions {
        CellOptions {
            mount: self.mount(),
            windows,
            keep_out: self.all(opt::KEEP_OUT),
            clearance: self.clearance(),
            has_floor: self.is_given(opt::FLOOR),
            is_at: self.is_given(opt::AT),
        }
    }

    /// So far, m, the arm must keep from everything, where that is asked: who names what must be kept free means the arm, too.
    fn clearance(&self) -> Option<f64> {
        let given = self.get(opt::CLEARANCE_MM).map(|mm| mm / 1e3);
        let is_meant = self.is_given(opt::KEEP_OUT) && !self.allows_contact();
        given.or_else(|| is_meant.then_some(0.0))
    }

    /// On several tasks no one knows which side is meant.
    pub(super) fn check_long_side(&self) -> Result<(), Refusal> {
        let is_long = matches!(self.angle(), Angle::Horizontal | Angle::Vertical);
        match (self.find(opt::ANGLE), self.verb.setting(opt::TASK)) {
            (Some(Given { setting, at, .. }), Some(task)) if is_long && 1 < self.tasks().len() => {
                Err(Refusal::LongSide { at: at.clone(), name: at.name(setting), task: at.name(task) })
            }
            _ => Ok(()),
        }
    }

    /// An angle turns what has sides.
    pub(super) fn check_has_sides(&self) -> Result<(), Refusal> {
        let zones = self.zone().into_iter().chain(self.get(opt::FLAT_TASK)).map(|task| Work::Zone(task.work));
        let works: Vec<Work> = self.all(opt::TASK).into_iter().map(|task| task.work).chain(zones).collect();
        let is_circle = |work: &Work| matches!(work, Work::Zone(zone) if zone.is_round());
        let has_circles_alone = !works.is_empty() && works.iter().all(is_circle);
        if has_circles_alone && self.angle() != Angle::Axes { Err(self.unanswered(Unsupported::Round)) } else { Ok(()) }
    }

    /// A part says itself how the tool meets each face, and has the faces that are asked for.
    pub(super) fn check_parts(&self) -> Result<(), Refusal> {
        let refused = |name: &str, why: &str| self.refused(name, why.into());
        let tasks = self.all(opt::TASK);
        let has_part = tasks.iter().any(|task| task.work.part().is_some());
        for name in [opt::TOOL_DIRECTION.name, opt::YAW_DEG.name] {
            if has_part && self.is_given(name) {
                return Err(refused(name, "a part says itself how the tool meets each face"));
            }
        }
        if let Some(Given { setting, at, .. }) = self.find(opt::TASK).filter(|_| has_part && !self.is_spatial()) {
            let name = format!("{} names a part with several faces, which", at.name(setting));
            return Err(Refusal::NeedsModel { at: at.clone(), name, model: at.model("spatial") });
        }
        if !self.is_given(opt::FACES) {
            return Ok(());
        }
        if !has_part {
            return Err(refused("faces", "a flat zone is one face; a part is such as box:0.8x0.5x0.1"));
        }
        for part in tasks.iter().filter_map(|task| task.work.part()) {
            part.with_faces(&self.all(opt::FACES)).map_err(|error| refused("faces", &error.to_string()))?;
        }
        Ok(())
    }
}
