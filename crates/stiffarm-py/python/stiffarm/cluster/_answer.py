"""What a sweep answers: its rows as a Parquet data set, and who wins how often."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np
import numpy.typing as npt

from .. import _stiffarm
from .._answers.base import Table
from .._given import Array
from .._stiffarm import StiffarmError
from ._folder import ASKED, SCENARIOS, SUMS, check, read_sums, read_whole
from ._question import read_question

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow
    from matplotlib.axes import Axes

Flags = npt.NDArray[np.bool_]

#: Standard deviations of a normal distribution that hold 95 %.
_Z95 = 1.959963984540054


def wilson(wins: float, of: int) -> tuple[float, float]:
    """Both ends of the 95 % confidence interval of a share (Wilson's score interval) [1]."""
    if of == 0:
        return 0.0, 1.0
    share, weight = wins / of, _Z95**2 / of
    middle, half = share + weight / 2, _Z95 * math.sqrt(max(share * (1 - share), 0.0) / of + weight / of / 4)
    low = 0.0 if wins <= 0 else (middle - half) / (1 + weight)
    return low, (1.0 if wins >= of else (middle + half) / (1 + weight))



def _columns_of(rows: Sequence[Mapping[str, Any]]) -> dict[str, list[Any]]:
    """Rows as columns; what is no single number or word is left out."""
    keys = {key: None for row in rows for key, value in row.items() if not isinstance(value, (list, dict))}
    return {key: [row.get(key) for row in rows] for key in keys}

class WinsRow(TypedDict):
    """One robot at one task and force. Every share has its 95 % confidence interval (Wilson's score interval) beside it."""

    task: str
    force_n: float
    robot: str | None
    vendor: str | None
    status: str | None
    #: It cannot win.
    estimated: bool
    #: In which all robots have an answer.
    scenarios: int
    errors: int
    #: In which the zone has a place; None where nothing is known of the robot.
    feasible_share: float | None
    #: In which it is the stiffest of those that are not estimated.
    share: float | None
    share_low: float | None
    share_high: float | None
    #: In which it is the stiffest of all.
    share_with_estimated: float | None
    share_with_estimated_low: float | None
    share_with_estimated_high: float | None
    #: In which it holds the tolerance; None where none was asked for.
    held_share: float | None
    held_share_low: float | None
    held_share_high: float | None
    #: Of the deflection, where the zone has a place.
    p05_mm: float | None
    median_mm: float | None
    p95_mm: float | None


class WinsDict(TypedDict):
    """`Wins.to_dict`."""

    rows: list[WinsRow]
    summary: list[str]


class Wins(Table[WinsDict]):
    """Who is the stiffest how often, task by task, the most frequent winner first; and who holds the tolerance how often.

    An estimated robot (``~``) cannot win: ``share`` is counted among the others, ``share_with_estimated`` among all.
    """

    rows: list[WinsRow]
    #: What a manager would read.
    summary: list[str]

    def __len__(self) -> int:
        return len(self.rows)

    def _columns(self) -> dict[str, Any]:
        return _columns_of(self.rows)

    def _words(self) -> str:
        return f"{len(self)} rows; {self.summary[0] if self.summary else 'nothing to compare'}"


class OrderDict(TypedDict):
    """`Order.to_dict`; a row has a key for every task."""

    tasks: list[str]
    model: str
    force_n: float
    rows: list[dict[str, Any]]


class Order(Table[OrderDict]):
    """Robots in order, the best first, as `stiffarm.rank` puts them."""

    tasks: list[str]
    model: str
    force_n: float
    #: ``rank`` (None for an estimated robot: it takes none; robots that cannot be distinguished share one), ``rank_tied``, ``robot, vendor, status, feasible_tasks, mean_ratio, error``, and
    #: the deflection [mm] under the name of each task.
    rows: list[dict[str, Any]]

    def __len__(self) -> int:
        return len(self.rows)

    def _columns(self) -> dict[str, Any]:
        return _columns_of(self.rows)

    def _words(self) -> str:
        best = next((f"; best {row['robot']}" for row in self.rows if row["rank"] == 1), "")
        return f"{len(self)} robots, {len(self.tasks)} tasks, {self.force_n:g} N, {self.model} model{best}"


class Sweep:
    """The answer of a finished sweep: a folder of Parquet files, read where it is asked for.

    Every file is checked against the digest that was kept when it was written, here and whenever it is read.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self._folder = Path(folder).absolute()
        self._question = question = read_question(self._folder)
        missing = [chunk for chunk in range(question.chunks) if not question.part(self._folder, chunk).is_file()]
        if missing:
            raise StiffarmError(
                f"{folder} is not finished: {len(missing)} of {question.chunks} chunks are missing, the first is "
                f"{missing[0]}; ask again with the same folder to go on"
            )
        self._sums = None if question.maker["format"] == 1 else self._checked()

    def _checked(self) -> dict[str, str]:
        """The digests of all files, each of which has its own."""
        sums, line = read_sums(self._folder)
        if line is not None:
            words = f"line {line} of {self._folder / SUMS} is damaged; ask the same with the same folder, and what it named"
            raise StiffarmError(f"{words} is computed again")
        head = [ASKED] if self._question.scenarios is None else [ASKED, SCENARIOS]
        check(self._folder, sums, [*head, *(path.name for path in self.files)])
        return sums

    @property
    def is_proved(self) -> bool:
        """Whether the folder has digests; those of the first format have none."""
        return self._sums is not None

    @property
    def folder(self) -> Path:
        """Where the part files are; what else is there begins with ``_``."""
        return self._folder

    @property
    def files(self) -> list[Path]:
        """The parts in the order of their rows."""
        return [self._question.part(self._folder, chunk) for chunk in range(self._question.chunks)]

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Scenarios, tasks, forces, robots: the order of the rows, robots changing fastest."""
        return self._question.shape

    def __len__(self) -> int:
        return self._question.rows

    def __repr__(self) -> str:
        scenarios, tasks, forces, robots = self.shape
        return f"<stiffarm.cluster.Sweep {scenarios} scenarios x {tasks} tasks x {forces} forces x {robots} robots>"

    def to_arrow(self, columns: list[str] | None = None) -> pyarrow.Table:
        """All rows, or some columns of them, in memory."""
        import pyarrow as pa

        return pa.concat_tables([self._part(chunk, columns) for chunk in range(self._question.chunks)])

    def _part(self, chunk: int, columns: list[str] | None) -> pyarrow.Table:
        """The rows of one part, from bytes that were checked."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        path = self._question.part(self._folder, chunk)
        data = read_whole(path, None if self._sums is None else self._sums[path.name])
        try:
            part = pq.ParquetFile(pa.BufferReader(data)).read(columns)
        except (OSError, pa.ArrowException) as error:
            raise StiffarmError(f"{path} cannot be read: {error}") from None
        rows = min(self._question.chunk_rows, len(self) - chunk * self._question.chunk_rows)
        if len(part) != rows:
            raise StiffarmError(f"{path} has {len(part)} rows; expected {rows}")
        return part

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a pandas DataFrame; needs pandas."""
        try:
            import pandas  # noqa: F401
        except ImportError as error:
            raise ImportError("to_pandas() needs pandas: pip install pandas") from error
        frame: pandas.DataFrame = self.to_arrow().to_pandas()
        return frame

    def to_polars(self) -> polars.DataFrame:
        """The rows as a polars DataFrame; needs polars."""
        try:
            import polars
        except ImportError as error:
            raise ImportError("to_polars() needs polars: pip install polars") from error
        frame = polars.from_arrow(self.to_arrow())
        assert isinstance(frame, polars.DataFrame)
        return frame

    def _deflections(self) -> tuple[Array, Flags, Flags | None]:
        """Deflections [mm], nan where there is none, whether there is an answer at all, and whether it holds the tolerance, where one was
        asked for; all of `shape`.
        """
        values, answered = np.full(len(self), np.nan), np.zeros(len(self), dtype=bool)
        held = np.zeros(len(self), dtype=bool) if "tolerance_mm" in self._question.options else None
        columns = ["deflection_mm", "feasible", *([] if held is None else ["pass"])]
        first = 0
        for chunk in range(self._question.chunks):
            part = self._part(chunk, columns)
            last = first + len(part)
            values[first:last] = part["deflection_mm"].to_numpy()
            answered[first:last] = part["feasible"].is_valid().to_numpy()
            if held is not None:
                held[first:last] = part["pass"].fill_null(False).to_numpy()
            first = last
        shape = self.shape
        return values.reshape(shape), answered.reshape(shape), None if held is None else held.reshape(shape)

    def wins(self) -> Wins:
        """How often is each robot the stiffest, how often does it hold the tolerance, and how far is the tool pushed off?

        A scenario counts where all robots have an answer, apart from those that have none in any scenario. Robots that
        agree to the last bit share a win. A zone without a place holds no tolerance. A share of so many scenarios is that of all that
        might have been drawn to within its 95 % confidence interval (Wilson's score interval, which holds for shares of 0 and 1, too).
        Takes ten bytes of memory a row, and some copies of one task's.

        Returns
        -------
        Wins
            One row per task, force and robot.
        """
        values, answered, held = self._deflections()
        who = self._question.robots
        known: Flags = np.array([robot["status"] != "estimated" for robot in who])
        sound: Flags = np.asarray(answered.any(axis=(0, 1, 2)))
        rows: list[WinsRow] = []
        summary: list[str] = []
        for t, task in enumerate(self._question.labels):
            for f, force_n in enumerate(self._question.forces_n):
                counted: Flags = np.asarray(answered[:, t, f][:, sound].all(axis=1) & sound.any())
                found, of = values[counted, t, f], int(counted.sum())
                among_all, among_known = _shares(found, sound), _shares(found, sound & known)
                counts_held = None if held is None else held[counted, t, f].sum(axis=0).tolist()
                group: list[WinsRow] = []
                for r, robot in enumerate(who):
                    row: Any = {
                        "task": task, "force_n": force_n, **_who(robot), "estimated": not known[r], "scenarios": of,
                        "errors": int((~answered[:, t, f, r]).sum()),
                    }  # fmt: skip
                    reached = found[:, r][np.isfinite(found[:, r])]
                    row["feasible_share"] = len(reached) / of if of and sound[r] else None
                    for name, shares, may in (("share", among_known, known[r]), ("share_with_estimated", among_all, True)):
                        counts = bool(of and sound[r] and may)
                        low, high = wilson(shares[r], of) if counts else (None, None)
                        row.update({name: shares[r] / of if counts else None, f"{name}_low": low, f"{name}_high": high})
                    times = counts_held[r] if counts_held is not None and of and sound[r] else None
                    low, high = (None, None) if times is None else wilson(times, of)
                    row.update(held_share=None if times is None else times / of, held_share_low=low, held_share_high=high)
                    quantiles = np.percentile(reached, [5, 50, 95]).tolist() if len(reached) else [None] * 3
                    row.update(zip(("p05_mm", "median_mm", "p95_mm"), quantiles))
                    group.append(row)
                group.sort(key=_frequency)
                rows += group
                summary += _sentences(group, task, force_n, of, self._question.options.get("tolerance_mm"))
        return Wins({"rows": rows, "summary": summary})

    def order(self) -> Order:
        """Robots in order: those that can do more tasks first, then by how much worse than the best they are.

        For one scenario and one force.
        """
        scenarios, _, forces, _ = self.shape
        if (scenarios, forces) != (1, 1):
            raise StiffarmError(f"{scenarios} scenarios and {forces} forces have no one order; wins() compares them")
        values, _, _ = self._deflections()
        values = values[0, :, 0]
        errors = self.to_arrow(["error"])["error"].to_pylist()
        labels, who = self._question.labels, self._question.robots
        deflections = [[float(v) if np.isfinite(v) else None for v in values[:, r]] for r in range(len(who))]
        names = [(robot["vendor"] or "", robot["robot"] or "", robot["status"] == "estimated") for robot in who]
        rows: list[dict[str, Any]] = []
        for r, rank, tied, mean_ratio in _stiffarm.order(names, self._proved(deflections)):
            row: dict[str, Any] = {"rank": rank, "rank_tied": tied, **_who(who[r])}
            row["feasible_tasks"] = sum(value is not None for value in deflections[r])
            row["mean_ratio"] = mean_ratio
            row.update(zip(labels, deflections[r]))
            row["error"] = next((error for error in errors[r :: len(who)] if error), None)
            rows.append(row)
        model = self._question.options["model"]
        return Order({"tasks": labels, "model": model, "force_n": self._question.forces_n[0], "rows": rows})

    def _proved(self, deflections: list[list[float | None]]) -> list[list[tuple[float, float] | None]]:
        """Lower bound and value [mm] of every robot and task, of one scenario and one force."""
        bounds = np.asarray(self.to_arrow(["lower_bound_mm"])["lower_bound_mm"].to_numpy(zero_copy_only=False), dtype=float)
        bounds = bounds.reshape(self.shape)[0, :, 0]
        return [
            [None if value is None else (float(bounds[task, r]), value) for task, value in enumerate(row)]
            for r, row in enumerate(deflections)
        ]

    def plot(
        self, *, task: str | None = None, force_n: float | None = None, ax: Axes | None = None, most: int = 24
    ) -> Axes:
        """How often each robot wins one task, beside the 5 to 95 % of its deflection; estimated robots ~ and pale.

        Parameters
        ----------
        task : str, optional
            As the rows call it; the first without it.
        force_n : float, optional
            One of the forces [N]; the first without it.
        ax : matplotlib Axes, optional
            Where to draw; a new figure without it.
        most : int
            So many robots are drawn, the first ones.
        """
        from ..plot import _COLOUR, _axes

        task = self._question.labels[0] if task is None else task
        force_n = self._question.forces_n[0] if force_n is None else force_n
        rows = [row for row in self.wins().rows if (row["task"], row["force_n"]) == (task, force_n)]
        if not rows:
            tasks, forces = self._question.labels, [f"{known:g}" for known in self._question.forces_n]
            raise KeyError(f"no task {task!r} under {force_n!r} N; expected one of {', '.join(tasks)} and of {', '.join(forces)} N")
        left_out = len(rows) - max(most, 1)
        rows = rows[: max(most, 1)]
        ax = _axes(ax, figsize=(6.8, 1.6 + 0.27 * len(rows)))
        names = []
        for y, row in enumerate(rows):
            names.append(_name(row))
            low, middle, high = row["p05_mm"], row["median_mm"], row["p95_mm"]
            if low is None or middle is None or high is None:
                continue
            span = [[middle - low], [high - middle]]
            alpha, colour = (0.4, _COLOUR["grey"]) if row["estimated"] else (1.0, _COLOUR["ink"])
            ax.errorbar(middle, y, xerr=span, fmt="o", capsize=3, color=colour, alpha=alpha)
            if row["share_with_estimated"] is not None:
                where = (high, y)
                ax.annotate(f" {row['share_with_estimated']:.0%}", where, (6, 0), textcoords="offset points", va="center")
        ax.set_yticks(range(len(names)), names)
        ax.invert_yaxis()
        ax.margins(x=0.15)
        ax.set_xlabel("worst deflection at the best place [mm]: median, 5 to 95 %")
        about = f"%: the stiffest of {rows[0]['scenarios']} scenarios" + ("; ~ estimated" if "~" in "".join(names) else "")
        about += f"; the first {len(rows)} of {len(rows) + left_out} robots" if 0 < left_out else ""
        ax.set_title(f"Task {task} under {force_n:g} N\n{about}", fontsize="medium", loc="left")
        return ax


def _who(robot: dict[str, str | None]) -> dict[str, str | None]:
    return {key: robot[key] for key in ("robot", "vendor", "status")}


def _name(row: WinsRow) -> str:
    """Maker and name, estimated robots marked."""
    return f"{row['vendor'] or ''} {row['robot']}".strip() + ("~" if row["status"] == "estimated" else "")


def _frequency(row: WinsRow) -> tuple[float, float]:
    share, median = row["share_with_estimated"], row["median_mm"]
    return (math.inf if share is None else -share), (math.inf if median is None else median)


def _shares(values: Array, may: Flags) -> list[float]:
    """How many scenarios each robot wins, ties shared; (scenarios, robots) deflections, nan where there is none."""
    held = np.where(np.isfinite(values) & may, values, np.inf)
    best = held.min(axis=1, keepdims=True, initial=np.inf)
    first = (held == best) & np.isfinite(held)
    shares: list[float] = (first / np.maximum(first.sum(axis=1, keepdims=True), 1)).sum(axis=0).tolist()
    return shares


def _sentences(group: list[WinsRow], task: str, force_n: float, of: int, tolerance_mm: str | None) -> list[str]:
    """The winner of a task in words; an estimated robot is named as such, and takes no win."""
    name = f"{task} under {force_n:g} N"
    winner = max((row for row in group if row["share"]), key=lambda row: row["share"] or 0.0, default=None)
    if winner is None:
        sentences = [f"{name}: no robot whose lengths are known can do it in any of {of} scenarios."]
    else:
        sentences = [
            f"{name}: {_name(winner)} is the stiffest in {winner['share']:.0%} of {of} scenarios "
            f"(95 % confidence {winner['share_low']:.0%} to {winner['share_high']:.0%})."
        ]
        if tolerance_mm is not None and winner["held_share"] is not None:
            sentences.append(
                f"{name}: it holds {float(tolerance_mm):g} mm in {winner['held_share']:.0%} of them "
                f"(95 % confidence {winner['held_share_low']:.0%} to {winner['held_share_high']:.0%})."
            )
    rivals = [row for row in group if row["estimated"] and row["share_with_estimated"]]
    if rivals:
        words = ", ".join(f"{_name(row)} in {row['share_with_estimated']:.0%}" for row in rivals)
        sentences.append(f"By estimated numbers would be stiffer: {words}; find the data sheets before you decide.")
    return sentences
