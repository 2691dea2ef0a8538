"""The verbs, with the options of the program `stiffarm`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _given, _options, _stiffarm
from ._answers import (
    Calibration,
    CalibrationPlan,
    Chatter,
    Comparison,
    Compliance,
    Compliances,
    FittingRobots,
    Force,
    Identification,
    Ledger,
    Map,
    MeasurementPlan,
    Milled,
    Modes,
    ModesOverZone,
    PathRanking,
    Placement,
    Ranking,
    Study,
    Toolpath,
    Verification,
)
from ._given import RobotLike
from ._asked import OutputLike, Question, answered, placed, question, written
from ._progress import ProgressLike, reporting
from ._stiffarm import Robot, StiffarmError
from .types import (
    CalibrateOptions,
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
    VerifyOptions,
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
    robot: RobotLike, *, joints_deg: Sequence[float], full: bool = ..., output: OutputLike = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliance: ...
@overload
def compliance(
    robot: RobotLike, *, joints_deg: Sequence[Sequence[float]], full: bool = ..., output: OutputLike = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliances: ...
@overload
def compliance(
    robot: RobotLike, *, joints_deg: npt.ArrayLike, full: bool = ..., output: OutputLike = ..., progress: ProgressLike = ..., **options: Unpack[ComplianceOptions]
) -> Compliance | Compliances: ...
@_options.takes("compliance", ComplianceOptions)
def compliance(
    robot: RobotLike,
    *,
    joints_deg: npt.ArrayLike,
    full: bool = False,
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[ComplianceOptions],
) -> Compliance | Compliances:
    """Six-axis compliance at one posture, or at many.

    All six drives are compliant, everything else is rigid. Joints beyond their limits are computed, and warned of.

    Parameters
    ----------
    robot : Robot or str
        With six axes.
    joints_deg : (6,) or (n, 6) array_like
        Joint angles as the robot reports them [deg]. Rows of float64 in one piece are not copied.
    full : bool
        Of many postures, the (n, 3, 3) matrices too.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` what can be turned, ``.json``; of one posture.
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
    asked = _options.spelt("compliance", options)
    joints = _given.numbers("joints_deg", joints_deg)
    if joints.shape == (6,):
        if full:
            raise StiffarmError("full=True is for many postures: one has all there is")
        given = {"joints_deg": _given.joints(joints), **asked}
        one = question("compliance", given, robot=_given.named("robot", robot))
        return Compliance(answered(one, "compliance", output=output)["answer"])
    if joints.ndim != 2 or joints.shape[1] != 6:
        raise StiffarmError(f"joints_deg of shape {joints.shape}; expected (6,) or (n, 6), in degrees")
    if output is not None:
        raise StiffarmError("output is for one posture; to_pandas() has the rows of many")
    if "force_n" in asked:
        raise StiffarmError("force_n is for one posture; of many, full=True gives the matrices")
    robot = _given.robot(robot)
    with reporting("compliances", progress) as tell:
        data: dict[str, object] = {"robot": robot.name, "worst_um_per_n": _stiffarm.worst(robot, joints, asked, tell)}
        if full:
            data["compliance_um_per_n"] = _stiffarm.matrices(robot, joints, asked, tell)
    return Compliances(data)


@_options.takes("place", PlaceOptions)
def place(robot: RobotLike, *, task: str, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[PlaceOptions]) -> Placement:
    """The best place of one zone.

    Parameters
    ----------
    robot : Robot or str
        Which.
    task : str
        ``circle:D``, ``rect:AxB`` in m, or the paper's ``A:d``, ``B:d``, ``C:d``.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` a report, ``.view.html`` what can be turned, ``.svg``, ``shop.svg`` the drawing for the shop, ``.json``.
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
    given = {"task": _given.text("task", task), **_options.spelt("place", options)}
    asked = question("place", given, robot=_given.named("robot", robot))
    found = answered(asked, "searching places", output=output, progress=progress)
    return Placement(found["answer"], found["columns"], asked)


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
    return Placement(placed(_given.robot(robot), _given.text("task", task), _options.spelt("place", options))).to_dict()


