"""The arm that the six-axis peers time: lengths and limits of the KR 210 R2700 extra, read from its robot file."""

import pathlib
import tomllib

import numpy as np

FILE = pathlib.Path(__file__).resolve().parents[2] / "robots/paper/kuka_kr_210_r2700_extra.toml"
ROBOT = tomllib.loads(FILE.read_text(encoding="utf-8"))
LENGTHS = ("a1", "a2", "b", "c1", "c2", "c3", "c4")
A1, A2, B, C1, C2, C3, C4 = (ROBOT["geometry"][f"{name}_mm"] / 1000 for name in LENGTHS)
DRIVES = np.full(6, 1e-6)  # rad/(N m), as the paper assumes
POSTURES = 100_000


def postures() -> np.ndarray:
    """Random postures within the limits, one a row, as angles from the upright arm, rad."""
    low, high = np.radians(ROBOT["limits"]["joint_deg"]).T
    reported = np.random.default_rng(1).uniform(low, high, (POSTURES, 6))
    return reported * ROBOT["geometry"]["sign"] - np.radians(ROBOT["geometry"]["offset_deg"])


def largest_eigenvalues(
    xx: np.ndarray, yy: np.ndarray, zz: np.ndarray, xy: np.ndarray, xz: np.ndarray, yz: np.ndarray
) -> np.ndarray:
    """Of symmetric 3 x 3 matrices, given entry by entry, by the trigonometric solution of the cubic."""
    mean = (xx + yy + zz) / 3
    x, y, z = xx - mean, yy - mean, zz - mean
    radius = np.sqrt((x * x + y * y + z * z + 2 * (xy * xy + xz * xz + yz * yz)) / 6)
    determinant = x * (y * z - yz * yz) - xy * (xy * z - yz * xz) + xz * (xy * yz - y * xz)
    return mean + 2 * radius * np.cos(np.arccos(np.clip(determinant / (2 * radius**3), -1, 1)) / 3)
