"""Toolpaths, and robots that mill them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

import numpy as np

from .._asked import Question, text
from .._given import Array
from .._stiffarm import StiffarmError
from ..types import (
    FedBackDict,
    ForceDict,
    LedgerDict,
    MilledDict,
    PathChatter,
    PathContact,
    PathLength,
    PathRankingDict,
    PathRankingRow,
    PlaceSearch,
    PublishedNumber,
    RollChoice,
    Schema,
    ToolpathDict,
)
from .base import Table


#: Endings of files that are written back in their own format.
_REWRITTEN = (".nc", ".gcode", ".ngc", ".tap", ".apt", ".cls")


class Force(Table[ForceDict]):
    """The force of a process on its tool: along the feed, across (left of the feed), axial (away from the work)."""

    _arrays = ("mean_n", "max_n", "min_n")

    schema: Schema
    process: str
    #: Where the force comes from.
    law: str
    material: str | None
    #: How well its numbers are known: ``"published"`` or ``"unverified"``.
    material_status: str | None
    material_source: str | None
    #: (3,) over a revolution; None where the force may point anywhere.
    mean_n: Array | None
    max_n: Array | None
    min_n: Array | None
    #: The largest size of the force over a revolution.
    largest_n: float
    moment_nm: float
    power_w: float | None
    spindle_rpm: float | None
    entry_deg: float | None
    exit_deg: float | None
    assumed: list[str]

    def _words(self) -> str:
        mean = "in any direction" if self.mean_n is None else f"mean {np.round(self.mean_n, 2).tolist()} N"
        return f"{self.process}: {mean}, at most {self.largest_n:.2f} N"


class Toolpath(Table[ToolpathDict]):
    """What is understood of a toolpath."""

    _arrays = ("box_m",)

    schema: Schema
    path: str
    #: ``"gcode"``, ``"apt"``, ``"csv"`` or ``"built-in"``.
    format: str
    lines: int | None
    feed_length_m: float
    rapid_length_m: float
    feed_moves: int
    rapid_moves: int
    #: Moves that are no part of the path.
    machine_moves: int
    arcs: int
    full_circles: int
    arc_length_m: float
    #: (2, 3) two corners of the box about all feed moves.
    box_m: Array | None
    feed_mm_per_min: list[float] | None
    time_s: float | None
    tilt_deg: float
    turn_deg: float
    samples: int
    chord_error_mm: float
    arc_miss_mm: float
    #: What the file leaves open and how it was taken.
    assumed: list[str]
    #: Words that move nothing.
    ignored: list[str]

    def _words(self) -> str:
        return f"{self.path}: {self.feed_moves} feed moves, {self.feed_length_m * 1e3:.3f} mm, {self.arcs} arcs"


class Milled(Table[MilledDict]):
    """The error along a toolpath; its data frame has a row for every sample."""

    _arrays = ("at_m", "worst_joints_deg", "worst_shares")

    schema: Schema
    robot: str
    stiffness_source: str
    path: str
    #: Where the force on the tool comes from.
    force: str
    part: PathLength
    roll: RollChoice
    #: What of the displacement counts: ``"total"``, ``"across"``, ``"axial"`` or ``"normal"``.
    error: str
    asked_limit_margin_deg: float
    asked_singular_margin_deg: float
    speed_share: float | None
    #: (3,) where the path's origin stands; None where no place was found.
    at_m: Array | None
    at_yaw_deg: float | None
    feasible: bool
    reason: str | None
    worst_mm: float | None
    #: Where it lies with 90 %, over draws of the drive stiffness.
    worst_mm_p05: float | None
    worst_mm_p50: float | None
    worst_mm_p95: float | None
    #: No rolls, and where the place was sought no place, have less.
    lower_bound_mm: float | None
    roll_lower_bound_mm: float | None
    rms_mm: float | None
    #: The sample with the largest error, from 0, and its line in the file.
    worst_sample: int | None
    worst_line: int | None
    worst_joints_deg: Array | None
    worst_shares: Array | None
    limit_margin_deg: float | None
    singular_margin_deg: float | None
    #: The nearest that the arm comes to anything along the path, and which link to what.
    clearance_mm: float | None
    clearance_of: str | None
    #: By which bodies: ``"enclosing"``, ``"estimated"`` or ``"stated"`` of the arm, and what it comes near to where that is a ``"keep-out"``, the
    #: ``"mesh"`` of a part or fixture, or what is left of the ``"stock"``.
    clearance_by: list[str] | None
    #: By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most, mm; 0 where none is estimated.
    clearance_outside_mm: float | None
    #: The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm, mm; negative where they overlap, so that the
    #: arm may touch; None where its bodies are known.
    clearance_wide_mm: float | None
    #: Which of those to what.
    clearance_wide_of: str | None
    asked_clearance_mm: float
    #: Where it is nearer than it was to keep; None where nobody looked.
    contacts: list[PathContact] | None
    #: Of a path that is not clear: what is nearer than was asked at some place at every roll; ``None`` where nothing of that kind is known.
    unavoidable: PathContact | None
    tolerance_mm: float | None
    margin_mm: float | None
    search: PlaceSearch | None
    #: What becomes of the largest error as width and depth of the cut change by it; None where no cut is known.
    fed_back: FedBackDict | None
    #: Whether the cuts swing with the arm (``chatter=True``): critical depth at the worst sample, its interval, what is not covered. In the
    #: data frame ``critical_depth_mm``, ``chatter_hz`` and ``chatter_covered`` of every sample.
    chatter: PathChatter | None
    remarks: list[str]

    #: The question, from which programs are written.
    _asked: Question | None

    def __init__(
        self,
        data: dict[str, Any],
        columns: dict[str, Any] | None = None,
        asked: Question | None = None,
    ) -> None:
        super().__init__(data, columns)
        self._asked = asked

    @property
    def passes(self) -> bool | None:
        """The key ``pass``: whether the tolerance is kept; None where none was given."""
        verdict: bool | None = self._data.get("pass")
        return verdict

    def program(self, controller: Literal["src", "mod", "ls", "py", "yaml"]) -> str:
        """The path as a program, by the ending of its files, compensated where that was asked for; the rolls are sought once more.

        ``"src"`` for KUKA, ``"mod"`` for ABB, ``"ls"`` for Fanuc, ``"py"`` a script for RoboDK, ``"yaml"`` a trajectory for ROS 2.
        """
        if controller not in ("src", "mod", "ls", "py", "yaml"):
            raise StiffarmError(f"no controller reads {controller!r}; expected src, mod, ls, py or yaml")
        return text(self._there(), f"path.{controller}")

    def rewritten(self) -> str:
        """The path's own file with its tips led aside by what the tool is pushed off; needs ``compensate=True``."""
        asked = self._there()
        given = dict(asked.given)
        ending = Path(given["path"]).suffix.lower()
        if ending not in _REWRITTEN:
            ending = f".{given['format']}" if given.get("format") in ("apt", "cls") else ".nc"
        return text(asked, f"path{ending}")

    def _there(self) -> Question:
        """The same question of the part where it was found to stand; its place need not be sought again."""
        if self._asked is None or self.at_m is None:
            raise StiffarmError(f"there is no program: {self.reason or 'the answer does not know what was asked'}")
        x, y, z = self.at_m.tolist()
        at = ",".join(repr(part) for part in (x, y, z, self.at_yaw_deg or 0.0))
        sought = [keyword for keyword, _ in self._asked.given if keyword.startswith("within")]
        return self._asked.without(*sought).with_given(at=at)

    def _words(self) -> str:
        if self.worst_mm is None:
            return f"{self.robot} along {self.path}: {self.reason}"
        return f"{self.robot} along {self.path}: at most {self.worst_mm:.4f} mm, no less than {self.lower_bound_mm:.4f} mm"


class PathRanking(Table[PathRankingDict]):
    """Robots in order on a toolpath, the best first, each at its own best place and rolls."""

    schema: Schema
    path: str
    #: Where the force on the tool comes from; None where no robot has six joints.
    force: str | None
    part: PathLength | None
    #: What of the displacement counts: ``"total"``, ``"across"`` or ``"axial"``.
    error: str | None
    #: One per robot: names, status, ``rank`` (None for an estimated robot; robots that cannot be distinguished share one), and as `Milled` tells it.
    rows: list[PathRankingRow]
    #: What a manager would read.
    summary: list[str]
    remarks: list[str]

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        best = next((f"; best {row['robot']}" for row in self.rows if row["rank"] == 1 and row["feasible"]), "")
        return f"{len(self)} robots along {self.path}{best}"


class Ledger(Table[LedgerDict]):
    """Published numbers beside the computed ones; its data frame has a row for each."""

    schema: Schema
    #: One per number: where it is printed, as it is printed, as it is computed, whether both agree, and where not, why.
    rows: list[PublishedNumber]

    def __len__(self) -> int:
        return len(self.rows)

    def _words(self) -> str:
        return f"{len(self)} published numbers, of which {sum(row['agrees'] for row in self.rows)} agree within their printed digits"
