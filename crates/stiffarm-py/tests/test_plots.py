"""Every figure is a picture with headings, units and something on it."""

import io

import matplotlib.pyplot as plt
import numpy as np
import pytest
import stiffarm
from stiffarm import plot


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


def test_rankings_and_studies():
    ax = picture(plot.ranking(stiffarm.rank(tasks=["A:0.1", "A:1.0", "A:9"], tolerance_mm=2)))
    assert len(ax.lines) == 11 and "[mm]" in ax.get_ylabel()
    assert np.isnan(ax.lines[0].get_ydata()[2])
    assert len(plot.ranking(stiffarm.rank(tasks="A:0.1"), most=3).lines) == 3
    study = stiffarm.study()
    for task in (None, "C"):
        ax = picture(plot.study(study, task=task))
        assert len(ax.get_legend_handles_labels()[0]) == 8 and "Task" in ax.get_title(loc="left")
    with pytest.raises(KeyError):
        plot.study(study, task="Z")


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
    drawn = stiffarm.rank(tasks=["A:0.1", "A:0.2"], tolerance_mm=2)
    warm, cool = iter(series["serial_curves"]), iter(series["quasi_serial_curves"])
    expected = [next(warm if row["architecture"] == "serial" else cool) for row in drawn.rows]
    ax = plot.ranking(drawn)
    assert shown(ax) == [*expected, single["tolerance"]]
    ax = plot.map(stiffarm.map("KR 210 R2700 extra", size=20, zone="B:0.5"))
    assert same_color(ax.patches[0].get_edgecolor(), single["zone"])
    assert [line.get_color() for line in ax.lines if line.get_marker() == "x"] == [single["worst_point"]]
    bands = ax.collections[0].get_cmap()
    assert same_color(bands(0.0), series["scale"][0]) and same_color(bands(1.0), series["scale"][-1])
    plt.close("all")
