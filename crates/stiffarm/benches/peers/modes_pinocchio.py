"""What a user would otherwise write: Pinocchio's mass matrix and SciPy's eigenvalues, posture by posture, of a KR 210 R2700-2 with 60 kg."""

import timing  # before NumPy
import pathlib
import sys

import numpy as np
import pinocchio as pin
import scipy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[4] / "scripts"))
import swinging

POSTURES = 1000
TOOL = {"mass_kg": 60, "com_mm": [0, 0, 200], "inertia_kg_m2": [0, 0, 0, 0, 0, 0], "tip_mm": [0, 0, 200]}
COMPLIANCE = np.array([0.417, 0.27, 0.459, 2.52, 3.01, 2.46]) * 1e-6


def frequencies(model: pin.Model, data: pin.Data, q: np.ndarray) -> float:
    stiffness = np.diag(1 / COMPLIANCE)
    found = 0.0
    for angles in q:
        mass = pin.crba(model, data, angles)
        mass = np.triu(mass) + np.triu(mass, 1).T
        found += np.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[0])
    return found


if __name__ == "__main__":
    robot = next(robot for robot in swinging.weighed() if robot["name"] == "KR 210 R2700-2")
    model, _ = swinging.arm(robot, TOOL)
    low, high = np.array(robot["limits"]["joint_deg"]).T
    reported = np.random.default_rng(1).uniform(low, high, (POSTURES, 6))
    q = np.array([swinging.model_angles(robot, joints) for joints in reported])
    data = model.createData()
    version = f"{pin.__version__}, SciPy {scipy.__version__}"
    timing.report("Pinocchio and SciPy, frequencies", version, POSTURES, lambda: frequencies(model, data, q), rounds=7)
