"""Measurements of stiffness, and which are worth making."""

from __future__ import annotations

from typing import Any

from .. import types
from .._given import Array
from .._stiffarm import Robot, StiffarmError
from .base import Table


class Identification(Table[types.IdentificationDict]):
    """How stiff the drives of a robot are, by measurements."""

    _arrays = ("correlation", "least_seen", "singular_values")

    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    date: str | None
    """When was measured."""

    fit: str
    """least-squares or huber."""

    postures: int
    """How many postures."""

    readings: int
    """How many rows."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    drives: list[types.IdentifiedDrive]
    """One entry per drive."""

    springs: list[types.FurtherSpring]
    """What springs besides the drives."""

    compensator: list[types.FoundCompensator]
    """What is found of a gravity compensator: its spring, and its preload."""

    posterior: list[types.UpdatedDrive] | None
    """What the measurements make of the prior, drive by drive; null where that was not asked for."""

    models: list[types.TriedModel]
    """The models that were tried."""

    rms_before_mm: float
    """How far a coordinate moved, root mean square."""

    rms_after_mm: float
    """What the compliances found leave of that."""

    rms_left_out_mm: float | None
    """The same of each posture by the others; null where a posture alone shows some drive."""

    rms_used_mm: float
    """What the compliances of the robot file leave of that."""

    explained: float
    """1 - rms after / rms before."""

    explained_left_out: float | None
    """The same of each posture by the others."""

    noise_ratio: float | None
    """How many times the noise that the table tells the remainders are."""

    condition: float | None
    """The largest singular value over the smallest; null where some drive is not seen."""

    singular_values: Array
    """Of all rows, mm per urad/(N m), descending."""

    least_seen: Array
    """The combination of drives that is seen worst; its squares add up to 1."""

    correlation: Array
    """Correlation of the compliances found."""

    outliers: list[int]
    """Rows that do not fit, from 1, the worst first."""

    residuals: list[types.ReadingRemainder]
    """What remains of every row."""

    remarks: list[str]
    """What is odd."""
    # End of the keys.

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


class MeasurementPlan(Table[types.MeasurementPlanDict]):
    """Which postures and loads to measure."""

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

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    criterion: str
    """What a plan is judged by."""

    value: float
    """By the criterion: mean variance of the displacement under 1 N over the work, (um/N)^2, or a variance in
    parts of the compliances."""

    lower_bound: float
    """No plan of so many runs of the candidates has less."""

    efficiency: float
    """The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of
    what no measurement takes away."""

    random_efficiency: float | None
    """The same of the median random choice; null where that leaves some drive unseen."""

    candidates: int
    """Among so many was chosen."""

    drives: list[types.ExpectedDrive]
    """One entry per drive."""

    unseen_drives: list[int]
    """Drives that no candidate shows."""

    unseen_share: float
    """What part of the variance of the prediction is the prior of these drives."""

    advised_loads: list[str]
    """Directions of loads that show them, where some do."""

    runs: list[types.MeasurementRun]
    """One entry per run, in the order in which they are made."""

    compared: types.ComparedTable | None
    """What the table that was given is worth."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.runs)

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} runs, efficiency {100 * self.efficiency:.1f} % at least"


class CalibrationPlan(Table[types.CalibrationPlanDict]):
    """In which postures to measure points of the flange, to calibrate the arm."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    points_mm: list[list[float]]
    """The points that were looked at, in the flange frame, mm."""

    at_work: types.PlannedAtWork
    """The error that remains at the work: expected, with its interval, and over how many postures; null where
    the arm does not reach it."""

    efficiency: float
    """The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of
    what no measurement takes away."""

    random_efficiency: float
    """The same of the median random choice; null where that leaves some drive unseen."""

    candidates: int
    """Among so many was chosen."""

    by_count: list[types.CalibrationLeaves]
    """What so many postures leave, each chosen after those before."""

    runs: list[types.PlannedPosture]
    """One entry per run, in the order in which they are made."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.runs)

    def _words(self) -> str:
        return f"{self.robot}: {len(self)} postures leave {self.at_work['expected_mm']:.3f} mm at the work, efficiency {100 * self.efficiency:.1f} % at least"


