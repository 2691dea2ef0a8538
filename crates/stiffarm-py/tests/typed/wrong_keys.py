"""What a type checker must not let pass, a line each: mypy says so where one of them is no error."""

import numpy as np
import stiffarm
from stiffarm import cluster, types

placed = stiffarm.place("BT200L", task="A:0.3")
placed.deflection_m  # type: ignore[attr-defined]
placed.deflection_mm + 1.0  # type: ignore[operator]
placed.to_dict()["deflection"]  # type: ignore[typeddict-item]
placed.to_dict()["pass"]
placed.schema["versions"]  # type: ignore[typeddict-item]
if placed.resolution is not None and placed.faces is not None and placed.cell is not None:
    placed.resolution["box"]  # type: ignore[typeddict-item]
    placed.faces[0]["faces"]  # type: ignore[typeddict-item]
    placed.cell["mounts"]  # type: ignore[typeddict-item]
stiffarm.cell("BT200L", "A:0.3")["robots"]  # type: ignore[typeddict-item]
stiffarm.place("BT200L", task="A:0.3", tolerance="2")  # type: ignore[call-arg]
stiffarm.place("BT200L", task="A:0.3", progress="yes")  # type: ignore[arg-type]

ranking = stiffarm.rank(tasks="A:0.3")
ranking.rows[0]["cell"]  # type: ignore[typeddict-item]
ranking.rows[0]["cells"][0]["deflection"]  # type: ignore[typeddict-item]
ranking.winners[0]["winner"]  # type: ignore[typeddict-item]
ranking.winner  # type: ignore[attr-defined]
stiffarm.rank(tasks="A:0.3", architecture="cereal")  # type: ignore[arg-type]

study = stiffarm.study()
study.rows[0]["mu"]  # type: ignore[typeddict-item]
study.boundaries[0]["size"]  # type: ignore[typeddict-item]

section = stiffarm.map("BT200L")
section.worst  # type: ignore[attr-defined]
section.to_dict()["y_m"]  # type: ignore[typeddict-item]

one = stiffarm.compliance("BT200L", joints_deg=(0.0, -90.0, 90.0, 0.0, 0.0, 0.0))
one.to_dict()["worst"]  # type: ignore[typeddict-item]
many = stiffarm.compliance("BT200L", joints_deg=np.zeros((2, 6)))
many.joints_deg  # type: ignore[union-attr]

found = stiffarm.identify("measured.csv", robot="BT200L")
found.drives[0]["compliance"]  # type: ignore[typeddict-item]
found.residuals[0]["sigma"]  # type: ignore[typeddict-item]
stiffarm.identify("measured.csv", robot="BT200L", fit="best")  # type: ignore[arg-type]
plan = stiffarm.measure("BT200L")
plan.runs[0]["joints"]  # type: ignore[typeddict-item]
if plan.compared is not None:
    plan.compared["name"]  # type: ignore[typeddict-item]

wins = cluster.load("answers").wins()
wins.rows[0]["shares"]  # type: ignore[typeddict-item]
wins.to_dict()["row"]  # type: ignore[typeddict-item]


def right(row: types.RankingRow, cell: types.Placed) -> tuple[str, "float | None", int]:
    """Of these nothing is wrong."""
    return row["robot"], cell["deflection_mm"], placed.to_dict()["schema"]["version"]
