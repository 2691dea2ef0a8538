"""Writes validation/link_distances.csv: how near links of an arm come to each other and to a floor, by MuJoCo's kinematics and distances.

Some robots have capsules that enclose their links, some radii along the lines of the arm, and of some nothing is known (docs/robot_file.md, body): the
floor is that of the wide bodies in which nine known arms in ten lie, links are as slim as the radii that are estimated from payload and reach.
Angles are model angles: zero has upper arm and forearm upright. Not compared: links that are joined to each other and what the file names
(not_compared); base and column with the floor.
"""

from __future__ import annotations

import csv
import pathlib
import random
import tomllib
from importlib.metadata import version
from typing import Any

import mujoco
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROBOTS = ROOT / "crates/stiffarm/robots"
TARGET = ROOT / "validation/link_distances.csv"
ENCLOSED = ("KR 4 R600", "KR 16 R2010-2", "KR 210 R2700-2", "KR 240 R3330", "KR 560 R3100-2")
ALONG_LINES = ("KR 210 R2700 extra", "TX2-90L", "IRB 120-3/0.58", "R-2000iC/165F", "BX100N")
ESTIMATED = ("KR 210 R2700 extra", "R-2000iC/165F", "BT200L", "BX100N")
POSTURES = 6
#: m, below the base.
FLOOR = -0.25
LENGTHS = ("a1", "a2", "b", "c1", "c2", "c3", "c4")
#: No distance in an arm is larger, m.
FAR = 100.0
#: By link: what may meet it, as others stand between.
MEET = {0: range(3, 7), 1: range(3, 7), 2: range(5, 7)}

Capsule = tuple[np.ndarray, np.ndarray, float]


def robots() -> dict[str, dict[str, Any]]:
    files = (tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(ROBOTS.glob("*/*.toml")))
    return {file["name"]: file for file in files if "geometry" in file}


def points(robot: dict[str, Any]) -> list[np.ndarray]:
    """Shoulder, elbow, where the forearm bends, wrist centre and flange upright, m."""
    a1, a2, b, c1, c2, c3, c4 = (robot["geometry"][f"{name}_mm"] / 1000 for name in LENGTHS)
    steps = [(a1, b, c1), (0, 0, c2), (a2, 0, 0), (0, 0, c3), (0, 0, c4)]
    return list(np.cumsum(np.array(steps, dtype=float), axis=0))


def along_lines(robot: dict[str, Any]) -> list[tuple[int, Capsule]]:
    """Tubes about the lines of the links, each with the number of what carries it."""
    shoulder, elbow, bend, wrist, flange = points(robot)
    column = 0.085 * (robot["payload_kg"] * robot["reach_m"]) ** 0.25
    upper_arm, forearm, thin = (part * column for part in (0.55, 0.45, 0.33))
    top = np.array([0, 0, shoulder[2]])
    length = np.linalg.norm(flange - wrist)
    # The round end of the wrist ends at the flange; a wrist that is thicker than long is a ball.
    end = wrist + (flange - wrist) * max(0.0, 1 - thin / max(length, thin))
    lines = [(1, np.zeros(3), top, column), (1, top, shoulder, upper_arm), (2, shoulder, elbow, upper_arm)]
    lines += [(3, elbow, bend, forearm), (3, bend, wrist, forearm), (5, wrist, end, thin)]
    return [(link, (one, other, radius)) for link, one, other, radius in lines]


def estimated(robot: dict[str, Any]) -> list[tuple[int, Capsule]]:
    """What stands in for the links towards all but each other."""
    shoulder, elbow, bend, wrist, _ = points(robot)
    c1, c4 = shoulder[2], robot["geometry"]["c4_mm"] / 1000
    eighth = robot["payload_kg"] ** 0.125
    t, w = eighth * robot["reach_m"] ** 0.5, eighth**2
    back, side, up = np.eye(3)
    housing = np.array([(elbow[0] + bend[0]) / 2 - 0.02 * t, elbow[1], elbow[2]])
    foot, low = 0.06 * t * up, c1 - 0.04 * t
    arm = min(0.165 * t, 0.9 * c1)
    return [
        (0, (foot, foot - 0.16 * t * back, 0.22 * t)),
        (0, (foot, max(c1 - 0.2 * t, 0.06 * t) * up, 0.24 * t)),
        (1, (low * up, np.array([shoulder[0], shoulder[1], low]), 0.27 * t)),
        *[(2, (shoulder + y * t * side, elbow + y * t * side, arm)) for y in (0.1, -0.1)],
        (3, (housing - 0.05 * t * up, housing + 0.05 * t * up, 0.26 * t)),
        (3, (bend, wrist, 0.15 * eighth)),
        (5, (wrist, wrist, 0.08 * w)),
        (5, (wrist, wrist + max(c4 - 0.035 * w, 0.0) * up, 0.068 * w)),
    ]


