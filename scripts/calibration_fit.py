"""Writes validation/calibration_fit.csv: what SciPy's least_squares finds of the arm of docs/examples/tracker.csv, with Pinocchio's flanges.

Unknown are the tracker's frame, three points and all errors of the arm, with priors and a noise that are given. Least is the sum of the squares of
distances over the noise and of errors over their priors. The Jacobian is SciPy's, by differences.
"""

from __future__ import annotations

import csv
import tomllib
from importlib.metadata import version

import numpy as np
import pinocchio as pin
import scipy.optimize

from reference import ROBOTS, ROOT, open_chain_deg
from true_chain import model_of, yielded

TABLE = ROOT / "docs/examples/tracker.csv"
TARGET = ROOT / "validation/calibration_fit.csv"
ROBOT = "KR 210 R2700 extra"
#: m, of a coordinate.
NOISE = 0.02e-3
#: Standard deviations of errors of frames, m and rad, of weight and of gears, rad.
PRIORS = np.repeat([0.3e-3, 0.5e-3, 0.1e-3], [36, 8, 12])
#: Lengths and angles become numbers about 1.
SCALE = 1e-3


def main() -> None:
    files = (tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(ROBOTS.glob("*.toml")))
    robot = next(file for file in files if file["name"] == ROBOT)
    with TABLE.open(encoding="utf-8") as file:
        rows = list(csv.reader(line for line in file if not line.startswith("#")))[1:]
    theta = [np.radians(open_chain_deg(robot, [float(x) for x in row[:6]])) for row in rows]
    seen = [[None if row[6 + 3 * j] == "" else np.array([float(x) for x in row[6 + 3 * j : 9 + 3 * j]]) / 1e3 for j in range(3)] for row in rows]
    unit = np.eye(20)
    turned = [np.stack([yielded(robot, q, each[:8], each[8:]) for each in unit], axis=1) for q in theta]

    def flanges(errors: np.ndarray) -> list[pin.SE3]:
        model = model_of(robot, errors[:36].reshape(6, 6))
        data, last, found = model.createData(), model.getFrameId("flange"), []
        for q, parts in zip(theta, turned, strict=True):
            pin.framesForwardKinematics(model, data, q + parts @ errors[36:])
            found.append(data.oMf[last].copy())
        return found

    # From the frame and the points that the arm as drawn has with the rest at zero: near enough to start from.
    truth = (ROOT / "validation/tracker_truth.csv").read_text(encoding="utf-8").splitlines()[-1].split(",")
    points, tracker = (np.array([float(x) for x in truth[i].split()]) for i in (4, 5))
    start = pin.SE3(pin.exp3(tracker[3:]), tracker[:3]).inverse()

    def residuals(x: np.ndarray) -> np.ndarray:
        turn, shift, at, errors = np.split(x * SCALE, [3, 6, 15])
        base = pin.SE3(pin.exp3(turn) @ start.rotation, start.translation + shift)
        at = points.reshape(3, 3) / 1e3 + at.reshape(3, 3)
        off = [
            point - base.act(flange.act(at[j]))
            for flange, row in zip(flanges(errors), seen, strict=True)
            for j, point in enumerate(row)
            if point is not None
        ]
        return np.concatenate([np.ravel(off) / NOISE, errors / PRIORS])

    found = scipy.optimize.least_squares(residuals, np.zeros(71), jac="3-point", method="lm", ftol=1e-15, xtol=1e-15, gtol=1e-15)
    turn, shift, at, errors = np.split(found.x * SCALE, [3, 6, 15])
    at = points.reshape(3, 3) / 1e3 + at.reshape(3, 3)
    with TARGET.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# recorded by scripts/calibration_fit.py: SciPy {version('scipy')}, Pinocchio (pin {version('pin')}). Least sum of squares; points in the flange, m; errors of frames, weight and gears, m and rad.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["noise_m", "priors", "cost", "points_m", "errors"])
        numbers = [[NOISE], PRIORS, [2 * found.cost], np.ravel(at), errors]
        table.writerow([" ".join(repr(float(x)) for x in each) for each in numbers])
    print(found.message, 2 * found.cost, found.nfev)


if __name__ == "__main__":
    main()
