//! Drilling cycles, hole by hole, as the moves they stand for.

use nalgebra::Vector3;

use super::super::fault::Wrong;
use super::super::moves::MoveKind;
use super::super::options::IncrementalCycles;
use super::arcs::Plane;
use super::codes::named;
use super::machine::Machine;

/// No block of a real program repeats a cycle, or pecks, more often, all its holes together.
const MOST: f64 = 10_000.0;

/// What holds from hole to hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    code: u16,
    /// Where the tool stood along the normal when the cycle began, m.
    initial: f64,
    /// R and Z as they were given, m.
    raw: [Option<f64>; 2],
    /// R and Z as levels, m, where they hold as such.
    levels: [Option<f64>; 2],
    peck: Option<f64>,
    /// I, J, K of back boring, m.
    offsets: [Option<f64>; 3],
}

/// What a block says of a hole, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hole {
    pub(super) plane: Plane,
    /// Along X, Y and Z.
    pub(super) words: [Option<f64>; 3],
    pub(super) r: Option<f64>,
    pub(super) q: Option<f64>,
    pub(super) offsets: [Option<f64>; 3],
    /// How often.
    pub(super) repeats: Option<f64>,
    pub(super) is_incremental: bool,
    pub(super) returns_to_r: bool,
    /// The origin of the program's coordinates, m.
    pub(super) origin: [f64; 3],
    pub(super) feed: Option<f64>,
    pub(super) how: Option<IncrementalCycles>,
}

impl Cycle {
    /// A cycle begins; what another one before it said of R, Z and Q goes on.
    pub(super) fn begun(code: u16, initial: f64, before: Option<Self>) -> Self {
        match before {
            Some(before) => Self { code, ..before },
            None => Self { code, initial, raw: [None; 2], levels: [None; 2], peck: None, offsets: [None; 3] },
        }
    }

    fn name(&self) -> String {
        named('G', self.code)
    }

    /// Makes the moves of one block.
    ///
    /// # Errors
    /// What is missing, makes no sense, or means different things to different makers.
    pub(super) fn drill(&mut self, hole: &Hole, machine: &mut Machine, line: usize) -> Result<(), Wrong> {
        let [a, b, n] = hole.plane.axes();
        let name = self.name();
        let wrong = |why: String| Wrong::new(name.clone(), why);
        if hole.is_incremental && hole.how.is_none() {
            return Err(wrong(
                "makers differ in what R and Z of a cycle count from under G91; say incremental-cycles nist, r-plane or initial"
                    .into(),
            ));
        }
        self.peck = hole.q.or(self.peck);
        for axis in 0..3 {
            self.offsets[axis] = hole.offsets[axis].or(self.offsets[axis]);
        }
        self.take(hole, n);
        let repeats = hole.repeats.unwrap_or(1.0);
        if repeats.fract() != 0.0 || !(0.0..=MOST).contains(&repeats) {
            return Err(wrong(format!("{repeats} repeats; expected a whole number up to {MOST}")));
        }
        machine.axis_to = hole.plane.normal();
        if hole.plane != Plane::Xy {
            machine.notes.assume(line, &format!("under {} a cycle has the tool along its normal", hole.plane.code()));
        }
        for axis in 0..3 {
            machine.counted_from(axis, line, &name)?;
        }
        // Every repeat is as deep as the first one.
        let [r, z] = self.levels_now(hole, machine.tip[n], n);
        let r = r.ok_or_else(|| wrong("R is missing: the level from which the tool feeds".into()))?;
        let z = z.ok_or_else(|| wrong("the depth is missing".into()))?;
        if !(z < r) {
            return Err(wrong(format!("it ends at {:.4} mm, above R at {:.4} mm", z * 1e3, r * 1e3)));
        }
        let above = if hole.how == Some(IncrementalCycles::Nist) { machine.tip[n] } else { self.initial };
        let clear = if hole.returns_to_r { r } else { r.max(above) };
        for _ in 0..repeats as usize {
            let mut at = machine.tip;
            for axis in [a, b] {
                if let Some(word) = hole.words[axis] {
                    at[axis] = if hole.is_incremental { at[axis] + word } else { word + hole.origin[axis] };
                }
            }
            self.hole(hole, machine, line, &Levels { at, n, r, z, clear })?;
        }
        Ok(())
    }

    /// R and Z of a block, as they were given and as levels.
    fn take(&mut self, hole: &Hole, n: usize) {
        let given = [hole.r, hole.words[n]];
        let base = hole.origin[n];
        for (raw, given) in self.raw.iter_mut().zip(given) {
            *raw = given.or(*raw);
        }
        let from_r = hole.how == Some(IncrementalCycles::FromR);
        if let Some(r) = given[0] {
            self.levels[0] = Some(r + if hole.is_incremental { self.initial } else { base });
        }
        if let Some(z) = given[1] {
            let from = if from_r { self.levels[0].unwrap_or(self.initial) } else { self.initial };
            self.levels[1] = Some(z + if hole.is_incremental { from } else { base });
        }
    }