def enclosing(robot: dict[str, Any]) -> list[tuple[int, Capsule]]:
    rows = [(link["link"], np.array(row) / 1000) for link in robot["body"]["link"] for row in link["capsules_mm"]]
    return [(link, (row[:3], row[3:6], float(row[6]))) for link, row in rows]


def geom(name: str, capsule: Capsule, at: np.ndarray) -> str:
    one, other, radius = capsule
    text = lambda place: " ".join(repr(float(x)) for x in place - at)  # noqa: E731
    if np.linalg.norm(one - other) < 1e-9:
        return f'<geom name="{name}" type="sphere" pos="{text(one)}" size="{float(radius)!r}"/>'
    return f'<geom name="{name}" type="capsule" fromto="{text(one)} {text(other)}" size="{float(radius)!r}"/>'


def model(robot: dict[str, Any], capsules: list[tuple[int, Capsule]]) -> mujoco.MjModel:
    """The arm upright at zero; geoms `link_number`."""
    shoulder, elbow, _, wrist, _ = points(robot)
    joints = [np.zeros(3), shoulder, elbow, wrist, wrist, wrist]
    of = lambda link, at: "".join(geom(f"{link}_{i}", one, at) for i, (number, one) in enumerate(capsules) if number == link)  # noqa: E731
    body, before = "", [np.zeros(3), *joints]
    for link in range(6, 0, -1):
        at, axis = joints[link - 1], "0 1 0" if link in (2, 3, 5) else "0 0 1"
        step = " ".join(repr(float(x)) for x in at - before[link - 1])
        weighs = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
        body = f'<body pos="{step}"><joint axis="{axis}"/>{weighs}{of(link, at)}{body}</body>'
    floor = f'<geom name="floor" type="plane" size="9 9 1" pos="0 0 {FLOOR}"/>'
    return mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{floor}{of(0, np.zeros(3))}{body}</worldbody></mujoco>")


def nearest(arm: mujoco.MjModel, data: mujoco.MjData, pairs: list[tuple[str, str]]) -> float:
    number = {name: mujoco.mj_name2id(arm, mujoco.mjtObj.mjOBJ_GEOM, name) for pair in pairs for name in pair}
    return min(mujoco.mj_geomDistance(arm, data, number[one], number[other], FAR, None) for one, other in pairs)


def main() -> None:
    known, rows = robots(), []
    for name, towards_links, towards_floor in [
        *((name, enclosing, enclosing) for name in ENCLOSED),
        *((name, along_lines, along_lines) for name in ALONG_LINES),
        *((name, along_lines, estimated) for name in ESTIMATED),
    ]:
        robot, rng = known[name], random.Random(f"distances {name}")
        apart = {tuple(pair) for pair in robot.get("body", {}).get("not_compared", [])}
        arms = []
        for capsules in (towards_links(robot), towards_floor(robot)):
            names = [(link, f"{link}_{i}") for i, (link, _) in enumerate(capsules)]
            links = [(one, other) for low, one in names for high, other in names if high in MEET.get(low, ()) and (low, high) not in apart]
            arm = model(robot, capsules)
            arms.append((arm, mujoco.MjData(arm), links, [(one, "floor") for link, one in names if link > 1]))
        for _ in range(POSTURES):
            theta = [round(rng.uniform(-most, most), 4) for most in (180, 80, 140, 180, 120, 180)]
            for arm, data, _, _ in arms:
                data.qpos[:] = np.radians(theta)
                mujoco.mj_kinematics(arm, data)
            distances = [nearest(*arms[0][:3]), nearest(*arms[1][:2], arms[1][3])]
            rows.append([name, " ".join(map(str, theta)), *(f"{1000 * distance:.9f}" for distance in distances)])
    with TARGET.open("w", newline="", encoding="utf-8") as file:
        file.write(f"# MuJoCo {version('mujoco')}, scripts/distances.py; negative where capsules overlap. A floor {-1000 * FLOOR:.0f} mm below the base.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["robot", "model_angles_deg", "between_links_mm", "above_floor_mm"])
        table.writerows(rows)
    print(f"{len(rows)} postures of {len(rows) // POSTURES} bodies")


if __name__ == "__main__":
    main()
