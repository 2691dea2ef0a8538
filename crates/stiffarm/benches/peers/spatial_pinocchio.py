"""What a user would otherwise write: Jacobians of Pinocchio in a Python loop, then all largest eigenvalues at once."""

import timing  # before NumPy

import numpy as np
import pinocchio as pin
from kr210 import A1, A2, B, C1, C2, C3, C4, DRIVES, POSTURES, largest_eigenvalues, postures


def arm() -> tuple[pin.Model, int]:
    """The arm upright at zero, and its flange."""
    model = pin.Model()
    about_y, about_z, here = pin.JointModelRY(), pin.JointModelRZ(), (0, 0, 0)
    joints = [about_z, about_y, about_y, about_z, about_y, about_z]
    steps = [here, (A1, B, C1), (0, 0, C2), (A2, 0, C3), here, here]
    for parent, (joint, step) in enumerate(zip(joints, steps, strict=True)):
        model.addJoint(parent, joint, pin.SE3(np.eye(3), np.array(step, dtype=float)), f"joint {parent + 1}")
    flange = pin.SE3(np.eye(3), np.array([0, 0, C4]))
    return model, model.addFrame(pin.Frame("flange", 6, flange, pin.FrameType.OP_FRAME))


def worst(model: pin.Model, data: pin.Data, flange: int, q: np.ndarray) -> np.ndarray:
    j = np.empty((len(q), 3, 6))
    for i, angles in enumerate(q):
        j[i] = pin.computeFrameJacobian(model, data, angles, flange, pin.LOCAL_WORLD_ALIGNED)[:3]
    c = (j * DRIVES) @ j.transpose(0, 2, 1)
    return largest_eigenvalues(c[:, 0, 0], c[:, 1, 1], c[:, 2, 2], c[:, 0, 1], c[:, 0, 2], c[:, 1, 2])


if __name__ == "__main__":
    model, flange = arm()
    data, q = model.createData(), postures()
    timing.report("Pinocchio in Python", pin.__version__, POSTURES, lambda: worst(model, data, flange, q), rounds=7)
