"""Writes docs/examples/pendant.csv and tracker.csv: what a pendant and a laser tracker would show of an arm, computed by Pinocchio;
and tip.csv and tip_modes.csv: what a tap test of a spindle on a rigid table would show, by the sum of its modes.

Nothing of it was measured. The arm of tracker.csv differs from its drawing by drawn errors, and its tracker reads with noise; both stand in
validation/tracker_truth.csv; drives of the arm of tracker_weighed.csv yield under the masses that its file has (weighed_truth.csv), so that what `stiffarm calibrate` finds has something to be compared with.
"""

from __future__ import annotations

import csv
import pathlib
import random
import tomllib
from collections.abc import Callable

import numpy as np
import pinocchio as pin

import swinging
from reference import ROOT, open_chain_deg
from true_chain import flange, model_of

#: Where the flange stands at joints as reported, deg.
Stands = Callable[[list[float]], pin.SE3]

ROBOT = "KR 210 R2700 extra"
EXAMPLES = ROOT / "docs/examples"
TRUTH = ROOT / "validation"
#: Its file says what its links weigh.
WEIGHED = "KR 210 R2700-2"
#: The table of each arm that a tracker sees, and the arm.
TABLES = {"tracker": ("tracker.csv", ROBOT), "weighed": ("tracker_weighed.csv", WEIGHED)}
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
MODES = [(612, 0.03, 2.2e7, (1, 0, 0)), (655, 0.025, 2.6e7, (0.1, 1, 0)), (1480, 0.02, 5.5e7, (0.7, 0.7, 0.14))]
#: Lines of the analyser, Hz.
LINES = range(4, 2401, 4)


def robot(name: str) -> dict:
    """The robot file of an arm."""
    files = (tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(pathlib.Path(swinging.ROBOTS).glob("*/*.toml")))
    return next(file for file in files if file["name"] == name)


def joints_of(kind: str = "joint") -> list[str]:
    """Headings of the six joints."""
    return [f"{kind}_{i}_deg" for i in range(1, 7)]


def pendant(arm: dict) -> None:
    """Base and tool are those of the arm: no base, no tool."""
    with (EXAMPLES / "pendant.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# What the pendant of a {ROBOT} would show, no base and no tool in force: computed by scripts/example_tables.py.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*joints_of(), "x_mm", "y_mm", "z_mm", "a_deg", "b_deg", "c_deg"])
        for joints in TYPED:
            pose, _ = flange(arm, joints, [0] * 36, [0] * 8, [0] * 12)
            # KUKA turns about z, then the new y, then the new x.
            yaw, pitch, roll = np.rad2deg(pin.rpy.matrixToRpy(pose.rotation))[::-1]
            table.writerow([*joints, *(f"{1e3 * x:.2f}" for x in pose.translation), *(f"{angle:.2f}" for angle in (yaw, pitch, roll))])


def record(name: str, errors: dict, draw: random.Random, drawn: Stands, stands: Stands) -> None:
    """A table of an example and what its arm truly is: postures with the flange well above the floor, one point in twenty not seen."""
    base = pin.SE3(pin.exp3(np.array(TRACKER[3:])), np.array(TRACKER[:3])).inverse()
    lines, worst = [], 0.0
    while len(lines) < ROWS:
        joints = [round(draw.uniform(*limit), 1) for limit in [(-120, 120), (-125, -30), (10, 140), (-170, 170), (-110, 110), (-170, 170)]]
        as_drawn = drawn(joints)
        if as_drawn.translation[2] < 0.3:
            continue
        pose = stands(joints)
        worst = max(worst, float(np.linalg.norm(pose.translation - as_drawn.translation)))
        seen = []
        for point in POINTS:
            at = base.act(pose.act(np.array(point) / 1e3)) * 1e3
            seen += [""] * 3 if draw.random() < 0.05 else [f"{x + draw.gauss(0, NOISE):.3f}" for x in at]
        lines.append([*joints, *seen])
    table_file, robot_name = TABLES[name]
    with (EXAMPLES / table_file).open("w", encoding="utf-8", newline="") as file:
        file.write(f"# Three points on the flange of a {robot_name} as a tracker would see them: computed by scripts/example_tables.py, not measured.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*joints_of(), *(f"{axis}{i}_mm" for i in (1, 2, 3) for axis in "xyz")])
        table.writerows(lines)
    with (TRUTH / f"{name}_truth.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# How the arm of docs/examples/{table_file} differs from its drawing: recorded by scripts/example_tables.py.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*errors, "noise_mm", "points_mm", "tracker_in_base"])
        numbers = [*errors.values(), [NOISE], np.ravel(POINTS).tolist(), TRACKER]
        table.writerow([" ".join(repr(float(x)) for x in each) for each in numbers])
    print(f"{name}: the arm errs by {1e3 * worst:.2f} mm at most")


def tracker(arm: dict) -> None:
    """An arm of which no mass is known."""
    draw = random.Random("a tracker beside the arm")
    errors = {
        "frames_mm_mrad": [round(draw.gauss(0, 0.3), 4) for _ in range(36)],
        "weight_mrad": [round(draw.gauss(0, 0.2), 4) for _ in range(8)],
        "gears_mrad": [round(draw.gauss(0, 0.05), 4) for _ in range(12)],
    }
    record("tracker", errors, draw, lambda joints: flange(arm, joints, [0] * 36, [0] * 8, [0] * 12)[0], lambda joints: flange(arm, joints, *errors.values())[0])


def weighed(arm: dict) -> None:
    """An arm whose file has its masses: its drives yield under them."""
    draw = random.Random("a tracker beside a heavy arm")
    errors = {
        "frames_mm_mrad": [round(draw.gauss(0, 0.3), 4) for _ in range(36)],
        "drive_urad_per_nm": [round(k * draw.uniform(0.6, 1.6), 4) for k in (0.42, 0.27, 0.46, 2.5, 3.0, 2.5)],
    }
    heavy = swinging.of_masses(arm)
    frames, compliance = np.array(errors["frames_mm_mrad"]).reshape(6, 6) / 1e3, np.array(errors["drive_urad_per_nm"]) * 1e-6

    def stands(joints: list[float]) -> pin.SE3:
        theta = np.radians(open_chain_deg(arm, joints))
        sag = -compliance * pin.computeGeneralizedGravity(heavy, heavy.createData(), theta)
        model = model_of(arm, frames)
        data = model.createData()
        pin.framesForwardKinematics(model, data, theta + sag)
        return data.oMf[model.getFrameId("flange")]

    record("weighed", errors, draw, lambda joints: flange(arm, joints, [0] * 36, [0] * 8, [0] * 12)[0], stands)


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
    pendant(robot(ROBOT))
    tracker(robot(ROBOT))
    weighed(robot(WEIGHED))
    tip()
