"""Every figure is a picture with headings, units and something on it."""

import io

import matplotlib.pyplot as plt
import numpy as np
import pytest
import stiffarm
from stiffarm import _asked, plot


def picture(ax):
    data = io.BytesIO()
    ax.figure.savefig(data, format="png")
    plt.close(ax.figure)
    pixels = plt.imread(io.BytesIO(data.getvalue()))
    assert np.unique(pixels.reshape(-1, pixels.shape[2]), axis=0).shape[0] > 50
    return ax


def test_maps():
    for options in ({"zone": "B:0.5", "angle": "free"}, {"zone": "A:0.5"}, {"direction_deg": 20}, {"model": "spatial"}):
        ax = picture(plot.map(stiffarm.map("KR 210 R2700 extra", size=40, **options)))
        assert ax.get_xlabel() == "x from the base [m]" and "KUKA" in ax.get_title(loc="left")
        assert len(ax.patches) == ("zone" in options)
        assert "[mm]" in ax.figure.axes[1].get_ylabel() and "1000 N" in ax.figure.axes[1].get_ylabel()


def bars(ax):
    """Lengths of the filled bars, from top to bottom."""
    filled = [patch for patch in ax.patches if patch.get_facecolor()[3] > 0]
    return [patch.get_width() for patch in sorted(filled, key=lambda patch: patch.get_y())]


def test_rankings():
    drawn = stiffarm.rank(tasks=["A:0.1", "A:1.0", "A:9"], tolerance_mm=2)
    axes = plot.ranking(drawn)
    assert len(axes) == 3
    picture(axes[0])
    for task, ax in enumerate(axes[:2]):
        assert bars(ax) == pytest.approx([row["cells"][task]["deflection_mm"] for row in drawn.rows])
        assert drawn.tasks[task] in ax.get_title(loc="left") and "[mm]" in ax.get_title(loc="left")
    assert [text.get_text() for text in axes[2].texts] == ["does not fit"] * 10 and not axes[2].patches
    assert axes[0].get_yticklabels()[0].get_text() == f"{drawn.rows[0]['robot']} ~"
    assert axes[0].figure.get_suptitle().endswith("stiffness of the drives assumed")
    plt.close("all")
    given = stiffarm.rank(tasks=["A:0.1"], drive_urad_per_nm=2)
    assert plot.ranking(given).figure.get_suptitle().endswith("stiffness of the drives: given")
    # One task, some of the robots, a scale: what lies beyond is marked.
    ax = picture(plot.ranking(stiffarm.rank(tasks="A:0.1"), most=6, scale=(0, 1.5)))
    assert len(bars(ax)) == 6 and max(bars(ax)) == 1.5
    assert ax.texts[-1].get_text().startswith("» ") and len(ax.get_yticks()) == 6
    proved = [line for line in ax.lines if len(set(line.get_xdata())) == 1 and len(line.get_xdata()) == 2]
    assert len(proved) == sum(row["cells"][0]["lower_bound_mm"] <= 1.5 for row in stiffarm.rank(tasks="A:0.1").rows[:6])
    with pytest.raises(KeyError):
        plot.ranking(drawn, task="A:0.2")
    with pytest.raises(ValueError, match="3 tasks"):
        plot.ranking(drawn, ax=plt.subplots()[1])
    plt.close("all")


def test_studies():
    study = stiffarm.study()
    for task in (None, "C"):
        ax = picture(plot.study(study, task=task))
        assert len(ax.get_legend_handles_labels()[0]) == 8 and "Task" in ax.get_title(loc="left")
    with pytest.raises(KeyError):
        plot.study(study, task="Z")


def test_places():
    for options in ({"within_m": "0.5..,0..", "tolerance_mm": 2.5}, {"model": "spatial", "tool_mm": (0, 0, 200)}):
        found = stiffarm.place("KR 210 R2700 extra", task="rect:0.6x0.4", **options)
        ax = picture(plot.place(found, size=60))
        names = ax.get_legend_handles_labels()[1]
        assert f"rect:0.6x0.4: {found.deflection_mm:.3f} mm at worst" in names
        assert "where the zone may stand" in names
        assert ("tolerance 2.5 mm" in names) == ("tolerance_mm" in options and found.deflection_mm < 10)
        # The rim is as wide as the zone from the side, about its centre.
        rim = next(line for line in ax.lines if "at worst" in line.get_label())
        x, z = rim.get_xdata(), rim.get_ydata()
        assert ((x.min() + x.max()) / 2, (z.min() + z.max()) / 2) == pytest.approx((found.x_m, found.z_m), abs=1e-6)
        assert max(np.ptp(x), np.ptp(z)) <= 0.6 + 1e-9
        # In the plane the paper's springs, in space what is published.
        assert ("published" if "model" in options else "assumed") in ax.get_title(loc="left")
    with pytest.raises(ValueError, match="one flat zone"):
        part = {"faces": "top", "angle": 0, "model": "spatial"}
        plot.place(stiffarm.place("KR 210 R2700 extra", task="box:0.3x0.2x0.1", **part))
    with pytest.raises(ValueError, match="no place"):
        plot.place(stiffarm.place("KR 210 R2700 extra", task="circle:9"))
    with pytest.raises(ValueError, match="stiffarm.place"):
        plot.place(stiffarm.rank(tasks="A:0.1").cell("BT200L", "A:0.1"))


