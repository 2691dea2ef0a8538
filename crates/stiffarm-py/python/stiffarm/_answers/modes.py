"""How an arm swings."""

from __future__ import annotations

from ..types import ModesDict, Schema, SwingMode
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
