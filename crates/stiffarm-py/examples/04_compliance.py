"""How compliant is the arm at a hundred thousand postures?"""

import matplotlib.pyplot as plt
import numpy as np
import stiffarm

robot = stiffarm.Robot("KR 210 R2700 extra")
limits = np.array(robot.to_dict()["limits"]["joint_deg"])
joints = np.random.default_rng(0).uniform(limits[:, 0], limits[:, 1], (100_000, 6))
many = stiffarm.compliance(robot, joints_deg=joints, tool_mm=(0, 0, 200))
print(many, "median", np.median(many.worst_um_per_n), "um/N")

one = stiffarm.compliance(robot, joints_deg=[0, -90, 90, 0, 30, 0], tool_mm=(0, 0, 200), force_n=(0, 0, -1000))
print(one)
print("deflection under 1 kN downwards [mm]:", one.deflection_mm)

figure, ax = plt.subplots(layout="constrained")
ax.hist(many.worst_um_per_n, bins=100)
ax.set_xlabel("worst compliance [um/N]")
ax.set_ylabel("postures [1]")
figure.savefig("04_compliance.png", dpi=120)
