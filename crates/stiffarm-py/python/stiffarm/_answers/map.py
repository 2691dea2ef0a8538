"""Deflections over everything that is reached."""

from __future__ import annotations

from typing import Any

import numpy as np

from .. import types
from .._given import Array
from .base import Table


class Map(Table[types.MapDict]):
    """Deflections over a grid: nan where nothing is reached. Points count from the robot's base."""

    _arrays = ("x_m", "z_m", "worst_mm", "deflection_mm", "limit_margin_deg", "singular_margin_deg", "first_frequency_hz")
    _layers: tuple[str, ...]
    _shown: dict[str, Any]

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

    force_n: float
    """The cutting force."""

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

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    direction_deg: float | None
    """Of the force in the arm plane, from straight ahead."""

    elbow: str | None
    """The one side of the elbow that was asked for, up or down; null where the stiffer of each point is mapped."""

    tool_mm: list[float] | None
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float | None
    """The tool axis above the horizontal."""

    roll_tolerance: float | None
    """How much more than at the best roll a point may tell, relative."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    slowest_hz_p05: float | None
    """5th percentile, over draws of the drive stiffness, of the first frequency at the slowest point of the map;
    null where its uncertainty is not known, and where frequencies are not mapped."""

    zone: types.Placed | None
    """The best placement of the task that was given."""

    x_m: Array
    """Ahead, from the base: of each column of cells."""

    z_m: Array
    """Up, from the base: of each row of cells."""

    worst_mm: Array | None
    """Deflection under the force in its worst direction, row by row; null where a cell is not reached, and
    without rows where the force has a direction."""

    deflection_mm: Array | None
    """Deflection under the force in the direction asked for, row by row; null without rows where none was."""

    limit_margin_deg: Array | None
    """The distance to the nearest joint limit, row by row; in space."""

    singular_margin_deg: Array | None
    """The angle to the nearest singular posture, row by row; in space."""

    posture: list[list[str | None]] | None
    """The configuration that holds each cell, row by row; in space."""

    roll_deg: list[list[float | None]] | None
    """The roll about the tool axis, row by row; in space."""

    first_frequency_hz: Array | None
    """The first natural frequency, row by row, where that was asked."""
    # End of the keys.

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
