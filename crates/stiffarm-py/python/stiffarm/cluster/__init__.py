"""Robots x tasks x forces x joint stiffnesses on many machines: which robot wins, and how sure is that?

`sweep` computes every combination on a `dask.distributed` cluster and writes a folder of Parquet files; `rank` puts robots
in order; `spread` draws joint stiffnesses that are known to some percent; `load` reads a finished folder.

A chunk is one task of the scheduler and one file. Files appear whole or not at all, under the fingerprint of the question:
ask again with the same folder, and only what is missing is computed. The bytes do not depend on the workers, and
``_sha256sums`` holds their digests: what was changed since is refused when it is read, and computed again when it is asked for.

Needs ``pip install 'stiffarm[cluster]'``. A script that starts workers needs ``if __name__ == "__main__":``.
"""

from __future__ import annotations

import itertools
import os
import tempfile
import warnings
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Union

import numpy as np
import numpy.typing as npt

from .. import _given, _options, _stiffarm
from .._given import Array, RobotLike
from .._asked import placed
from .._stiffarm import Robot, StiffarmError
from .._verbs import PAPER_TASKS
from ..types import SweepOptions
from ._answer import Order, Sweep, Wins
from ._question import Question, is_circle

if TYPE_CHECKING:
    from distributed import Client
    from typing_extensions import Unpack

__all__ = ["Order", "Sweep", "Wins", "load", "rank", "spread", "sweep"]

#: Rows of a chunk where nothing is said: docs/scale.md derives them.
CHUNK_ROWS = {"planar": 20_000, "spatial": 20}

#: A client, the address of a scheduler, or None for workers on this machine.
ClientLike = Union["Client", str, None]


def spread(m: int, *, percent: float = 30.0, robots: int | None = None, seed: int = 0) -> Array:
    """Scenarios of joint stiffnesses that are known to some percent.

    Every stiffness is drawn evenly between ``1 - percent / 100`` and ``1 + percent / 100`` of its nominal value, on its own.

    Parameters
    ----------
    m : int
        Scenarios.
    percent : float
        Below 100.
    robots : int, optional
        As many robots, each with its own draws: their makers err independently. Without it all robots share the draws,
        as where one unknown (a load, a wear) acts on all of them.
    seed : int
        The same seed gives the same draws.

    Returns
    -------
    (m, 6) or (m, robots, 6) ndarray
        Factors on the compliance of each drive [1].
    """
    percent = _given.number("percent", percent)
    if not 0 <= percent < 100:
        raise StiffarmError(f"percent={percent}; expected 0 to less than 100")
    m = _given.whole("m", m, 1, 10**9)
    robots = None if robots is None else _given.whole("robots", robots, 1, 10**6)
    seed = _given.whole("seed", seed, 0, 2**128)
    shape = (m, 6) if robots is None else (m, robots, 6)
    drawn: Array = 1.0 / np.random.default_rng(seed).uniform(1 - percent / 100, 1 + percent / 100, shape)
    return drawn


def load(folder: str | os.PathLike[str]) -> Sweep:
    """A finished sweep, read from its folder, whichever stiffarm made it.

    Raises
    ------
    StiffarmError
        Where it is not finished, or a file is not the one that was written. Folders of the first format have no digests:
        they are read with a warning.
    """
    _needed()
    found = Sweep(_given.path("folder", folder))
    if not found.is_proved:
        warnings.warn(
            f"{found.folder} was made by a stiffarm that kept no digests: a file that was changed since is not noticed",
            RuntimeWarning,
            stacklevel=2,
        )
    return found


