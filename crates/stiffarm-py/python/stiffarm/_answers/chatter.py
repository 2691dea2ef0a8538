"""Whether a cut swings."""

from __future__ import annotations

from .. import types
from .base import Table


class Chatter(Table[types.ChatterDict]):
    """From which depth a cut swings with the arm, as far as its own modes tell."""

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

    process: str
    """The process file."""

    spindle_rpm: float
    """Speed of the spindle."""

    cut_depth_mm: float
    """Axial depth of the cut, as the process has it."""

    entry_deg: float
    """Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns
    counter-clockwise from its right."""

    exit_deg: float
    """Where a tooth leaves."""

    method: str
    """How teeth are counted: mean (over a revolution) or teeth (one by one)."""

    critical_depth_mm: float | None
    """The least axial depth that swings with the robot at the speed of the spindle; null where none up to 300 mm
    does."""

    critical_depth_mm_p05: float | None
    """5th percentile over draws of drive stiffness and damping; null beyond 300 mm."""

    critical_depth_mm_p95: float | None
    """95th percentile; null beyond 300 mm."""

    depth_reserve: float | None
    """The least depth that swings at the speed of the spindle, in parts of that of the cut; null where none up
    to 300 mm does."""

    chatter_hz: float | None
    """The frequency of the swing at that depth."""

    tooth_phase_rad: float | None
    """By how much the swing turns from tooth to tooth; far below 1 the cut is a damper, which calms or drives."""

    any_speed_depth_mm: float | None
    """Less deep no speed swings, by the mean of the teeth, and never deeper than at the speed of the cut; null
    where none up to 300 mm does."""

    any_speed_depth_mm_p05: float | None
    """5th percentile over the same draws."""

    any_speed_depth_mm_p95: float | None
    """95th percentile."""

    any_speed_hz: float | None
    """The frequency of the swing at that depth."""

    other_way_depth_mm: float | None
    """The least axial depth that swings at the speed of the spindle where the cut is fed the other way, up for
    down; null where none up to 300 mm does."""

    other_way_hz: float | None
    """The frequency of the swing at that depth."""

    calm_rpm: list[list[float]] | None
    """Speeds of the spindle within 0.5 to 1.5 of its own at which the cut swings neither at the nominal
    stiffness and damping nor in more than 5 of 100 draws: pairs of from and to; null where teeth are counted
    one by one, of drives that are nobody's, and where a measured table decides nothing."""

    pan_depth_mm: float | None
    """The least depth at which modes couple without the delay (Pan); beside the others, never instead of them."""

    pan_hz: float | None
    """Its frequency; 0 where the arm gives way."""

    drawn: list[str]
    """What the intervals are over: drives, damping, both or neither."""

    modes_looked_at: list[float]
    """Frequencies of the robot's modes that were looked at, Hz; none where the robot is in what was measured.
    Nothing is known above the last of these and of what was measured."""

    robot_modes: str
    """Of the robot with what was measured at its tip: calm where the cut swings neither at the nominal stiffness
    and damping nor in more than 5 of 100 draws, limit where it swings at the nominal and in 95 of 100 or
    more, else not decided; not covered of a path without a cut of which anything is known."""

    spindle_modes: str
    """unknown where nothing was measured at the tip, else measured; those of the work are never looked at."""

    frf: str | None
    """The table of what was measured at the tip; null where there is none."""

    frf_on: str | None
    """What held the tip while it was measured: rigid (spindle, holder and cutter alone) or robot (it takes the
    place of the model); null without a table."""

    measured_modes: list[float] | None
    """Frequencies of the modes of the table, Hz; null without a table of modes."""

    measured_between: list[float] | None
    """From where to where the table tells frequency by frequency, Hz; null without one."""

    verdict: str
    """What is reported of robot modes and of what was measured at the tip, in words."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""

    lobes: list[types.Lobe]
    """By the speed of the spindle: the least depth that swings."""
    # End of the keys.

    def __len__(self) -> int:
        return len(self.lobes)

    def _words(self) -> str:
        return f"{self.robot}, {self.process}: {self.verdict}"
