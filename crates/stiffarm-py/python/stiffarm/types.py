"""What goes in, for type checkers: the options of every verb.

Written by ``STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types`` from the tables of the library; not to be edited.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal, TypedDict

import numpy.typing as npt

from ._given import RangeLike


class RobotsOptions(TypedDict, total=False):
    """Keywords of `stiffarm.robots`."""

    vendor: str | Iterable[str] | None
    """Only robots of these makers, separated by commas."""

    payload_kg: RangeLike | None
    """Only robots with a payload in this range [kg]: A..B; either end may be left open."""

    reach_m: RangeLike | None
    """Only robots with a reach in this range [m]: A..B; either end may be left open."""

    architecture: Literal["serial", "quasi-serial"] | None
    """Only robots of this architecture: serial or quasi-serial."""

    status: str | Iterable[Literal["identified", "data-sheet", "derived", "estimated"]] | None
    """Only robots of these statuses: identified, data-sheet, derived, estimated; separated by commas."""


class ComplianceOptions(TypedDict, total=False):
    """Keywords of `stiffarm.compliance`."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    force_n: float | npt.ArrayLike | None
    """Force at the tool point [N]: x,y,z in base axes, or its size, in its worst direction."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: base]."""

    feed_deg: float | None
    """Direction of the feed of a force along tool axes [deg], from the tool's x axis, counter-clockwise seen
    from the spindle [default: the worst of all directions]."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes [default: the flange
    centre]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else prior]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""


class PlaceOptions(TypedDict, total=False):
    """Keywords of `stiffarm.place`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, on a wall from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in
    the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor
    [default: in front of the joint-1 axis, above the floor]."""

    limit_margin_deg: float | None
    """What every joint keeps from either end of its range [deg], all over the zone [default: 5]."""

    singular_margin_deg: float | None
    """What wrist and arm keep from straight [deg], all over the zone [default: 5]."""

    clear_of_base_m: float | None
    """What the zone keeps from the joint-1 axis [m] [default: the robot's own column, estimated as a1 + 0.15 (c2
    + l3)]."""

    floor_m: str | float | None
    """Height of the floor from the robot's base [m], or none; all of the zone stands above it [default: 0,
    unless --within says how low the zone may stand]."""

    angle: str | float
    """Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or
    degrees of its first side."""

    gap: float | None
    """Largest relative distance between a value and its proof [default: 0.0001] [planar model only]."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else paper in the planar model
    and prior in space]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

    model: Literal["planar", "spatial"]
    """Which model."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis
    [default: the flange]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    tool_direction: str | float | None
    """The tool axis: down, forward, up, or its angle above the horizontal in degrees [default: down]."""

    yaw_deg: str | float | None
    """Angle of the zone about the vertical [deg], 0 faces the robot; or any [default: the best of -90..90]."""

    roll_deg: float | None
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What must be kept free [m]: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several
    times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: told, not asked]."""


