"""What the verbs answer: attributes by the keys of the program's JSON, and the ways out to other libraries."""

from __future__ import annotations

import copy
from typing import TYPE_CHECKING, Any, Generic, TypedDict, TypeVar

import numpy as np

from ._given import Array
from ._stiffarm import Robot, StiffarmError
from .types import (
    AdviceDict, Boundary, CellDict, ComparedTable, ComparisonDict, ComplianceDict, ExpectedDrive, FaceDict, ForceDict, FoundCompensator, FurtherSpring, IdentificationDict,
    IdentifiedDrive, MapDict, MeasurementPlanDict, MeasurementRun, MilledDict, PathLength, Placed, PlaceSearch, PlacementDict, RankingDict, RankingRow, ReadingRemainder, Resolution,
    RollChoice, Schema, StudyDict, StudyRow, ToolpathDict, TriedModel, UpdatedDrive, Winner,
)  # fmt: skip

if TYPE_CHECKING:
    import pandas
    import polars

#: The keys of an answer.
D = TypeVar("D")


def _plain(value: Any) -> Any:
    """Arrays as nested lists, and nan as None: what JSON says."""
    if isinstance(value, np.ndarray):
        plain = value.astype(object)
        plain[np.isnan(value)] = None
        return plain.tolist()
    return copy.deepcopy(value)


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return type(one) is type(other) and np.array_equal(one, other, equal_nan=True)
    return bool(one == other)


class Answer(Generic[D]):
    """An answer; its attributes are the keys of the program's JSON. Absent keys are None."""

    _arrays: tuple[str, ...] = ()
    _data: dict[str, Any]

    def __init__(self, data: dict[str, Any]) -> None:
        arrays = {key: np.asarray(data[key], dtype=np.float64) for key in self._arrays if data.get(key) is not None}
        self._data = {**data, **arrays}

    if not TYPE_CHECKING:  # which knows the keys, and takes no others

        def __getattr__(self, key: str) -> Any:
            if key.startswith("_"):
                raise AttributeError(key)
            if key in self._data:
                return self._data[key]
            if any(key in kind.__dict__.get("__annotations__", ()) for kind in type(self).__mro__):
                return None
            raise AttributeError(f"{type(self).__name__} has no attribute {key!r}; it has {', '.join(self._data)}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def to_dict(self) -> D:
        """The JSON of the program, as `json.loads` reads it."""
        plain: Any = {key: _plain(value) for key, value in self._data.items()}
        told: D = plain
        return told

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other) or not isinstance(other, Answer):
            return NotImplemented
        mine, theirs = self._data, other._data
        return mine.keys() == theirs.keys() and all(_same(mine[key], theirs[key]) for key in mine)

    __hash__ = None  # type: ignore[assignment]

    def _words(self) -> str:
        return ", ".join(f"{key}={value!r}" for key, value in self._data.items())

    def __repr__(self) -> str:
        return f"<stiffarm.{type(self).__name__} {self._words()}>"


class _Table(Answer[D]):
    """An answer that has rows; its columns are those of the program's CSV, typed whatever they hold."""

    _rows: dict[str, Any]

    def __init__(self, data: dict[str, Any], columns: dict[str, Any] | None = None) -> None:
        super().__init__(data)
        self._rows = {} if columns is None else columns

    def _columns(self) -> dict[str, Any]:
        return self._rows

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a pandas DataFrame; needs pandas."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: pip install pandas") from error
        return pandas.DataFrame(self._columns())

    def to_polars(self) -> polars.DataFrame:
        """The rows as a polars DataFrame; needs polars."""
        try:
            import polars
        except ImportError as error:
            raise ImportError("to_polars() needs polars: pip install polars") from error
        return polars.DataFrame(self._columns(), nan_to_null=True, strict=False)


