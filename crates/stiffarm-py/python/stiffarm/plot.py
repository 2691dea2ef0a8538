"""Figures with matplotlib, in the colours of the program: every function draws on ``ax``, or makes one, and returns it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import cycle
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from . import _stiffarm
from ._asked import answered
from ._answers import Compliance, Map, Placement, Ranking, Study

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap

    from .types import ComplianceDict, Placed, RankingRow, StudyRow

__all__ = ["compliance", "map", "place", "ranking", "study"]

#: Bands of a map.
_BANDS = 12
#: The six marks of robots, as the program draws them.
_MARKS = ("o", "s", "^", "D", "v", "p")

#: What each colour means is said where they stand: in the library.
_COLOUR, _COLOURS = (dict(part) for part in _stiffarm.palette())

#: The layers of a map: key, what it is, unit, which scale.
_LAYERS = {
    "limit_margin": ("limit_margin_deg", "nearest joint limit [deg]", "margins"),
    "singular_margin": ("singular_margin_deg", "nearest singular posture [deg]", "margins"),
}

Scale = tuple[float, float]


def _axes(ax: Axes | None, **size: Any) -> Axes:
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("stiffarm.plot needs matplotlib: pip install matplotlib") from error
    made: Axes = pyplot.subplots(layout="constrained", **size)[1]
    return made


def _colours(which: str = "scale") -> Colormap:
    from matplotlib.colors import LinearSegmentedColormap

    scale = LinearSegmentedColormap.from_list("stiffarm", _COLOURS[which])
    under, over = str(_COLOUR["under"]), str(_COLOUR["over"])
    if which != "scale":
        under, over = over, under
    return scale.with_extremes(under=under, over=over)


def map(
    result: Map,
    *,
    ax: Axes | None = None,
    layer: Literal["deflection", "limit_margin", "singular_margin"] = "deflection",
    levels: Any = _BANDS,
    scale: Scale | None = None,
    tolerance_mm: float | None = None,
    colorbar: bool = True,
) -> Axes:
    """The deflection over the section, with arm, base, zone, its window and the force.

    Parameters
    ----------
    result : Map
        Of `stiffarm.map`.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    layer : {"deflection", "limit_margin", "singular_margin"}
        What is drawn; the margins are known in the spatial model.
    levels : int or array_like
        Bands, or their edges [mm].
    scale : (low, high), optional
        From where to where the colours go [mm, of margins deg], for figures that are to be compared; what lies beyond
        is marked.
    tolerance_mm : float, optional
        What the work allows: a line.
    colorbar : bool
        Whether to draw one.
    """
    ax = _axes(ax)
    key, label, which = _LAYERS.get(layer, ("", "", "scale"))
    if layer != "deflection" and layer not in _LAYERS:
        raise ValueError(f"layer {layer!r}; expected deflection, {', '.join(_LAYERS)}")
    found = getattr(result, key) if key else result.values_mm
    if found is None:
        raise ValueError(f"a map in the {result.model} model has no {layer}")
    if not key:
        what = "worst deflection" if result.direction_deg is None else f"deflection at {result.direction_deg:g}°"
        label = f"{what} under {result.force_n:g} N [mm]"
    _field(ax, result.x_m, result.z_m, found, label, levels, scale, which, colorbar)
    if tolerance_mm is not None and not key:
        _tolerance(ax, result.x_m, result.z_m, found, tolerance_mm)
    shown = result._shown
    _draw_arm(ax, shown)
    placed = result.zone is not None and result.zone["feasible"]
    if result.zone is not None and placed:
        _draw_window(ax, result.zone["within_m"])
        _draw_zone(ax, result.zone, shown)
    if result.direction_deg is not None:
        _draw_force(ax, result.direction_deg, result.force_n, shown.get("arm_m"))
    _finish(ax, shown, f"{shown['subtitle']}, {result.model} model")
    return ax


def _field(
    ax: Axes, x: Any, z: Any, found: Any, label: str, levels: Any, scale: Scale | None, which: str, colorbar: bool
) -> None:
    from matplotlib import ticker

    values = np.ma.masked_invalid(found)
    if not values.count():
        return
    beyond: Literal["neither", "both", "min", "max"] = "both"
    if isinstance(levels, int):
        low, high = scale or (float(values.min()), float(values.max()))
        if not low < high:
            low, high = low - 0.5 * abs(low) - 1e-9, high + 0.5 * abs(high) + 1e-9
        levels = ticker.MaxNLocator(levels, steps=[1, 2, 5, 10]).tick_values(low, high)
        beyond = "neither"
        if scale is not None:
            levels = np.unique([low, *(level for level in levels if low < level < high), high])
            below, above = values.min() < low, values.max() > high
            beyond = "both" if below and above else "min" if below else "max" if above else "neither"
    bands = ax.contourf(x, z, values, levels=levels, cmap=_colours(which), extend=beyond)
    if colorbar and ax.figure is not None:
        ax.figure.colorbar(bands, ax=ax, label=label)


def _tolerance(ax: Axes, x: Any, z: Any, values: Any, tolerance: float) -> None:
    known = np.asarray(values)[np.isfinite(values)]
    label = f"tolerance {tolerance:g} mm"
    if known.size and known.min() < tolerance < known.max():
        masked = np.ma.masked_invalid(values)
        ax.contour(x, z, masked, levels=[tolerance], colors=[_COLOUR["tolerance"]], linestyles=["-."], linewidths=[1.6])
    elif known.size:
        label += ": held everywhere" if known.max() <= tolerance else ": held nowhere"
    ax.plot([], [], "-.", color=_COLOUR["tolerance"], linewidth=1.6, label=label)


def _draw_arm(ax: Axes, shown: dict[str, Any]) -> None:
    if not shown.get("arm_m"):
        return
    if shown["knows_base"]:
        _draw_base(ax, shown["arm_m"])
    x, z = zip(*shown["arm_m"])
    for colour, width in ((_COLOUR["ink"], 7), (_COLOUR["arm"], 5)):
        ax.plot(x, z, color=colour, linewidth=width, solid_capstyle="round", solid_joinstyle="round", zorder=4)
    ax.plot(x, z, "o", color=_COLOUR["paper"], markeredgecolor=_COLOUR["ink"], markersize=7, zorder=5)


def _draw_base(ax: Axes, arm: list[list[float]]) -> None:
    # In space the arm begins at the base, in the plane at the joint-2 axis.
    x, z = next(point for point in arm if any(point))
    ax.axhline(0, color=_COLOUR["ground"], linewidth=1, zorder=1)
    ax.plot([0, 0, x], [0, z, z], color=_COLOUR["base"], linewidth=8, solid_joinstyle="round", zorder=3)


def _draw_zone(ax: Axes, zone: Mapping[str, Any], shown: dict[str, Any]) -> None:
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
    _draw_worst(ax, x, z)


def _draw_worst(ax: Axes, x: float, z: float) -> None:
    ax.plot(x, z, "x", color=_COLOUR["worst_point"], markersize=8, markeredgewidth=2, zorder=6)


def _draw_window(ax: Axes, within: Any) -> None:
    """Where the zone may stand; an open end lies at the end of the axes."""
    if within is None or all(end is None for ends in within for end in ends):
        return
    limits = (ax.get_xlim(), ax.get_ylim())
    (x0, x1), (z0, z1) = (
        [low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]]
        for ends, (low, high) in zip(within, limits)
    )
    line = ([x0, x1, x1, x0, x0], [z0, z0, z1, z1, z0])
    ax.plot(*line, "--", color=_COLOUR["window"], linewidth=1.5, zorder=3.2, label="where the zone may stand")


def _draw_force(ax: Axes, direction_deg: float, newtons: float, arm: list[list[float]] | None) -> None:
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    at = arm[-1] if arm else ((left + right) / 2, (low + high) / 2)
    length, angle = 0.13 * max(right - left, high - low), math.radians(direction_deg)
    tip = (at[0] + length * math.cos(angle), at[1] + length * math.sin(angle))
    for colour, width in ((_COLOUR["paper"], 6), (_COLOUR["force"], 3)):
        how: dict[str, Any] = {"arrowstyle": "-|>", "color": colour, "linewidth": width, "mutation_scale": 18, "shrinkA": 0}
        how["shrinkB"] = 0
        ax.annotate("", xy=tip, xytext=(at[0], at[1]), arrowprops=how, zorder=7)
    ax.plot([], [], color=_COLOUR["force"], linewidth=3, label=f"force of {newtons:g} N")


def _finish(ax: Axes, shown: dict[str, Any], subtitle: str) -> None:
    origin = "base" if shown["knows_base"] else "joint-2 axis"
    ax.set_aspect("equal")
    ax.set_xlabel(f"x from the {origin} [m]")
    ax.set_ylabel(f"z from the {origin} [m]")
    ax.set_title(f"{shown['title']}\n{subtitle}", fontsize="medium", loc="left")
    if ax.get_legend_handles_labels()[1]:
        # Below the section, where it covers nothing.
        ax.legend(loc="upper left", bbox_to_anchor=(0.0, -0.13), fontsize="small", frameon=False, ncols=2)


def place(
    result: Placement,
    *,
    ax: Axes | None = None,
    levels: Any = _BANDS,
    scale: Scale | None = None,
    size: int = 200,
    colorbar: bool = True,
) -> Axes:
    """The zone at its best place on the section of what is reached, held as the zone is, with tolerance and window.

    The search is done once more, and the section is mapped.

    Parameters
    ----------
    result : Placement
        Of `stiffarm.place`, with a place.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    levels, scale, colorbar
        As in `map`.
    size : int
        Points along the longer side of the section.
    """
    asked = result._asked
    if asked is None:
        raise ValueError("plot.place draws what stiffarm.place has returned; of a ranking, place the robot once more")
    if not result.feasible:
        raise ValueError(f"{result.robot}: no place for {result.task} to draw: {result.reason}")
    if result.faces:
        raise ValueError(f"{result.robot}: the map shows one flat zone, and {result.task} is a part")
    reply = answered(asked, "mapping", advice=False, points=size)
    shown, (cells, *_) = reply["shown"], reply["layers"].values()
    ax = _axes(ax)
    x, z = np.asarray(shown["x_m"]), np.asarray(shown["z_m"])
    label = f"worst deflection under {result.force_n:g} N [mm]"
    _field(ax, x, z, cells, label, levels, scale, "scale", colorbar)
    if result.tolerance_mm is not None:
        _tolerance(ax, x, z, cells, result.tolerance_mm)
    _draw_arm(ax, shown)
    _draw_window(ax, result.within_m)
    rim = np.asarray(shown["rim_m"])
    name = f"{result.task}: {result.deflection_mm:.3f} mm at worst"
    ax.plot(rim[:, 0], rim[:, 1], color=_COLOUR["zone"], linewidth=2.5, zorder=4.5, label=name)
    _draw_worst(ax, *shown["worst_m"])
    _finish(ax, shown, shown["subtitle"])
    return ax


def compliance(result: Compliance, *, ax: Axes | None = None) -> Axes:
    """What each of the six drives gives of the compliance in the worst direction.

    Parameters
    ----------
    result : Compliance
        Of `stiffarm.compliance`, one posture.
    ax : matplotlib Axes, optional
        Where to draw; a new figure without it.
    """
    ax = _axes(ax, figsize=(7.0, 3.4))
    worst = float(result.principal_um_per_n[2])
    values, shares = np.asarray(result.worst_shares) * worst, np.asarray(result.worst_shares)
    direction = ", ".join(f"{part + 0:.2f}" for part in result.worst_direction)
    ax.barh(range(6), values, height=0.6, color=_COLOUR["worst_direction"])
    longest = float(values.max())
    for row, (value, share) in enumerate(zip(values, shares)):
        ax.text(value + 0.01 * longest, row, f"{value:.3f}  ({share:.1%})", va="center", fontsize="small")
    ax.set_yticks(range(6), [f"drive {joint}" for joint in range(1, 7)])
    ax.invert_yaxis()
    ax.set_xlim(0, 1.25 * longest)
    ax.set_xlabel(f"part of {worst:.3f} µm/N in the worst direction ({direction}) [µm/N]")
    angles = ", ".join(f"{angle:g}" for angle in result.joints_deg)
    tool = ", ".join(f"{length:.3f}" for length in result.tcp_m)
    title = f"{result.robot}; {_stiffness([result.to_dict()])}\njoints as reported {angles} deg; tool point {tool} m"
    ax.set_title(title, fontsize="medium", loc="left")
    return ax


def ranking(
    result: Ranking,
    *,
    task: str | None = None,
    ax: Axes | Sequence[Axes] | None = None,
    most: int = 24,
    scale: Scale | None = None,
) -> Any:
    """The deflection of every robot at its best place as bars, the best first, as the program draws them.

    A black tick on a bar is the proved lower bound. Serial robots are warm, quasi-serial ones cool, estimated
    ones pale.

    Parameters
    ----------
    result : Ranking
        Of `stiffarm.rank`.
    task : str, optional
        One of its tasks; without it all, a column each.
    ax : matplotlib Axes or sequence of them, optional
        Where to draw, one for each task; a new figure without it.
    most : int
        So many robots are drawn, the first ones.
    scale : (low, high), optional
        From where to where the bars go [mm].

    Returns
    -------
    Axes or numpy array of Axes
        One where one task is drawn.
    """
    tasks = list(result.tasks) if task is None else [task]
    if task is not None and task not in result.tasks:
        raise KeyError(f"no task {task!r}; expected one of {', '.join(result.tasks)}")
    rows = result.rows[: max(most, 1)]
    if ax is None:
        height = 1.5 + 0.27 * len(rows)
        width = 6.8 if len(tasks) == 1 else 2.2 + 2.3 * len(tasks)
        made: Any = _axes(None, ncols=len(tasks), sharey=True, figsize=(width, height))
        axes = list(np.atleast_1d(made))
    else:
        axes = list(np.atleast_1d(np.asarray(ax, dtype=object)))
    if len(axes) != len(tasks):
        raise ValueError(f"{len(axes)} axes for {len(tasks)} tasks; give one for each, or name a task")
    looks = _looks(result)[: len(rows)]
    for number, (one, name) in enumerate(zip(axes, tasks)):
        _bars(one, rows, looks, result.tasks.index(name), scale)
        one.set_title(f"{name} [mm]", fontsize="medium", loc="left", fontweight="bold")
        if number == 0 or ax is not None:
            one.set_yticks(range(len(rows)), [_named(row) for row in rows])
        one.set_ylim(len(rows) - 0.4, -0.6)
    title = f"Worst deflection at the best place, {result.force_n:g} N, {result.model} model; {_stiffness(rows)}"
    chosen = "" if len(rows) == len(result.rows) else f"; the first {len(rows)} of {len(result.rows)} robots"
    if ax is None:
        axes[0].figure.suptitle(title + chosen, fontsize="medium", x=0.01, ha="left")
    legend = "tick: proved lower bound; ~ and pale: estimated"
    axes[-1].set_xlabel(legend, fontsize="x-small", loc="right")
    return axes[0] if len(axes) == 1 else np.asarray(axes, dtype=object)


def _stiffness(rows: Sequence[RankingRow | Placed | ComplianceDict]) -> str:
    """Who says how stiff the drives are: what every deflection rests on."""
    assumed = sum(row["stiffness_source"] == "assumed" for row in rows)
    if assumed == len(rows):
        return "stiffness of the drives assumed"
    if assumed:
        return f"stiffness of the drives assumed of {assumed} of {len(rows)} robots"
    return "stiffness of the drives: " + " and ".join(sorted({row["stiffness_source"] for row in rows}))


def _named(row: RankingRow) -> str:
    return f"{row['robot']}" + (" ~" if row["status"] == "estimated" else "")


def _looks(result: Ranking) -> list[tuple[str, int] | None]:
    return _stiffarm.looks([(row["robot"], row["architecture"]) for row in result.rows])


def _bars(ax: Axes, rows: list[RankingRow], looks: list[Any], task: int, scale: Scale | None) -> None:
    from matplotlib.patheffects import withStroke

    found = [row["cells"][task] for row in rows]
    known = [cell["deflection_mm"] for cell in found if cell["deflection_mm"] is not None]
    tolerance = next((cell["tolerance_mm"] for cell in found if cell["tolerance_mm"] is not None), None)
    most = max(known, default=1.0)
    # A tolerance far above all bars would press them flat.
    seen = tolerance if tolerance is not None and tolerance <= 2 * most else None
    low, high = scale or (0.0, max(most, seen or 0.0))
    room = 0.24 * (high - low)
    for number, (row, look, cell) in enumerate(zip(rows, looks, found)):
        value = cell["deflection_mm"]
        if value is None:
            ax.text(low + 0.02 * room, number, "does not fit", va="center", fontsize="small", color=_COLOUR["grey"])
            continue
        colour = _COLOUR[row["architecture"].replace("-", "_")] if look is None else look[0]
        alpha = 0.3 if row["status"] == "estimated" else 1.0
        ax.barh(number, min(value, high) - low, left=low, height=0.6, color=colour, alpha=alpha, label=_named(row))
        ax.barh(number, min(value, high) - low, left=low, height=0.6, facecolor="none", edgecolor=colour, linewidth=1)
        bound = cell["lower_bound_mm"]
        if bound is not None and low <= bound <= high:
            ax.plot([bound, bound], [number - 0.3, number + 0.3], color=_COLOUR["limit"], linewidth=2)
        if look is not None:
            fill = _COLOUR["estimated"] if row["status"] == "estimated" else colour
            rim = colour if fill != colour else _COLOUR["paper"]
            ax.plot(low + 0.08 * room, number, _MARKS[look[1]], markersize=5, color=fill, markeredgecolor=rim)
        beyond = "» " if value > high else ""
        words = ax.text(min(value, high) + 0.06 * room, number, f"{beyond}{value:.3f}", va="center", fontsize="small")
        # It is read where the line of the tolerance runs through it, too.
        words.set_path_effects([withStroke(linewidth=3, foreground=str(_COLOUR["paper"]))])
    if seen is not None and low <= seen <= high:
        ax.axvline(seen, color=_COLOUR["tolerance"], linestyle="-.", linewidth=1.4, label=f"tolerance {seen:g} mm")
    ax.set_xlim(low, high + room)
    ax.tick_params(axis="y", length=0)
    ax.grid(axis="x", color=_COLOUR["faint"], linewidth=0.8)
    ax.set_axisbelow(True)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


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
        known = dict.fromkeys(row["task"] for row in result.rows)
        raise KeyError(f"no task {task!r}; expected one of {', '.join(known)}")
    lines: dict[tuple[tuple[Any, ...], float | None], list[StudyRow]] = {}
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
