"""Figures with matplotlib, in the colours of the program: every function draws on ``ax``, or makes one, and returns it."""

from __future__ import annotations

from itertools import cycle
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _stiffarm
from ._answers import Map, Ranking, Study

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import LinearSegmentedColormap

__all__ = ["map", "ranking", "study"]

#: Bands of a map.
_BANDS = 12

#: What each colour means is said where they stand: in the library.
_COLOUR, _COLOURS = (dict(part) for part in _stiffarm.palette())


def _axes(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("stiffarm.plot needs matplotlib: pip install matplotlib") from error
    _, made = pyplot.subplots(layout="constrained")
    return made


def _scale() -> LinearSegmentedColormap:
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("stiffarm", _COLOURS["scale"])


def map(result: Map, *, ax: Axes | None = None, levels: Any = _BANDS, colorbar: bool = True) -> Axes:
    """The deflection over the section, with arm, base and zone.

    Parameters
    ----------
    result : Map
        Of `stiffarm.map`.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    levels : int or array_like
        Bands, or their edges [mm].
    colorbar : bool
        Whether to draw one.
    """
    from matplotlib import ticker

    ax = _axes(ax)
    values = np.ma.masked_invalid(result.values_mm)
    shown = result._shown
    if values.count():
        beyond: Literal["neither", "both"] = "both"
        if isinstance(levels, int):
            beyond = "neither"
            levels = ticker.MaxNLocator(levels, steps=[1, 2, 5, 10]).tick_values(values.min(), values.max())
        bands = ax.contourf(result.x_m, result.z_m, values, levels=levels, cmap=_scale(), extend=beyond)
        if colorbar and ax.figure is not None:
            which = "worst deflection" if result.direction_deg is None else f"deflection at {result.direction_deg:g}°"
            ax.figure.colorbar(bands, ax=ax, label=f"{which} under {result.force_n:g} N [mm]")
    origin = "base" if shown["knows_base"] else "joint-2 axis"
    if shown["knows_base"] and shown["arm_m"]:
        _draw_base(ax, shown["arm_m"])
    placed = result.zone is not None and result.zone["feasible"]
    if result.zone is not None and placed:
        _draw_zone(ax, result.zone, shown)
    if shown.get("arm_m"):
        x, z = zip(*shown["arm_m"])
        for colour, width in ((_COLOUR["ink"], 7), (_COLOUR["arm"], 5)):
            ax.plot(x, z, color=colour, linewidth=width, solid_capstyle="round", solid_joinstyle="round", zorder=4)
        ax.plot(x, z, "o", color=_COLOUR["paper"], markeredgecolor=_COLOUR["ink"], markersize=7, zorder=5)
    ax.set_aspect("equal")
    ax.set_xlabel(f"x from the {origin} [m]")
    ax.set_ylabel(f"z from the {origin} [m]")
    ax.set_title(f"{shown['title']}\n{shown['subtitle']}, {result.model} model", fontsize="medium", loc="left")
    if placed:
        ax.legend(loc="upper left", fontsize="small")
    return ax


def _draw_base(ax: Axes, arm: list[list[float]]) -> None:
    # In space the arm begins at the base, in the plane at the joint-2 axis.
    x, z = next(point for point in arm if any(point))
    ax.axhline(0, color=_COLOUR["ground"], linewidth=1, zorder=1)
    ax.plot([0, 0, x], [0, z, z], color=_COLOUR["base"], linewidth=8, solid_joinstyle="round", zorder=3)


def _draw_zone(ax: Axes, zone: dict[str, Any], shown: dict[str, Any]) -> None:
    from matplotlib.patches import Circle, Rectangle

    (width, height), (x, z) = shown["zone_sides_m"], (zone["x_m"], zone["z_m"])
    how: dict[str, Any] = {"facecolor": "none", "edgecolor": _COLOUR["zone"], "linewidth": 2.0, "zorder": 3.5}
    label = f"{zone['task']}: {zone['deflection_mm']:.3f} mm at worst"
    if shown["zone_is_circle"]:
        ax.add_patch(Circle((x, z), width / 2, label=label, **how))
    else:
        corner = (x - width / 2, z - height / 2)
        turned = {"angle": zone["angle_deg"], "rotation_point": "center"}
        ax.add_patch(Rectangle(corner, width, height, label=label, **turned, **how))
    x, _, z = zone["worst_point_m"]
    ax.plot(x, z, "x", color=_COLOUR["worst_point"], markersize=8, markeredgewidth=2, zorder=6)


def ranking(result: Ranking, *, ax: Axes | None = None, most: int = 24) -> Axes:
    """Deflection of every robot at its best place, task by task.

    Serial robots are warm and solid, quasi-serial ones cool and dashed, estimated ones pale.

    Parameters
    ----------
    result : Ranking
        Of `stiffarm.rank`.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    most : int
        More robots than this cannot be told apart; the first are drawn.
    """
    ax = _axes(ax)
    rows = result.rows[:most]
    colours = {name: cycle(_COLOURS[f"{name.replace('-', '_')}_curves"]) for name in ("serial", "quasi-serial")}
    for row in rows:
        values = [np.nan if cell.get("deflection_mm") is None else cell["deflection_mm"] for cell in row["cells"]]
        dashes = "-" if row["architecture"] == "serial" else "--"
        estimated = row["status"] == "estimated"
        label = f"{row['vendor']} {row['robot']}".strip() + (" ~" if estimated else "")
        alpha = 0.5 if estimated else 1.0
        colour = next(colours[row["architecture"]])
        ax.plot(result.tasks, values, dashes, marker="o", markersize=4, color=colour, alpha=alpha, label=label)
    tolerance = next((cell["tolerance_mm"] for row in rows for cell in row["cells"]), None)
    if tolerance is not None:
        how: dict[str, Any] = {"color": _COLOUR["tolerance"], "linestyle": "-.", "linewidth": 1}
        ax.axhline(tolerance, label=f"tolerance {tolerance:g} mm", **how)
    ax.set_xlabel("task [m]")
    ax.set_ylabel("worst deflection at the best place [mm]")
    ax.set_ylim(bottom=0)
    title = f"Worst deflection under {result.force_n:g} N, {result.model} model"
    chosen = "" if len(rows) == len(result.rows) else f"; the first {most} of {len(result.rows)} robots"
    ax.set_title(title + chosen, fontsize="medium", loc="left")
    ax.legend(fontsize="x-small", loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return ax


def study(result: Study, *, task: str | None = None, ax: Axes | None = None) -> Axes:
    """Accuracy over size for both architectures, a line per link ratio, the best ratio drawn heavier.

    Parameters
    ----------
    result : Study
        Of `stiffarm.study`.
    task : str, optional
        One of its shapes; the first without it.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    """
    ax = _axes(ax)
    task = result.rows[0]["task"] if task is None else task
    rows = [row for row in result.rows if row["task"] == task]
    if not rows:
        raise KeyError(task)
    lines: dict[tuple[tuple[Any, ...], float | None], list[dict[str, Any]]] = {}
    for row in rows:
        who = (row["architecture"], row["k2"], row["k3"])
        lines.setdefault((who, None if row["best"] else row["mu_l3_over_l2"]), []).append(row)
    ratios = [*dict.fromkeys(mu for _, mu in lines)]
    hues = dict(zip((mu for mu in ratios if mu is not None), cycle(_COLOURS["ratios"])))
    contenders = [*dict.fromkeys(who for who, _ in lines)]
    for (who, mu), points in lines.items():
        values = [np.nan if row["accuracy"] is None else row["accuracy"] for row in points]
        name = who[0] if who[1:] == (1.0, 1.0) else f"{who[0]} (k2 {who[1]:g}, k3 {who[2]:g})"
        ax.plot(
            [row["d"] for row in points],
            values,
            "-" if contenders.index(who) == 0 else "--",
            color=_COLOUR["best_ratio"] if mu is None else hues[mu],
            linewidth=2.5 if mu is None else 1.2,
            marker="o",
            markersize=3,
            label=f"{name}, best ratio" if mu is None else f"{name}, μ = {mu:g}",
        )
    for boundary in result.boundaries:
        if boundary["task"] == task and boundary["mu_l3_over_l2"] is None:
            ax.axvline(boundary["d"], color=_COLOUR["ink"], linestyle=":", linewidth=1)
    ax.set_xlabel("size d / (l2 + l3) [1]")
    ax.set_ylabel("worst deflection / (k F (l2 + l3)²) [1]")
    ax.set_ylim(bottom=0)
    ax.set_title(f"Task {task}: link ratio and size, no joint limits", fontsize="medium", loc="left")
    ax.legend(fontsize="x-small", loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    return ax
