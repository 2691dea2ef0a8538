"""Places of zones and parts, and who is best at them."""

from __future__ import annotations

import copy
from typing import Any

from .._asked import Question
from .._stiffarm import Robot, StiffarmError
from ..types import (
    AdviceDict,
    Boundary,
    CellDict,
    ComparisonDict,
    FaceDict,
    Placed,
    PlacementDict,
    RankingDict,
    RankingRow,
    Resolution,
    Schema,
    StudyDict,
    StudyMark,
    StudyRow,
    Winner,
)
from .base import Table


class Placement(Table[PlacementDict]):
    """The best place of one zone; what only one model knows is None in the other. Positions count from the robot's base."""

    #: Version of the keys, and what positions count from.
    schema: Schema
    robot: str
    vendor: str
    architecture: str
    #: Nothing says that it is of this architecture.
    architecture_assumed: bool
    #: How well the robot's numbers are known.
    status: str
    #: Who says how stiff the drives are: ``"assumed"``, ``"robot file"`` or ``"given"``.
    stiffness_source: str
    #: The compliance of each drive; None where a robot of two links has none.
    drive_urad_per_nm: list[float | None]
    task: str
    model: str
    force_n: float
    #: ``"base"`` (ahead, left, up) or ``"tool"`` (feed, across, axial); None for the worst direction of the force.
    force_axes: str | None
    force_direction: list[float] | None
    force_cone_deg: float | None
    #: None where the feed may go any way.
    feed_deg: float | None
    #: What counts: ``"total"``, ``"normal"`` or ``"along"``.
    component: str
    #: What the maker sells the robot for; None where it is not known.
    payload_kg: float | None
    #: None where it was not given.
    tool_mass_kg: float | None
    #: Tool and force weigh more than the payload; None where one of them is not known.
    overloaded: bool | None
    #: About axes 4, 5 and 6 at worst, N m; None where there is nothing to report of it.
    wrist_moment_nm: list[float] | None
    wrist_limit_nm: list[float] | None
    #: ``"allowed by the maker"`` or ``"torque limits of the drives"``.
    wrist_limit_by: str | None
    #: None where no limit is known.
    wrist_exceeded: bool | None
    #: None where it is not known: the search did not end, or the planar model does not hold.
    feasible: bool | None
    #: Why there is no place.
    reason: str | None
    #: That there is no place is proved.
    proved: bool | None
    deflection_mm: float | None
    #: 90 % interval and median, over draws of the drive stiffness (and of the residual of an identified model); None where nothing says how far.
    deflection_mm_p05: float | None
    deflection_mm_p50: float | None
    deflection_mm_p95: float | None
    #: No allowed place has less.
    lower_bound_mm: float | None
    #: ``"pass"`` (kept, with a probability of 0.95 or more), ``"pass, not sure"`` or ``"fail"``; None where no tolerance was given.
    verdict: str | None
    #: How likely the tolerance is kept; None where nothing is known of the drives.
    probability: float | None
    x_m: float | None
    z_m: float | None
    angle_deg: float | None
    elbow: str | None
    worst_point_m: list[float] | None
    largest_feasible_scale: float | None
    below_base: bool | None
    behind_axis_1: bool | None
    bearing_deg: float | None
    yaw_deg: float | None
    roll_deg: float | None
    shoulder: str | None
    wrist: str | None
    tool_mm: list[float] | None
    tool_direction_deg: float | None
    within_m: list[list[float | None]] | None
    asked_limit_margin_deg: float
    asked_singular_margin_deg: float
    clear_of_base_m: float | None
    floor_m: float | None
    from_axis_1_m: float | None
    worst_joints_deg: list[float] | None
    #: Whether the pendant shows these joints so: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``; None in the plane and of two links.
    pendant: str | None
    worst_shares: list[float] | None
    limit_margin_deg: float | None
    limit_margin_joint: int | None
    singular_margin_deg: float | None
    #: The smaller of both, and what it is of.
    smallest_margin_deg: float | None
    smallest_margin_of: str | None
    #: The cell as it was asked for: mount, windows, what is kept free.
    cell: CellDict | None
    #: The centre of the zone in the axes of the cell.
    cell_m: list[float] | None
    #: The nearest that the arm comes to anything in the zone, links as capsules; negative where they overlap.
    clearance_mm: float | None
    #: Which link to what.
    clearance_of: str | None
    #: A radius in it is estimated.
    clearance_estimated: bool | None
    #: By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most, mm; 0 where none is estimated.
    clearance_outside_mm: float | None
    #: The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm, mm; negative where they overlap, so that the
    #: arm may touch; None where its bodies are known.
    clearance_wide_mm: float | None
    #: Which of those to what.
    clearance_wide_of: str | None
    resolution: Resolution | None
    #: Every face of a part; None of one flat zone.
    faces: list[FaceDict] | None
    tolerance_mm: float | None
    margin_mm: float | None
    #: What the tolerance says of force, stiffness and size: ``force_factor``, ``largest_force_n``, ``stiffness_factor``, ``softest_drive``,
    #: ``largest_zone`` and more; None where no tolerance was given, and in a ranking of all but the best robots.
    advice: AdviceDict | None
    #: In a ranking: its rank in this task alone, and whether another cannot be distinguished from it by the proof.
    task_rank: int | None
    task_rank_tied: bool | None

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


class Ranking(Table[RankingDict]):
    """Robots in order, the best first."""

    schema: Schema
    tasks: list[str]
    model: str
    force_n: float
    #: ``"base"`` (ahead, left, up) or ``"tool"`` (feed, across, axial); None for the worst direction of the force.
    force_axes: str | None
    force_direction: list[float] | None
    force_cone_deg: float | None
    #: None where the feed may go any way.
    feed_deg: float | None
    #: What counts: ``"total"``, ``"normal"`` or ``"along"``.
    component: str
    #: One per robot: names, status, ``rank`` (None for an estimated robot; robots that cannot be distinguished share one), ``rank_tied``, ``mean_ratio``, and ``cells`` with one placement per task.
    rows: list[RankingRow]
    #: Who is best at each task.
    winners: list[Winner]
    #: What a manager would read.
    summary: list[str]

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


class Comparison(Table[ComparisonDict]):
    """Two setups side by side; its columns have a row for each."""

    schema: Schema
    #: What `stiffarm.place` tells of each.
    a: Placed
    b: Placed
    #: The deflection of the second over that of the first; None where one has no place.
    ratio: float | None
    #: It is proved which is better: its value lies below the other's bound.
    told_apart: bool
    #: ``"a"`` or ``"b"``; None where they cannot be distinguished.
    better: str | None
    #: In which share of the draws of the drives each gives way least; None where the uncertainty of the drives is not known.
    win_probability: list[float] | None
    #: What is not the same of both besides the answer.
    differ_in: list[str]
    #: What a manager would read.
    summary: list[str]

    def _words(self) -> str:
        return self.summary[0]


class Study(Table[StudyDict]):
    """Accuracies over link ratio and size, normalised as Table I of the paper."""

    schema: Schema
    #: ``task, d, mu_l3_over_l2, best, architecture, k2, k3, accuracy``.
    rows: list[StudyRow]
    #: Sizes at which the better architecture changes.
    boundaries: list[Boundary]
    #: Where the robot with its task stands among all this, if one was named.
    mark: StudyMark | None

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        return f"{len(self)} rows, {len(self.boundaries)} boundaries"