    fn levels_now(&self, hole: &Hole, now: f64, n: usize) -> [Option<f64>; 2] {
        if hole.how != Some(IncrementalCycles::Nist) {
            return self.levels;
        }
        let [r, z] = self.raw;
        if !hole.is_incremental {
            return [r, z].map(|raw| raw.map(|raw| raw + hole.origin[n]));
        }
        let r = r.map(|r| now + r);
        [r, r.zip(z).map(|(r, z)| r + z)]
    }

    fn hole(&self, hole: &Hole, machine: &mut Machine, line: usize, levels: &Levels) -> Result<(), Wrong> {
        let name = self.name();
        let Levels { at, n, r, z, clear } = *levels;
        let level = |mut p: Vector3<f64>, height: f64| {
            p[n] = height;
            p
        };
        let rapid = |machine: &mut Machine, to| machine.go(line, (MoveKind::Rapid, &name), to, [true; 3], None);
        let feed = |machine: &mut Machine, to| {
            if hole.feed.is_none() {
                return Err(Wrong::new(name.clone(), "no feed rate: expected F in this or an earlier block"));
            }
            machine.go(line, (MoveKind::Feed, &name), to, [true; 3], hole.feed)
        };
        if machine.tip[n] < r {
            rapid(machine, level(machine.tip, r))?;
        }
        if self.code == 870 {
            return self.back_bore(hole, machine, line, levels);
        }
        rapid(machine, level(at, machine.tip[n]))?;
        rapid(machine, level(at, r))?;
        match self.code {
            830 => {
                let repeats = hole.repeats.unwrap_or(1.0);
                let peck = self.peck.filter(|peck| 0.0 < *peck && (r - z) / peck * repeats <= MOST);
                let peck = peck.ok_or_else(|| {
                    Wrong::new(
                        name.clone(),
                        format!(
                            "Q is missing or too small; expected the depth of a peck, at most {MOST} pecks in all holes of the block"
                        ),
                    )
                })?;
                let mut depth = r;
                while z < depth {
                    let from = depth;
                    depth = (depth - peck).max(z);
                    if from < r {
                        rapid(machine, level(at, r))?;
                        rapid(machine, level(at, from))?;
                    }
                    feed(machine, level(at, depth))?;
                }
            }
            730 => {
                machine.notes.assume(line, "G73 feeds down in one: its short retracts are left out");
                feed(machine, level(at, z))?;
            }
            // Tapping, boring and reaming come out at the feed rate.
            740 | 840 | 850 | 890 => {
                feed(machine, level(at, z))?;
                feed(machine, level(at, r))?;
            }
            _ => feed(machine, level(at, z))?,
        }
        rapid(machine, level(at, clear))
    }

    /// G87 of RS274/NGC: down beside the hole, in at the bottom, up to K and back, out the same way.
    fn back_bore(&self, hole: &Hole, machine: &mut Machine, line: usize, levels: &Levels) -> Result<(), Wrong> {
        let name = self.name();
        let Levels { at, n, r, z, clear } = *levels;
        let [a, b, _] = hole.plane.axes();
        let [Some(i), Some(j), Some(k)] = [self.offsets[a], self.offsets[b], self.offsets[n]] else {
            let why = "makers differ in back boring; only that of RS274/NGC with I, J and K is known";
            return Err(Wrong::new(name, why));
        };
        let middle = if hole.is_incremental { z + k } else { k + hole.origin[n] };
        let mut beside = at;
        beside[a] += i;
        beside[b] += j;
        let level = |mut p: Vector3<f64>, height: f64| {
            p[n] = height;
            p
        };
        let ways = [
            (MoveKind::Rapid, level(beside, machine.tip[n])),
            (MoveKind::Rapid, level(beside, r)),
            (MoveKind::Rapid, level(beside, z)),
            (MoveKind::Rapid, level(at, z)),
            (MoveKind::Feed, level(at, middle)),
            (MoveKind::Feed, level(at, z)),
            (MoveKind::Rapid, level(beside, z)),
            (MoveKind::Rapid, level(beside, clear)),
            (MoveKind::Rapid, level(at, clear)),
        ];
        for (kind, to) in ways {
            let feed = hole.feed.filter(|_| kind == MoveKind::Feed);
            if kind == MoveKind::Feed && feed.is_none() {
                return Err(Wrong::new(name, "no feed rate: expected F in this or an earlier block"));
            }
            machine.go(line, (kind, &name), to, [true; 3], feed)?;
        }
        Ok(())
    }
}

/// Where a hole is: above it the tool moves to `at`, along axis `n` between the levels.
#[derive(Clone, Copy, Debug)]
struct Levels {
    at: Vector3<f64>,
    n: usize,
    r: f64,
    z: f64,
    clear: f64,
}