@_options.takes("rank", RankOptions)
def rank(
    robots: RobotLike | Iterable[RobotLike] | None = None,
    *,
    tasks: str | Iterable[str] = PAPER_TASKS,
    output: OutputLike = None,
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
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` a report, ``.svg``, ``.json``.
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
    wanted = _given.tasks(tasks)
    if not wanted:
        raise StiffarmError("no task to rank for; give tasks")
    given = {"tasks": ",".join(wanted), **asked}
    who = None if robots is None else _given.named_robots(robots)
    found = answered(question("rank", given, robots=who), "placing zones", output=output, progress=progress)
    return Ranking(found["answer"], found["columns"])



@_options.takes("map", MapOptions)
def map(robot: RobotLike, *, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[MapOptions]) -> Map:
    """The deflection over everything a robot reaches.

    Parameters
    ----------
    robot : Robot or str
        Which.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` what can be turned, ``.svg``, ``.json``.
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
    asked = question("map", _options.spelt("map", options), robot=_given.named("robot", robot))
    found = answered(asked, "mapping", output=output, points=0, progress=progress)
    return Map(found["answer"], found["layers"], found["shown"])


@_options.takes("study", StudyOptions)
def study(*, robot: RobotLike | None = None, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[StudyOptions]) -> Study:
    """Two architectures against link ratio and task size, without joint limits.

    Parameters
    ----------
    robot : Robot or str, optional
        One that is to be found among all this with its `task`: ``mark`` says where both stand, and which architecture is stiffer there.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.svg``, ``.json``.
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
    marked = None if robot is None else _given.named("robot", robot)
    asked = question("study", _options.spelt("study", options), robot=marked)
    found = answered(asked, "studying", output=output, progress=progress)
    return Study(found["answer"], found["columns"])


@_options.takes("compare", CompareOptions)
def compare(
    a: RobotLike, b: RobotLike, *, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[CompareOptions]
) -> Comparison:
    """Two setups side by side.

    Parameters
    ----------
    a, b : Robot or str
        Robots, or paths of job files for `place` (TOML), which may say more: one robot with two tools takes two of them. What a job
        file says comes before the keywords, which are asked of both.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.svg``, ``.json``.
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Comparison
        Both placements, and whether they can be distinguished.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense of one of them.
    """
    asked = question("compare", _options.spelt("compare", options), a=_given.named("a", a), b=_given.named("b", b))
    found = answered(asked, "placing zones", output=output, progress=progress)
    return Comparison(found["answer"], found["columns"])


@_options.takes("identify", IdentifyOptions)
def identify(
    data: str | os.PathLike[str] | object,
    *,
    robot: RobotLike,
    output: OutputLike = None,
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
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` a report, ``.toml`` the robot file, ``.svg``, ``.json``.
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
    name, text = _given.table("data", data)
    given = {"data": name, **_options.spelt("identify", options)}
    asked = question("identify", given, texts={} if text is None else {name: text}, robot=_given.named("robot", robot))
    found = answered(asked, "identifying", output=output, progress=progress)
    return Identification(found["answer"], found["columns"], found["robot_file"])


@_options.takes("calibrate", CalibrateOptions)
def calibrate(
    robot: RobotLike,
    data: str | os.PathLike[str] | object,
    *,
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[CalibrateOptions],
) -> Calibration:
    """How this very arm differs from its drawing, from points on its flange that a tracker measured.

    Parameters
    ----------
    robot : Robot or str
        The robot that was measured, as drawn.
    data : path or data frame
        A table of six joints and one to four points (CSV). Whatever has ``to_csv`` (pandas) or ``write_csv`` (polars) will do.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` a report, ``.toml`` the robot file, ``.svg``, ``.json``.
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Calibration
        The errors of the arm, the error that remains at the work with its interval, and the robot that knows them.

    Raises
    ------
    StiffarmError
        Names every fault with its row and column, or says why nothing can be concluded.
    """
    name, text = _given.table("data", data)
    given = {"data": name, **_options.spelt("calibrate", options)}
    asked = question("calibrate", given, texts={} if text is None else {name: text}, robot=_given.named("robot", robot))
    found = answered(asked, "calibrating", output=output, progress=progress)
    return Calibration(found["answer"], found["columns"], found["robot_file"])


@overload
def verify(
    robot: None, data: str | os.PathLike[str] | object, *, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[VerifyOptions]
) -> FittingRobots: ...
@overload
def verify(
    robot: RobotLike, data: str | os.PathLike[str] | object, *, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[VerifyOptions]
) -> Verification: ...
@_options.takes("robots verify", VerifyOptions)
def verify(
    robot: RobotLike | None,
    data: str | os.PathLike[str] | object,
    *,
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[VerifyOptions],
) -> Verification | FittingRobots:
    """Whether a robot file counts the joints as a pendant does.

    Parameters
    ----------
    robot : Robot or str, or None
        Which; None with ``any=True`` where it is asked from which robot the readings are.
    data : path or data frame
        A table of six joints with the controller's position, or with measured points (CSV). Whatever has ``to_csv`` (pandas) or
        ``write_csv`` (polars) will do.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.toml`` the robot file, ``.json``.
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    Verification or FittingRobots
        Whether it does, what fits best, and the robot that counts so; of no robot all that fit, the best first.

    Raises
    ------
    StiffarmError
        Names every fault with its row and column, or says why nothing can be concluded.
    """
    name, text = _given.table("data", data)
    given = {"data": name, **_options.spelt("robots verify", options)}
    named = {} if robot is None else {"robot": _given.named("robot", robot)}
    asked = question("robots verify", given, texts={} if text is None else {name: text}, **named)
    found = answered(asked, "comparing", output=output, progress=progress)
    if robot is None:
        return FittingRobots(found["answer"], found["columns"])
    return Verification(found["answer"], found["columns"], found["robot_file"])


@overload
def measure(
    robot: RobotLike, *, geometry: Literal[False] = False, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[MeasureOptions]
) -> MeasurementPlan: ...


@overload
def measure(
    robot: RobotLike, *, geometry: Literal[True], output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[MeasureOptions]
) -> CalibrationPlan: ...


@_options.takes("measure", MeasureOptions)
def measure(
    robot: RobotLike, *, geometry: bool = False, output: OutputLike = None, progress: ProgressLike = None, **options: Unpack[MeasureOptions]
) -> MeasurementPlan | CalibrationPlan:
    """Which postures and loads to measure, with a certificate that no other choice is much better.

    Parameters
    ----------
    robot : Robot or str
        Which.
    geometry : bool
        Postures in which points of the flange are measured to calibrate the arm; nothing is loaded then.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.json``.
    progress : bool or callable, optional
        True tells on a line of the terminal how far it is, if there is one. Or what is called some times a second with how many
        parts are done, and of how many, or None where nobody knows; an exception that it raises ends the call.

    Returns
    -------
    MeasurementPlan or CalibrationPlan
        Runs in an order with short ways; ``to_pandas()`` is the table to be filled in, which `identify`, or with ``geometry`` `calibrate`, reads.

    Raises
    ------
    StiffarmError
        Where no posture can be measured, or the loads show nothing.
    """
    typed = {"geometry": True, **options} if geometry else options
    asked = question("measure", _options.spelt("measure", typed), robot=_given.named("robot", robot))
    found = answered(asked, "planning", output=output, progress=progress)
    if geometry:
        return CalibrationPlan(found["answer"], found["columns"])
    return MeasurementPlan(found["answer"], found["columns"])


@overload
def modes(
    robot: RobotLike, *, joints_deg: Sequence[float] | npt.NDArray[np.float64], output: OutputLike = None, **options: Unpack[ModesOptions]
) -> Modes: ...
@overload
def modes(robot: RobotLike, *, joints_deg: None = None, output: OutputLike = None, **options: Unpack[ModesOptions]) -> ModesOverZone: ...
@_options.takes("modes", ModesOptions)
def modes(
    robot: RobotLike,
    *,
    joints_deg: Sequence[float] | npt.NDArray[np.float64] | None = None,
    output: OutputLike = None,
    **options: Unpack[ModesOptions],
) -> Modes | ModesOverZone:
    """How an arm swings at one posture: frequencies, shapes, damping. With ``task`` and ``at`` over a zone: least and largest frequencies.

    Parameters
    ----------
    robot : Robot or str
        Which; its file must say what its bodies weigh.
    joints_deg : six numbers, optional
        The posture, as the robot counts its joints; instead of a zone.
    {options}
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.json``, of one posture ``.svg``.

    Returns
    -------
    Modes or ModesOverZone
        The lowest first, with the motors held still and free; over a zone also a proved least first frequency.

    Raises
    ------
    StiffarmError
        Where masses are not known, nothing holds a drive, or the zone has no place.
    """
    posture = {} if joints_deg is None else {"joints_deg": _given.joints(joints_deg)}
    given = {**posture, **_options.spelt("modes", options)}
    found = answered(question("modes", given, robot=_given.named("robot", robot)), "modes", output=output)
    answer = Modes if joints_deg is not None else ModesOverZone
    return answer(found["answer"], found["columns"])


@_options.takes("chatter", ChatterOptions)
def chatter(
    process: str | os.PathLike[str],
    robot: RobotLike,
    *,
    joints_deg: Sequence[float] | npt.NDArray[np.float64],
    feed: Sequence[float] | npt.NDArray[np.float64],
    output: OutputLike = None,
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
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.svg``, ``.json``.

    Returns
    -------
    Chatter
        A row a speed of the spindle: from which depth the cut swings.

    Raises
    ------
    StiffarmError
        Where masses are not known, and of processes that are not covered.
    """
    given = {
        "process": str(_given.path("process", process)),
        "joints_deg": _given.joints(joints_deg),
        **_options.spelt("chatter", {"feed": feed, **options}),
    }
    found = answered(question("chatter", given, robot=_given.named("robot", robot)), "chatter", output=output)
    return Chatter(found["answer"], found["columns"])


def force(process: str | os.PathLike[str], *, output: OutputLike = None) -> Force:
    """The cutting force of a process, on the tool: mean over a revolution, extremes, moment and power.

    Parameters
    ----------
    process : path
        A process file (TOML): tool, material, engagement and spindle, or a force as it is.
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.json``.

    Returns
    -------
    Force
        Along the feed, across it (left of the feed, seen from the spindle) and axial (away from the work).

    Raises
    ------
    StiffarmError
        Where the file has faults: all of them, with their lines.
    """
    given = {"process": str(_given.path("process", process))}
    found = answered(question("force", given), "force", output=output)
    return Force(found["answer"], found["columns"])


@overload
def mill(
    path: str | os.PathLike[str],
    robot: None = None,
    *,
    robots: None = None,
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> Toolpath: ...
@overload
def mill(
    path: str | os.PathLike[str],
    robot: RobotLike,
    *,
    robots: None = None,
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> Milled: ...
@overload
def mill(
    path: str | os.PathLike[str],
    robot: None = None,
    *,
    robots: RobotLike | Iterable[RobotLike],
    output: OutputLike = None,
    progress: ProgressLike = None,
    **options: Unpack[MillOptions],
) -> PathRanking: ...
@_options.takes("mill", MillOptions)
def mill(
    path: str | os.PathLike[str],
    robot: RobotLike | None = None,
    *,
    robots: RobotLike | Iterable[RobotLike] | None = None,
    output: OutputLike = None,
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
        the sets ``"paper"`` and ``"all"``; of them those that have a vendor, a payload or another property that is asked for. Where only
        such a property is asked for, all robots that have it.
    output : path or list of paths, optional
        Files to which the answer is written as well; the ending chooses the form: ``.html`` a report, ``.view.html`` what can be turned, ``.svg``, ``shop.svg`` the drawing for the shop, ``.src``, ``.mod`` and ``.ls`` programs of controllers, ``.json``.
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
    given = {"path": str(_given.path("path", path)), **_options.spelt("mill", options)}
    one = None if robot is None else _given.named("robot", robot)
    several = None if robots is None else _given.named_robots(robots)
    asked = question("mill", given, robot=one, robots=several)
    found = answered(asked, "milling", output=output, progress=progress)
    if "rows" in found["answer"]:
        return PathRanking(found["answer"], found["columns"])
    return Milled(found["answer"], found["columns"], asked) if one is not None else Toolpath(found["answer"], found["columns"])


def paper(folder: str | os.PathLike[str], *, progress: ProgressLike = None) -> Path:
    """Every table and figure of the paper under its number, in a folder; ``index.md`` says which is which.

    Parameters
    ----------
    folder : path
        Made where it is not there; files of the same names are written anew.
    progress : bool or callable, optional
        As in `place`.

    Returns
    -------
    Path
        Of ``index.md``.

    Raises
    ------
    StiffarmError
        Where a file cannot be written.
    """
    where = _given.path("folder", folder)
    try:
        where.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StiffarmError(f"cannot make {where}: {error.strerror or error}") from None
    arms, texts, figures = _stiffarm.paper()
    with reporting("drawing", progress) as tell:
        for done, (file, verb, given) in enumerate(figures, 1):
            answered(Question(verb, given, [], dict(arms)), "drawing", output=where / file)
            if tell is not None:
                tell(done, len(figures))
    for file, text in [*arms, *texts]:
        written(where / file, text.encode())
    return where / "index.md"


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
    with reporting("validating", progress) as tell:
        return Ledger(*_stiffarm.validate(tell))