class Compliance(Answer[ComplianceDict]):
    """One posture. Base axes: x forward, y left, z up."""

    _arrays = (
        "joints_deg",
        "tcp_m",
        "compliance_um_per_n",
        "compliance_6x6_si",
        "principal_um_per_n",
        "worst_direction",
        "worst_shares",
        "force_n",
        "deflection_mm",
        "rotation_mrad",
    )

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
    #: The compliance of each drive.
    drive_urad_per_nm: list[float]
    model: str
    #: (6,) as the robot reports them.
    joints_deg: Array
    #: (3,) the tool point from the base.
    tcp_m: Array
    #: (3, 3) from force to translation.
    compliance_um_per_n: Array
    #: (6, 6) translation first, m and rad per N and N m.
    compliance_6x6_si: Array
    #: (3,) ascending.
    principal_um_per_n: Array
    #: (3,) the unit direction of the last of them.
    worst_direction: Array
    #: (6,) what each drive gives of it; adds up to 1.
    worst_shares: Array
    #: (3,) the force along base axes, where one was given; of those that it may be the one that does most.
    force_n: Array | None
    #: Along which axes it was given: ``"base"`` or ``"tool"`` (feed, across, axial); None for its worst direction.
    force_axes: str | None
    #: Its unit direction along these.
    force_direction: list[float] | None
    force_cone_deg: float | None
    feed_deg: float | None
    #: What counts: ``"total"``, ``"normal"`` or ``"along"``.
    component: str | None
    #: What counts of the translation, the largest that the force may cause.
    largest_mm: float | None
    #: (3,) the translation under it.
    deflection_mm: Array | None
    #: 90 % of such drives give a length of more than p05 and less than p95; None where nothing says how far the drives may be off.
    deflection_mm_p05: float | None
    deflection_mm_p95: float | None
    #: (3,) the rotation under it.
    rotation_mrad: Array | None

    def _words(self) -> str:
        worst = float(self.principal_um_per_n[2])
        return f"{self.robot}: worst {worst:.4f} um/N along {np.round(self.worst_direction, 3).tolist()}"


class CompliancesDict(TypedDict):
    """`stiffarm.Compliances.to_dict`; the matrices are None where they were not asked for."""

    robot: str
    worst_um_per_n: list[float]
    compliance_um_per_n: list[list[list[float]]] | None


class Compliances(_Table[CompliancesDict]):
    """Many postures."""

    robot: str
    #: (n,) largest translation per force in any direction.
    worst_um_per_n: Array
    #: (n, 3, 3) from force to translation, base axes; where ``full=True`` was asked.
    compliance_um_per_n: Array | None

    def __len__(self) -> int:
        return len(self.worst_um_per_n)

    def _columns(self) -> dict[str, Any]:
        return {"worst_um_per_n": self.worst_um_per_n}

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} postures"


