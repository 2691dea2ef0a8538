"""Measurements of stiffness, and which are worth making."""

from __future__ import annotations

from typing import Any

from .._given import Array
from .._stiffarm import Robot, StiffarmError
from ..types import (
    CalibratedAtWork,
    CalibrationDict,
    CalibrationLeaves,
    CalibrationPlanDict,
    ComparedTable,
    ExpectedDrive,
    FittingRobotsDict,
    FoundCompensator,
    FurtherSpring,
    IdentificationDict,
    IdentifiedDrive,
    MeasurementPlanDict,
    LevelFit,
    MeasurementRun,
    NarrowJoint,
    PlannedAtWork,
    PlannedPosture,
    ReadingRemainder,
    Schema,
    TriedModel,
    UpdatedDrive,
    VerificationDict,
    WayOfCounting,
    WrongReading,
    WrongRow,
)
from .base import Table


class Identification(Table[IdentificationDict]):
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


class MeasurementPlan(Table[MeasurementPlanDict]):
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
    #: Whether the pendant shows the joints as the robot file counts them: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``; None of two links.
    pendant: str | None
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
    #: Their share of the variance of what is predicted, with the prior that they keep.
    unseen_share: float | None
    #: Load directions that would show them.
    advised_loads: list[str]
    #: ``joints_deg``, ``load``, ``force_n``, ``expected_mm`` of each.
    runs: list[MeasurementRun]
    #: What the table that was given is worth.
    compared: ComparedTable | None

    def __len__(self) -> int:
        return len(self.runs)

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} runs, efficiency {100 * self.efficiency:.1f} % at least"


class CalibrationPlan(Table[CalibrationPlanDict]):
    """In which postures to measure points of the flange, to calibrate the arm."""

    schema: Schema
    robot: str
    vendor: str
    #: Whether the pendant shows the joints as the robot file counts them: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``.
    pendant: str | None
    #: The points that are looked at, in the flange frame.
    points_mm: list[list[float]]
    #: What a calibration by these postures leaves at the work, and what any choice of as many, a random one, and none leave.
    at_work: PlannedAtWork
    #: The bound over the value, in the mean square of what a plan decides.
    efficiency: float
    random_efficiency: float | None
    candidates: int
    #: What 10 to 100 postures leave.
    by_count: list[CalibrationLeaves]
    #: ``joints_deg`` of each posture.
    runs: list[PlannedPosture]

    def __len__(self) -> int:
        return len(self.runs)

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} postures leave {self.at_work['expected_mm']:.3f} mm at the work, efficiency {100 * self.efficiency:.1f} % at least"


class Calibration(Table[CalibrationDict]):
    """How an arm differs from its drawing, by measured points."""

    _arrays = ("tracker_in_base", "points_mm", "zero_deg", "frames_mm_mrad", "weight_mrad", "weight_ci95_mrad", "gears_mrad")

    schema: Schema
    robot: str
    #: How much was found to differ: ``"zeros"``, ``"geometry"``, ``"weight"``, ``"gears"``.
    level: str
    #: ``"terms"`` of the joint angles, or ``"masses"`` of the robot file; None of levels without it.
    own_weight: str | None
    rows: int
    #: As drawn.
    nominal_rms_mm: float
    #: As drawn first, then each level: ``rms_mm``, ``left_out_rms_mm``, ``largest_mm``, ...
    levels: list[LevelFit]
    #: Points that were left out: line, point (0: all of the row), distance.
    wrong_rows: list[WrongRow]
    #: x, y, z in mm and rx, ry, rz in deg of each stand.
    tracker_in_base: Array
    #: In the flange frame.
    points_mm: Array
    #: To be added to the joints as reported.
    zero_deg: Array
    #: Three shifts and three turns of each joint's frame.
    frames_mm_mrad: Array
    #: Both None where the own weight is that of masses.
    weight_mrad: Array | None
    weight_ci95_mrad: Array | None
    gears_mrad: Array
    #: What the own weight tells of the compliance of each drive; None where it has terms.
    drives: list[UpdatedDrive] | None
    #: Joints that moved over less than a third of their range, with that share.
    narrow: list[NarrowJoint]
    #: The error that remains at the work; None where the arm does not reach it.
    at_work: CalibratedAtWork | None

    def __init__(self, data: dict[str, Any], columns: dict[str, Any], robot: str) -> None:
        super().__init__(data, columns)
        self._robot_file = robot

    @property
    def calibrated_robot(self) -> Robot:
        """The robot that knows how it differs; ``to_toml()`` of it is its file."""
        return Robot.from_toml(self._robot_file)

    def _words(self) -> str:
        taken = next(level for level in self.levels if level["level"] == self.level)
        return f"{self.robot}: {self.nominal_rms_mm:.3f} mm rms as drawn, {taken['rms_mm']:.3f} mm calibrated ({self.level})"


class Verification(Table[VerificationDict]):
    """Whether a robot file counts the joints as readings do."""

    _arrays = ("base_mm_deg", "points_mm")

    schema: Schema
    robot: str
    verified: bool
    rows: int
    #: Points were measured; else the controller computed them.
    measured: bool
    largest_mm: float
    rms_mm: float
    #: None where no orientation was read.
    largest_deg: float | None
    base_mm_deg: Array
    points_mm: Array
    #: Ways of counting, the best first.
    fits: list[WayOfCounting]
    #: What these readings do not tell apart.
    alike: list[str]
    #: Postures that would.
    postures_deg: list[list[float]]
    #: The one row that does not agree, where all others do.
    wrong_row: WrongReading | None

    def __init__(self, data: dict[str, Any], columns: dict[str, Any], robot: str | None) -> None:
        super().__init__(data, columns)
        self._robot_file = robot

    @property
    def verified_robot(self) -> Robot:
        """The robot that counts as the readings do; ``to_toml()`` of it is its file."""
        if self._robot_file is None:
            raise StiffarmError(f"{self.robot}: no way of counting the joints fits these readings")
        return Robot.from_toml(self._robot_file)

    def _words(self) -> str:
        return f"{self.robot}: {'verified' if self.verified else 'not verified'}, {self.largest_mm:.3f} mm off at most in {self.rows} rows"


class FittingRobots(Table[FittingRobotsDict]):
    """From which robot of the catalogue readings are."""

    schema: Schema
    verified: bool
    rows: int
    #: The best first.
    fits: list[WayOfCounting]

    def _words(self) -> str:
        return ", ".join(f"{fit['robot']}: {fit['rms_mm']:.3f} mm rms" for fit in self.fits[:3])
