"""Places of zones and parts, and who is best at them."""

from __future__ import annotations

import copy
from typing import Any

from .. import types
from .._asked import Question
from .._stiffarm import Robot, StiffarmError
from .base import Table


class Placement(Table[types.PlacementDict]):
    """The best place of one zone; what only one model knows is None in the other. Positions count from the robot's base."""

    #: Version of the keys, and what positions count from.
    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    task: str
    """The zone as it was asked for."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

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

    tool_mm: list[float] | None
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float | None
    """The tool axis above the horizontal."""

    within_m: list[list[float | None]] | None
    """Where the zone may stand; null where it is open."""

    cell: types.CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    floor_m: float | None
    """Height of the floor above which the zone was to stand, from the base; null where there is none, and where
    the base leans or is on a wall: the floor is then z = 0 of the cell."""

    feasible: bool | None
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    proved: bool | None
    """That there is no place is proved."""

    largest_feasible_scale: float | None
    """The largest scale at which a zone of this shape has a place."""

    deflection_mm: float | None
    """The worst deflection in the zone at its best place."""

    lower_bound_mm: float | None
    """No allowed place has less."""

    x_m: float | None
    """Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`,
    `cell_m`)."""

    z_m: float | None
    """Up, from the base."""

    bearing_deg: float | None
    """Where about the joint-1 axis the zone stands."""

    yaw_deg: float | None
    """Of the zone's plane about the vertical."""

    angle_deg: float | None
    """Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.
    Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a
    tool that points up from the opposite direction); where the side then points is told beside it."""

    first_side: list[float] | None
    """Which way the first side points where the zone stands, a unit vector: axes of the cell, of the base
    without one; null in the plane."""

    roll_deg: float | None
    """About the tool axis."""

    shoulder: str | None
    """front or back."""

    elbow: str | None
    """up or down."""

    wrist: str | None
    """no flip or flip."""

    worst_point_m: list[float] | None
    """Where in the zone the deflection is largest."""

    from_axis_1_m: float | None
    """Distance of the zone's nearest point from the joint-1 axis."""

    below_base: bool | None
    """Part of the zone lies below the base."""

    behind_axis_1: bool | None
    """Part of the zone lies behind the joint-1 axis."""

    worst_joints_deg: list[float] | None
    """Joint angles at the worst point as the robot reports them."""

    pendant: str | None
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    worst_shares: list[float] | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    limit_margin_joint: int | None
    """That joint; 0 is the angle between the links."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    smallest_margin_deg: float | None
    """The least that is kept from a joint limit or a straight posture anywhere in the zone."""

    smallest_margin_of: str | None
    """What that is of: a joint, the angle between the links, the forearm's angle, or a straight posture."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_estimated: bool | None
    """A radius in it is estimated."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    cell_m: list[float] | None
    """The centre of the zone in the axes of the cell, its floor at 0."""

    resolution: types.Resolution | None
    """How finely a place was looked for."""

    faces: list[types.FaceDict] | None
    """Every face of a part; null of one flat zone."""

    deflection_mm_p05: float | None
    """5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is
    not known."""

    deflection_mm_p50: float | None
    """Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes
    away."""

    deflection_mm_p95: float | None
    """Their 95th percentile."""

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

    advice: types.AdviceDict | None
    """What is missing where the tolerance is not kept, and what is left where it is; null where none was given,
    and in a ranking of all but the best robots."""

    task_rank: int | None
    """The same for this task alone."""

    task_rank_tied: bool | None
    """Some other robot cannot be distinguished from it by the proof in this task."""
    # End of the keys.

    #: The question, from which a figure is drawn; of a ranking None.
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

    def _words(self) -> str:
        if self.deflection_mm is None:
            known = "not known" if self.feasible is None else "no place"
            return f"{self.robot}, {self.task}: {known}; {self.reason}"
        place = f"{self.deflection_mm:.4f} mm at x {self.x_m:.4f} m, z {self.z_m:.4f} m"
        return f"{self.robot}, {self.task}: {place}, {self.force_n:g} N, {self.model} model"


class Ranking(Table[types.RankingDict]):
    """Robots in order, the best first."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    tasks: list[str]
    """The tasks as they were asked for."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    rows: list[types.RankingRow]
    """One entry per row."""

    winners: list[types.Winner]
    """Who is best at each task."""

    summary: list[str]
    """What a manager would read."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.rows)

    def cell(self, robot: str, task: str) -> Placement:
        """The placement of a task (by its label) on a robot (by its name); where two robots have it, see ``rows``."""
        asked = (robot, task)
        cells = [cell for row in self.rows for cell in row["cells"]]
        found = [i for i, cell in enumerate(cells) if (cell["robot"], cell["task"]) == asked]
        if not found:
            names = ", ".join(str(row["robot"]) for row in self.rows[:10])
            raise KeyError(f"no robot {robot!r} with a task {task!r}; expected one of {names}{', ...' if 10 < len(self) else ''} and of {', '.join(self.tasks)}")
        if len(found) > 1:
            raise StiffarmError(f"{len(found)} robots are called {robot}; their placements stand in rows")
        columns = {key: column[found[0] : found[0] + 1] for key, column in self._rows.items()}
        return Placement({"schema": self.schema, **copy.deepcopy(cells[found[0]])}, columns)

    def _words(self) -> str:
        best = next((f"; best {row['robot']}" for row in self.rows if row["rank"] == 1), "")
        return f"{len(self)} robots, {len(self.tasks)} tasks, {self.force_n:g} N, {self.model} model{best}"


class Comparison(Table[types.ComparisonDict]):
    """Two setups side by side; its columns have a row for each."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    a: types.Placed
    """The first setup, as place tells it."""

    b: types.Placed
    """The second setup."""

    ratio: float | None
    """The deflection of the second over that of the first; null where one has no place."""

    told_apart: bool
    """It is proved that no other is as good, at the nominal stiffness."""

    better: str | None
    """Which of the two is better, a or b, which is proved at the nominal stiffness; null where they cannot be
    distinguished."""

    win_probability: list[float | None] | None
    """In which share of the draws of the drive stiffness it has the least deflection, of each task; null where
    it has no place, is estimated, is not to be taken (its arm collides, it carries more than it may), or the
    uncertainty of its drives is not known."""

    differ_in: list[str]
    """What is not the same of both besides the answer: robot, stiffness, model, tool, tool mass, tool direction,
    force, component, task, tolerance, margins, mount, allowed place, angle, gap."""

    summary: list[str]
    """What a manager would read."""
    # End of the keys.

    def _words(self) -> str:
        return self.summary[0]


class Study(Table[types.StudyDict]):
    """Accuracies over link ratio and size, normalised as Table I of the paper."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    rows: list[types.StudyRow]
    """One entry per row."""

    boundaries: list[types.Boundary]
    """Sizes at which the better architecture changes."""

    mark: types.StudyMark | None
    """Where the robot with its task stands among what was studied."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        return f"{len(self)} rows, {len(self.boundaries)} boundaries"
