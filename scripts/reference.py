"""Writes validation/spatial_cases.csv: six-axis compliances at random postures, computed by two other programs.

Each case is computed twice, along two ways that share only the lengths and angles of the robot file:

- Pinocchio moves the *drives*. Its model has the joints where the robot has them. Under a parallelogram drive 3 turns
  the forearm against a plate at the elbow, and the linkage keeps that plate level: the plate turns back by what drive 2
  turns.
- The Robotics Toolbox moves the *joints* of the open chain, described by Denavit and Hartenberg's parameters. What the
  drives hold, `psi = B q`, is inverted: `q = B^-1 psi`.

The springs sit in the drives, so with the drive Jacobian `J` at the tool point the compliance is `J diag(k) J^T`: m and
rad for N and N m, base axes, translation first. Nothing is written where both programs differ by more than 1e-10.
"""

from __future__ import annotations

import csv
import math
import pathlib
import random
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.metadata import version
from typing import Any

import numpy as np
import pinocchio as pin
from roboticstoolbox import DHRobot, RevoluteDH
from spatialmath import SE3

ROOT = pathlib.Path(__file__).resolve().parent.parent
ROBOTS = ROOT / "crates/stiffarm/robots/paper"
TARGET = ROOT / "validation/spatial_cases.csv"
LENGTHS = ("a1", "a2", "b", "c1", "c2", "c3", "c4")
AS_BUILT, AS_VARIANT = 4, 2
AGREEMENT = 1e-10


@dataclass(frozen=True)
class Case:
    """A question: a robot at one posture, with a tool, springs and a force, in the units of robot file and program."""

    robot: dict[str, Any]
    joints_deg: list[float]
    tool_mm_deg: list[float]
    drive_urad_per_nm: list[float]
    force_n: list[float]

    @property
    def quasi_serial(self) -> bool:
        return self.robot["architecture"] == "quasi-serial"

    def lengths_m(self) -> list[float]:
        return [self.robot["geometry"][f"{name}_mm"] / 1000 for name in LENGTHS]

    def joints_rad(self) -> np.ndarray:
        return np.radians(open_chain_deg(self.robot, self.joints_deg))


@dataclass(frozen=True)
class Answer:
    """What one program says, SI, base axes."""

    wrist: np.ndarray
    tcp: np.ndarray
    rotation: np.ndarray
    compliance: np.ndarray

    def moved(self, force_n: list[float]) -> np.ndarray:
        return self.compliance @ [*force_n, 0, 0, 0]

    def parts(self) -> list[np.ndarray]:
        """What is compared as a whole, so that metres are never weighed against radians."""
        c = self.compliance
        return [self.wrist, self.tcp, self.rotation, c[:3, :3], c[:3, 3:], c[3:, 3:]]


def open_chain_deg(robot: dict[str, Any], reported: list[float]) -> list[float]:
    """Angles of the open chain, zero where both links stand upright, from those that the robot reports."""
    geometry = robot["geometry"]
    angles = [s * q - offset for s, q, offset in zip(geometry["sign"], reported, geometry["offset_deg"], strict=True)]
    if robot["limits"].get("third_axis") == "forearm":  # joint 3 is reported as the lean of the forearm
        angles[2] -= angles[1]
    return angles


def by_pinocchio(case: Case) -> Answer:
    a1, a2, b, c1, c2, c3, c4 = case.lengths_m()
    q = case.joints_rad()
    model = pin.Model()

    def add(parent: int, joint: Any, x: float, y: float, z: float) -> int:
        return model.addJoint(parent, joint, pin.SE3(np.eye(3), np.array([x, y, z])), f"joint {model.njoints}")

    body = add(0, pin.JointModelRZ(), 0, 0, 0)
    upper_arm = add(body, pin.JointModelRY(), a1, b, c1)
    if case.quasi_serial:
        elbow_plate = add(upper_arm, pin.JointModelRY(), 0, 0, c2)
        forearm = add(elbow_plate, pin.JointModelRY(), 0, 0, 0)
        turns = np.insert(np.eye(6), 2, [0, -1, 0, 0, 0, 0], axis=0)
        drives = np.array([q[0], q[1], q[1] + q[2], *q[3:]])
    else:
        forearm = add(upper_arm, pin.JointModelRY(), 0, 0, c2)
        turns, drives = np.eye(6), q
    tube = add(forearm, pin.JointModelRZ(), a2, 0, c3)
    hand = add(tube, pin.JointModelRY(), 0, 0, 0)
    flange = add(hand, pin.JointModelRZ(), 0, 0, 0)
    *tool_mm, rx, ry, rz = case.tool_mm_deg
    flange_from_tool = pin.SE3(pin.rpy.rpyToMatrix(*np.radians([rx, ry, rz])), np.array(tool_mm) / 1000)
    placement = pin.SE3(np.eye(3), np.array([0, 0, c4])) * flange_from_tool
    tool = model.addFrame(pin.Frame("tool", flange, placement, pin.FrameType.OP_FRAME))

    data = model.createData()
    jacobian = pin.computeFrameJacobian(model, data, turns @ drives, tool, pin.LOCAL_WORLD_ALIGNED) @ turns
    pin.framesForwardKinematics(model, data, turns @ drives)
    pose = data.oMf[tool]
    compliance = jacobian @ np.diag(case.drive_urad_per_nm) @ jacobian.T * 1e-6
    return Answer(data.oMi[hand].translation.copy(), pose.translation.copy(), pose.rotation.copy(), compliance)


