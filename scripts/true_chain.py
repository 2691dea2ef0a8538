"""Writes validation/true_chain.csv: flanges and Jacobians of arms whose joint frames stand otherwise than drawn, by Pinocchio.

The frames' errors are in the placements of Pinocchio's joints. By what the drives yield under the own weight is computed apart from that, with
vectors: the moment of a unit weight at the end of a unit vector about the joint axis that Pinocchio has of the arm as drawn.
"""

from __future__ import annotations

import pathlib
import random
import tomllib
from importlib.metadata import version

import numpy as np
import pinocchio as pin

from reference import LENGTHS, ROBOTS, ROOT, open_chain_deg, random_posture, record

TARGET = ROOT / "validation/true_chain.csv"
CASES = 3
AXES = "zyyzyz"


def model_of(robot: dict, frames: np.ndarray) -> pin.Model:
    """The arm, each joint's frame shifted and turned in base axes at model zero."""
    a1, a2, b, c1, c2, c3, _ = (robot["geometry"][f"{name}_mm"] / 1000 for name in LENGTHS)
    between = [(0, 0, 0), (a1, b, c1), (0, 0, c2), (a2, 0, c3), (0, 0, 0), (0, 0, 0)]
    joints = {"y": pin.JointModelRY, "z": pin.JointModelRZ}
    model, parent = pin.Model(), 0
    for i, (axis, point) in enumerate(zip(AXES, between, strict=True)):
        placement = pin.SE3(pin.exp3(frames[i, 3:]), np.array(point) + frames[i, :3])
        parent = model.addJoint(parent, joints[axis](), placement, f"joint {i + 1}")
    flange = pin.SE3(np.eye(3), np.array([0, 0, robot["geometry"]["c4_mm"] / 1000]))
    model.addFrame(pin.Frame("flange", parent, flange, pin.FrameType.OP_FRAME))
    return model


def yielded(robot: dict, theta: np.ndarray, weight: list[float], gears: list[float]) -> np.ndarray:
    """By how much weight and gears turn each joint, rad."""
    model = model_of(robot, np.zeros((6, 6)))
    data = model.createData()
    pin.forwardKinematics(model, data, theta)
    unit = {"y": np.array([0.0, 1, 0]), "z": np.array([0.0, 0, 1])}
    axis = [data.oMi[i + 1].rotation @ unit[name] for i, name in enumerate(AXES)]
    down = np.array([0.0, 0, -1])
    upper, forearm, tool = (data.oMi[i].rotation @ unit["z"] for i in (2, 3, 6))

    def moments(i: int, along: np.ndarray) -> list[float]:
        return [axis[i] @ np.cross(arm, down) for arm in (along, np.cross(axis[i], along))]

    terms = [*moments(1, upper), *moments(1, forearm), *moments(2, forearm), *moments(4, tool)]
    of_drive = [1, 1, 1, 1, 2, 2, 4, 4]
    drives = np.zeros(6)
    for drive, term, parameter in zip(of_drive, terms, weight, strict=True):
        drives[drive] += term * parameter
    turned = drives.copy()
    if robot["architecture"] == "quasi-serial":
        turned[2] -= drives[1]  # the forearm keeps its direction where only drive 2 yields
    periodic = np.array(gears).reshape(6, 2)
    return turned + periodic[:, 0] * np.sin(theta) + periodic[:, 1] * np.cos(theta)


def flange(robot: dict, joints: list[float], frames: list[float], weight: list[float], gears: list[float]) -> tuple[pin.SE3, np.ndarray]:
    """Where the flange of such an arm stands at angles as reported, deg, and its Jacobian there."""
    theta = np.radians(open_chain_deg(robot, joints))
    psi = theta + yielded(robot, theta, np.array(weight) / 1e3, np.array(gears) / 1e3)
    model = model_of(robot, np.array(frames).reshape(6, 6) / 1e3)
    data = model.createData()
    last = model.getFrameId("flange")
    jacobian = pin.computeFrameJacobian(model, data, psi, last, pin.LOCAL_WORLD_ALIGNED)
    pin.framesForwardKinematics(model, data, psi)
    return data.oMf[last], jacobian


def row(robot: dict, draw: random.Random) -> dict[str, str]:
    def numbers(count: int, most: float) -> list[float]:
        return [round(draw.uniform(-most, most), 4) for _ in range(count)]

    frames, weight, gears = numbers(36, 2), numbers(8, 1), numbers(12, 0.2)
    joints = random_posture(robot, draw)
    pose, jacobian = flange(robot, joints, frames, weight, gears)
    vectors = {
        "joints_deg": joints,
        "frames_mm_mrad": frames,
        "weight_mrad": weight,
        "gears_mrad": gears,
        "flange_m": pose.translation,
        "flange_rotation": pose.rotation.ravel(),
        "jacobian": jacobian.ravel(),
    }
    told = {name: " ".join(repr(float(x)) for x in vector) for name, vector in vectors.items()}
    return {"robot": robot["name"], **told}


def main() -> None:
    rows = []
    for path in sorted(pathlib.Path(ROBOTS).glob("*.toml")):
        robot = tomllib.loads(path.read_text(encoding="utf-8"))
        draw = random.Random(f"true {path.stem}")
        rows += [row(robot, draw) for _ in range(CASES)]
    by = f"Pinocchio (pin {version('pin')}), with shifted joint placements"
    record(TARGET, rows, by, "rows of flange_rotation and of the Jacobian at the flange, translation first")


if __name__ == "__main__":
    main()
