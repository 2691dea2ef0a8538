"""Writes docs/examples/pendant.csv and tracker.csv: what a pendant and a laser tracker would show of an arm, computed by Pinocchio;
and tip.csv and tip_modes.csv: what a tap test of a spindle on a rigid table would show, by the sum of its modes.

Nothing of it was measured. The arm of tracker.csv differs from its drawing by drawn errors, and its tracker reads with noise; both stand in
validation/tracker_truth.csv, so that what `stiffarm calibrate` finds has something to be compared with.
"""

from __future__ import annotations

import csv
import pathlib
import random
import tomllib

import numpy as np
import pinocchio as pin

from reference import ROBOTS, ROOT
from true_chain import flange

ROBOT = "KR 210 R2700 extra"
EXAMPLES = ROOT / "docs/examples"
TRUTH = ROOT / "validation/tracker_truth.csv"
#: Whole degrees, as they are typed at the pendant; every joint moves.
TYPED = [
    [0, -90, 90, 0, 45, 0],
    [30, -70, 80, 40, 60, 10],
    [-40, -110, 100, -60, -50, 90],
    [60, -60, 60, 100, 70, -120],
    [-25, -80, 110, -120, 40, 45],
    [15, -120, 130, 20, -80, -60],
]
ROWS = 40
#: mm in the flange frame: reflectors on a plate.
POINTS = [(110.0, 40.0, 30.0), (-60.0, 95.0, 30.0), (-50.0, -100.0, 80.0)]
#: mm, of a coordinate.
NOISE = 0.02
#: Position, m, and rotation vector, rad, in the arm's base.
TRACKER = [3.1, -1.9, 1.4, 0.02, -0.01, 2.2]

#: Hz, share of critical damping, N/m and direction in the tool frame: in the range of small electric spindles.
MODES = [(612, 0.03, 2.2e7, (1, 0, 0)), (655, 0.025, 2.6e7, (0.1, 1, 0)), (1480, 0.02, 5.5e7, (0.5, 0.5, 0.1))]
#: Lines of the analyser, Hz.
LINES = range(4, 2401, 4)


def robot() -> dict:
    """The robot file of the arm."""
    files = (tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(pathlib.Path(ROBOTS).glob("*.toml")))
    return next(file for file in files if file["name"] == ROBOT)


def joints_of(kind: str = "joint") -> list[str]:
    """Headings of the six joints."""
    return [f"{kind}_{i}_deg" for i in range(1, 7)]


def pendant(arm: dict) -> None:
    """Base and tool are those of the arm: no base, no tool."""
    with (EXAMPLES / "pendant.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# What the pendant of a {ROBOT} would show, no base and no tool in force: computed by scripts/example_tables.py.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*joints_of(), "x_mm", "y_mm", "z_mm"])
        for joints in TYPED:
            pose, _ = flange(arm, joints, [0] * 36, [0] * 8, [0] * 12)
            table.writerow([*joints, *(f"{1e3 * x:.2f}" for x in pose.translation)])


def tracker(arm: dict) -> None:
    """Postures with the flange well above the floor, one point in twenty not seen."""
    draw = random.Random("a tracker beside the arm")
    errors = {
        "frames_mm_mrad": [round(draw.gauss(0, 0.3), 4) for _ in range(36)],
        "weight_mrad": [round(draw.gauss(0, 0.2), 4) for _ in range(8)],
        "gears_mrad": [round(draw.gauss(0, 0.05), 4) for _ in range(12)],
    }
    base = pin.SE3(pin.exp3(np.array(TRACKER[3:])), np.array(TRACKER[:3])).inverse()
    lines, worst = [], 0.0
    while len(lines) < ROWS:
        joints = [round(draw.uniform(*limit), 1) for limit in [(-120, 120), (-125, -30), (10, 140), (-170, 170), (-110, 110), (-170, 170)]]
        drawn, _ = flange(arm, joints, [0] * 36, [0] * 8, [0] * 12)
        if drawn.translation[2] < 0.3:
            continue
        pose, _ = flange(arm, joints, *errors.values())
        worst = max(worst, float(np.linalg.norm(pose.translation - drawn.translation)))
        seen = []
        for point in POINTS:
            at = base.act(pose.act(np.array(point) / 1e3)) * 1e3
            seen += [""] * 3 if draw.random() < 0.05 else [f"{x + draw.gauss(0, NOISE):.3f}" for x in at]
        lines.append([*joints, *seen])
    with (EXAMPLES / "tracker.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# Three points on the flange of a {ROBOT} as a tracker would see them: computed by scripts/example_tables.py, not measured.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*joints_of(), *(f"{axis}{i}_mm" for i in (1, 2, 3) for axis in "xyz")])
        table.writerows(lines)
    with TRUTH.open("w", encoding="utf-8", newline="") as file:
        file.write("# How the arm of docs/examples/tracker.csv differs from its drawing: recorded by scripts/example_tables.py.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*errors, "noise_mm", "points_mm", "tracker_in_base"])
        numbers = [*errors.values(), [NOISE], np.ravel(POINTS).tolist(), TRACKER]
        table.writerow([" ".join(repr(float(x)) for x in each) for each in numbers])
    print(f"the arm errs by {1e3 * worst:.2f} mm at most")


def tip() -> None:
    """Axes of the tool; the response is displacement over force."""
    said = "# Spindle, holder and cutter on a rigid table, made up: computed by scripts/example_tables.py.\n"
    with (EXAMPLES / "tip_modes.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(said)
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["freq_hz", "damping_ratio", "stiffness_n_per_m", "ux", "uy", "uz"])
        table.writerows([own, ratio, f"{stiffness:g}", *along] for own, ratio, stiffness, along in MODES)
    with (EXAMPLES / "tip.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(said)
        table = csv.writer(file, lineterminator="\n")
        parts = [(0, 0), (1, 1), (0, 1)]
        table.writerow(["freq_hz", *(f"g{'xyz'[i]}{'xyz'[j]}_{part}" for i, j in parts for part in ("re", "im"))])
        for line in LINES:
            response = np.zeros((3, 3), dtype=complex)
            for own, ratio, stiffness, along in MODES:
                unit = np.array(along) / np.linalg.norm(along)
                share = line / own
                response += np.outer(unit, unit) / (stiffness * (1 - share**2 + 2j * ratio * share))
            told = [response[part] for part in parts]
            table.writerow([line, *(f"{part:.3e}" for one in told for part in (one.real, one.imag))])


if __name__ == "__main__":
    pendant(robot())
    tracker(robot())
    tip()