class RankOptions(TypedDict, total=False):
    """Keywords of `stiffarm.rank`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, on a wall from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in
    the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor
    [default: in front of the joint-1 axis, above the floor]."""

    limit_margin_deg: float | None
    """What every joint keeps from either end of its range [deg], all over the zone [default: 5]."""

    singular_margin_deg: float | None
    """What wrist and arm keep from straight [deg], all over the zone [default: 5]."""

    clear_of_base_m: float | None
    """What the zone keeps from the joint-1 axis [m] [default: the robot's own column, estimated as a1 + 0.15 (c2
    + l3)]."""

    floor_m: str | float | None
    """Height of the floor from the robot's base [m], or none; all of the zone stands above it [default: 0,
    unless --within says how low the zone may stand]."""

    angle: str | float
    """Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or
    degrees of its first side."""

    gap: float | None
    """Largest relative distance between a value and its proof [default: 0.0001] [planar model only]."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else paper in the planar model
    and prior in space]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

    model: Literal["planar", "spatial"]
    """Which model."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis
    [default: the flange]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    tool_direction: str | float | None
    """The tool axis: down, forward, up, or its angle above the horizontal in degrees [default: down]."""

    yaw_deg: str | float | None
    """Angle of the zone about the vertical [deg], 0 faces the robot; or any [default: the best of -90..90]."""

    roll_deg: float | None
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What must be kept free [m]: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several
    times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: told, not asked]."""

    vendor: str | Iterable[str] | None
    """Only robots of these makers, separated by commas."""

    payload_kg: RangeLike | None
    """Only robots with a payload in this range [kg]: A..B; either end may be left open."""

    reach_m: RangeLike | None
    """Only robots with a reach in this range [m]: A..B; either end may be left open."""

    architecture: Literal["serial", "quasi-serial"] | None
    """Only robots of this architecture: serial or quasi-serial."""

    status: str | Iterable[Literal["identified", "data-sheet", "derived", "estimated"]] | None
    """Only robots of these statuses: identified, data-sheet, derived, estimated; separated by commas."""


class MapOptions(TypedDict, total=False):
    """Keywords of `stiffarm.map`."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    elbow: Literal["up", "down"] | None
    """Only one elbow side [default: the stiffer that reaches a point] [planar model only]."""

    posture: str | None
    """Only one posture, with model="spatial": such as front,up,no-flip [default: the stiffest at each point]."""

    zone: str | None
    """Draw the best placement of this task [planar model only]."""

    step_m: float | None
    """Distance between points [m]."""

    size: int
    """Points along the longer side."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, on a wall from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in
    the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor
    [default: in front of the joint-1 axis, above the floor]."""

    limit_margin_deg: float | None
    """What every joint keeps from either end of its range [deg], all over the zone [default: 5]."""

    singular_margin_deg: float | None
    """What wrist and arm keep from straight [deg], all over the zone [default: 5]."""

    clear_of_base_m: float | None
    """What the zone keeps from the joint-1 axis [m] [default: the robot's own column, estimated as a1 + 0.15 (c2
    + l3)]."""

    floor_m: str | float | None
    """Height of the floor from the robot's base [m], or none; all of the zone stands above it [default: 0,
    unless --within says how low the zone may stand]."""

    angle: str | float
    """Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or
    degrees of its first side."""

    gap: float | None
    """Largest relative distance between a value and its proof [default: 0.0001] [planar model only]."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else paper in the planar model
    and prior in space]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

    model: Literal["planar", "spatial"]
    """Which model."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis
    [default: the flange]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    tool_direction: str | float | None
    """The tool axis: down, forward, up, or its angle above the horizontal in degrees [default: down]."""

    roll_deg: float | None
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, on a wall upright [default: the best]."""


class StudyOptions(TypedDict, total=False):
    """Keywords of `stiffarm.study`."""

    tasks: str | Iterable[str]
    """Shapes at size 1: A, B, C, or such as rect:1x3."""

    sizes: npt.ArrayLike
    """Sizes over l2 + l3."""

    ratios: npt.ArrayLike
    """Link ratios mu = l3/l2."""

    range: RangeLike
    """Link ratios among which the best is sought."""

    compare: str | Iterable[Literal["serial", "quasi-serial"]]
    """The two architectures that are compared."""

    k2: npt.ArrayLike
    """Compliance of drive 2 over the reference k, for both or one each; 0: rigid."""

    k3: npt.ArrayLike
    """Compliance of drive 3 over the reference k, for both or one each; 0: rigid."""


class IdentifyOptions(TypedDict, total=False):
    """Keywords of `stiffarm.identify`."""

    load_mm: npt.ArrayLike | None
    """Where the load acts [mm], in the flange frame; columns load_x_mm, .. overrule it [default: the flange
    centre]."""

    marker_mm: str | Iterable[str] | None
    """Where a marker sits [mm], in the flange frame; of several each with the name that the column marker tells
    (with ; between, or given several times); columns marker_x_mm, .. overrule it [default: the load point]."""

    force_axes: Literal["base", "flange"]
    """Along which axes the forces and moments point."""

    displacement_axes: Literal["base", "flange"]
    """Along which axes the displacements point."""

    fit: Literal["least-squares", "huber"]
    """How the compliances are estimated."""

    model: Literal["drives", "base", "tool", "base-and-tool", "auto"]
    """What is taken to spring."""

    date: str | None
    """When was measured, as year-month-day: it is told, and stands in the robot file."""


class MeasureOptions(TypedDict, total=False):
    """Keywords of `stiffarm.measure`."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else prior]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

    load_mm: npt.ArrayLike | None
    """Where the load acts [mm], in the flange frame; columns load_x_mm, .. overrule it [default: the flange
    centre]."""

    marker_mm: str | Iterable[str] | None
    """Where a marker sits [mm], in the flange frame; of several each with the name that the column marker tells
    (with ; between, or given several times); columns marker_x_mm, .. overrule it [default: the load point]."""

    task: str | None
    """The work over which the deflection is to be predicted: a zone at its best place, the tool down [default:
    anywhere within the limits]."""

    loads: str | Iterable[str]
    """In which directions you can load: down (weights), up, ahead, back, left, right, or x:y:z along base axes
    (pulleys); separated by commas."""

    force_n: float
    """How large the load is [N]."""

    runs: int
    """How many postures and loads are to be measured."""

    candidates: int
    """Among how many of them is chosen."""

    sigma_mm: float
    """Standard deviation of what is read of a coordinate [mm]."""

    window: str | Iterable[str | Sequence[RangeLike | None]] | None
    """Where load point and markers must be [m]: x0..x1,y0..y1,z0..z1 from the base; ranges may be left open
    [default: above the floor]."""

    tool_mm: npt.ArrayLike | None
    """The tool of the work in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes [default: the
    flange]."""

    compare: str | None
    """A table of postures and loads of your own: what it is worth beside the plan."""


class SweepOptions(TypedDict, total=False):
    """Keywords of `stiffarm.cluster.sweep`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, on a wall from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 about it, or x0..x1,y0..y1,z0..z1 in
    the cell (several with ; between); ranges may be left open, and with --mount count from the cell's floor
    [default: in front of the joint-1 axis, above the floor]."""

    limit_margin_deg: float | None
    """What every joint keeps from either end of its range [deg], all over the zone [default: 5]."""

    singular_margin_deg: float | None
    """What wrist and arm keep from straight [deg], all over the zone [default: 5]."""

    clear_of_base_m: float | None
    """What the zone keeps from the joint-1 axis [m] [default: the robot's own column, estimated as a1 + 0.15 (c2
    + l3)]."""

    floor_m: str | float | None
    """Height of the floor from the robot's base [m], or none; all of the zone stands above it [default: 0,
    unless --within says how low the zone may stand]."""

    angle: str | float
    """Angle of a rectangle: axes (horizontal or vertical), horizontal, vertical (its long side), free, or
    degrees of its first side."""

    gap: float | None
    """Largest relative distance between a value and its proof [default: 0.0001] [planar model only]."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else paper in the planar model
    and prior in space]."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

    model: Literal["planar", "spatial"]
    """Which model."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; its z is the tool axis
    [default: the flange]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    tool_direction: str | float | None
    """The tool axis: down, forward, up, or its angle above the horizontal in degrees [default: down]."""

    yaw_deg: str | float | None
    """Angle of the zone about the vertical [deg], 0 faces the robot; or any [default: the best of -90..90]."""

    roll_deg: float | None
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What must be kept free [m]: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given several
    times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: told, not asked]."""