class Placement(_Table[PlacementDict]):
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
    #: None where it is not known: the search did not end, or the planar model does not hold.
    feasible: bool | None
    #: Why there is no place.
    reason: str | None
    #: That there is no place is proved.
    proved: bool | None
    deflection_mm: float | None
    #: 90 % of such drives give more than p05 and less than p95; None where nothing says how far the drives may be off.
    deflection_mm_p05: float | None
    deflection_mm_p95: float | None
    #: No allowed place has less.
    lower_bound_mm: float | None
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
    resolution: Resolution | None
    #: Every face of a part; None of one flat zone.
    faces: list[FaceDict] | None
    tolerance_mm: float | None
    margin_mm: float | None
    #: What the tolerance says of force, stiffness and size: ``force_factor``, ``largest_force_n``, ``stiffness_factor``, ``softest_drive``,
    #: ``largest_zone`` and more; None where no tolerance was given, and in a ranking of all but the best robots.
    advice: AdviceDict | None
    #: In a ranking: its rank in this task alone, and whether another cannot be told apart from it by the proof.
    task_rank: int | None
    task_rank_tied: bool | None

    #: Robot, task and options, from which a figure is drawn; of a ranking None.
    _asked: tuple[Any, str, dict[str, str]] | None

    def __init__(
        self,
        data: dict[str, Any],
        columns: dict[str, Any] | None = None,
        asked: tuple[Any, str, dict[str, str]] | None = None,
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


class Ranking(_Table[RankingDict]):
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
    #: One per robot: names, status, ``rank`` (None for an estimated robot; robots that cannot be told apart share one), ``rank_tied``, ``mean_ratio``, and ``cells`` with one placement per task.
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
            raise KeyError(asked)
        if len(found) > 1:
            raise StiffarmError(f"{len(found)} robots are called {robot}; their placements stand in rows")
        columns = {key: column[found[0] : found[0] + 1] for key, column in self._rows.items()}
        return Placement({"schema": self.schema, **copy.deepcopy(cells[found[0]])}, columns)

    def _words(self) -> str:
        best = next((f"; best {row['robot']}" for row in self.rows if row["rank"] == 1), "")
        return f"{len(self)} robots, {len(self.tasks)} tasks, {self.force_n:g} N, {self.model} model{best}"


class Comparison(_Table[ComparisonDict]):
    """Two setups side by side; its columns have a row for each."""

    schema: Schema
    #: What `stiffarm.place` tells of each.
    a: Placed
    b: Placed
    #: The deflection of the second over that of the first; None where one has no place.
    ratio: float | None
    #: It is proved which is better: its value lies below the other's bound.
    told_apart: bool
    #: ``"a"`` or ``"b"``; None where they cannot be told apart.
    better: str | None
    #: What is not the same of both besides the answer.
    differ_in: list[str]
    #: What a manager would read.
    summary: list[str]

    def _words(self) -> str:
        return self.summary[0]


class Study(_Table[StudyDict]):
    """Accuracies over link ratio and size, normalised as Table I of the paper."""

    schema: Schema
    #: ``task, d, mu_l3_over_l2, best, architecture, k2, k3, accuracy``.
    rows: list[StudyRow]
    #: Sizes at which the better architecture changes.
    boundaries: list[Boundary]

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        return f"{len(self)} rows, {len(self.boundaries)} boundaries"


class Identification(_Table[IdentificationDict]):
    """How stiff the drives of a robot are, by measurements."""

    _arrays = ("correlation", "least_seen", "singular_values")

    schema: Schema
    robot: str
    vendor: str
    #: When was measured, where that was said.
    date: str | None
    #: ``"least-squares"`` or ``"huber"``.
    fit: str
    #: What springs: ``"drives"``, ``"base"``, ``"tool"``, ``"base-and-tool"``.
    model: str
    #: What springs besides the drives.
    springs: list[FurtherSpring]
    #: A gravity compensator's spring and preload, where they were sought.
    compensator: list[FoundCompensator]
    #: What the measurements made of the prior of each drive, where that was asked for.
    posterior: list[UpdatedDrive] | None
    #: Those that were tried, where one was to be chosen.
    models: list[TriedModel]
    postures: int
    readings: int
    #: Of each: ``compliance_urad_per_nm``, ``standard_error_urad_per_nm``, ``ci95_urad_per_nm``, ``identified``, ``why_not``, ...
    drives: list[IdentifiedDrive]
    rms_before_mm: float
    rms_after_mm: float
    #: None where one posture alone shows some drive.
    rms_left_out_mm: float | None
    #: With what the robot file has.
    rms_used_mm: float
    explained: float
    explained_left_out: float | None
    #: How many times the noise that the table tells remains.
    noise_ratio: float | None
    #: None where some drive is not seen.
    condition: float | None
    #: mm per urad/(N m), descending.
    singular_values: Array
    #: The combination of drives that is seen worst.
    least_seen: Array
    correlation: Array
    #: Rows that do not fit, from 1, the worst first.
    outliers: list[int]
    #: What remains of every row.
    residuals: list[ReadingRemainder]
    remarks: list[str]

    def __init__(self, data: dict[str, Any], columns: dict[str, Any], robot: str) -> None:
        super().__init__(data, columns)
        self._robot_file = robot

    @property
    def identified_robot(self) -> Robot:
        """The robot with what was identified; ``to_toml()`` of it is its file."""
        return Robot.from_toml(self._robot_file)

    def _words(self) -> str:
        known = ", ".join(str(drive["drive"]) for drive in self.drives if drive["identified"])
        return f"{self.robot}: drives {known or 'none'} identified in {self.postures} postures, {100 * self.explained:.1f} % explained"


class MeasurementPlan(_Table[MeasurementPlanDict]):
    """Which postures and loads to measure."""

    schema: Schema
    robot: str
    vendor: str
    architecture: str
    architecture_assumed: bool
    status: str
    #: Who says how stiff the drives are taken to be.
    stiffness_source: str
    drive_urad_per_nm: list[float]
    #: What it is judged by.
    criterion: str
    #: (um/N)^2.
    value: float
    #: No plan of so many runs of the candidates has less.
    lower_bound: float
    #: The bound over the value.
    efficiency: float
    random_efficiency: float | None
    candidates: int
    #: What is expected of each drive: ``standard_error_urad_per_nm``.
    drives: list[ExpectedDrive]
    #: Drives that no candidate shows.
    unseen_drives: list[int]
    #: ``joints_deg``, ``load``, ``force_n``, ``expected_mm`` of each.
    runs: list[MeasurementRun]
    #: What the table that was given is worth.
    compared: ComparedTable | None

    def __len__(self) -> int:
        return len(self.runs)

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} runs, efficiency {100 * self.efficiency:.1f} % at least"


