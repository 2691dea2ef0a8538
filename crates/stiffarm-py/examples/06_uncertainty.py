"""The joint compliances are assumed: how sure is the choice of a robot where they may be off by 30 %?"""

import matplotlib.pyplot as plt
import numpy as np
import stiffarm

robots = [stiffarm.Robot(name) for name in ("KR 210 R2700 extra", "IRB 6650S-200", "ES200RD II")]
rng = np.random.default_rng(0)
found = np.array(
    [
        [
            stiffarm.cell(robot.with_compliance(drive_urad_per_nm=np.exp(rng.normal(0, 0.3, 6))), "B:0.5")["deflection_mm"]
            for robot in robots
        ]
        for _ in range(60)
    ]
)
for robot, column in zip(robots, found.T):
    low, middle, high = np.percentile(column, [5, 50, 95])
    wins = np.mean(column == found.min(axis=1))
    print(f"{robot.full_name}: {middle:.2f} mm, 90 % within {low:.2f} to {high:.2f} mm; the stiffest in {wins:.0%}")

figure, ax = plt.subplots(layout="constrained")
ax.boxplot(found, tick_labels=[robot.full_name for robot in robots])
ax.set_ylabel("worst deflection at the best place [mm]")
figure.savefig("06_uncertainty.png", dpi=120)
