"""Postures."""

from __future__ import annotations

from typing import Any, TypedDict

import numpy as np

from .._given import Array
from ..types import ComplianceDict, Schema
from .base import Answer, Table


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
    #: Whether the pendant shows the joints as the robot file counts them: ``"as-file"``, ``"verified"``, ``"given"`` or ``"unknown"``; None of two links.
    pendant: str | None
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
    #: 90 % interval and median of its length, over draws of the drive stiffness; None where its uncertainty is not known.
    deflection_mm_p05: float | None
    deflection_mm_p50: float | None
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