@_options.takes("place", SweepOptions)
def sweep(
    robots: RobotLike | Iterable[RobotLike] = "paper",
    *,
    folder: str | os.PathLike[str],
    tasks: str | Iterable[str] = PAPER_TASKS,
    force_n: float | Sequence[float] = 1000.0,
    scenarios: int | npt.ArrayLike | None = None,
    client: ClientLike = None,
    workers: int | None = None,
    chunk_rows: int | None = None,
    timeout_s: float = 30.0,
    progress: bool | None = None,
    **options: Unpack[SweepOptions],
) -> Sweep:
    """Every robot at every task, force and scenario, on a cluster.

    Parameters
    ----------
    robots : robots
        As in `stiffarm.rank`. A file that cannot be read becomes rows with an ``error``. Of several robots of one name
        all but the first are called ``name #2`` and so on, whoever makes them.
    folder : path
        Where the Parquet files go: new, empty, or begun with the same question, which is then finished. All workers
        must see it.
    tasks : str or list of str
        As in `stiffarm.rank`: what is one zone under two names is one task, under the first of them.
    force_n : float or list of float
        Cutting forces [N].
    scenarios : int, or (m, 6) or (m, robots, 6) array_like, optional
        A whole number: so many draws of the drive stiffness, the first of those from which `stiffarm.rank` has its
        intervals; of the prior (``stiffness="prior"``, which is taken in space where nothing is said) or of an identification.
        A robot of which nothing is known becomes rows with an ``error``.
        Else factors on the compliance of each drive [1], for all robots or for each: `spread`. A factor that is no positive
        number becomes rows with an ``error``. They multiply the compliances that ``stiffness`` asks for.
    client : distributed.Client or str, optional
        A client, or the address of a scheduler. Without it workers of one thread on this machine.
    workers : int, optional
        How many of them; as many as there are cores without it.
    chunk_rows : int, optional
        Rows of a part file. Belongs to the question: a folder is finished with the one it was begun with.
    timeout_s : float
        How long to wait for a scheduler and its first worker [s].
    progress : bool, optional
        Whether to show how far it is; without it on a terminal.
    {options}

    Returns
    -------
    Sweep
        Null where there is no place (``reason``) or no answer (``error``).

    Raises
    ------
    StiffarmError
        Where the question makes no sense, the folder holds something else or cannot be written, another run is
        writing there, or no worker answers. Finished parts are kept.
    """
    _needed()
    forces = _given.row("force_n", force_n)
    path, timeout_s = _given.path("folder", folder).absolute(), _given.number("timeout_s", timeout_s)
    workers = None if workers is None else _given.whole("workers", workers, 1, 1024)
    # Both stand in every folder, and name its columns.
    asked = _options.spelt("place", {"angle": "axes", "model": "planar", **options})
    question = _checked(robots, tasks, forces, asked, scenarios, chunk_rows)
    from ._run import run

    run(question, path, client, workers, timeout_s, progress)
    return Sweep(path)


@_options.takes("place", SweepOptions)
def rank(
    robots: RobotLike | Iterable[RobotLike] = "paper",
    *,
    folder: str | os.PathLike[str] | None = None,
    tasks: str | Iterable[str] = PAPER_TASKS,
    force_n: float = 1000.0,
    client: ClientLike = None,
    workers: int | None = None,
    chunk_rows: int | None = None,
    timeout_s: float = 30.0,
    progress: bool | None = None,
    **options: Unpack[SweepOptions],
) -> Order:
    """Robots in the order of `stiffarm.rank`, with its deflections.

    Parameters
    ----------
    folder : path, optional
        Where the Parquet files go; nothing is kept without it. Workers on other machines need one.
    {options}

    All others are as in `sweep`.

    Returns
    -------
    Order
        The best first; an estimated robot takes no place.
    """
    if folder is None and client is not None:
        raise StiffarmError("folder is missing: the workers of a client write where they can all see it")
    with tempfile.TemporaryDirectory(prefix="stiffarm-") as kept:
        return sweep(
            robots, folder=kept if folder is None else folder, tasks=tasks, force_n=force_n, client=client, workers=workers,
            chunk_rows=chunk_rows, timeout_s=timeout_s, progress=progress, **options,
        ).order()  # fmt: skip


def _needed() -> None:
    try:
        import distributed  # noqa: F401
        import pyarrow  # noqa: F401
    except ImportError as error:
        words = "stiffarm.cluster needs dask, distributed and pyarrow: pip install 'stiffarm[cluster]'"
        raise ImportError(words) from error


