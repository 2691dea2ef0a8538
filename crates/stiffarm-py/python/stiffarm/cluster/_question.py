"""What is asked of a cluster: written down once in the folder, read by every worker, answered in parts."""

from __future__ import annotations

import functools
import hashlib
import io
import json
import math
import os
import platform
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _stiffarm
from .._asked import placed
from .._given import Array
from .._stiffarm import Robot, StiffarmError
from ._folder import ASKED, SCENARIOS, SUMS, listed, part_name, write_whole

if TYPE_CHECKING:
    import pyarrow

#: What a folder looks like; a change of it makes another question. 1: without a manifest, and without the sources. 2: without the
#: factors of the scenarios in its rows. All are read.
FORMAT = 3
#: On the compliance of each drive.
FACTORS = tuple(f"compliance_factor_{drive}" for drive in range(1, 7))
#: Rows that are Python's own values at once: those take ten times the memory of columns.
_PIECE = 10_000


def is_circle(task: str) -> bool:
    """A zone without sides."""
    return task.strip().lower().startswith(("circle:", "a:"))


def maker() -> dict[str, Any]:
    """Who computes here: what differs between two of them must not be mixed."""
    return {"format": FORMAT, "stiffarm": _stiffarm.__version__, "sources": _sources()}


def _sources() -> str:
    """SHA-256 of the Rust sources that were compiled in, and of this package's own as they lie here."""
    package = Path(__file__).parents[1]
    found = hashlib.sha256(_stiffarm.__sources__.encode())
    for name in sorted(path.relative_to(package).as_posix() for path in package.rglob("*.py")):
        found.update(f"{hashlib.sha256((package / name).read_bytes()).hexdigest()}  {name}\n".encode())
    return found.hexdigest()


def _named(made_by: dict[str, Any]) -> str:
    return f"stiffarm {made_by['stiffarm']} (sources {made_by.get('sources', 'unknown')[:12]})"


