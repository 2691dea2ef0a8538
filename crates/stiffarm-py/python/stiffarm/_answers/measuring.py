"""Measurements of stiffness, and which are worth making."""

from __future__ import annotations

from typing import Any

from .._given import Array
from .._stiffarm import Robot
from ..types import (
    CalibrationLeaves,
    CalibrationPlanDict,
    ComparedTable,
    ExpectedDrive,
    FoundCompensator,
    FurtherSpring,
    IdentificationDict,
    IdentifiedDrive,
    MeasurementPlanDict,
    MeasurementRun,
    PlannedAtWork,
    PlannedPosture,
    ReadingRemainder,
    Schema,
    TriedModel,
    UpdatedDrive,
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
