"""How an arm swings."""

from __future__ import annotations

from ..types import ModeOverZone, ModesDict, ModesOverZoneDict, Schema, SwingMode
from .base import Table


class Modes(Table[ModesDict]):
    """Frequencies and shapes in which an arm swings at one posture."""

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
    #: ``"given"``, ``"robot file"`` or ``"assumed"``.
    damping_source: str
    #: Bodies of which the robot file has no mass.
    masses_left_out: list[str]
    #: The lowest first: ``frequency_hz``, its 90 % interval, ``frequency_motors_free_hz``, ``damping_ratio``, ``tip_shape``, ``drive_shares``.
    modes: list[SwingMode]

    def __len__(self) -> int:
        return len(self.modes)

    def _words(self) -> str:
        first = ", ".join(f"{mode['frequency_hz']:.2f}" for mode in self.modes[:3])
        return f"{self.robot}: {first} Hz"


class ModesOverZone(Table[ModesOverZoneDict]):
    """Least and largest frequencies of an arm over a zone at one place."""

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
    task: str
    tool_mm: list[float]
    tool_direction_deg: float
    #: Middle of the zone from the base, m: ahead and up.
    x_m: float
    z_m: float
    #: How the zone stands and is held, as in `Placement`.
    bearing_deg: float
    yaw_deg: float
    angle_deg: float
    roll_deg: float
    shoulder: str
    elbow: str
    wrist: str
    #: Whether the pendant shows the joints as the robot file counts them: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``.
    pendant: str | None
    #: None where the tool weighs nothing.
    tool_mass_kg: float | None
    #: Its mass centre in the flange frame.
    tool_com_mm: list[float] | None
    #: ixx, ixy, ixz, iyy, iyz, izz about its own centre, flange axes.
    tool_inertia_kg_m2: list[float] | None
    #: Bodies of which the robot file has no mass.
    masses_left_out: list[str]
    #: Nowhere in the zone the first frequency is lower: proved for the stiffness that is stated; None where the proof did not end.
    first_at_least_hz: float | None
    #: 5th percentile over draws of the drive stiffness: drawn, not proved.
    first_at_least_hz_p05: float | None
    #: Into how many parts the zone was cut for the proof.
    zone_parts: int
    #: How many points were looked at for least and largest, and how far they lie apart, m.
    samples: int
    sample_step_m: float
    #: The lowest first: ``least_frequency_hz`` with its 90 % interval and place, ``largest_frequency_hz`` with its place.
    modes: list[ModeOverZone]

    def __len__(self) -> int:
        return len(self.modes)

    def _words(self) -> str:
        first = self.modes[0]
        proved = "nothing proved" if self.first_at_least_hz is None else f"proved at least {self.first_at_least_hz:.2f} Hz"
        return f"{self.robot} over {self.task}: first mode {first['least_frequency_hz']:.2f} to {first['largest_frequency_hz']:.2f} Hz, {proved}"
