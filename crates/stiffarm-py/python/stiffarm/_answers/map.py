"""Deflections over everything that is reached."""

from __future__ import annotations

from typing import Any

import numpy as np

from .._given import Array
from ..types import MapDict, Placed, Schema
from .base import Table


class Map(Table[MapDict]):
    """Deflections over a grid: nan where nothing is reached. Points count from the robot's base."""

    _arrays = ("x_m", "z_m")
    _layers: tuple[str, ...]
    _shown: dict[str, Any]

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
    #: The compliance of each drive; None where a robot of two links has none.
    drive_urad_per_nm: list[float | None]
    model: str
    force_n: float
    #: ``"base"`` (ahead, left, up) or ``"tool"`` (feed, across, axial); None for the worst direction of the force.
    force_axes: str | None
    force_direction: list[float] | None
    force_cone_deg: float | None
    #: None where the feed may go any way.
    feed_deg: float | None
    #: What counts: ``"total"``, ``"normal"`` or ``"along"``.
    component: str
    #: (nx,) forwards.
    x_m: Array
    #: (nz,) upwards.
    z_m: Array
    #: (nz, nx) under the force in its worst direction.
    worst_mm: Array | None
    #: (nz, nx) under the force in the direction that was given.
    deflection_mm: Array | None
    direction_deg: float | None
    #: The one side of the elbow that was asked for; None where the stiffer of each point is mapped.
    elbow: str | None
    tool_mm: list[float] | None
    tool_direction_deg: float | None
    #: How much more than at the best roll a point may tell, relative; spatial model, where no roll was given.
    roll_tolerance: float | None
    #: By row and column, in words; spatial model.
    posture: list[list[str | None]] | None
    #: By row and column, about the tool axis; spatial model.
    roll_deg: list[list[float | None]] | None
    #: (nz, nx) of the nearest joint to its limits; spatial model.
    limit_margin_deg: Array | None
    #: (nz, nx) to the nearest singular posture; spatial model.
    singular_margin_deg: Array | None
    #: What the arm holds while it swings; None where it weighs nothing.
    tool_mass_kg: float | None
    tool_com_mm: list[float] | None
    tool_inertia_kg_m2: list[float] | None
    #: 5th percentile, over draws of the drive stiffness, of the first frequency at the slowest point.
    slowest_hz_p05: float | None
    #: (nz, nx) of the arm with what it holds, motors held still; with ``quantity="first-frequency"``.
    first_frequency_hz: Array | None
    #: The best placement of the task that was given.
    zone: Placed | None

    def __init__(self, data: dict[str, Any], layers: dict[str, Array], shown: dict[str, Any]) -> None:
        super().__init__({key: layers.get(key, value) for key, value in data.items()})
        self._layers = tuple(layers)
        self._shown = shown

    @property
    def values_mm(self) -> Array:
        """(nz, nx) the deflections, whichever direction of the force was asked for."""
        values: Array = self._data[self._layers[0]]
        return values

    def _columns(self) -> dict[str, Any]:
        x, z = np.meshgrid(self.x_m, self.z_m)
        columns = {"x_m": x.ravel(), "z_m": z.ravel(), "deflection_mm": self.values_mm.ravel()}
        return {**columns, **{key: self._data[key].ravel() for key in self._layers[1:]}}

    def _words(self) -> str:
        nz, nx = self.values_mm.shape
        return f"{self.robot}: {nx} x {nz} points, {self.force_n:g} N, {self.model} model"
