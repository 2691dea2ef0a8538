"""Toolpaths, and robots that mill them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import numpy as np

from .. import types
from .._asked import Question, text
from .._given import Array
from .._stiffarm import StiffarmError
from .base import Table


#: Endings of files that are written back in their own format.
_REWRITTEN = (".nc", ".gcode", ".ngc", ".tap", ".apt", ".cls")


class Force(Table[types.ForceDict]):
    """The force of a process on its tool: along the feed, across (left of the feed), axial (away from the work)."""

    _arrays = ("mean_n", "max_n", "min_n")

    # Keys, written from the tables of the library.
    schema: types.Schema

    process: str
    """The process file."""

    law: str
    """Where the force comes from."""

    material: str | None
    """The material whose numbers come with the program; null where they are given."""

    material_status: str | None
    """How well its numbers are known: published or unverified."""

    material_source: str | None
    """Who says so."""

    mean_n: Array | None
    """Mean force over a revolution, on the tool: along the feed, across (left of it), axial (away from the
    work); null where it may point anywhere."""

    max_n: Array | None
    """The largest of each over a revolution."""

    min_n: Array | None
    """The smallest of each over a revolution."""

    largest_n: float
    """The largest size of the force over a revolution."""

    moment_nm: float
    """Mean moment on the tool about its axis, positive about the axis away from the work."""

    power_w: float | None
    """Mean power of the spindle; null where its speed or the moment is not known."""

    spindle_rpm: float | None
    """Speed of the spindle."""

    entry_deg: float | None
    """Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns
    counter-clockwise from its right."""

    exit_deg: float | None
    """Where a tooth leaves."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""
    # End of the keys.

    def _words(self) -> str:
        mean = "in any direction" if self.mean_n is None else f"mean {np.round(self.mean_n, 2).tolist()} N"
        return f"{self.process}: {mean}, at most {self.largest_n:.2f} N"