@dataclass(frozen=True)
class Question:
    """Robots x tasks x forces x scenarios. Row n: robots change fastest, then forces, tasks, scenarios."""

    #: ``robot, vendor, status``, and either ``toml`` or ``error``.
    robots: list[dict[str, str | None]]
    #: As they were given, and as the answers call them.
    tasks: list[str]
    labels: list[str]
    forces_n: list[float]
    #: What else was asked, as the command line spells it.
    options: dict[str, str]
    #: (m, 6) or (m, robots, 6) factors on the compliance of the drives; None where they stay as they are.
    scenarios: Array | None
    chunk_rows: int
    maker: dict[str, Any] = field(default_factory=maker)

    @property
    def shape(self) -> tuple[int, int, int, int]:
        """Scenarios, tasks, forces, robots."""
        scenarios = 1 if self.scenarios is None else len(self.scenarios)
        return scenarios, len(self.tasks), len(self.forces_n), len(self.robots)

    @property
    def rows(self) -> int:
        return math.prod(self.shape)

    @property
    def chunks(self) -> int:
        return -(-self.rows // self.chunk_rows)

    @property
    def spatial(self) -> bool:
        return self.options["model"] == "spatial"

    @functools.cached_property
    def written(self) -> dict[str, Any]:
        """What stands in the folder; the scenarios by their digest."""
        drawn = None
        if self.scenarios is not None:
            digest = hashlib.sha256(np.ascontiguousarray(self.scenarios, "<f8").tobytes()).hexdigest()
            drawn = {"shape": list(self.scenarios.shape), "sha256": digest}
        return {
            **self.maker, "robots": self.robots, "tasks": self.tasks, "labels": self.labels, "force_n": self.forces_n,
            "options": self.options, "scenarios": drawn, "chunk_rows": self.chunk_rows,
        }  # fmt: skip

    @functools.cached_property
    def fingerprint(self) -> str:
        text = json.dumps(self.written, sort_keys=True, allow_nan=False)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def part(self, folder: Path, chunk: int) -> Path:
        return folder / part_name(chunk, self.fingerprint)

    def schema(self) -> pyarrow.Schema:
        import pyarrow as pa

        number, text = pa.float64(), pa.string()
        columns = [
            pa.field("scenario", pa.int64(), nullable=False), pa.field("task", text, nullable=False),
            pa.field("force_n", number, nullable=False), pa.field("robot", text, nullable=False),
            pa.field("vendor", text), pa.field("status", text), pa.field("feasible", pa.bool_()), ("deflection_mm", number),
            ("lower_bound_mm", number), ("x_m", number), ("z_m", number), ("angle_deg", number), ("elbow", text),
        ]  # fmt: skip
        if self.spatial:
            columns += [
                ("bearing_deg", number), ("yaw_deg", number), ("roll_deg", number), ("shoulder", text), ("wrist", text),
                ("limit_margin_deg", number), ("singular_margin_deg", number),
            ]  # fmt: skip
        if "tolerance_mm" in self.options:
            columns.append(("pass", pa.bool_()))
        if self.scenarios is not None:
            columns += [(name, number) for name in FACTORS]
        return pa.schema([*columns, ("reason", text), ("error", text)], {"stiffarm": self.fingerprint})

    def answer(self, first: int, last: int) -> list[dict[str, Any]]:
        """The rows from ``first`` up to ``last``; what goes wrong in one of them stands in its ``error``."""
        _, tasks, forces, robots = self.shape
        made: dict[tuple[int, int], Robot | str] = {}
        found: dict[tuple[int, int, float], tuple[dict[str, Any], int]] = {}
        rows = []
        for n in range(first, last):
            rest, robot = divmod(n, robots)
            rest, force = divmod(rest, forces)
            scenario, task = divmod(rest, tasks)
            if robot == 0 and force == 0 and task == 0:
                made.clear()
                found.clear()
            if (scenario, robot) not in made:
                made[scenario, robot] = self._robot(scenario, robot)
            arm, force_n = made[scenario, robot], self.forces_n[force]
            who = self.robots[robot]
            row: dict[str, Any] = {"scenario": scenario, "task": self.labels[task], "force_n": force_n}
            row.update((name, who[name]) for name in ("robot", "vendor", "status"))
            factors = self._factors(scenario, robot)
            if factors is not None:
                row.update(zip(FACTORS, factors.tolist()))
            if isinstance(arm, str):
                rows.append({**row, "error": arm})
                continue
            # Deflections are linear in the force, and doubling rounds nothing: forces that are each other's doubles
            # are computed once. All else is computed, for no other factor is exact to the last bit.
            mantissa, exponent = math.frexp(force_n)
            key = (task, robot, mantissa)
            if key in found:
                known, before = found[key]
                known = _doubled(known, exponent - before, self.options)
            else:
                known = _placed(arm, self.tasks[task], {**self._options(task), "force_n": repr(force_n)})
                if forces > 1 and "error" not in known:
                    found[key] = known, exponent
            rows.append({**known, **row})
        return rows

    def _options(self, task: int) -> dict[str, str]:
        """An angle is of the tasks with sides; whether it is of any was asked before."""
        return {key: value for key, value in self.options.items() if key != "angle" or not is_circle(self.tasks[task])}

    def _factors(self, scenario: int, robot: int) -> Array | None:
        """On the compliances of one robot's drives."""
        if self.scenarios is None:
            return None
        found: Array = self.scenarios[scenario] if self.scenarios.ndim == 2 else self.scenarios[scenario, robot]
        return found

    def _robot(self, scenario: int, robot: int) -> Robot | str:
        """One robot of one scenario, or why there is none."""
        toml = self.robots[robot]["toml"]
        if toml is None:
            return self.robots[robot]["error"] or "no robot"
        nominal = _nominal(toml)
        factors = self._factors(scenario, robot)
        if factors is None:
            return nominal
        good = np.isfinite(factors) & (factors > 0)
        if not good.all():
            drive = int(np.argmin(good))
            return f"scenario {scenario}: factor {factors[drive]} of drive {drive + 1}; expected a positive number"
        drives = np.ones(6)
        given = nominal.drive_urad_per_nm
        # A planar robot has the drives 2 and 3 only.
        drives[slice(1, 3) if len(given) == 2 else slice(None)] = given
        try:
            return nominal.with_compliance(drive_urad_per_nm=(drives * factors).tolist())
        except StiffarmError as error:
            return str(error)

    def table(self, chunk: int) -> pyarrow.Table:
        import pyarrow as pa

        first = chunk * self.chunk_rows
        last = min(first + self.chunk_rows, self.rows)
        pieces = [
            pa.Table.from_pylist(self.answer(piece, min(piece + _PIECE, last)), self.schema())
            for piece in range(first, last, _PIECE)
        ]
        return pa.concat_tables(pieces).combine_chunks()


@functools.lru_cache(maxsize=1024)
def _nominal(toml: str) -> Robot:
    return Robot.from_toml(toml)


def _placed(robot: Robot, task: str, asked: dict[str, str]) -> dict[str, Any]:
    try:
        return placed(robot, task, asked)
    except (KeyboardInterrupt, SystemExit):
        raise
    # A panic of the library is no Exception, and must not end the run either.
    except BaseException as error:
        return {"error": str(error) if isinstance(error, StiffarmError) else f"{type(error).__name__}: {error}"}


def _doubled(known: dict[str, Any], times: int, options: dict[str, str]) -> dict[str, Any]:
    row = dict(known)
    for key in ("deflection_mm", "lower_bound_mm"):
        if row.get(key) is not None:
            row[key] = math.ldexp(row[key], times)
    if row.get("pass") is not None and row.get("deflection_mm") is not None:
        row["pass"] = row["deflection_mm"] <= float(options["tolerance_mm"])
    return row


def part_bytes(table: pyarrow.Table) -> bytes:
    """The same table gives the same bytes: one row group, fixed options."""
    import pyarrow.parquet as pq

    data = io.BytesIO()
    pq.write_table(
        table, data, row_group_size=max(len(table), 1), version="2.6", compression="zstd", compression_level=3,
        use_dictionary=True, write_statistics=True, store_schema=True,
    )  # fmt: skip
    return data.getvalue()


def write_question(folder: Path, question: Question) -> dict[str, str]:
    """Begins a folder; the question comes last, and with it the folder is begun. Gives the digests of what it wrote."""
    sums = {}
    if question.scenarios is not None:
        data = io.BytesIO()
        np.save(data, np.ascontiguousarray(question.scenarios, "<f8"), allow_pickle=False)
        sums[SCENARIOS] = write_whole(folder / SCENARIOS, data.getvalue())
    text = json.dumps({**question.written, "fingerprint": question.fingerprint}, indent=1, allow_nan=False).encode()
    sums[ASKED] = hashlib.sha256(text).hexdigest()
    write_whole(folder / SUMS, listed(sums))
    write_whole(folder / ASKED, text)
    return sums


def read_question(folder: Path) -> Question:
    """The question that a folder answers, whoever began it; its fingerprint is proved."""
    path = folder / ASKED
    try:
        held = json.loads(path.read_text(encoding="utf-8"))
        made_by = {key: held[key] for key in ("format", "stiffarm", "sources") if key in held}
        if made_by["format"] not in range(1, FORMAT + 1):
            raise StiffarmError(f"{folder} was made by {_named(made_by)}, a later one; install that to read it")
        path = folder / (SCENARIOS if held["scenarios"] else ASKED)
        scenarios = np.load(path, mmap_mode="r", allow_pickle=False) if held["scenarios"] else None
        question = Question(
            held["robots"], held["tasks"], held["labels"], held["force_n"], held["options"], scenarios, held["chunk_rows"],
            made_by,
        )  # fmt: skip
        fits = question.fingerprint == held["fingerprint"]
    except FileNotFoundError as error:
        raise StiffarmError(f"{folder} holds no sweep: {error.filename} is not there") from None
    except StiffarmError:
        raise
    # A damaged head of an array may name any type and any length.
    except Exception as error:
        raise StiffarmError(f"{path} cannot be read: {type(error).__name__}: {error}; {_RESTORE}") from None
    if not fits:
        what = f"{ASKED} or {SCENARIOS}" if held["scenarios"] else ASKED
        raise StiffarmError(f"{folder} was changed: {what} does not fit the fingerprint in {ASKED}; {_RESTORE}")
    return question


_RESTORE = "restore it from a copy, or give another folder"


def refuse_another_maker(folder: Path, question: Question) -> None:
    """Two builds may differ in the last bit, or in more: their parts are not mixed."""
    if question.maker != maker():
        raise StiffarmError(
            f"{folder} was begun by {_named(question.maker)}, and {platform.node()} has {_named(maker())}: install the "
            "same on all, or give another folder"
        )


@functools.lru_cache(maxsize=4)
def _known(folder: str, fingerprint: str) -> Question:
    path = Path(folder)
    if not (path / ASKED).is_file():
        raise StiffarmError(f"the worker on {platform.node()} does not see {path}: give a folder that all workers share")
    question = read_question(path)
    refuse_another_maker(path, question)
    if question.fingerprint != fingerprint:
        raise StiffarmError(f"{path} holds another question on {platform.node()}: give a folder that all workers share")
    return question


def answer_chunk(folder: str, fingerprint: str, chunk: int, caller: int) -> tuple[int, int, str]:
    """On a worker: computes one chunk and writes its part; gives its rows, how many of them are errors, and its digest."""
    if os.getpid() != caller:
        # The cluster shares out the cores already.
        _stiffarm.set_threads(1)
    question = _known(folder, fingerprint)
    table = question.table(chunk)
    digest = write_whole(question.part(Path(folder), chunk), part_bytes(table))
    return len(table), len(table) - int(table["error"].null_count), digest
