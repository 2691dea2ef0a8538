"""The verbs, with the options of the program `stiffarm`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, overload

import numpy as np
import numpy.typing as npt

from . import _given, _options, _stiffarm
from ._answers import Chatter, Comparison, Compliance, Compliances, Force, Identification, Ledger, Map, MeasurementPlan, Milled, Modes, PathRanking, Placement, Ranking, Study, Toolpath
from ._given import RobotLike
from ._progress import ProgressLike, told
from ._stiffarm import Robot, StiffarmError
from .types import (
    ChatterOptions,
    CompareOptions,
    ComplianceOptions,
    IdentifyOptions,
    MapOptions,
    MeasureOptions,
    MillOptions,
    ModesOptions,
    PlaceOptions,
    PlacementDict,
    RankOptions,
    RobotsOptions,
    StudyOptions,
)

if TYPE_CHECKING:
    from typing_extensions import Unpack

PAPER_TASKS = ("A:0.1", "A:1.0", "B:0.1", "B:0.5", "C:0.05", "C:0.15")


@_options.takes("robots list", RobotsOptions)
def robots(
    words: str = "", *, among: RobotLike | Iterable[RobotLike] = "all", **options: Unpack[RobotsOptions]
) -> list[Robot]:
    """The robots of the catalogue, or those that have all that is asked for.

    Parameters
    ----------
    words : str
        Words that must stand in the maker's or the robot's name.
    among : robots
        Which are looked at: names, patterns, paths, robots, ``"paper"`` or ``"all"``.
    {options}

    Raises
    ------
    StiffarmError
        Where no robot is left; it says what would match.
    """
    asked = _options.spelt("robots list", options)
    return _stiffarm.robots(_given.robots(among), _given.text("words", words).split(), asked)


@overload
def compliance(
    robot: RobotLike, *, joints_deg: Sequence[float], full: bool = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliance: ...
@overload
def compliance(
    robot: RobotLike, *, joints_deg: Sequence[Sequence[float]], full: bool = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliances: ...
@overload
def compliance(
    robot: RobotLike, *, joints_deg: npt.ArrayLike, full: bool = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliance | Compliances: ...
@_options.takes("compliance", ComplianceOptions)
def compliance(
    robot: RobotLike,
    *,
    joints_deg: npt.ArrayLike,
    full: bool = False,
    progress: ProgressLike = None,
    **options: Unpack[ComplianceOptions],
) -> Compliance | Compliances:
    """Six-axis compliance at one posture, or at many.

    All six drives are compliant, everything else is rigid. Joint limits are not checked.

    Parameters
    ----------
    robot : Robot or str
        With six axes.
    joints_deg : (6,) or (n, 6) array_like
        Joint angles as the robot reports them [deg]. Rows of float64 in one piece are not copied.
    full : bool
        Of many postures, the (n, 3, 3) matrices too.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Compliance or Compliances
        Of one posture every key of the program; of many ``worst_um_per_n``, with a relative error below 3e-8.

    Raises
    ------
    StiffarmError
        For wrong shapes, angles that are no numbers or beyond 1080 deg, and planar robots.
    """
    robot = _given.robot(robot)
    asked = _options.spelt("compliance", options)
    joints = _given.numbers("joints_deg", joints_deg)
    if joints.shape == (6,):
        if full:
            raise StiffarmError("full=True is for many postures: one has all there is")
        return Compliance(_stiffarm.posture(robot, joints.tolist(), asked))
    if joints.ndim != 2 or joints.shape[1] != 6:
        raise StiffarmError(f"joints_deg of shape {joints.shape}; expected (6,) or (n, 6), in degrees")
    if "force_n" in asked:
        raise StiffarmError("force_n is for one posture; of many, full=True gives the matrices")
    with told("compliances", progress) as tell:
        data: dict[str, object] = {"robot": robot.name, "worst_um_per_n": _stiffarm.worst(robot, joints, asked, tell)}
        if full:
            data["compliance_um_per_n"] = _stiffarm.matrices(robot, joints, asked, tell)
    return Compliances(data)


@_options.takes("place", PlaceOptions)
def place(robot: RobotLike, *, task: str, progress: ProgressLike = None, **options: Unpack[PlaceOptions]) -> Placement:
    """The best place of one zone.

    Parameters
    ----------
    robot : Robot or str
        Which.
    task : str
        ``circle:D``, ``rect:AxB`` in m, or the paper's ``A:d``, ``B:d``, ``C:d``.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Placement
        Where there is no place, ``feasible`` is False and ``reason`` says why.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense.
    """
    asked = (_given.robot(robot), _given.text("task", task), _options.spelt("place", options))
    with told("searching places", progress) as tell:
        return Placement(*_stiffarm.place(*asked, True, tell), asked)


def cell(robot: RobotLike, task: str, **options: Unpack[PlaceOptions]) -> PlacementDict:
    """One placement as a plain dict: what a worker on another machine computes and sends back, without ``advice``.

    Robots, options and the answer can all be pickled.

    Parameters
    ----------
    robot : Robot or str
        For a scenario of joint stiffnesses ``robot.with_compliance(drive_urad_per_nm=...)``.
    task : str
        As in `place`.
    **options
        As in `place`.
    """
    asked = (_given.robot(robot), _given.text("task", task), _options.spelt("place", options))
    return Placement(*_stiffarm.place(*asked, False), asked).to_dict()


@_options.takes("rank", RankOptions)
def rank(
    robots: RobotLike | Iterable[RobotLike] | None = None,
    *,
    tasks: str | Iterable[str] = PAPER_TASKS,
    progress: ProgressLike = None,
    **options: Unpack[RankOptions],
) -> Ranking:
    """Robots in order, for several tasks.

    Parameters
    ----------
    robots : robots, optional
        Robots, names, patterns (``"IRB 6700*"``), paths, or the sets ``"paper"`` and ``"all"``. Without them those of the paper, or,
        where a vendor, a payload or another property is asked for, all that have it.
    tasks : str or list of str
        As the task of `place`; without it the six of the paper.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Ranking
        Those that can do more of the tasks first, then by how much worse than the best they are.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense, or no robot is left.
    """
    asked = _options.spelt("rank", options)
    if robots is None:
        robots = "all" if asked.keys() & _options.table("robots list").keys() else "paper"
    with told("placing zones", progress) as tell:
        return Ranking(*_stiffarm.rank(_given.robots(robots), _given.tasks(tasks), asked, tell))


@_options.takes("map", MapOptions)
def map(robot: RobotLike, *, progress: ProgressLike = None, **options: Unpack[MapOptions]) -> Map:
    """The deflection over everything a robot reaches.

    Parameters
    ----------
    robot : Robot or str
        Which.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Map
        Arrays of shape (nz, nx); nan where nothing is reached.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense; too many points are refused before memory is taken.
    """
    with told("mapping", progress) as tell:
        return Map(*_stiffarm.map(_given.robot(robot), _options.spelt("map", options), tell))


@_options.takes("study", StudyOptions)
def study(*, robot: RobotLike | None = None, progress: ProgressLike = None, **options: Unpack[StudyOptions]) -> Study:
    """Two architectures against link ratio and task size, without joint limits.

    Parameters
    ----------
    robot : Robot or str, optional
        One that is to be found among all this with its `task`: ``mark`` says where both stand, and which architecture is stiffer there.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Study
        Accuracies over k F (l2 + l3)^2; None where a zone does not fit.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense.
    """
    with told("studying", progress) as tell:
        marked = None if robot is None else _given.robot(robot)
        return Study(*_stiffarm.study(marked, _options.spelt("study", options), tell))


@_options.takes("compare", CompareOptions)
def compare(
    a: RobotLike, b: RobotLike, *, progress: ProgressLike = None, **options: Unpack[CompareOptions]
) -> Comparison:
    """Two setups side by side.

    Parameters
    ----------
    a, b : Robot or str
        Robots, or paths of job files for `place` (TOML), which may say more: one robot with two tools takes two of them. What a job
        file says comes before the keywords, which are asked of both.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Comparison
        Both placements, and whether they can be told apart.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense of one of them.
    """
    asked = _options.spelt("compare", options)
    with told("placing zones", progress) as tell:
        return Comparison(*_stiffarm.compare(_given.setup("a", a), _given.setup("b", b), asked, tell))


@_options.takes("identify", IdentifyOptions)
def identify(
    data: str | os.PathLike[str] | object,
    *,
    robot: RobotLike,
    progress: ProgressLike = None,
    **options: Unpack[IdentifyOptions],
) -> Identification:
    """How stiff the drives of a robot are, from deflections that were measured.

    Parameters
    ----------
    data : path or data frame
        A table of measurements (CSV): joint angles, forces, displacements, in columns that name their units; see the program's help.
        Whatever has ``to_csv`` (pandas) or ``write_csv`` (polars) will do.
    robot : Robot or str
        The robot that was measured.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Identification
        Compliances with intervals, what remains, and the robot that knows them.

    Raises
    ------
    StiffarmError
        Names every fault with its row and column, or says why nothing can be concluded.
    """
    asked = _options.spelt("identify", options)
    with told("identifying", progress) as tell:
        return Identification(*_stiffarm.identify(*_given.table("data", data), _given.robot(robot), asked, tell))


@_options.takes("measure", MeasureOptions)
def measure(
    robot: RobotLike, *, progress: ProgressLike = None, **options: Unpack[MeasureOptions]
) -> MeasurementPlan:
    """Which postures and loads to measure, with a certificate that no other choice is much better.

    Parameters
    ----------
    robot : Robot or str
        Which.
    {options}
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    MeasurementPlan
        Runs in an order with short ways; ``to_pandas()`` is the table to be filled in, which `identify` reads.

    Raises
    ------
    StiffarmError
        Where no posture can be measured, or the loads show nothing.
    """
    asked = _options.spelt("measure", options)
    with told("planning", progress) as tell:
        return MeasurementPlan(*_stiffarm.measure(_given.robot(robot), asked, tell))


@_options.takes("modes", ModesOptions)
def modes(
    robot: RobotLike, *, joints_deg: Sequence[float] | npt.NDArray[np.float64], **options: Unpack[ModesOptions]
) -> Modes:
    """How an arm swings at one posture: frequencies, shapes, damping.

    Parameters
    ----------
    robot : Robot or str
        Which; its file must say what its bodies weigh.
    joints_deg : six numbers
        The posture, as the robot counts its joints.
    {options}

    Returns
    -------
    Modes
        The lowest first, with the motors held still and free.

    Raises
    ------
    StiffarmError
        Where masses are not known, or nothing holds a drive.
    """
    asked = _options.spelt("modes", options)
    return Modes(*_stiffarm.modes(_given.robot(robot), [float(angle) for angle in joints_deg], asked))


@_options.takes("chatter", ChatterOptions)
def chatter(
    process: str | os.PathLike[str],
    robot: RobotLike,
    *,
    joints_deg: Sequence[float] | npt.NDArray[np.float64],
    feed: Sequence[float] | npt.NDArray[np.float64],
    **options: Unpack[ChatterOptions],
) -> Chatter:
    """Does a cut swing with the arm at one posture, and how deep may it go?

    Modes of the robot alone are looked at; those of spindle, tool and work are not known here.

    Parameters
    ----------
    process : path
        A process file (TOML): a flat end mill with a material, its engagement and its spindle.
    robot : Robot or str
        Which; its file must say what its bodies weigh.
    joints_deg : six numbers
        The posture, as the robot counts its joints.
    feed : three numbers
        In which direction the tool feeds, along the axes of the base.
    {options}

    Returns
    -------
    Chatter
        A row a speed of the spindle: from which depth the cut swings.

    Raises
    ------
    StiffarmError
        Where masses are not known, and of processes that are not covered.
    """
    asked = _options.spelt("chatter", {"feed": feed, **options})
    path = str(_given.path("process", process))
    return Chatter(*_stiffarm.chatter(path, _given.robot(robot), [float(angle) for angle in joints_deg], asked))


def force(process: str | os.PathLike[str]) -> Force:
    """The cutting force of a process, on the tool: mean over a revolution, extremes, moment and power.

    Parameters
    ----------
    process : path
        A process file (TOML): tool, material, engagement and spindle, or a force as it is.

    Returns
    -------
    Force
        Along the feed, across it (left of the feed, seen from the spindle) and axial (away from the work).

    Raises
    ------
    StiffarmError
        Where the file has faults: all of them, with their lines.
    """
    return Force(*_stiffarm.force(str(_given.path("process", process))))


@overload
def mill(
    path: str | os.PathLike[str],
    robot: None = None,
    *,
    robots: None = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> Toolpath: ...
@overload
def mill(
    path: str | os.PathLike[str],
    robot: RobotLike,
    *,
    robots: None = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> Milled: ...
@overload
def mill(
    path: str | os.PathLike[str],
    robot: None = None,
    *,
    robots: RobotLike | Iterable[RobotLike],
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> PathRanking: ...
@_options.takes("mill", MillOptions)
def mill(
    path: str | os.PathLike[str],
    robot: RobotLike | None = None,
    *,
    robots: RobotLike | Iterable[RobotLike] | None = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> Milled | Toolpath | PathRanking:
    """The error along a toolpath that a robot mills, or that several mill; with ``dry=True`` what is understood of the path, and no robot.

    Parameters
    ----------
    path : path or str
        G-code, APT or CLS, a CSV table; or a path built in, with sizes in m: ``"circle:0.3"``, ``"rect:0.4x0.2"``, ``"line:0.5"``,
        ``"raster:rect:0.4x0.2@0.02"``.
    robot : Robot or str, optional
        The robot that mills: a name, or the path of a robot file.
    robots : robots, optional
        Robots that are ranked on the path, each at its own best place and rolls: robots, names, patterns (``"IRB 6700*"``), paths, or
        the sets ``"paper"`` and ``"all"``; of them those that have a vendor, a payload or another property that is asked for.
    progress : bool or callable, optional
        True shows on stderr how much of the work is done (None does on a terminal); a callable gets how much and of how much (or None).
    {options}

    Returns
    -------
    Milled, PathRanking or Toolpath
        Of one robot the largest error, proved and where it is, the place of the part, and every sample as a row of ``to_pandas()``; of
        several a row per robot; of a dry run lengths, moves, extents, feed rates, what was assumed and what ignored.

    Raises
    ------
    StiffarmError
        Where the path is refused: its line, the word and what was expected; where something makes no sense.
    """
    asked = _options.spelt("mill", options)
    one = None if robot is None else _given.robot(robot)
    several = None if robots is None else _given.robots(robots)
    with told("milling", progress) as tell:
        found = _stiffarm.mill(os.fspath(path), asked, one, several, tell)
    if several is not None:
        return PathRanking(*found)
    return Milled(*found, (os.fspath(path), asked, one)) if one is not None else Toolpath(*found)


def validate(*, progress: ProgressLike = None) -> Ledger:
    """Every published number of the paper beside the computed one.

    Parameters
    ----------
    progress : bool or callable, optional
        As in `place`.

    Returns
    -------
    Ledger
        A row for each number: whether both agree within the printed digits, and where not, why.
    """
    with told("validating", progress) as tell:
        return Ledger(*_stiffarm.validate(tell))
