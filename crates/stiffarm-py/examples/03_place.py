"""Where must the work stand, and what do all six drives add to the paper's two?"""

import stiffarm

robot = stiffarm.Robot("KR 210 R2700 extra")
planar = stiffarm.place(robot, task="B:0.5", within_m="0..,0..")
print(planar)
print(f"proved lower bound {planar.lower_bound_mm:.4f} mm")

spatial = stiffarm.place(robot, task="B:0.5", model="spatial", tool_mm=(0, 0, 200), tool_direction="down")
print(spatial)
for drive, share in enumerate(spatial.worst_shares, start=1):
    print(f"drive {drive} gives {share:.1%} of it")