def _checked(
    robots: RobotLike | Iterable[RobotLike],
    tasks: str | Iterable[str],
    forces_n: list[float],
    asked: dict[str, str],
    scenarios: int | npt.ArrayLike | None,
    chunk_rows: int | None,
) -> Question:
    """Refuses what would be wrong in every row."""
    who = _distinguished(robots)
    # Tasks of one zone are one task, under the first of its names.
    wanted = _stiffarm.distinct(_given.tasks(tasks))
    if not who or not wanted or not forces_n:
        what = "robot" if not who else "task" if not wanted else "force"
        raise StiffarmError(f"no {what} is given; a sweep needs at least one robot, one task and one force")
    if all(robot["toml"] is None for robot in who):
        raise StiffarmError(f"no robot can be read; the first says: {who[0]['error']}")
    # Any robot of the catalogue will do: a zone that no arm reaches is refused at once, after its options were read.
    any_robot = Robot("KR 210 R2700 extra")
    nowhere = "circle:50" if all(is_circle(task) for task in wanted) else "rect:50x50"
    for force in forces_n:
        placed(any_robot, nowhere, {**asked, "force_n": repr(force)})
    drawn: Array | None = None
    if scenarios is not None:
        for stiffness in asked.keys() & {"drive_urad_per_nm", "stiffness_nm_per_rad"}:
            # It would be that of every scenario.
            raise StiffarmError(
                f"{stiffness} and scenarios both say how stiff the drives are; factors apply to Robot.with_compliance"
            )
        who, drawn = _drawn(who, {**asked, "force_n": repr(forces_n[0])}, scenarios)
        # The robots have it from here on.
        asked = {key: value for key, value in asked.items() if key != "stiffness"}
        if drawn.shape[1:] not in ((6,), (len(who), 6)) or not len(drawn):
            raise StiffarmError(
                f"scenarios of shape {drawn.shape}; expected (m, 6) or (m, {len(who)}, 6): factors on the compliance of "
                "six drives, for all robots or for each"
            )
        if not (np.isfinite(drawn) & (drawn > 0)).all(axis=-1).any():
            raise StiffarmError("scenarios hold no six factors that are positive numbers")
    rows = CHUNK_ROWS[asked["model"]] if chunk_rows is None else _given.whole("chunk_rows", chunk_rows, 1, 10_000_000)
    return Question(who, wanted, wanted, list(dict.fromkeys(forces_n)), asked, drawn, rows)


def _drawn(
    who: list[dict[str, str | None]], asked: dict[str, str], scenarios: int | npt.ArrayLike
) -> tuple[list[dict[str, str | None]], Array]:
    """Robots with the drives that are asked for, and the factors on their compliances."""
    is_count = isinstance(scenarios, (int, np.integer))
    count = _given.whole("scenarios", scenarios, 1, 10**6) if is_count else 0
    robots: list[dict[str, str | None]] = []
    factors: list[Array] = []
    for robot in who:
        if robot["toml"] is None:
            robots.append(robot)
            factors.append(np.full((count, 6), np.nan))
            continue
        try:
            equipped, drawn = _stiffarm.draws(Robot.from_toml(robot["toml"]), asked, count)
            if is_count and drawn is None:
                raise StiffarmError(
                    f"the drive stiffness of {robot['robot']} has no stated uncertainty; stiffness='prior' gives one by its size"
                )
            robots.append({**robot, "toml": equipped.to_toml()})
        except StiffarmError as error:
            robots.append({**robot, "toml": None, "error": str(error)})
            drawn = None
        factors.append(np.full((count, 6), np.nan) if drawn is None else drawn)
    if all(robot["toml"] is None for robot in robots):
        raise StiffarmError(f"scenarios: {next(robot['error'] for robot in robots)}")
    return robots, np.stack(factors, axis=1) if is_count else _given.numbers("scenarios", scenarios)


def _distinguished(robots: RobotLike | Iterable[RobotLike]) -> list[dict[str, str | None]]:
    """Robots as plain text, each under a name of its own; a file that cannot be read keeps its place, with the reason."""
    found: dict[Robot | tuple[str, str], None] = {}
    for each in _given.each_robot(robots):
        for one in _files(each):
            try:
                found.update(dict.fromkeys(_given.robots(one)))
            except StiffarmError as error:
                # A name that is not found is a slip of the pen; a file that is broken is one of many.
                if isinstance(one, Robot) or not Path(one).is_file():
                    raise
                found[os.fspath(one), str(error)] = None
    named: list[dict[str, str | None]] = []
    names: set[str] = set()
    for robot in found:
        if isinstance(robot, Robot):
            name, who = robot.name, {"vendor": robot.vendor or None, "status": robot.status}
            who.update(toml=robot.to_toml(), error=None)
        else:
            name, who = robot[0], {"vendor": None, "status": None, "toml": None, "error": robot[1]}
        free = itertools.chain([name], (f"{name} #{number}" for number in itertools.count(2)))
        named.append({"robot": next(one for one in free if one not in names), **who})
        names.add(str(named[-1]["robot"]))
    return named


def _files(robot: RobotLike) -> list[RobotLike]:
    """The robot files of a folder, one by one."""
    if isinstance(robot, Robot):
        return [robot]
    path = Path(robot)
    files: list[RobotLike] = [*sorted(path.glob("*.toml"))] if path.is_dir() else [robot]
    return files
