"""The verbs, with the options of the program `stiffarm`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal, overload

import numpy.typing as npt

from . import _given, _stiffarm
from ._answers import Compliance, Compliances, Map, Placement, Ranking, Study
from ._given import RangeLike, RobotLike
from ._stiffarm import Robot, StiffarmError

Model = Literal["planar", "spatial"]

PAPER_TASKS = ("A:0.1", "A:1.0", "B:0.1", "B:0.5", "C:0.05", "C:0.15")


def robots(
    words: str = "",
    *,
    among: RobotLike | Iterable[RobotLike] = "all",
    vendor: str | Iterable[str] = (),
    payload_kg: RangeLike | None = None,
    reach_m: RangeLike | None = None,
    architecture: str | None = None,
    status: str | Iterable[str] = (),
) -> list[Robot]:
    """The robots of the catalogue, or those that have all that is asked for.

    Parameters
    ----------
    words : str
        Words that must stand in the maker's or the robot's name.
    among : robots
        Which are looked at: names, patterns, paths, robots, ``"paper"`` or ``"all"``.
    vendor : str or list of str
        One of these makers.
    payload_kg, reach_m : (low, high) or str, optional
        None for an open end: ``(300, None)``, or ``"300.."``.
    architecture : str, optional
        ``"serial"`` or ``"quasi-serial"``.
    status : str or list of str
        ``"identified"``, ``"data-sheet"``, ``"derived"``, ``"estimated"``.

    Raises
    ------
    StiffarmError
        Where no robot is left; it says what would match.
    """
    asked = _given.asked(
        vendor=_given.listed("vendor", vendor), payload_kg=_given.between("payload_kg", payload_kg),
        reach_m=_given.between("reach_m", reach_m), status=_given.listed("status", status),
        architecture=None if architecture is None else _given.text("architecture", architecture),
    )  # fmt: skip
    return _stiffarm.robots(_given.robots(among), _given.text("words", words).split(), asked)


@overload
def compliance(
    robot: RobotLike,
    *,
    joints_deg: Sequence[float],
    tool_mm: npt.ArrayLike | str | None = ...,
    force_n: npt.ArrayLike | None = ...,
    full: bool = ...,
) -> Compliance: ...
@overload
def compliance(
    robot: RobotLike,
    *,
    joints_deg: npt.ArrayLike,
    tool_mm: npt.ArrayLike | str | None = ...,
    force_n: npt.ArrayLike | None = ...,
    full: bool = ...,
) -> Compliance | Compliances: ...
def compliance(
    robot: RobotLike,
    *,
    joints_deg: npt.ArrayLike,
    tool_mm: npt.ArrayLike | str | None = None,
    force_n: npt.ArrayLike | None = None,
    full: bool = False,
) -> Compliance | Compliances:
    """Six-axis compliance at one posture, or at many.

    All six drives are compliant, everything else is rigid. Joint limits are not checked.

    Parameters
    ----------
    robot : Robot or str
        With six axes.
    joints_deg : (6,) or (n, 6) array_like
        Joint angles as the robot reports them [deg]. Rows of float64 in one piece are not copied.
    tool_mm : (3,) or (6,) array_like, optional
        Tool frame in the flange frame: x, y, z [mm], and rotations about fixed axes [deg]; the flange without it.
    force_n : (3,) array_like, optional
        Force at the tool point, base axes [N]; one posture only.
    full : bool
        Of many postures, the (n, 3, 3) matrices too.

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
    asked = _given.asked(tool_mm=tool_mm)
    joints = _given.numbers("joints_deg", joints_deg)
    if joints.shape == (6,):
        if full:
            raise StiffarmError("full=True is for many postures: one has all there is")
        asked.update(_given.asked(force_n=None if force_n is None else _given.row("force_n", force_n)))
        return Compliance(_stiffarm.posture(robot, joints.tolist(), asked))
    if joints.ndim != 2 or joints.shape[1] != 6:
        raise StiffarmError(f"joints_deg of shape {joints.shape}; expected (6,) or (n, 6), in degrees")
    if force_n is not None:
        raise StiffarmError("force_n is for one posture; of many, full=True gives the matrices")
    data: dict[str, object] = {"robot": robot.name, "worst_um_per_n": _stiffarm.worst(robot, joints, asked)}
    if full:
        data["compliance_um_per_n"] = _stiffarm.matrices(robot, joints, asked)
    return Compliances(data)


