"""What a user would otherwise write: the worst-direction map of 1000 x 1000 points with vectorised NumPy.

Trace, determinant and one square root, no trigonometry, and no joint limits; one thread.
"""

import timing  # before NumPy

import numpy as np

SIDE = 1000
L2, L3, K2, K3, FORCE = 1.15, 1.2007, 1e-6, 1e-6, 1000.0
xs = np.linspace(-(L2 + L3), L2 + L3, SIDE)


def worst():
    t = xs[None, :] ** 2 + xs[:, None] ** 2
    c = (t - L2**2 - L3**2) / (2 * L2 * L3)
    reached = np.abs(c) <= 1
    trace = K2 * t + K3 * L3**2
    determinant = K2 * K3 * (L2 * L3) ** 2 * np.where(reached, 1 - c * c, 0)
    sigma = 0.5 * FORCE * (trace + np.sqrt(np.maximum(trace * trace - 4 * determinant, 0)))
    return np.where(reached, sigma, np.nan)


if __name__ == "__main__":
    timing.report("NumPy, planar map", np.__version__, SIDE * SIDE, worst, rounds=40)