class Map(_Table[MapDict]):
    """Deflections over a grid: nan where nothing is reached. Points count from the robot's base."""

    _arrays = ("x_m", "z_m")
    _layers: tuple[str, ...]
    _shown: dict[str, Any]

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
    #: (nx,) forwards.
    x_m: Array
    #: (nz,) upwards.
    z_m: Array
    #: (nz, nx) under the force in its worst direction.
    worst_mm: Array | None
    #: (nz, nx) under the force in the direction that was given.
    deflection_mm: Array | None
    direction_deg: float | None
    tool_mm: list[float] | None
    tool_direction_deg: float | None
    #: How much more than at the best roll a point may tell, relative; spatial model, where no roll was given.
    roll_tolerance: float | None
    #: By row and column, in words; spatial model.
    posture: list[list[str | None]] | None
    #: By row and column, about the tool axis; spatial model.
    roll_deg: list[list[float | None]] | None
    #: (nz, nx) of the nearest joint to its limits; spatial model.
    limit_margin_deg: Array | None
    #: (nz, nx) to the nearest singular posture; spatial model.
    singular_margin_deg: Array | None
    #: The best placement of the task that was given.
    zone: Placed | None

    def __init__(self, data: dict[str, Any], layers: dict[str, Array], shown: dict[str, Any]) -> None:
        super().__init__({key: layers.get(key, value) for key, value in data.items()})
        self._layers = tuple(layers)
        self._shown = shown

    @property
    def values_mm(self) -> Array:
        """(nz, nx) the deflections, whichever direction of the force was asked for."""
        values: Array = self._data[self._layers[0]]
        return values

    def _columns(self) -> dict[str, Any]:
        x, z = np.meshgrid(self.x_m, self.z_m)
        columns = {"x_m": x.ravel(), "z_m": z.ravel(), "deflection_mm": self.values_mm.ravel()}
        return {**columns, **{key: self._data[key].ravel() for key in self._layers[1:]}}

    def _words(self) -> str:
        nz, nx = self.values_mm.shape
        return f"{self.robot}: {nx} x {nz} points, {self.force_n:g} N, {self.model} model"


