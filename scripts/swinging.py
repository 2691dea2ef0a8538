"""Writes validation/modes_cases.csv: frequencies and shapes of arms that swing, by Pinocchio's mass matrix and SciPy's eigenvalues, and how weight turns their joints.

The robots are those whose file says what every link weighs. With the springs `K = diag(1/k)` of the drives and the mass matrix `M(q)` of
Pinocchio's `crba`, SciPy's `eigh(K, M)` has the squares of the frequencies, and shapes with `v^T M v = 1`; the tip moves by `J v`.
"""

from __future__ import annotations

import csv
import pathlib
import random
import tomllib
from importlib.metadata import version
from typing import Any

import numpy as np
import pinocchio as pin
import scipy.linalg

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROBOTS = ROOT / "crates/stiffarm/robots"
TARGET = ROOT / "validation/modes_cases.csv"
LENGTHS = ("a1", "a2", "b", "c1", "c2", "c3")
POSTURES = 3
#: m/s^2.
GRAVITY = 9.80665


def weighed() -> list[dict[str, Any]]:
    """Serial robots whose file says what every link weighs, and nothing of springs beside the drives."""
    files = (tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(ROBOTS.glob("*/*.toml")))
    return [file for file in files if {body["link"] for body in file.get("mass", [])} >= set(range(1, 7)) and "compensator" not in file and file["architecture"] == "serial"]


def inertia(body: dict[str, Any]) -> np.ndarray:
    xx, xy, xz, yy, yz, zz = body["inertia_kg_m2"]
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def of_masses(robot: dict[str, Any]) -> pin.Model:
    """The arm upright at zero with what its links weigh."""
    a1, a2, b, c1, c2, c3 = (robot["geometry"][f"{name}_mm"] / 1000 for name in LENGTHS)
    about_y, about_z, here = pin.JointModelRY(), pin.JointModelRZ(), np.zeros(3)
    joints = [about_z, about_y, about_y, about_z, about_y, about_z]
    steps = [here, np.array([a1, b, c1]), np.array([0, 0, c2]), np.array([a2, 0, c3]), here, here]
    model, at, places = pin.Model(), np.zeros(3), []
    model.gravity = pin.Motion(np.array([0, 0, -GRAVITY]), np.zeros(3))
    for parent, (joint, step) in enumerate(zip(joints, steps, strict=True)):
        model.addJoint(parent, joint, pin.SE3(np.eye(3), step), f"joint {parent + 1}")
        at = at + step
        places.append(at)
    for body in robot["mass"]:
        if body["link"] > 0:
            lever = np.array(body["com_mm"]) / 1000 - places[body["link"] - 1]
            model.appendBodyToJoint(body["link"], pin.Inertia(body["mass_kg"], lever, inertia(body)), pin.SE3.Identity())
    return model


def arm(robot: dict[str, Any], tool: dict[str, Any]) -> tuple[pin.Model, int]:
    """With what the tool weighs, and the frame of the tip."""
    model, flange = of_masses(robot), np.array([0, 0, robot["geometry"]["c4_mm"] / 1000])
    lever = flange + np.array(tool["com_mm"]) / 1000
    model.appendBodyToJoint(6, pin.Inertia(tool["mass_kg"], lever, inertia(tool)), pin.SE3.Identity())
    tip = pin.SE3(np.eye(3), flange + np.array(tool["tip_mm"]) / 1000)
    return model, model.addFrame(pin.Frame("tip", 6, tip, pin.FrameType.OP_FRAME))


def model_angles(robot: dict[str, Any], reported: list[float]) -> np.ndarray:
    geometry = robot["geometry"]
    return np.radians([s * q - offset for s, q, offset in zip(geometry["sign"], reported, geometry["offset_deg"], strict=True)])


def swings(model: pin.Model, data: pin.Data, tip: int, q: np.ndarray, compliance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies, Hz, and how the tip moves, 3 x 6."""
    mass = pin.crba(model, data, q)
    mass = np.triu(mass) + np.triu(mass, 1).T
    squares, shapes = scipy.linalg.eigh(np.diag(1 / compliance), mass)
    jacobian = pin.computeFrameJacobian(model, data, q, tip, pin.LOCAL_WORLD_ALIGNED)[:3]
    return np.sqrt(squares) / (2 * np.pi), jacobian @ shapes


def numbers(values: Any) -> str:
    return " ".join(repr(float(value)) for value in np.ravel(values))


def main() -> None:
    rows = []
    for robot in weighed():
        draw = random.Random(robot["name"])
        for _ in range(POSTURES):
            joints = [round(draw.uniform(*limit), 3) for limit in robot["limits"]["joint_deg"]]
            a, b, c = (draw.uniform(0.2, 1.5) for _ in range(3))
            tool = {
                "mass_kg": round(draw.uniform(2, 40), 3),
                "com_mm": [round(draw.uniform(-80, 80), 1), round(draw.uniform(-80, 80), 1), round(draw.uniform(50, 250), 1)],
                # A body: no principal moment is larger than the sum of the others.
                "inertia_kg_m2": [round(x, 4) for x in (b + c, 0.05 * a, -0.03 * b, a + c, 0.04 * c, a + b)],
                "tip_mm": [round(draw.uniform(-100, 100), 1), round(draw.uniform(-100, 100), 1), round(draw.uniform(100, 400), 1)],
            }
            compliance = [round(draw.uniform(0.2, 4), 4) for _ in range(6)]
            model, tip = arm(robot, tool)
            hertz, shapes = swings(model, model.createData(), tip, model_angles(robot, joints), np.array(compliance) * 1e-6)
            asked = [joints, [tool["mass_kg"]], tool["com_mm"], tool["inertia_kg_m2"], tool["tip_mm"], compliance]
            torques = -pin.computeGeneralizedGravity(model, model.createData(), model_angles(robot, joints))
            rows.append([robot["name"], *map(numbers, asked), numbers(hertz), numbers(shapes.T), numbers(torques)])
    with TARGET.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# recorded by scripts/swinging.py: Pinocchio (pin {version('pin')}) and SciPy {version('scipy')}. The tip's shapes mode by mode, m per root of kg m2, base axes, up to their sign; torques of weight about the model angles.\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["robot", "joints_deg", "tool_mass_kg", "tool_com_mm", "tool_inertia_kg_m2", "tip_mm", "drive_urad_per_nm", "frequency_hz", "tip_shapes", "gravity_nm"])
        table.writerows(rows)
    print(f"{len(rows)} cases of {len(rows) // POSTURES} robots")


if __name__ == "__main__":
    main()