class Calibration(Table[types.CalibrationDict]):
    """How an arm differs from its drawing, by measured points."""

    _arrays = ("tracker_in_base", "points_mm", "zero_deg", "frames_mm_mrad", "weight_mrad", "weight_ci95_mrad", "gears_mrad")

    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    level: str
    """How much of the arm may differ from its drawing: zeros, geometry, weight, gears; of a list also as drawn."""

    own_weight: str | None
    """How the own weight is computed: `terms` of the joint angles, or `masses` of the robot file, with the
    compliance of each drive (`drives`) as all that is unknown; null of levels without it."""

    rows: int
    """Postures that were read."""

    nominal_rms_mm: float
    """Root mean square of the distances of the arm as drawn."""

    sigma_mm: float
    """Standard deviation of a coordinate of a reading about the level taken; of single points with how the arm
    repeats a posture."""

    posture_sigma_mm: float | None
    """The same of where the arm stands at a posture, which all of its points share; null of single points, of
    which nothing tells it from `sigma_mm`."""

    levels: list[types.LevelFit]
    """Every level: what it leaves."""

    wrong_rows: list[types.WrongRow]
    """Points that were left out: line of the file, point (0: all of the row) and distance, mm."""

    tracker_in_base: Array
    """Each stand of the tracker in the base: x, y, z mm and turns about fixed x, y, z deg."""

    points_mm: Array
    """The points that were looked at, in the flange frame, mm."""

    zero_deg: Array
    """What is to be added to each reported angle."""

    frames_mm_mrad: Array
    """Of each joint's frame three shifts, mm, and three turns, mrad, in the base's axes at model zero; the zeros
    are left out."""

    weight_mrad: Array | None
    """How drives yield under the arm's own weight, null where it is that of masses: of drive 2 on sin t2, cos
    t2, sin t23, cos t23, of drive 3 on sin t23, cos t23, of drive 5 on two arms of the tool."""

    weight_ci95_mrad: Array | None
    """Where each lies with 95 %."""

    drives: list[types.UpdatedDrive] | None
    """One entry per drive."""

    gears_mrad: Array
    """Once per turn of each joint: sine, cosine."""

    narrow: list[types.NarrowJoint]
    """Joints that moved over less than a third of their range, with that share."""

    at_work: types.CalibratedAtWork | None
    """The error that remains at the work: expected, with its interval, and over how many postures; null where
    the arm does not reach it."""
    # End of the keys.

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


class Verification(Table[types.VerificationDict]):
    """Whether a robot file counts the joints as readings do."""

    _arrays = ("base_mm_deg", "points_mm")

    # Keys, written from the tables of the library.
    schema: types.Schema

    robot: str
    """The maker's name for the robot."""

    verified: bool
    """The readings agree with the robot file, and with no other way of counting the joints."""

    rows: int
    """Postures that were read."""

    measured: bool
    """Points were measured by an instrument; else the controller computed them."""

    largest_mm: float
    """The largest distance between what was read and what the file says."""

    rms_mm: float
    """The root mean square of these distances."""

    largest_deg: float | None
    """The largest turn between orientations; null where none was read."""

    base_mm_deg: Array
    """The base of the robot file in the frame of the readings: x, y, z mm and turns about fixed x, y, z deg; one
    for each stand."""

    points_mm: Array
    """The points that were looked at, in the flange frame, mm."""

    fits: list[types.WayOfCounting]
    """Robots and ways of counting the joints, the best first."""

    alike: list[str]
    """What the readings do not tell apart, in words."""

    zeros_not_seen: list[int]
    """Joints whose zeros were not looked at, as a base or a tool that is fitted takes them up."""

    postures_deg: list[list[float]]
    """Postures that would tell it apart: joint angles."""

    wrong_row: types.WrongReading | None
    """The row that is off where all others agree: its line in the file and its distance, mm; null where there is
    none."""
    # End of the keys.

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


class FittingRobots(Table[types.FittingRobotsDict]):
    """From which robot of the catalogue readings are."""

    # Keys, written from the tables of the library.
    schema: types.Schema

    verified: bool
    """The readings agree with the robot file, and with no other way of counting the joints."""

    rows: int
    """Postures that were read."""

    fits: list[types.WayOfCounting]
    """Robots and ways of counting the joints, the best first."""
    # End of the keys.

    def _words(self) -> str:
        return ", ".join(f"{fit['robot']}: {fit['rms_mm']:.3f} mm rms" for fit in self.fits[:3])