class Force(_Table[ForceDict]):
    """The force of a process on its tool: along the feed, across (left of the feed), axial (away from the work)."""

    _arrays = ("mean_n", "max_n", "min_n")

    schema: Schema
    process: str
    #: Where the force comes from.
    law: str
    material: str | None
    #: How well its numbers are known: ``"published"`` or ``"unverified"``.
    material_status: str | None
    material_source: str | None
    #: (3,) over a revolution; None where the force may point anywhere.
    mean_n: Array | None
    max_n: Array | None
    min_n: Array | None
    #: The largest size of the force over a revolution.
    largest_n: float
    moment_nm: float
    power_w: float | None
    spindle_rpm: float | None
    entry_deg: float | None
    exit_deg: float | None
    assumed: list[str]

    def _words(self) -> str:
        mean = "in any direction" if self.mean_n is None else f"mean {np.round(self.mean_n, 2).tolist()} N"
        return f"{self.process}: {mean}, at most {self.largest_n:.2f} N"


class Toolpath(_Table[ToolpathDict]):
    """What is understood of a toolpath."""

    _arrays = ("box_m",)

    schema: Schema
    path: str
    #: ``"gcode"``, ``"apt"``, ``"csv"`` or ``"built-in"``.
    format: str
    lines: int | None
    feed_length_m: float
    rapid_length_m: float
    feed_moves: int
    rapid_moves: int
    #: Moves that are no part of the path.
    machine_moves: int
    arcs: int
    full_circles: int
    arc_length_m: float
    #: (2, 3) two corners of the box about all feed moves.
    box_m: Array | None
    feed_mm_per_min: list[float] | None
    time_s: float | None
    tilt_deg: float
    turn_deg: float
    samples: int
    chord_error_mm: float
    arc_miss_mm: float
    #: What the file leaves open and how it was taken.
    assumed: list[str]
    #: Words that move nothing.
    ignored: list[str]

    def _words(self) -> str:
        return f"{self.path}: {self.feed_moves} feed moves, {self.feed_length_m * 1e3:.3f} mm, {self.arcs} arcs"


class Milled(_Table[MilledDict]):
    """The error along a toolpath; its data frame has a row for every sample."""

    _arrays = ("at_m", "worst_joints_deg", "worst_shares")

    schema: Schema
    robot: str
    stiffness_source: str
    path: str
    #: Where the force on the tool comes from.
    force: str
    part: PathLength
    roll: RollChoice
    #: What of the displacement counts: ``"total"``, ``"across"`` or ``"axial"``.
    error: str
    asked_limit_margin_deg: float
    asked_singular_margin_deg: float
    speed_share: float | None
    #: (3,) where the path's origin stands; None where no place was found.
    at_m: Array | None
    at_yaw_deg: float | None
    feasible: bool
    reason: str | None
    worst_mm: float | None
    #: Where it lies with 90 %, as the drives may be.
    worst_mm_p05: float | None
    worst_mm_p95: float | None
    #: No rolls, and where the place was sought no place, have less.
    lower_bound_mm: float | None
    roll_lower_bound_mm: float | None
    rms_mm: float | None
    #: The sample with the largest error, from 0, and its line in the file.
    worst_sample: int | None
    worst_line: int | None
    worst_joints_deg: Array | None
    worst_shares: Array | None
    limit_margin_deg: float | None
    singular_margin_deg: float | None
    tolerance_mm: float | None
    margin_mm: float | None
    search: PlaceSearch | None
    remarks: list[str]

    @property
    def passes(self) -> bool | None:
        """The key ``pass``: whether the tolerance is kept; None where none was given."""
        verdict: bool | None = self._data.get("pass")
        return verdict

    def _words(self) -> str:
        if self.worst_mm is None:
            return f"{self.robot} along {self.path}: {self.reason}"
        return f"{self.robot} along {self.path}: at most {self.worst_mm:.4f} mm, no less than {self.lower_bound_mm:.4f} mm"
