"""How far is the tool pushed off, everywhere the arm reaches?"""

import numpy as np
import stiffarm
from stiffarm import plot

section = stiffarm.map("KR 210 R2700 extra", force_n=1000, zone="B:0.5")
print(section)
print(f"stiffest point {np.nanmin(section.values_mm):.3f} mm, reached {np.isfinite(section.values_mm).mean():.0%} of the grid")

plot.map(section).figure.savefig("02_map.png", dpi=120)