def place(
    robot: RobotLike,
    *,
    task: str,
    force_n: float = 1000.0,
    tolerance_mm: float | None = None,
    within_m: str | Sequence[RangeLike | None] | None = None,
    angle: str | float = "axes",
    gap: float | None = None,
    model: Model = "planar",
    tool_mm: npt.ArrayLike | str | None = None,
    tool_direction: str | float | None = None,
    yaw_deg: str | float | None = None,
    roll_deg: float | None = None,
) -> Placement:
    """The best place of one zone.

    Parameters
    ----------
    robot : Robot or str
        Which.
    task : str
        ``circle:D``, ``rect:AxB`` in m, or the paper's ``A:d``, ``B:d``, ``C:d``.
    force_n : float
        Cutting force in its worst direction [N].
    tolerance_mm : float, optional
        Largest deflection that is acceptable [mm]: adds pass or fail.
    within_m : ((x0, x1), (z0, z1)) or str, optional
        Where the zone may stand, from the base [m]; None for an open end. Without it anywhere; in space in front of the
        joint-1 axis and above the base.
    angle : str or float
        Of a rectangle: ``"axes"``, ``"horizontal"``, ``"vertical"`` (its long side), ``"free"``, or of its first side [deg].
    gap : float, optional
        Largest relative distance between the value and its proof, 1e-4 without it; planar model.
    model : {"planar", "spatial"}
        The paper's drives 2 and 3 in the arm plane, or all six drives and flat zones about the robot.
    tool_mm : (3,) or (6,) array_like, optional
        Tool frame in the flange frame [mm, deg]; spatial model, as all below.
    tool_direction : str or float, optional
        ``"down"``, ``"forward"``, ``"up"``, or above the horizontal [deg]; down without it.
    yaw_deg : float or "any", optional
        Angle of the zone about the vertical [deg], 0 faces the robot; the best of -90 to 90 without it.
    roll_deg : float, optional
        Rotation about the tool axis [deg]; the best without it.

    Returns
    -------
    Placement
        Where there is no place, ``feasible`` is False and ``reason`` says why.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense.
    """
    asked = _given.asked(
        force_n=force_n, tolerance_mm=tolerance_mm, within_m=_given.within(within_m), angle=angle, gap=gap, model=model,
        tool_mm=tool_mm, tool_direction=tool_direction, yaw_deg=yaw_deg, roll_deg=roll_deg,
    )  # fmt: skip
    return Placement(*_stiffarm.place(_given.robot(robot), _given.text("task", task), asked))


