"""`stiffarm.compliance` on a million postures, against what a user would otherwise call from Python.

One thread against one thread, in the same run, round by round in turn: the median, and the ratios. Needs the package and
what `scripts/requirements.txt` pins; the peers are those of the library's benchmarks.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "stiffarm" / "benches" / "peers"))

import timing  # noqa: F401  # before NumPy

import json
import statistics
import time

import kr210
import numpy as np
import spatial_numpy
import spatial_pinocchio
import stiffarm

COUNT = 1_000_000
#: The loop takes some ten microseconds a posture: a tenth of them say as much.
LOOPED = COUNT // 10
ROUNDS = 5


def main() -> None:
    stiffarm.set_threads(1)
    robot = stiffarm.Robot("KR 210 R2700 extra")
    low, high = np.array(kr210.ROBOT["limits"]["joint_deg"]).T
    reported = np.random.default_rng(1).uniform(low, high, (COUNT, 6))
    geometry = kr210.ROBOT["geometry"]
    angles = np.radians(reported) * geometry["sign"] - np.radians(geometry["offset_deg"])
    model, flange = spatial_pinocchio.arm()
    data = model.createData()

    def ours() -> np.ndarray:
        return stiffarm.compliance(robot, joints_deg=reported).worst_um_per_n

    def numpy() -> np.ndarray:
        return spatial_numpy.worst(angles)

    def pinocchio() -> np.ndarray:
        return spatial_pinocchio.worst(model, data, flange, angles[:LOOPED])

    expected = ours()
    for other in (numpy(), pinocchio()):
        # The worse of the two roots where the two softest directions nearly agree.
        np.testing.assert_allclose(other * 1e6, expected[: len(other)], rtol=1e-6)
    works = {"stiffarm": (ours, COUNT), "NumPy": (numpy, COUNT), "Pinocchio": (pinocchio, LOOPED)}
    times: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(ROUNDS):
        for name, (work, count) in works.items():
            start = time.perf_counter()
            work()
            times[name].append((time.perf_counter() - start) / count)
    each = {name: statistics.median(taken) for name, taken in times.items()}
    for name, seconds in each.items():
        print(json.dumps({"name": name, "ns_per_posture": round(seconds * 1e9, 1), "ratio": seconds / each["stiffarm"]}))


if __name__ == "__main__":
    main()
