"""Whether a cut swings."""

from __future__ import annotations

from ..types import ChatterDict, Lobe, Schema
from .base import Table


class Chatter(Table[ChatterDict]):
    """From which depth a cut swings with the arm, as far as its own modes tell."""

    schema: Schema
    robot: str
    vendor: str
    architecture: str
    architecture_assumed: bool
    status: str
    #: Who says how stiff the drives are taken to be.
    stiffness_source: str
    drive_urad_per_nm: list[float]
    model: str
    joints_deg: list[float]
    #: Whether the pendant shows the joints as the robot file counts them: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``.
    pendant: str | None
    #: Tool point from the base, m.
    tcp_m: list[float]
    #: None where the tool weighs nothing.
    tool_mass_kg: float | None
    #: Its mass centre in the flange frame.
    tool_com_mm: list[float] | None
    #: ixx, ixy, ixz, iyy, iyz, izz about its own centre, flange axes.
    tool_inertia_kg_m2: list[float] | None
    #: The process file.
    process: str
    spindle_rpm: float
    #: Axial depth of the cut, as the process has it.
    cut_depth_mm: float
    #: From the left of the feed in the sense of the rotation.
    entry_deg: float
    exit_deg: float
    #: How teeth are counted: ``"mean"`` or ``"teeth"``.
    method: str
    #: The least that swings at the speed of the spindle; None where none up to 300 mm does.
    critical_depth_mm: float | None
    critical_depth_mm_p05: float | None
    critical_depth_mm_p95: float | None
    #: In parts of the depth of the cut; below 1 it swings.
    depth_reserve: float | None
    chatter_hz: float | None
    #: By how much the swing turns from tooth to tooth.
    tooth_phase_rad: float | None
    #: Less deep no speed swings.
    any_speed_depth_mm: float | None
    any_speed_depth_mm_p05: float | None
    any_speed_depth_mm_p95: float | None
    any_speed_hz: float | None
    #: Fed the other way, up for down, at the speed of the spindle.
    other_way_depth_mm: float | None
    other_way_hz: float | None
    #: Speeds at which the cut would be calm, from where to where, within 0.5 to 1.5 of the spindle's; None where they are not known.
    calm_rpm: list[list[float]] | None
    #: Without the delay: beside the others, never instead of them.
    pan_depth_mm: float | None
    pan_hz: float | None
    #: What the intervals are over: ``"drives"``, ``"damping"``.
    drawn: list[str]
    #: Frequencies of the robot, Hz; none where it is in what was measured.
    modes_looked_at: list[float]
    #: ``"calm"``, ``"limit"`` or ``"not decided"``.
    robot_modes: str
    #: ``"measured"`` or ``"unknown"``.
    spindle_modes: str
    #: The table of what was measured at the tip, and what held it: ``"rigid"`` or ``"robot"``; None without one.
    frf: str | None
    frf_on: str | None
    #: Hz: its modes, or from where to where it tells frequency by frequency.
    measured_modes: list[float] | None
    measured_between: list[float] | None
    verdict: str
    #: What the process file leaves open.
    assumed: list[str]
    #: By the speed of the spindle: ``depth_mm``, its 90 % interval, ``chatter_hz``.
    lobes: list[Lobe]

    def __len__(self) -> int:
        return len(self.lobes)

    def _words(self) -> str:
        return f"{self.robot}, {self.process}: {self.verdict}"