def cell(robot: RobotLike, task: str, **options: object) -> dict[str, object]:
    """One placement as a plain dict: what a worker on another machine computes and sends back.

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
    return place(robot, task=task, **options).to_dict()  # type: ignore[arg-type]


def rank(
    robots: RobotLike | Iterable[RobotLike] = "paper",
    *,
    tasks: str | Iterable[str] = PAPER_TASKS,
    force_n: float = 1000.0,
    tolerance_mm: float | None = None,
    within_m: str | Sequence[RangeLike | None] | None = None,
    angle: str | float = "axes",
    gap: float | None = None,
    model: Model = "planar",
    tool_mm: npt.ArrayLike | str | None = None,
    tool_direction: str | float | None = None,
    yaw_deg: str | float | None = None,
    roll_deg: float | None = None,
) -> Ranking:
    """Robots in order, for several tasks.

    Parameters
    ----------
    robots : robots
        Robots, names, patterns (``"IRB 6700*"``), paths, or the sets ``"paper"`` and ``"all"``.
    tasks : str or list of str
        As the task of `place`; without it the six of the paper.
    **options
        All others as in `place`.

    Returns
    -------
    Ranking
        Those that can do more of the tasks first, then by how much worse than the best they are.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense.
    """
    asked = _given.asked(
        force_n=force_n, tolerance_mm=tolerance_mm, within_m=_given.within(within_m), angle=angle, gap=gap, model=model,
        tool_mm=tool_mm, tool_direction=tool_direction, yaw_deg=yaw_deg, roll_deg=roll_deg,
    )  # fmt: skip
    return Ranking(*_stiffarm.rank(_given.robots(robots), _given.tasks(tasks), asked))


def map(
    robot: RobotLike,
    *,
    force_n: float = 1000.0,
    direction_deg: float | None = None,
    component: Literal["total", "along"] | None = None,
    elbow: Literal["up", "down"] | None = None,
    zone: str | None = None,
    step_m: float | None = None,
    size: int | None = None,
    within_m: str | Sequence[RangeLike | None] | None = None,
    angle: str | float | None = None,
    gap: float | None = None,
    model: Model = "planar",
    tool_mm: npt.ArrayLike | str | None = None,
    tool_direction: str | float | None = None,
    roll_deg: float | None = None,
) -> Map:
    """The deflection over everything a robot reaches.

    Parameters
    ----------
    robot : Robot or str
        Which.
    force_n : float
        Force [N].
    direction_deg : float, optional
        Direction of the force, counter-clockwise from straight ahead [deg]; the worst in every point without it.
    component : {"total", "along"}, optional
        The whole displacement, or its part along the force; needs ``direction_deg``.
    elbow : {"up", "down"}, optional
        One elbow side only; without it the stiffer that reaches a point.
    zone : str, optional
        Adds the best placement of this task; ``within_m``, ``angle`` and ``gap`` are as in `place`.
    step_m : float, optional
        Distance between points [m], in place of ``size``.
    size : int, optional
        Points along the longer side; 400 without it.
    model, tool_mm, tool_direction, roll_deg
        As in `place`.

    Returns
    -------
    Map
        Arrays of shape (nz, nx); nan where nothing is reached.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense; too many points are refused before memory is taken.
    """
    asked = _given.asked(
        force_n=force_n, direction_deg=direction_deg, component=component, elbow=elbow, zone=zone, step_m=step_m,
        size=size, within_m=_given.within(within_m), angle=angle, gap=gap, model=model, tool_mm=tool_mm,
        tool_direction=tool_direction, roll_deg=roll_deg,
    )  # fmt: skip
    return Map(*_stiffarm.map(_given.robot(robot), asked))


def study(
    *,
    tasks: str | Iterable[str] = ("A", "B", "C"),
    sizes: Iterable[float] = (0.1, 0.3, 0.5, 0.8),
    ratios: Iterable[float] = (0.8, 1.0, 1.2),
    range: tuple[float, float] = (0.5, 1.5),
    compare: tuple[str, str] = ("serial", "quasi-serial"),
    k2: float | tuple[float, float] = 1.0,
    k3: float | tuple[float, float] = 1.0,
) -> Study:
    """Two architectures against link ratio and task size, without joint limits.

    Parameters
    ----------
    tasks : str or list of str
        Shapes at size 1: ``A``, ``B``, ``C``, or such as ``rect:1x3``.
    sizes : list of float
        Over l2 + l3.
    ratios : list of float
        Link ratios mu = l3/l2.
    range : (low, high)
        Link ratios among which the best is sought.
    compare : (str, str)
        The two architectures.
    k2, k3 : float or (float, float)
        Compliance of the drives 2 and 3 over the reference k, for both or one each; 0 for a rigid drive.

    Returns
    -------
    Study
        Accuracies over k F (l2 + l3)^2; None where a zone does not fit.

    Raises
    ------
    StiffarmError
        Where an argument makes no sense.
    """
    rows = {name: _given.row(name, value) for name, value in (("sizes", sizes), ("ratios", ratios), ("k2", k2), ("k3", k3))}
    ends = _given.row("range", range)
    if len(ends) != 2:
        raise StiffarmError(f"range of {len(ends)} numbers; expected both ends")
    asked = _given.asked(
        tasks=",".join(_given.tasks(tasks)), range=_given.between("range", ends),
        compare=_given.listed("compare", compare), **rows,
    )  # fmt: skip
    return Study(*_stiffarm.study(asked))
