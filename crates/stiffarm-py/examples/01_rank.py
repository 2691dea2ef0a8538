"""Which robot holds the cutting force best?"""

import stiffarm
from stiffarm import plot

# Robots that carry 300 kg and more, on a pocket of 0.5 m x 1 m that stands in front of the base and above its floor.
robots = stiffarm.robots(payload_kg=(300, 500), reach_m=(2.5, None))
ranking = stiffarm.rank(robots, tasks=["A:0.5", "B:0.5"], force_n=1000, tolerance_mm=2, within_m="0..,0..")

print("\n".join(ranking.summary))
print(ranking.to_pandas()[["rank", "robot", "task", "deflection_mm", "pass"]].head(8).to_string(index=False))

plot.ranking(ranking, task="B:0.5", most=8).figure.savefig("01_rank.png", dpi=120)