def test_a_place_is_drawn_with_the_stiffness_that_was_asked_for():
    def drawn(**more):
        given = {"task": "A:0.3", "within_m": "0.5..,0..", **more}
        reply = _asked.answered(_asked.question("place", given, robot=stiffarm.Robot("BT200L")), "mapping", points=40)
        (cells,) = reply["layers"].values()
        return reply["shown"], cells

    (_, usual), (shown, softer) = drawn(), drawn(drive_urad_per_nm="2")
    assert np.allclose(softer, 2 * usual, rtol=1e-12, equal_nan=True) and "2 urad/(N m)" in shown["subtitle"]


def test_compliances():
    found = stiffarm.compliance("KR 210 R2700 extra", joints_deg=(0, -90, 90, 0, 45, 0), tool_mm=(0, 0, 150))
    ax = picture(plot.compliance(found))
    # What the drives give adds up to the whole.
    assert sum(patch.get_width() for patch in ax.patches) == pytest.approx(found.principal_um_per_n[2])
    assert "µm/N" in ax.get_xlabel() and len(ax.texts) == 6
    assert "stiffness of the drives: published" in ax.get_title(loc="left")


def test_maps_of_one_scale_with_tolerance_force_and_margins():
    directed = stiffarm.map("BT200L", size=40, direction_deg=30)
    ax = picture(plot.map(directed, scale=(0, 5), tolerance_mm=2))
    assert ax.collections[0].get_clim() == (0, 5)
    assert {"tolerance 2 mm", "force of 1000 N"} <= set(ax.get_legend_handles_labels()[1])
    space = stiffarm.map("BT200L", size=30, model="spatial")
    ax = picture(plot.map(space, layer="limit_margin"))
    assert "[deg]" in ax.figure.axes[1].get_ylabel()
    with pytest.raises(ValueError, match="no limit_margin"):
        plot.map(directed, layer="limit_margin")


def test_a_figure_is_drawn_where_it_is_wanted():
    _, axes = plt.subplots(1, 2)
    assert plot.map(stiffarm.map("BT200L", size=20), ax=axes[1], colorbar=False) is axes[1]
    assert not axes[0].has_data() and axes[1].has_data()
    plt.close("all")


def test_colours_are_those_of_the_program():
    from matplotlib.colors import same_color

    def shown(ax):
        return [line.get_color() for line in ax.lines]

    single, series = (dict(part) for part in stiffarm._stiffarm.palette())
    drawn = stiffarm.rank(tasks="A:0.1", tolerance_mm=2)
    looks = stiffarm._stiffarm.looks([(row["robot"], row["architecture"]) for row in drawn.rows])
    for row, (colour, mark) in zip(drawn.rows, looks):
        assert colour in series[f"{row['architecture'].replace('-', '_')}_curves"] and 0 <= mark < 6
    assert len(set(looks)) == 10
    ax = plot.ranking(drawn)
    # Of every row the bar, then its rim.
    named = dict(zip((label.get_text() for label in ax.get_yticklabels()), ax.patches[::2]))
    for row, (colour, _) in zip(drawn.rows, looks):
        name = row["robot"] + (" ~" if row["status"] == "estimated" else "")
        assert same_color(named[name].get_facecolor()[:3], colour)
    assert single["tolerance"] in shown(ax)
    ax = plot.map(stiffarm.map("KR 210 R2700 extra", size=20, zone="B:0.5"))
    assert same_color(ax.patches[0].get_edgecolor(), single["zone"])
    assert [line.get_color() for line in ax.lines if line.get_marker() == "x"] == [single["worst_point"]]
    bands = ax.collections[0].get_cmap()
    assert same_color(bands(0.0), series["scale"][0]) and same_color(bands(1.0), series["scale"][-1])
    plt.close("all")