class Toolpath(Table[types.ToolpathDict]):
    """What is understood of a toolpath."""

    _arrays = ("box_m",)

    # Keys, written from the tables of the library.
    schema: types.Schema

    path: str
    """The toolpath as it was asked for."""

    format: str
    """How it is written: gcode, apt, csv or built-in."""

    lines: int | None
    """Lines that were read."""

    feed_length_m: float
    """Length of all moves at a feed rate."""

    rapid_length_m: float
    """Length of all rapid moves whose beginning is known."""

    feed_moves: int
    """Moves at a feed rate."""

    rapid_moves: int
    """Rapid moves whose beginning is known."""

    tools: list[int | None]
    """Numbers of the tools that feed, in the order in which they come; null where none is named."""

    machine_moves: int
    """Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine."""

    arcs: int
    """Feed moves that are arcs or helices."""

    full_circles: int
    """Of these, those of a whole turn or more."""

    arc_length_m: float
    """Length of the arcs."""

    box_m: Array | None
    """Two corners of the box about all feed moves, in the axes of the path."""

    rapid_box_m: list[list[float]] | None
    """Two corners of the box about the ends of all rapid moves whose beginning is known, in the axes of the
    path; null where there is none."""

    feed_mm_per_min: list[float] | None
    """The smallest and the largest feed rate; null where none is said."""

    time_s: float | None
    """Time of all feed moves; null where a feed rate is missing."""

    spindle_speeds_rpm: list[float] | None
    """The slowest and the fastest that the spindle turns while it feeds; null where it is not said."""

    tilt_deg: float
    """The largest angle between tool axis and z while it feeds."""

    turn_deg: float
    """The largest angle of the tool axis to where it first feeds."""

    samples: int
    """Samples along the path."""

    chord_error_mm: float
    """By how much chords between samples are off the arcs at most."""

    arc_miss_mm: float
    """By how much the ends of an arc miss one radius at most."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""

    ignored: list[str]
    """Words of the file that move nothing, each kind once."""
    # End of the keys.

    def _words(self) -> str:
        return f"{self.path}: {self.feed_moves} feed moves, {self.feed_length_m * 1e3:.3f} mm, {self.arcs} arcs"


class Milled(Table[types.MilledDict]):
    """The error along a toolpath; its data frame has a row for every sample."""

    _arrays = ("at_m", "worst_joints_deg", "worst_shares")

    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    path: str
    """The toolpath as it was asked for."""

    only_tool: int | None
    """The number of the only tool that mills, of several; null where all of the path is milled, and in
    `by_tool`."""

    force: str
    """Where the force on the tool comes from."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    part: types.PathLength
    """The path as it was cut: samples, lengths and time."""

    roll: types.RollChoice
    """How the tool is turned about its axis."""

    error: str
    """What of the displacement counts: total, across, axial or normal."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    speed_share: float | None
    """Of the joints' speeds what is used at most; null where the robot file tells none."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    cell: types.CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    at_m: Array | None
    """Where the path's origin stands, from the robot's base."""

    at_yaw_deg: float | None
    """By how much the part is turned about the vertical from straight ahead of the robot; null of a base that
    leans."""

    cell_m: list[float] | None
    """Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell."""

    cell_yaw_deg: float | None
    """By how much the part is turned about the vertical from the cell's x axis; null without a cell."""

    feasible: bool
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    worst_mm: float | None
    """The largest error along the path."""

    worst_mm_p05: float | None
    """5th percentile over draws of the drive stiffness, in the postures of the answer; null where the
    uncertainty of the drives is not known."""

    worst_mm_p50: float | None
    """Median."""

    worst_mm_p95: float | None
    """95th percentile."""

    lower_bound_mm: float | None
    """No rolls of the mode that was asked for, through the pins where there are some, and where the best place
    was asked for no place, have less."""

    roll_lower_bound_mm: float | None
    """No rolls of that mode have less at this place."""

    rms_mm: float | None
    """The root mean square of the error over what feeds."""

    worst_sample: int | None
    """The sample with the largest error, from 0."""

    worst_line: int | None
    """Its line in the file; 0 of a path built in."""

    worst_joints_deg: Array | None
    """Joint angles at the worst point as the robot reports them."""

    worst_shares: Array | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_by: list[str] | None
    """By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot
    file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and
    what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the
    `stock`."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    error_without_wide_mm: float | None
    """The largest error of the best path, where `clearance_wide_mm` ruled it out and this one is worse."""

    asked_clearance_mm: float | None
    """What the arm was to keep from everything; null where nobody looked."""

    contacts: list[types.PathContact] | None
    """Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody
    looked."""

    unavoidable: types.PathContact | None
    """Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every
    configuration, as the one that is farthest from it has it. Null where nothing of that kind is known."""

    misplaced: list[types.Misplaced] | None
    """What of the work (part, stock, fixture) stands more than 1 mm deep in a keep-out or below the floor; null
    where nobody looked."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    fed_back: types.FedBackDict | None
    """What becomes of the largest error as width and depth of the cut change with the displacement; null where
    no cut is known."""

    chatter: types.PathChatter | None
    """Whether the cuts swing with the arm, at the sample at which the critical depth is least in proportion to
    the cut; null where that was not asked, or the path is not followed."""

    compensation: types.CompensatedPath | None
    """What compensation makes of the path; null where it was not asked for."""

    search: types.PlaceSearch | None
    """How finely a place was looked for; null where it was given."""

    work_frame: str | None
    """How the place of the work was found: measured or touched; null where nothing is followed."""

    true_arm: types.TrueArm | None
    """The largest error of the calibrated arm, geometry and load together; null of an arm that was not
    calibrated."""

    arm_error: types.ArmError | None
    """The largest geometric error along the path of arms that nobody has calibrated: median and 95th percentile;
    null of one that was calibrated."""

    remarks: list[str]
    """What is odd."""

    worst_tool: int | None
    """The tool with the largest error, of a path that is milled with several."""

    by_tool: list[types.MilledWithTool] | None
    """What each tool of the path does, in the order in which they mill: the keys of a path with one tool, its
    number and its tip."""
    # End of the keys.

    #: The question, from which programs are written.
    _asked: Question | None

    def __init__(
        self,
        data: dict[str, Any],
        columns: dict[str, Any] | None = None,
        asked: Question | None = None,
    ) -> None:
        super().__init__(data, columns)
        self._asked = asked

    @property
    def passes(self) -> bool | None:
        """The key ``pass``: whether the tolerance is kept; None where none was given."""
        verdict: bool | None = self._data.get("pass")
        return verdict

    def program(self, controller: Literal["src", "mod", "ls", "py", "yaml"]) -> str:
        """The path as a program, by the ending of its files, compensated where that was asked for; the rolls are sought once more.

        ``"src"`` for KUKA, ``"mod"`` for ABB, ``"ls"`` for Fanuc, ``"py"`` a script for RoboDK, ``"yaml"`` a trajectory for ROS 2.
        """
        if controller not in ("src", "mod", "ls", "py", "yaml"):
            raise StiffarmError(f"no controller reads {controller!r}; expected src, mod, ls, py or yaml")
        return text(self._there(), f"path.{controller}")

    def rewritten(self) -> str:
        """The path's own file with its tips led aside by what the tool is pushed off; needs ``compensate=True``."""
        asked = self._there()
        given = dict(asked.given)
        ending = Path(given["path"]).suffix.lower()
        if ending not in _REWRITTEN:
            ending = f".{given['format']}" if given.get("format") in ("apt", "cls") else ".nc"
        return text(asked, f"path{ending}")

    def _there(self) -> Question:
        """The same question of the part where it was found to stand; its place need not be sought again."""
        if self._asked is None or self.at_m is None:
            raise StiffarmError(f"there is no program: {self.reason or 'the answer does not know what was asked'}")
        x, y, z = self.at_m.tolist()
        at = ",".join(repr(part) for part in (x, y, z, self.at_yaw_deg or 0.0))
        sought = [keyword for keyword, _ in self._asked.given if keyword.startswith("within")]
        return self._asked.without(*sought).with_given(at=at)

    def _words(self) -> str:
        if self.worst_mm is None:
            return f"{self.robot} along {self.path}: {self.reason}"
        return f"{self.robot} along {self.path}: at most {self.worst_mm:.4f} mm, no less than {self.lower_bound_mm:.4f} mm"


class PathRanking(Table[types.PathRankingDict]):
    """Robots in order on a toolpath, the best first, each at its own best place and rolls."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    path: str
    """The toolpath as it was asked for."""

    force: str | None
    """Where the force on the tool comes from."""

    part: types.PathLength | None
    """The path as it was cut: samples, lengths and time."""

    error: str | None
    """What of the displacement counts: total, across, axial or normal."""

    rows: list[types.PathRankingRow]
    """One entry per row."""

    summary: list[str]
    """What a manager would read."""

    remarks: list[str]
    """What is odd."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        best = next((f"; best {row['robot']}" for row in self.rows if row["rank"] == 1 and row["feasible"]), "")
        return f"{len(self)} robots along {self.path}{best}"


class Ledger(Table[types.LedgerDict]):
    """Published numbers beside the computed ones; its data frame has a row for each."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    rows: list[types.PublishedNumber]
    """One entry per row."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        return f"{len(self)} published numbers, of which {sum(row['agrees'] for row in self.rows)} agree within their printed digits"
