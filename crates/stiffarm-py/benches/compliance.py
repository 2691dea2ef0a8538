"""`stiffarm.compliance` on a million postures, against the library's own kernel and what a user would otherwise call from Python.

One thread against one thread, in the same run, round by round in turn: the median, and the ratios. Needs the package and
what `scripts/requirements.txt` pins; the peers are those of the library's benchmarks. The kernel is what `cargo bench` has measured,
where CRITERION_HOME says where that lies; ``--alone`` leaves the peers out.
"""

import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "stiffarm" / "benches" / "peers"))

import timing  # noqa: F401  # before NumPy

import json
import statistics
import time

import kr210
import numpy as np
import stiffarm

COUNT = 1_000_000
#: The loop takes some ten microseconds a posture: a tenth of them say as much.
LOOPED = COUNT // 10
ROUNDS = 5
#: Of a benchmark of the library: a hundred thousand postures, joint by joint, at the flange.
KERNEL, KERNEL_COUNT = "postures_100k/flange", 100_000


def kernel() -> float | None:
    """Seconds a posture of the kernel itself; None where it was not measured."""
    home = os.environ.get("CRITERION_HOME")
    found = sorted(pathlib.Path(home).glob(f"{KERNEL}/*/estimates.json"), key=os.path.getmtime) if home else []
    return json.loads(found[-1].read_text())["median"]["point_estimate"] * 1e-9 / KERNEL_COUNT if found else None


def main() -> None:
    stiffarm.set_threads(1)
    robot = stiffarm.Robot("KR 210 R2700 extra")
    low, high = np.array(kr210.ROBOT["limits"]["joint_deg"]).T
    reported = np.random.default_rng(1).uniform(low, high, (COUNT, 6))

    def ours() -> np.ndarray:
        return stiffarm.compliance(robot, joints_deg=reported).worst_um_per_n

    works = {"stiffarm": (ours, COUNT), **({} if "--alone" in sys.argv else peers(reported, ours()))}
    times: dict[str, list[float]] = {name: [] for name in works}
    for _ in range(ROUNDS):
        for name, (work, count) in works.items():
            start = time.thread_time()
            work()
            times[name].append((time.thread_time() - start) / count)
    each = {name: statistics.median(taken) for name, taken in times.items()}
    of_kernel = kernel()
    if of_kernel is not None:
        each["the kernel in Rust"] = of_kernel
    for name, seconds in each.items():
        print(json.dumps({"name": name, "ns_per_posture": round(seconds * 1e9, 1), "ratio": seconds / each["stiffarm"]}))


def peers(reported: np.ndarray, expected: np.ndarray) -> dict:
    """What else computes the same, each proved to do so."""
    import spatial_numpy
    import spatial_pinocchio

    geometry = kr210.ROBOT["geometry"]
    angles = np.radians(reported) * geometry["sign"] - np.radians(geometry["offset_deg"])
    model, flange = spatial_pinocchio.arm()
    data = model.createData()

    def numpy() -> np.ndarray:
        return spatial_numpy.worst(angles)

    def pinocchio() -> np.ndarray:
        return spatial_pinocchio.worst(model, data, flange, angles[:LOOPED])

    for other in (numpy(), pinocchio()):
        # The worse of the two roots where the two softest directions nearly agree.
        np.testing.assert_allclose(other * 1e6, expected[: len(other)], rtol=1e-6)
    return {"NumPy": (numpy, COUNT), "Pinocchio": (pinocchio, LOOPED)}


if __name__ == "__main__":
    main()
