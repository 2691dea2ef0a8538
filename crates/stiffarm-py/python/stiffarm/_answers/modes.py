"""How an arm swings."""

from __future__ import annotations

from .. import types
from .base import Table


class Modes(Table[types.ModesDict]):
    """Frequencies and shapes in which an arm swings at one posture."""

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

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tcp_m: list[float]
    """The tool point."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    damping_source: str
    """Where the damping is from: assumed, given or robot file."""

    masses_left_out: list[str]
    """Moving parts whose masses the robot file does not have."""

    modes: list[types.SwingMode]
    """How the arm swings, the lowest frequency first."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.modes)

    def _words(self) -> str:
        first = ", ".join(f"{mode['frequency_hz']:.2f}" for mode in self.modes[:3])
        return f"{self.robot}: {first} Hz"


class ModesOverZone(Table[types.ModesOverZoneDict]):
    """Least and largest frequencies of an arm over a zone at one place."""

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

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    task: str
    """The zone as it was asked for."""

    tool_mm: list[float]
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float
    """The tool axis above the horizontal."""

    x_m: float
    """Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`,
    `cell_m`)."""

    z_m: float
    """Up, from the base."""

    bearing_deg: float | None
    """Where about the joint-1 axis the zone stands."""

    yaw_deg: float | None
    """Of the zone's plane about the vertical."""

    angle_deg: float
    """Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.
    Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a
    tool that points up from the opposite direction); where the side then points is told beside it."""

    roll_deg: float | None
    """About the tool axis."""

    shoulder: str | None
    """front or back."""

    elbow: str
    """up or down."""

    wrist: str | None
    """no flip or flip."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    masses_left_out: list[str]
    """Moving parts whose masses the robot file does not have."""

    first_at_least_hz: float | None
    """Nowhere in the zone the first frequency is lower, motors held still: proved at the nominal stiffness, and
    no promise where that is not measured; null where the proof did not end."""

    first_at_least_hz_p05: float | None
    """5th percentile of the least first frequency over draws of the drive stiffness: drawn, not proved; null
    where its uncertainty is not known."""

    zone_parts: int
    """Into how many parts the zone was cut for the proof."""

    samples: int
    """How many they are."""

    sample_step_m: float
    """Distance between the poses in the zone."""

    modes: list[types.ModeOverZone]
    """How the arm swings, the lowest frequency first."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.modes)

    def _words(self) -> str:
        first = self.modes[0]
        proved = "nothing proved" if self.first_at_least_hz is None else f"proved at least {self.first_at_least_hz:.2f} Hz"
        return f"{self.robot} over {self.task}: first mode {first['least_frequency_hz']:.2f} to {first['largest_frequency_hz']:.2f} Hz, {proved}"
