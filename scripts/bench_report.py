"""Prints the ratios of a benchmark run: ours (criterion's medians) against the peers', and whole runs of the program.

Reads what the peers print, a line of JSON each; where a peer ran several times, its mean counts.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import time

CRITERION = pathlib.Path(os.environ["CRITERION_HOME"])
PROGRAM = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", "target")) / "dist/stiffarm"
# Directories of criterion, a kind of build each: with registers of eight numbers where the machine has them, and of four.
WIDE, NARROW = "wide", "narrow"
HAS_AVX512 = "avx512f" in pathlib.Path("/proc/cpuinfo").read_text().split() if sys.platform == "linux" else False
WIDTHS = {WIDE: "AVX-512", NARROW: "AVX2"} if HAS_AVX512 else {WIDE: "this machine's registers"}
POSTURES, CELLS = 100_000, 1_000_000


def median_s(benchmark, width=WIDE):
    estimates = json.loads((CRITERION / benchmark / width / "estimates.json").read_text())
    return estimates["median"]["point_estimate"] * 1e-9


def peers(lines):
    """Seconds per item of every peer, by its name."""
    runs = {}
    for line in filter(str.strip, lines):
        run = json.loads(line)
        runs.setdefault(run["name"], []).append(run)
    return {
        name: (f"{name} ({of_one[0]['version']})", statistics.mean(1 / run["per_second"] for run in of_one))
        for name, of_one in runs.items()
    }


def compare(title, unit, count, ours, theirs, widths=WIDTHS):
    """Ours are benchmarks with what they do, built for registers of these widths; theirs are names with seconds per item."""
    print(f"\n{title}, million {unit} a second, one thread")
    for name, seconds in theirs:
        print(f"  {1e-6 / seconds:8.2f}  {name}")
    for benchmark, what in ours:
        for width, label in widths.items():
            seconds = median_s(benchmark, width) / count
            ratios = ", ".join(f"{peer / seconds:.1f} x {name.split(' (')[0]}" for name, peer in theirs)
            print(f"  {1e-6 / seconds:8.2f}  {what}{label and ', ' + label}: {ratios}")


def wall_s(arguments):
    """The median of as many runs as three seconds hold, at least five."""
    times = []
    while len(times) < 5 or sum(times) < 3:
        start = time.perf_counter()
        subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main():
    found = peers(sys.stdin)
    maps = [("limits", "map with limits"), ("limits_fresh_memory", "the same, into fresh memory")]
    maps += [("no_limits", "without limits"), ("limits_directed", "one direction of the force")]
    ours = [(f"map_1000x1000/{name}", what) for name, what in maps]
    compare("Planar map, worst direction", "points", CELLS, ours, [found["NumPy, planar map"]])

    six_axis = [found[name] for name in ("NumPy, closed form", "Pinocchio in Python", "Pinocchio in C++") if name in found]
    ours = [("postures_100k/flange", "ours, at the flange"), ("postures_100k/tool_aside", "ours, a tool aside")]
    compare("Six-axis compliance of postures, worst direction", "postures", POSTURES, ours, six_axis)

    ours = [("poses_100k/all_postures_limits_and_compliance", "ours, with limits and compliance")]
    rust = "poses_100k/rs_opw_kinematics_inverse"
    runs = [median_s(rust, width) / POSTURES for width in (WIDE, NARROW)]
    inverse = ("rs-opw-kinematics (inverse alone, neither limits nor compliance)", statistics.mean(runs))
    compare("All postures of poses", "poses", POSTURES, ours, [inverse])

    proved, grid = (median_s(f"place_in_space/{name}") for name in ("with_proof", "grid_without_proof"))
    print("\nThe best place of a zone in space, one thread, s")
    print(f"  {grid:8.3f}  on a grid of 0.1 m and 10 deg, by the same kernel, without a proof")
    print(f"  {proved:8.3f}  with a proved bound: {grid / proved:.2f} x the grid")

    ours, scipy = [("modes_1k/frequencies", "ours")], found["Pinocchio and SciPy, frequencies"]
    # Posture by posture, whatever the registers.
    compare("Frequencies of an arm with six springs and masses", "postures", 1000, ours, [scipy], {WIDE: ""})

    print("\nVerbs, one thread, ms")
    verbs = [(f"place/{name}", f"place, {name}") for name in ("exact", "within", "within_any_angle")]
    verbs += [("rank_ten_robots_six_tasks", "rank, ten robots, six tasks"), ("table_1/with_boundaries", "Table I with boundaries")]
    for benchmark, what in verbs:
        print(f"  {median_s(benchmark) * 1e3:8.3f}  {what}")

    print("\nWhole runs of the program, all cores and one thread, ms")
    spatial = ["--task", "rect:0.5x0.5", "--model", "spatial"]
    place = ["place", "BT200L"]
    for arguments in (["rank"], [*place, "--task", "B:0.5"], ["robots", "list"], ["study"], ["rank", *spatial], [*place, *spatial]):
        all_cores, one_thread = wall_s(arguments), wall_s([*arguments, "--threads", "1"])
        print(f"  {all_cores * 1e3:8.1f} {one_thread * 1e3:8.1f}  stiffarm {' '.join(arguments)}")


if __name__ == "__main__":
    main()
