"""Postures."""

from __future__ import annotations

from typing import Any, TypedDict

import numpy as np

from .. import types
from .._given import Array
from .base import Answer, Table


class Compliance(Answer[types.ComplianceDict]):
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

    joints_deg: Array
    """Joint angles as the robot reports them, deg."""

    joints_beyond_limits: list[int]
    """Joints beyond their limits at these angles, 0 for the angle between the links."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tcp_m: Array
    """The tool point."""

    compliance_um_per_n: Array
    """From force to translation, base axes."""

    compliance_6x6_si: Array
    """From wrench to translation and rotation, base axes, SI."""

    principal_um_per_n: Array
    """Principal compliances, ascending."""

    worst_direction: Array
    """The unit direction of the last of them."""

    worst_shares: Array
    """What each drive gives of the worst deflection; adds up to 1."""

    force_n: Array | None
    """The force at the tool point, base axes: as given, or of those that it may be the one that does most."""

    deflection_mm: Array | None
    """The translation under it."""

    rotation_mrad: Array | None
    """The rotation under it."""

    largest_mm: float | None
    """What counts of the translation, the largest that the force may cause."""

    deflection_mm_p05: float | None
    """5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is
    not known."""

    deflection_mm_p50: float | None
    """Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes
    away."""

    deflection_mm_p95: float | None
    """Their 95th percentile."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str | None
    """What of the displacement counts: total, normal (to the face) or along (the force)."""
    # End of the keys.

    def _words(self) -> str:
        worst = float(self.principal_um_per_n[2])
        return f"{self.robot}: worst {worst:.4f} um/N along {np.round(self.worst_direction, 3).tolist()}"


class CompliancesDict(TypedDict):
    """`stiffarm.Compliances.to_dict`; the matrices are None where they were not asked for."""

    robot: str
    worst_um_per_n: list[float]
    compliance_um_per_n: list[list[list[float]]] | None


class Compliances(Table[CompliancesDict]):
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
