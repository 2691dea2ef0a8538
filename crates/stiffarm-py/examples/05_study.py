"""Which architecture suits which link ratio and size?"""

import stiffarm
from stiffarm import plot

study = stiffarm.study(tasks=["A", "C"], sizes=[0.05 * i for i in range(1, 19)])
for boundary in study.boundaries:
    print("{task}: {better_below} is better below d = {d:.3f}".format(**boundary), boundary["mu_l3_over_l2"] or "best")

plot.study(study, task="A").figure.savefig("05_study.png", dpi=120)