def by_roboticstoolbox(case: Case) -> Answer:
    a1, a2, b, c1, c2, c3, c4 = case.lengths_m()
    quarter = math.pi / 2
    *tool_mm, rx, ry, rz = case.tool_mm_deg
    links = [
        RevoluteDH(d=c1, a=a1, alpha=-quarter),
        RevoluteDH(d=b, a=c2, offset=-quarter),
        RevoluteDH(a=a2, alpha=quarter, offset=quarter),
        RevoluteDH(d=c3, alpha=-quarter),
        RevoluteDH(alpha=quarter),
        RevoluteDH(d=c4),
    ]
    arm = DHRobot(links, tool=SE3(np.array(tool_mm) / 1000) * SE3.RPY([rx, ry, rz], order="zyx", unit="deg"))
    q = case.joints_rad()
    held = np.eye(6)
    if case.quasi_serial:
        held[2, 1] = 1  # drive 3 stands on the shoulder: it holds q2 + q3
    jacobian = arm.jacob0(q) @ np.linalg.inv(held)
    pose = arm.fkine(q)
    compliance = jacobian @ np.diag(case.drive_urad_per_nm) @ jacobian.T * 1e-6
    return Answer(arm.fkine_all(q)[4].t, pose.t, pose.R, compliance)


def difference(one: Answer, other: Answer) -> float:
    """The largest difference of a part, relative to the size of that part."""
    return max(
        float(np.linalg.norm(x - y) / np.linalg.norm(x)) for x, y in zip(one.parts(), other.parts(), strict=True)
    )


def random_posture(robot: dict[str, Any], draw: random.Random) -> list[float]:
    """Reported angles within every limit of the robot, degrees."""
    limits = robot["limits"]
    low, high = limits.get("elbow_deg", (-math.inf, math.inf))
    while True:
        joints = [round(draw.uniform(*limit), 2) for limit in limits["joint_deg"]]
        if low < 180 - open_chain_deg(robot, joints)[2] < high:
            return joints


def random_case(robot: dict[str, Any], draw: random.Random) -> Case:
    def numbers(count: int, low: float, high: float, digits: int) -> list[float]:
        return [round(draw.uniform(low, high), digits) for _ in range(count)]

    tool = [*numbers(2, -300, 300, 1), *numbers(1, 0, 500, 1), *numbers(3, -180, 180, 1)]
    return Case(robot, random_posture(robot, draw), tool, numbers(6, 0.1, 3, 3), numbers(3, -2000, 2000, 0))


def variant(robot: dict[str, Any], draw: random.Random) -> dict[str, Any]:
    """The same arm with the other architecture and its plane beside the axis of joint 1."""
    other = "serial" if robot["architecture"] == "quasi-serial" else "quasi-serial"
    sideways = {**robot["geometry"], "b_mm": round(draw.uniform(-200, 200), 1)}
    return {**robot, "architecture": other, "geometry": sideways}


def cases() -> Iterator[Case]:
    for path in sorted(ROBOTS.glob("*.toml")):
        robot = tomllib.loads(path.read_text(encoding="utf-8"))
        draw = random.Random(path.stem)
        for _ in range(AS_BUILT):
            yield random_case(robot, draw)
        for _ in range(AS_VARIANT):
            yield random_case(variant(robot, draw), draw)


def row(case: Case, answer: Answer) -> dict[str, str]:
    """One line of the file: a vector is one cell, its numbers apart by blanks, a matrix row by row."""
    moved = answer.moved(case.force_n)
    vectors: dict[str, Iterable[float]] = {
        "joints_deg": case.joints_deg,
        "tool_mm_deg": case.tool_mm_deg,
        "drive_urad_per_nm": case.drive_urad_per_nm,
        "force_n": case.force_n,
        "wrist_m": answer.wrist,
        "tcp_m": answer.tcp,
        "tool_rotation": answer.rotation.ravel(),
        "compliance_si": answer.compliance[np.triu_indices(6)],
        "deflection_mm": moved[:3] * 1e3,
        "rotation_mrad": moved[3:] * 1e3,
    }
    question = {
        "robot": case.robot["name"],
        "architecture": case.robot["architecture"],
        "b_mm": str(case.robot["geometry"]["b_mm"]),
    }
    return question | {name: " ".join(repr(float(x)) for x in vector) for name, vector in vectors.items()}


def record(target: pathlib.Path, rows: list[dict], by: str, columns: str) -> None:
    """Writes the cases with who computed them."""
    with target.open("w", encoding="utf-8", newline="") as file:
        file.write(f"# recorded by scripts/reference: {by}.\n")
        file.write(f"# Base axes, SI unless named; {columns}\n")
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    print(f"{len(rows)} cases in {target.relative_to(ROOT)}")


def main() -> None:
    rows, worst = [], 0.0
    for case in cases():
        answer, second = by_pinocchio(case), by_roboticstoolbox(case)
        apart = difference(answer, second)
        if not apart <= AGREEMENT:
            where = f"{case.robot['name']}, {case.robot['architecture']}, at {case.joints_deg}"
            raise SystemExit(f"the programs differ by {apart:.1e}, nothing is written: {where}")
        worst = max(worst, apart)
        rows.append(row(case, answer))
    toolbox = f"Robotics Toolbox (roboticstoolbox-python {version('roboticstoolbox-python')})"
    programs = f"Pinocchio (pin {version('pin')}) and {toolbox}"
    by = f"{programs}, which agree to {AGREEMENT:.0e}"
    record(TARGET, rows, by, "rows of tool_rotation, rows of the upper triangle of compliance_si")
    print(f"{programs} differ by {worst:.1e} at most")


if __name__ == "__main__":
    main()
