"""The measured Fanuc R-2000iC identified anew, with NumPy and a chain of its own: writes identification.csv beside this file.

The chain is the modified Denavit-Hartenberg one that the data set states, not the geometry of the robot file.
"""

from pathlib import Path

import numpy as np

here = Path(__file__).parent
table = np.loadtxt(here / "../docs/examples/fanuc_r2000ic.csv", delimiter=",", skiprows=2)
q, force, moved = table[:, :6], table[:, 6:9], 1e3 * table[:, 9:]
# alpha deg, a m, theta0 deg, d m
chain = [(0, 0, 0, 0.670), (-90, 0.312, -90, 0), (0, 1.075, 0, 0), (-90, 0.225, 0, 1.280), (90, 0, 0, 0), (-90, 0, 0, 0.215)]


def columns(q, tool=(0.0069, 0.2453, 0.3193, 1)):
    pose, frames = np.eye(4), []
    for (alpha, a, theta, d), angle in zip(chain, [q[0], q[1], -q[1] - q[2], -q[3], -q[4], -q[5]]):
        ca, sa = np.cos(np.radians(alpha)), np.sin(np.radians(alpha))
        ct, st = np.cos(angle + np.radians(theta)), np.sin(angle + np.radians(theta))
        pose = pose @ [[ct, -st, 0, a], [st * ca, ct * ca, -sa, -d * sa], [st * sa, ct * sa, ca, d * ca], [0, 0, 0, 1]]
        frames.append(pose)
    point = (pose @ tool)[:3]
    return np.array([np.cross(frame[:3, 2], point - frame[:3, 3]) for frame in frames]).T


J = [columns(angles) for angles in q]
a = 1e-3 * np.vstack([j * (j.T @ f) for j, f in zip(J, force)])  # mm per urad/(N m)
y = moved.ravel()


def fit(rows):
    return np.linalg.lstsq(a[rows], y[rows], rcond=None)[0]


everything = np.ones(len(y), bool)
k = fit(everything)
rest = y - a @ k
scatter = np.sqrt(np.diag(np.linalg.inv(a.T @ a)) * (rest @ rest) / (len(y) - 6))
without = [np.delete(np.arange(len(y)), [3 * i, 3 * i + 1, 3 * i + 2]) for i in range(len(q))]
others = np.array([fit(rows) for rows in without])
left_out = np.concatenate([y[3 * i : 3 * i + 3] - a[3 * i : 3 * i + 3] @ k for i, k in enumerate(others)])
jackknife = np.sqrt((len(q) - 1) / len(q) * ((others - others.mean(0)) ** 2).sum(0))
rms = lambda x: np.sqrt(np.mean(x**2))
values = {f"k{i + 1}_urad_per_nm": k[i] for i in range(6)}
values |= {f"scatter{i + 1}_urad_per_nm": scatter[i] for i in range(6)}
values |= {f"jackknife{i + 1}_urad_per_nm": jackknife[i] for i in range(6)}
values |= {"rms_before_mm": rms(y), "rms_after_mm": rms(rest), "rms_left_out_mm": rms(left_out), "condition": np.linalg.cond(a)}
values |= {f"singular{i + 1}": s for i, s in enumerate(np.linalg.svd(a)[1])}
(here / "identification.csv").write_text("item,value\n" + "".join(f"{item},{value:.12g}\n" for item, value in values.items()))
