"""What goes in and what comes out, for type checkers: the options of every verb, and the keys of every answer.

Written by ``STIFFARM_WRITE=1 cargo test -p stiffarm-py --test types`` from the tables of the library; not to be edited.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, TypedDict

import numpy.typing as npt

from ._given import RangeLike


class RankOptions(TypedDict, total=False):
    """Keywords of `stiffarm.rank`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg]: compared with the robot's payload, together with the force."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    process: str | os.PathLike[str] | None
    """A process file (TOML) in place of the cutting force: its mean force over a revolution acts along feed,
    across and axial; its moment is left out."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall
    from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    at: npt.ArrayLike | None
    """The one place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above
    it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given
    [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any
    direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open,
    and with --mount count from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What neither work nor arm may touch (with --allow-contact the work alone) [m]: x0..x1,y0..y1,z0..z1 in the
    cell; several with ; between, or given several times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: 0 with --keep-out; else reported, none required]."""

    allow_contact: bool
    """Take the best place of the work although the arm may touch something there."""

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


class PlaceOptions(TypedDict, total=False):
    """Keywords of `stiffarm.place`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg]: compared with the robot's payload, together with the force."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    process: str | os.PathLike[str] | None
    """A process file (TOML) in place of the cutting force: its mean force over a revolution acts along feed,
    across and axial; its moment is left out."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall
    from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    at: npt.ArrayLike | None
    """The one place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above
    it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given
    [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any
    direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open,
    and with --mount count from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What neither work nor arm may touch (with --allow-contact the work alone) [m]: x0..x1,y0..y1,z0..z1 in the
    cell; several with ; between, or given several times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: 0 with --keep-out; else reported, none required]."""

    allow_contact: bool
    """Take the best place of the work although the arm may touch something there."""


class MapOptions(TypedDict, total=False):
    """Keywords of `stiffarm.map`."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    elbow: Literal["up", "down"] | None
    """Only one elbow side [default: the stiffer that reaches a point] [planar model only]."""

    posture: str | None
    """Only one posture, with model="spatial": such as front,up,no-flip [default: the stiffest at each point]."""

    quantity: Literal["deflection", "first-frequency"]
    """What is mapped, with model="spatial"."""

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
    and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall
    from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    at: npt.ArrayLike | None
    """The one place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above
    it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given
    [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any
    direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open,
    and with --mount count from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the best]."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg], which swings with the arm; its centre says where [default: a tool
    that weighs nothing]."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    tool_inertia_kg_m2: npt.ArrayLike | None
    """Inertia of the tool about its own mass centre [kg m2], along flange axes: elements of the matrix as URDF
    has them [default: none: a point mass]."""


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


class ModesOptions(TypedDict, total=False):
    """Keywords of `stiffarm.modes`."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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

    task: str | None
    """Instead of a posture a flat zone, with --at: circle:D, rect:AxB, A:d, B:d, C:d with sizes in m; tells the
    least and the largest frequencies, and a proved least first frequency."""

    at: npt.ArrayLike | None
    """The place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above it;
    of a rectangle with --angle 0 unless another is given."""

    tool_direction: str | float | None
    """The tool axis: down, forward, up, or its angle above the horizontal in degrees [default: down]."""

    yaw_deg: str | float | None
    """Angle of the zone about the vertical [deg], 0 faces the robot; or any [default: 0]."""

    roll_deg: float | None
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the stiffest]."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg], which swings with the arm; its centre says where [default: a tool
    that weighs nothing]."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    tool_inertia_kg_m2: npt.ArrayLike | None
    """Inertia of the tool about its own mass centre [kg m2], along flange axes: elements of the matrix as URDF
    has them [default: none: a point mass]."""

    damping_ratio: float | None
    """Damping of every mode, as a share of the critical: measured on such arms: 0.02 to 0.08 [default: as the
    robot file has it of the drives, else 0.03]."""

    count: int
    """How many modes are reported, the lowest first."""


class ChatterOptions(TypedDict, total=False):
    """Keywords of `stiffarm.chatter`."""

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

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg], which swings with the arm; its centre says where [default: a tool
    that weighs nothing]."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    tool_inertia_kg_m2: npt.ArrayLike | None
    """Inertia of the tool about its own mass centre [kg m2], along flange axes: elements of the matrix as URDF
    has them [default: none: a point mass]."""

    damping_ratio: float | None
    """Damping of every mode, as a share of the critical: measured on such arms: 0.02 to 0.08 [default: as the
    robot file has it of the drives, else 0.03]."""

    method: Literal["mean", "teeth"] | None
    """How teeth are counted [default: teeth where each cuts for half of the time or less and passes slowly, else
    mean]."""

    frf: str | os.PathLike[str] | None
    """How the tip answered where it was tapped: a table with freq_hz and gxx_re, gxx_im, gyy_re, gyy_im ..
    gzz_im in m/N along the tool axes, or one of its modes with freq_hz, damping_ratio, stiffness_n_per_m, ux,
    uy, uz [default: spindle, holder and cutter are rigid]."""

    frf_on: Literal["rigid", "robot"] | None
    """What held the tip while it was measured."""


class StudyOptions(TypedDict, total=False):
    """Keywords of `stiffarm.study`."""

    tasks: str | Iterable[str]
    """Shapes at size 1: A, B, C, or such as rect:1x3; the shape of the task is studied besides, and instead
    where nothing is said here."""

    task: str | None
    """A flat zone at its size, whose shape is studied: where it stands with a robot is marked, with the
    architecture that is stiffer there."""

    sizes: npt.ArrayLike
    """Sizes over l2 + l3."""

    ratios: npt.ArrayLike
    """Link ratios mu = l3/l2."""

    range: RangeLike
    """Link ratios among which the best is searched for."""

    compare: str | Iterable[Literal["serial", "quasi-serial"]]
    """The two architectures that are compared."""

    k2: npt.ArrayLike
    """Compliance of drive 2 over the reference k, for both or one each; 0: rigid."""

    k3: npt.ArrayLike
    """Compliance of drive 3 over the reference k, for both or one each; 0: rigid."""


class CompareOptions(TypedDict, total=False):
    """Keywords of `stiffarm.compare`."""

    task: str | None
    """circle:D, rect:AxB, A:d, B:d, C:d with sizes in m, or with model="spatial" a part; of setups whose job
    files name none."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg]: compared with the robot's payload, together with the force."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    force_n: float | npt.ArrayLike
    """Cutting force [N]: its size, in its worst direction; or three numbers along the feed, across it and axial
    (away from the work), in the planar model ahead,0,up."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall
    from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    at: npt.ArrayLike | None
    """The one place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above
    it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given
    [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any
    direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open,
    and with --mount count from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What neither work nor arm may touch (with --allow-contact the work alone) [m]: x0..x1,y0..y1,z0..z1 in the
    cell; several with ; between, or given several times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: 0 with --keep-out; else reported, none required]."""

    allow_contact: bool
    """Take the best place of the work although the arm may touch something there."""


class MillOptions(TypedDict, total=False):
    """Keywords of `stiffarm.mill`."""

    drive_urad_per_nm: npt.ArrayLike | None
    """Compliance of the drives [urad/(N m)]: one for all six, or six; of every robot that is asked for [default:
    as --stiffness says]."""

    stiffness_nm_per_rad: npt.ArrayLike | None
    """The same as a stiffness [N m/rad]: one for all six drives, or six."""

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

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    tool_inertia_kg_m2: npt.ArrayLike | None
    """Inertia of the tool about its own mass centre [kg m2], along flange axes: elements of the matrix as URDF
    has them [default: none: a point mass]."""

    damping_ratio: float | None
    """Damping of every mode, as a share of the critical: measured on such arms: 0.02 to 0.08 [default: as the
    robot file has it of the drives, else 0.03]."""

    frf: str | os.PathLike[str] | None
    """How the tip answered where it was tapped: a table with freq_hz and gxx_re, gxx_im, gyy_re, gyy_im ..
    gzz_im in m/N along the tool axes, or one of its modes with freq_hz, damping_ratio, stiffness_n_per_m, ux,
    uy, uz [default: spindle, holder and cutter are rigid]."""

    frf_on: Literal["rigid"] | None
    """What held the tip while it was measured; on the robot it would hold at one posture alone, and not along a
    path."""

    dry: bool
    """Only tell what was understood of the path: lengths, moves, extents, feed rates, what was assumed and
    ignored."""

    only_tool: int | None
    """Mill only what the tool of this number cuts (T, LOAD); each tool of a path has a process and a length of
    its own [default: all of the path, which then has one tool]."""

    process: str | os.PathLike[str] | Iterable[str] | Mapping[int, str | os.PathLike[str]] | None
    """A process file (TOML): tool, material and engagement, or a force as it is; the mean force over a
    revolution acts. T1=FILE,T2=FILE: one for each tool of a path that changes its tool."""

    tool_lengths_mm: str | Iterable[str] | Mapping[int, float] | None
    """How far the tip of each tool of the path stands out of the spindle [mm], along the tool axis:
    T1=82.5,T2=140; the tool point (tool, tool-mm) is then the spindle's nose, from which tools are measured."""

    force_n: float | npt.ArrayLike | None
    """Cutting force on the tool [N]: FEED,ACROSS,AXIAL (across: left of the feed, seen from the spindle; axial:
    away from the work), or its size, in its worst direction."""

    stock_mm: str | Iterable[str | Sequence[RangeLike | None]] | None
    """The block from which the part is cut [mm], in the path's frame: x0..x1,y0..y1,z0..z1; entry, exit and
    depth of the cut are then computed along the path, and arm and spindle keep clear of what is left of it
    (three axes, flat mills)."""

    at: npt.ArrayLike | None
    """Where the path's origin stands, m from the robot's base, or with --mount from the cell's origin, and by
    how many degrees the part is turned about the vertical [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where all of the path must stand, in m from the robot's base: x0..x1,z0..z1 about it, or
    x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open, and with --mount count
    from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """Where neither path nor arm may go [m]: x0..x1,y0..y1,z0..z1 in the cell; several with ; between, or given
    several times."""

    clearance_mm: float | None
    """Smallest distance that arm and tool [mm], links as capsules, keep along the path from floor, themselves
    and what is kept free [default: 0; of several robots not looked at]."""

    part: str | os.PathLike[str] | None
    """The finished part as STL in the path's frame: arm and spindle keep clear of it, the cutter may touch it."""

    fixture: str | os.PathLike[str] | None
    """What holds the part as STL in the path's frame: arm, spindle and cutter keep clear of it."""

    part_unit: Literal["mm", "inch", "m"]
    """Of the lengths in the STL files, which name none."""

    stick_out_mm: float | None
    """How far the cutter stands out of the spindle [mm]: so near to its tip nothing of the tool can touch part
    or stock [default: the length of the tool (tool-lengths-mm); else the tool is not compared with part,
    stock and fixture]."""

    allow_contact: bool
    """Write programs of a path along which the arm comes nearer to something than it should."""

    roll: str | float
    """How the tool is turned about its axis [deg]: free (from sample to sample, as is best), constant (the best
    of all), linear (changing evenly), or so many degrees of its x axis from the part's, clockwise seen from
    the spindle."""

    pin: str | Iterable[str] | None
    """So many mm along the path the roll must be so many degrees, and is as is best on the way there and on;
    separated by commas or given several times."""

    error: Literal["total", "across", "axial", "normal"]
    """What of the displacement counts."""

    tolerance_mm: float | None
    """Largest error that passes [mm]."""

    work_frame: Literal["touched", "measured"]
    """How the place of the work was found, for the error of the arm's own geometry."""

    compensate: bool
    """Take the deflection out: tell what is left of it, and which joints and tips are to be commanded; -o writes
    programs with them."""

    stiffness_uncertainty: float | None
    """Standard deviation of the logarithm of the compliance of every drive, for what compensation leaves
    [default: as the robot file or the prior has it]."""

    chatter: bool
    """Tell whether the cuts swing with the arm, and from which depth: at every sample, and with intervals at the
    worst; flat end mills and a robot whose masses are known."""

    pendant_as_file: bool
    """The pendant shows the joints as the robot file counts them (zeros, signs, joint 3): programs then begin
    with a move in joints where the file does not say so."""

    speed_share: float
    """Of the largest speed of every joint what is used while cutting, where the robot file tells speeds."""

    limit_margin_deg: float
    """What every joint keeps from either end of its range [deg]."""

    singular_margin_deg: float
    """What wrist and arm keep from straight [deg]."""

    clear_of_base_m: float | None
    """What the whole path keeps from the joint-1 axis [m] [default: the robot's own column, estimated as a1 +
    0.15 (c2 + l3)]."""

    floor_m: str | float | None
    """Height of the floor from the robot's base [m], or none; all of the path stands above it [default: 0,
    unless --within says how low the path may stand]."""

    tool_mm: npt.ArrayLike | None
    """Tool frame in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes; z out of the spindle
    to the tip [default: the flange centre]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg]: compared with the robot's payload, together with the force."""

    stiffness: Literal["paper", "prior", "file"] | None
    """How stiff the drives are taken to be [default: as the robot file has it, else prior]."""

    read_as: Literal["gcode", "apt", "csv"] | None
    """How the path is written [default: by the ending of its name]."""

    unit: Literal["mm", "inch"] | None
    """Of lengths, where the file names none [default: mm]."""

    arc_centres: Literal["incremental", "absolute"] | None
    """What centres of arcs in G-code count from [default: the reading in which arcs close]."""

    arc_sense: Literal["left", "right"] | None
    """In which sense arcs of APT turn [default: that of the program which wrote the file]."""

    cutter_compensation: Literal["refuse", "centre"]
    """What is done about a path that is not that of the tool's centre."""

    incremental_cycles: Literal["nist", "r-plane", "initial"] | None
    """What R and Z of drilling cycles count from under G91 [default: such cycles are refused]."""

    rotary: Literal["head-ac", "head-bc", "table-ac", "table-bc"] | None
    """What A, B and C turn; X, Y and Z are the tip in the part [default: angles that turn anything are refused]."""

    columns: str | Iterable[str] | None
    """Names of the columns of a CSV file without a header, separated by commas: x_mm, y_mm, z_mm, i, j, k or nx,
    ny, nz, feed_mm_per_min, rapid; - for one that moves nothing [default: the header]."""

    feed_mm_per_min: float | None
    """Feed rate [mm/min], where the file says none."""

    chord_mm: float
    """By how much the chord between two samples may be off an arc [mm]."""

    step_mm: float
    """Longest way between two samples [mm]."""


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
    """The work over which the deflection, or with geometry the error of the arm, is to be predicted: a zone at
    its best place, the tool down [default: anywhere within the limits]."""

    loads: str | Iterable[str]
    """In which directions you can load: down (weights), up, ahead, back, left, right, or x:y:z along base axes
    (pulleys); separated by commas."""

    force_n: float
    """How large the load is [N]."""

    runs: int
    """How many postures and loads, or with geometry postures, are to be measured."""

    criterion: Literal["prediction", "a", "d"]
    """By what a plan is judged; each is certified against every other choice of the candidates."""

    candidates: int
    """Among how many of them is chosen."""

    sigma_mm: float
    """Standard deviation of what is read of a coordinate [mm]."""

    posture_sigma_mm: float
    """Standard deviation of what the model misses of a coordinate in a posture [mm], alike for all markers and
    however often it is read there: neither more markers nor repeats take it away (where markers err less
    alike, planned errors are upper bounds)."""

    repeats: int
    """How often a posture is measured at most, whatever the load."""

    window: str | Iterable[str | Sequence[RangeLike | None]] | None
    """Where load point and markers must be [m]: x0..x1,y0..y1,z0..z1 from the base; ranges may be left open; one
    below the base says that the floor is as deep [default: above the floor]."""

    instrument_m: npt.ArrayLike | None
    """Where the tracker or camera stands [m], from the base: only postures in which it sees all markers past the
    arm are looked at [default: markers are seen from everywhere]."""

    marker_faces: npt.ArrayLike | None
    """Where the markers face, along flange axes: they are seen within the acceptance of this direction [default:
    all sides]."""

    acceptance_deg: float
    """How far a marker may be turned away from the line to the instrument [deg]."""

    tool_mm: npt.ArrayLike | None
    """The tool of the work in the flange frame [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed axes [default: the
    flange]."""

    tool: str | None
    """The tool by its shape [mm, deg]: spindle:LENGTH@ANGLE+OFFSET, ANGLE between tool axis and flange axis (it
    leans towards the flange's x, and joint 6 turns it), OFFSET from the flange to where they cross."""

    compare: str | os.PathLike[str] | None
    """A table of postures and loads of your own: what it is worth beside the plan."""


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

    model: Literal["drives", "base", "tool", "base-and-tool", "compensator", "compensator-and-preload", "regions", "auto"]
    """What is taken to spring."""

    regions: int
    """In how many ranges of joint 2, of as many postures each, drive 2 has a compliance of its own in the model
    "regions"."""

    prior: bool
    """Update what is known of drives of robots of this payload and reach, rather than leave it aside: the robot
    file has the posterior; drives that the rows do not show keep the prior with its scatter."""

    date: str | None
    """When was measured, as year-month-day: it is reported, and stands in the robot file."""


class CalibrateOptions(TypedDict, total=False):
    """Keywords of `stiffarm.calibrate`."""

    level: Literal["auto", "zeros", "geometry", "weight", "gears"]
    """How much may differ from the drawing."""

    columns: str | Iterable[str] | Mapping[str, str] | None
    """What columns are called in the table: joint_1_deg=J1,x1_mm=X [default: as they are called here]."""

    frame_by: str | None
    """The column that tells apart where the tracker stood; each stand has a frame of its own [default: one
    frame]."""

    at: npt.ArrayLike | None
    """Where the work is [m], from the robot's base: the error that remains is computed within 0.25 m about it
    [default: over all the arm reaches]."""

    controller_model: Literal["nominal", "calibrated"] | None
    """With which arm the controller computes while it is measured, and later: for the robot file [default: no
    program is written of the robot file]."""

    date: str | None
    """When it was read or measured, as year-month-day: for the robot file [default: today]."""


class VerifyOptions(TypedDict, total=False):
    """Keywords of `stiffarm.verify`."""

    any: bool
    """Try all robots of the catalogue, not only those of the same maker; which robot are the readings from,
    where none is named."""

    base_mm: npt.ArrayLike | None
    """The base of the robot file in the frame of the readings [mm, deg]: x,y,z or x,y,z,rx,ry,rz about fixed
    axes, 0,0,0 where no base is in force; shows the zero of joint 1 [default: fitted]."""

    tool_mm: npt.ArrayLike | None
    """The tool in force [mm, deg], in the flange frame: x,y,z or x,y,z,rx,ry,rz about fixed axes, 0,0,0 where
    none is; shows the zero of joint 6 [default: fitted]."""

    columns: str | Iterable[str] | Mapping[str, str] | None
    """What columns are called in the table: joint_1_deg=J1,x1_mm=X [default: as they are called here]."""

    frame_by: str | None
    """The column that tells apart where the tracker stood; each stand has a frame of its own [default: one
    frame]."""

    date: str | None
    """When it was read or measured, as year-month-day: for the robot file [default: today]."""


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


class SweepOptions(TypedDict, total=False):
    """Keywords of `stiffarm.cluster.sweep`."""

    faces: str | Iterable[str] | None
    """Which faces of a part are machined, by name, separated by commas; front faces the robot before the part is
    turned [default: all: of a box top, front, left, back, right]."""

    tolerance_mm: float | None
    """Largest deflection that is acceptable [mm]: adds pass or fail; in figures a line."""

    tool_mass_kg: float | None
    """Mass of the tool with its spindle [kg]: compared with the robot's payload, together with the force."""

    tool_com_mm: npt.ArrayLike | None
    """Mass centre of the tool in the flange frame [mm]: x,y,z; with its mass."""

    process: str | os.PathLike[str] | None
    """A process file (TOML) in place of the cutting force: its mean force over a revolution acts along feed,
    across and axial; its moment is left out."""

    force_axes: Literal["base", "tool"] | None
    """Along which axes a force of three numbers points [default: tool]."""

    feed_deg: float | None
    """Direction of the feed in the face [deg], from the first side of the zone towards the second; of a circle
    and of a map from straight ahead, with the tool up (as down under a ceiling) from straight back, on a wall
    from upright [default: the worst of all directions]."""

    direction_deg: float | None
    """Direction of the force in the arm plane [deg], counter-clockwise from straight ahead [default: the worst
    in every point] [planar model only]."""

    force_cone_deg: float | None
    """Half angle of a cone about its direction in which the force may point [deg]: the largest deflection over
    it [default: 0]."""

    component: Literal["total", "normal", "along"]
    """What of the displacement counts."""

    at: npt.ArrayLike | None
    """The one place where the middle of the zone stands [m]: so far ahead of the robot's base and so far above
    it, or with --mount above the cell's floor; of a rectangle with --angle 0 unless another is given
    [default: the best place within --within]."""

    within_m: str | Sequence[RangeLike | None] | None
    """Where the zone may stand, in m from the robot's base: x0..x1,z0..z1 with x from the joint-1 axis in any
    direction about it, or x0..x1,y0..y1,z0..z1 in the cell (several with ; between); ranges may be left open,
    and with --mount count from the cell's floor [default: in front of the joint-1 axis, above the floor]."""

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
    """Angle of a rectangle or a part, refused where there are circles alone: axes (horizontal or vertical; under
    a force with --feed-deg all four quarter turns), horizontal, vertical (its long side), free, or degrees of
    its first side from the direction in which it lies from the joint-1 axis (with windows of three ranges
    from x of the cell, of a base that leans from its own)."""

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
    """Rotation about the tool axis [deg]; 0 has the tool's x axis ahead, with the tool up (as down under a
    ceiling) back, on a wall upright [default: the best]."""

    mount: str | None
    """How the base is mounted: floor, pedestal:H, wall:H, ceiling:H (H in m above the cell's floor), or
    pose:x,y,z,rx,ry,rz; @DEG behind it turns it about the vertical [default: floor]."""

    keep_out: str | Iterable[str | Sequence[RangeLike | None]] | None
    """What neither work nor arm may touch (with --allow-contact the work alone) [m]: x0..x1,y0..y1,z0..z1 in the
    cell; several with ; between, or given several times."""

    clearance_mm: float | None
    """Smallest distance of the arm [mm], links as capsules, from floor, work, itself and what is kept free
    [default: 0 with --keep-out; else reported, none required]."""

    allow_contact: bool
    """Take the best place of the work although the arm may touch something there."""


_Pass = TypedDict("_Pass", {"pass": "bool | None"})


class Schema(TypedDict):
    """What a program must know to read an answer."""

    version: int
    """The version of what keys mean."""

    verb: str
    """What was asked."""

    origin: str
    """What positions count from."""

    axes: str
    """Which way axes point."""

    units: str
    """Where the unit of a number stands."""


class CellDict(TypedDict):
    """A cell as it was asked for."""

    mount: str
    """How the base is mounted: pedestal, wall, ceiling, or pose where it was given as one."""

    base_m: list[float]
    """The base in the axes of the cell, its floor at 0."""

    base_deg: list[float]
    """How it is turned, about fixed x, y and z."""

    within_m: list[list[list[float | None]]]
    """Where the work may stand: each window as ranges of x, y and z, or of the distance from the joint-1 axis
    and z; null where a range is open; empty where none was asked, and where one of two ranges counts from the
    base, straight ahead."""

    keep_out_m: list[list[list[float | None]]]
    """What is kept free: each box as ranges of x, y and z; null where a range is open."""

    keep_out_carries_base: list[int]
    """Which of these boxes, from 1, the base stands in or on."""

    clearance_mm: float | None
    """What the arm was to keep from everything; null where it may touch."""


class Resolution(TypedDict):
    """How finely a place was looked for."""

    coarse_step_m: float
    """Distance between the places of the coarse search; 0 where there is one place."""

    coarse_mm: float | None
    """The best value of the coarse search."""

    fine_step_m: float
    """The last step of the refinement."""

    fine_turn_deg: float
    """The last turn of the refinement."""

    sample_step_m: float
    """Distance between the poses in the zone."""

    samples: int
    """How many they are."""

    halving: float
    """By how much the value grew when that distance was halved last, relative."""

    boxes: int
    """Boxes of places behind the lower bound."""


class FaceDict(TypedDict):
    """One face of a part."""

    face: str
    """Which face of a part."""

    centre_m: list[float]
    """Its centre."""

    tool_direction_deg: float
    """The tool axis above the horizontal."""

    yaw_deg: float
    """Of the zone's plane about the vertical."""

    roll_deg: float
    """About the tool axis."""

    deflection_mm: float
    """The worst deflection in the zone at its best place."""

    lower_bound_mm: float
    """No allowed place has less."""

    shoulder: str
    """front or back."""

    elbow: str
    """up or down."""

    wrist: str
    """no flip or flip."""

    worst_point_m: list[float]
    """Where in the zone the deflection is largest."""

    worst_joints_deg: list[float]
    """Joint angles at the worst point as the robot reports them."""

    worst_shares: list[float]
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float
    """The smallest distance of any joint to its limits in the zone."""

    limit_margin_joint: int
    """That joint; 0 is the angle between the links."""

    singular_margin_deg: float
    """The smallest angle to a singular posture in the zone."""


class LargestZone(TypedDict):
    """The largest zone that passes."""

    scale: float | None
    """Its size as a part of the size that was asked for; null where not even the smallest that was tried passes."""

    size: str | None
    """The same in mm."""

    sides_m: list[float] | None
    """Its sides; null of a part."""

    deflection_mm: float | None
    """The worst deflection in the zone at its best place."""

    fails_at_scale: float | None
    """The smallest part of that size that was tried and does not pass."""

    fails_proved: bool
    """That no place of that passes is proved."""

    tried: int
    """How many zones were placed for it."""


class AdviceDict(TypedDict):
    """What a tolerance says of force, stiffness and size."""

    force_factor: float | None
    """So many times the force keeps the tolerance at this place, exactly; null where nothing gives way."""

    force_factor_bound: float | None
    """No place keeps it under more."""

    largest_force_n: float | None
    """The same as a force."""

    stiffness_factor: float | None
    """So many times as stiff must all drives be."""

    stiffness_needed_nm_per_rad: list[float | None] | None
    """The stiffness of each drive that this asks for; null of rigid ones, and of drive 2 beside a gravity
    compensator."""

    drive_shares: list[float | None] | None
    """What each drive gives of the deflection at the worst point along its direction; adds up to 1."""

    softest_drive: int | None
    """The drive that gives most there."""

    softest_drive_share: float | None
    """Its share."""

    compensation_assumed: float | None
    """The part of the deflection that a compensation of the program is taken to take out: an assumption."""

    compensated_mm: float | None
    """What it would leave of the deflection."""

    compensated_pass: bool | None
    """That keeps the tolerance."""

    largest_zone: LargestZone | None
    """The largest zone of the shape that passes; null where the one that was asked for does."""


class PlacedInRanking(_Pass):
    """One placement of a ranking, with its rank for this task."""

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    task: str
    """The zone as it was asked for."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    tool_mm: list[float] | None
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float | None
    """The tool axis above the horizontal."""

    within_m: list[list[float | None]] | None
    """Where the zone may stand; null where it is open."""

    cell: CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    floor_m: float | None
    """Height of the floor above which the zone was to stand, from the base; null where there is none, and where
    the base leans or is on a wall: the floor is then z = 0 of the cell."""

    feasible: bool | None
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    proved: bool | None
    """That there is no place is proved."""

    largest_feasible_scale: float | None
    """The largest scale at which a zone of this shape has a place."""

    deflection_mm: float | None
    """The worst deflection in the zone at its best place."""

    lower_bound_mm: float | None
    """No allowed place has less."""

    x_m: float | None
    """Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`,
    `cell_m`)."""

    z_m: float | None
    """Up, from the base."""

    bearing_deg: float | None
    """Where about the joint-1 axis the zone stands."""

    yaw_deg: float | None
    """Of the zone's plane about the vertical."""

    angle_deg: float | None
    """Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.
    Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a
    tool that points up from the opposite direction); where the side then points is told beside it."""

    first_side: list[float] | None
    """Which way the first side points where the zone stands, a unit vector: axes of the cell, of the base
    without one; null in the plane."""

    roll_deg: float | None
    """About the tool axis."""

    shoulder: str | None
    """front or back."""

    elbow: str | None
    """up or down."""

    wrist: str | None
    """no flip or flip."""

    worst_point_m: list[float] | None
    """Where in the zone the deflection is largest."""

    from_axis_1_m: float | None
    """Distance of the zone's nearest point from the joint-1 axis."""

    below_base: bool | None
    """Part of the zone lies below the base."""

    behind_axis_1: bool | None
    """Part of the zone lies behind the joint-1 axis."""

    worst_joints_deg: list[float] | None
    """Joint angles at the worst point as the robot reports them."""

    pendant: str | None
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    worst_shares: list[float] | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    limit_margin_joint: int | None
    """That joint; 0 is the angle between the links."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    smallest_margin_deg: float | None
    """The least that is kept from a joint limit or a straight posture anywhere in the zone."""

    smallest_margin_of: str | None
    """What that is of: a joint, the angle between the links, the forearm's angle, or a straight posture."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_estimated: bool | None
    """A radius in it is estimated."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    cell_m: list[float] | None
    """The centre of the zone in the axes of the cell, its floor at 0."""

    resolution: Resolution | None
    """How finely a place was looked for."""

    faces: list[FaceDict] | None
    """Every face of a part; null of one flat zone."""

    deflection_mm_p05: float | None
    """5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is
    not known."""

    deflection_mm_p50: float | None
    """Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes
    away."""

    deflection_mm_p95: float | None
    """Their 95th percentile."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    task_rank: int | None
    """The same for this task alone."""

    task_rank_tied: bool | None
    """Some other robot cannot be distinguished from it by the proof in this task."""

    advice: AdviceDict | None
    """What is missing where the tolerance is not kept, and what is left where it is; null where none was given,
    and in a ranking of all but the best robots."""


class RankingRow(TypedDict):
    """One robot of a ranking."""

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    rank: int | None
    """One more than the robots that are certainly better, their values below its bound; none for a robot that is
    estimated, or of which nothing is known."""

    rank_tied: bool | None
    """Some other robot cannot be distinguished from it by the proof, at the nominal stiffness."""

    planar_rank: int | None
    """The rank in the planar ranking of the same robots and tasks."""

    bound_mm: float | None
    """Deflection at the stiffest posture of the links."""

    mean_ratio: float | None
    """How much worse than the best of each task, geometric mean."""

    mean_ratio_bound: float | None
    """The same of the proved lower bounds."""

    win_probability: list[float | None]
    """In which share of the draws of the drive stiffness it has the least deflection, of each task; null where
    it has no place, is estimated, is not to be taken (its arm collides, it carries more than it may), or the
    uncertainty of its drives is not known."""

    expected_regret_mm: list[float | None]
    """How much more than the best it has on average, of each task."""

    ties_with_best: list[bool | None]
    """It ties with the best: no other robot has a smaller deflection in more than 95 % of the draws of the drive
    stiffness, of each task; shared ranks are about the proof."""

    cells: list[PlacedInRanking]
    """One placement per task."""


class Winner(TypedDict):
    """Who is best at a task."""

    task: str
    """The zone as it was asked for."""

    best: str | None
    """The best robot whose geometry and limits are published: of those that may be taken (clear, and strong
    enough for the tool), or where none may, of all."""

    told_apart: bool | None
    """It is proved that no other is as good, at the nominal stiffness."""

    rivals: list[str]
    """Robots of published geometry that may be as good as the best."""

    best_with_estimated: str | None
    """The best robot of all."""

    best_serial: str | None
    """The best serial robot."""

    best_quasi_serial: str | None
    """The best quasi-serial robot."""


class RankingDict(TypedDict):
    """What `rank` answers."""

    schema: Schema

    tasks: list[str]
    """The tasks as they were asked for."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    rows: list[RankingRow]
    """One entry per row."""

    winners: list[Winner]
    """Who is best at each task."""

    summary: list[str]
    """What a manager would read."""


class PathLength(TypedDict):
    """How long a path is."""

    samples: int
    """Samples along the path."""

    length_m: float
    """Length of the path, rapid ways and all."""

    cutting_length_m: float
    """Length of what feeds."""

    time_s: float | None
    """Time of what feeds; null where a feed rate is not said."""

    box_m: list[list[float]] | None
    """Two corners of the box about all feed moves, in the axes of the path."""

    rapid_length_m: float
    """Length of all rapid moves whose beginning is known."""

    rapid_box_m: list[list[float]] | None
    """Two corners of the box about the ends of all rapid moves whose beginning is known, in the axes of the
    path; null where there is none."""


class PinnedRoll(TypedDict):
    """A roll that is pinned."""

    sample: int
    """Which sample, from 0."""

    way_mm: float
    """How far along the path it stands."""

    roll_deg: float
    """Its roll."""


class RollChoice(TypedDict):
    """How the tool is turned about its axis."""

    mode: str
    """free, constant, linear or fixed."""

    from_deg: float | None
    """The smallest roll: of the tool's x axis from the part's."""

    to_deg: float | None
    """The largest roll."""

    pins: list[PinnedRoll]
    """Where the roll is pinned: samples with their way along the path and their roll."""

    posture: str | None
    """The configuration that holds a point."""

    rearranged: int | None
    """How often the arm takes another configuration, clear of the work."""


class PathContact(TypedDict):
    """A stretch of a path along which the arm is nearer to something than it was to keep."""

    line: int
    """From 1."""

    s_m: float
    """How far along the path it is nearest."""

    bodies: str
    """Which link to what; in `misplaced` what of the work."""

    depth_mm: float
    """By how much that is nearer than what was to be kept; where nothing was, how deep they overlap; in
    `misplaced` at most, by the boxes about both along the sides of the keep-out."""


class Misplaced(TypedDict):
    """Something of the work that stands where nothing may."""

    bodies: str
    """Which link to what; in `misplaced` what of the work."""

    depth_mm: float
    """By how much that is nearer than what was to be kept; where nothing was, how deep they overlap; in
    `misplaced` at most, by the boxes about both along the sides of the keep-out."""


class PlaceSearch(TypedDict):
    """How finely a place was looked for."""

    fine_step_m: float
    """The last step of the refinement."""

    samples: int
    """Samples that stood for the path in the search."""

    boxes: int
    """Boxes of places behind the lower bound."""


class PathRankingRow(_Pass):
    """One robot of a ranking on a path."""

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    rank: int | None
    """One more than the robots that are certainly better, their values below its bound; none for a robot that is
    estimated, or of which nothing is known."""

    rank_tied: bool | None
    """Some other robot cannot be distinguished from it by the proof, at the nominal stiffness."""

    feasible: bool | None
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    worst_mm: float | None
    """The largest error along the path."""

    worst_mm_p05: float | None
    """5th percentile over draws of the drive stiffness, in the postures of the answer; null where the
    uncertainty of the drives is not known."""

    worst_mm_p50: float | None
    """Median."""

    worst_mm_p95: float | None
    """95th percentile."""

    lower_bound_mm: float | None
    """No rolls of the mode that was asked for, through the pins where there are some, and where the best place
    was asked for no place, have less."""

    rms_mm: float | None
    """The root mean square of the error over what feeds."""

    roll: RollChoice | None
    """How the tool is turned about its axis."""

    at_m: list[float] | None
    """Where the path's origin stands, from the robot's base."""

    at_yaw_deg: float | None
    """By how much the part is turned about the vertical from straight ahead of the robot; null of a base that
    leans."""

    cell_m: list[float] | None
    """Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell."""

    cell_yaw_deg: float | None
    """By how much the part is turned about the vertical from the cell's x axis; null without a cell."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_by: list[str] | None
    """By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot
    file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and
    what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the
    `stock`."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    error_without_wide_mm: float | None
    """The largest error of the best path, where `clearance_wide_mm` ruled it out and this one is worse."""

    asked_clearance_mm: float | None
    """What the arm was to keep from everything; null where nobody looked."""

    contacts: list[PathContact] | None
    """Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody
    looked."""

    unavoidable: PathContact | None
    """Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every
    configuration, as the one that is farthest from it has it. Null where nothing of that kind is known."""

    misplaced: list[Misplaced] | None
    """What of the work (part, stock, fixture) stands more than 1 mm deep in a keep-out or below the floor; null
    where nobody looked."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    win_probability: list[float | None]
    """In which share of the draws of the drive stiffness it has the least deflection, of each task; null where
    it has no place, is estimated, is not to be taken (its arm collides, it carries more than it may), or the
    uncertainty of its drives is not known."""

    expected_regret_mm: list[float | None]
    """How much more than the best it has on average, of each task."""

    ties_with_best: list[bool | None]
    """It ties with the best: no other robot has a smaller deflection in more than 95 % of the draws of the drive
    stiffness, of each task; shared ranks are about the proof."""

    search: PlaceSearch | None
    """How finely a place was looked for; null where it was given."""


class PathRankingDict(TypedDict):
    """What `mill --robots` and `rank --task PATH` answer."""

    schema: Schema

    path: str
    """The toolpath as it was asked for."""

    force: str | None
    """Where the force on the tool comes from."""

    part: PathLength | None
    """The path as it was cut: samples, lengths and time."""

    error: str | None
    """What of the displacement counts: total, across, axial or normal."""

    rows: list[PathRankingRow]
    """One entry per row."""

    summary: list[str]
    """What a manager would read."""

    remarks: list[str]
    """What is odd."""


class Placed(_Pass):
    """One placement; `pass` says whether the tolerance is kept."""

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    task: str
    """The zone as it was asked for."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    tool_mm: list[float] | None
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float | None
    """The tool axis above the horizontal."""

    within_m: list[list[float | None]] | None
    """Where the zone may stand; null where it is open."""

    cell: CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    floor_m: float | None
    """Height of the floor above which the zone was to stand, from the base; null where there is none, and where
    the base leans or is on a wall: the floor is then z = 0 of the cell."""

    feasible: bool | None
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    proved: bool | None
    """That there is no place is proved."""

    largest_feasible_scale: float | None
    """The largest scale at which a zone of this shape has a place."""

    deflection_mm: float | None
    """The worst deflection in the zone at its best place."""

    lower_bound_mm: float | None
    """No allowed place has less."""

    x_m: float | None
    """Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`,
    `cell_m`)."""

    z_m: float | None
    """Up, from the base."""

    bearing_deg: float | None
    """Where about the joint-1 axis the zone stands."""

    yaw_deg: float | None
    """Of the zone's plane about the vertical."""

    angle_deg: float | None
    """Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.
    Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a
    tool that points up from the opposite direction); where the side then points is told beside it."""

    first_side: list[float] | None
    """Which way the first side points where the zone stands, a unit vector: axes of the cell, of the base
    without one; null in the plane."""

    roll_deg: float | None
    """About the tool axis."""

    shoulder: str | None
    """front or back."""

    elbow: str | None
    """up or down."""

    wrist: str | None
    """no flip or flip."""

    worst_point_m: list[float] | None
    """Where in the zone the deflection is largest."""

    from_axis_1_m: float | None
    """Distance of the zone's nearest point from the joint-1 axis."""

    below_base: bool | None
    """Part of the zone lies below the base."""

    behind_axis_1: bool | None
    """Part of the zone lies behind the joint-1 axis."""

    worst_joints_deg: list[float] | None
    """Joint angles at the worst point as the robot reports them."""

    pendant: str | None
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    worst_shares: list[float] | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    limit_margin_joint: int | None
    """That joint; 0 is the angle between the links."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    smallest_margin_deg: float | None
    """The least that is kept from a joint limit or a straight posture anywhere in the zone."""

    smallest_margin_of: str | None
    """What that is of: a joint, the angle between the links, the forearm's angle, or a straight posture."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_estimated: bool | None
    """A radius in it is estimated."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    cell_m: list[float] | None
    """The centre of the zone in the axes of the cell, its floor at 0."""

    resolution: Resolution | None
    """How finely a place was looked for."""

    faces: list[FaceDict] | None
    """Every face of a part; null of one flat zone."""

    deflection_mm_p05: float | None
    """5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is
    not known."""

    deflection_mm_p50: float | None
    """Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes
    away."""

    deflection_mm_p95: float | None
    """Their 95th percentile."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    advice: AdviceDict | None
    """What is missing where the tolerance is not kept, and what is left where it is; null where none was given,
    and in a ranking of all but the best robots."""


class _OfRanking(TypedDict, total=False):
    """What a placement of a ranking has besides."""

    task_rank: int | None
    """The same for this task alone."""

    task_rank_tied: bool | None
    """Some other robot cannot be distinguished from it by the proof in this task."""


class PlacementDict(Placed, _OfRanking):
    """What `place` answers."""

    schema: Schema


class FedBackDict(TypedDict):
    """What becomes of an error as the cut changes by it."""

    worst_mm: float | None
    """The largest error along the path."""

    contraction: float
    """To which part a displacement shrinks, in the long run, from round to round of displacement and force of
    the cut (spectral radius), at the worst sample; from 1 on nothing settles."""

    unsettled: int
    """Samples at which nothing settles: pushed aside, the tool is drawn in."""


class UncoveredSamples(TypedDict):
    """Samples of a path of whose chatter nothing is known."""

    why: str
    """plunge, turn in place, force of the path (it gives no cut), or air."""

    samples: int
    """Samples along the path."""

    lines: list[int]
    """Lines of the file, ascending; none of a path built in."""


class PathChatter(TypedDict):
    """Whether the cuts of a path swing with the arm."""

    chatter_verdict: str | None
    """What is reported of robot modes and of spindle modes along a path, in words, with the sample of which it
    is."""

    covered_samples: int
    """Samples of which a critical depth is computed."""

    not_covered: list[UncoveredSamples]
    """Samples that feed, and of which nothing is computed: why, how many, and the lines on which they are."""

    mean_misleads: int
    """Samples whose teeth cut so shortly, and pass so slowly, that their mean over a revolution misleads; only
    the worst is counted tooth by tooth."""

    at_sample: int | None
    """The sample at which the critical depth is least in proportion to the cut, from 0; null where no sample is
    covered."""

    at_line: int | None
    """Its line in the file; 0 of a path built in."""

    joints_deg: list[float] | None
    """Joint angles as the robot reports them, deg."""

    feed: list[float] | None
    """Where the tool feeds, of length one, base axes."""

    spindle_rpm: float | None
    """Speed of the spindle."""

    cut_depth_mm: float | None
    """Axial depth of the cut, as the process has it."""

    entry_deg: float | None
    """Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns
    counter-clockwise from its right."""

    exit_deg: float | None
    """Where a tooth leaves."""

    method: str | None
    """How teeth are counted: mean (over a revolution) or teeth (one by one)."""

    critical_depth_mm: float | None
    """The least axial depth that swings with the robot at the speed of the spindle; null where none up to 300 mm
    does."""

    critical_depth_mm_p05: float | None
    """5th percentile over draws of drive stiffness and damping; null beyond 300 mm."""

    critical_depth_mm_p95: float | None
    """95th percentile; null beyond 300 mm."""

    depth_reserve: float | None
    """The least depth that swings at the speed of the spindle, in parts of that of the cut; null where none up
    to 300 mm does."""

    chatter_hz: float | None
    """The frequency of the swing at that depth."""

    tooth_phase_rad: float | None
    """By how much the swing turns from tooth to tooth; far below 1 the cut is a damper, which calms or drives."""

    any_speed_depth_mm: float | None
    """Less deep no speed swings, by the mean of the teeth, and never deeper than at the speed of the cut; null
    where none up to 300 mm does."""

    any_speed_depth_mm_p05: float | None
    """5th percentile over the same draws."""

    any_speed_depth_mm_p95: float | None
    """95th percentile."""

    any_speed_hz: float | None
    """The frequency of the swing at that depth."""

    other_way_depth_mm: float | None
    """The least axial depth that swings at the speed of the spindle where the cut is fed the other way, up for
    down; null where none up to 300 mm does."""

    other_way_hz: float | None
    """The frequency of the swing at that depth."""

    calm_rpm: list[list[float]] | None
    """Speeds of the spindle within 0.5 to 1.5 of its own at which the cut swings neither at the nominal
    stiffness and damping nor in more than 5 of 100 draws: pairs of from and to; null where teeth are counted
    one by one, of drives that are nobody's, and where a measured table decides nothing."""

    pan_depth_mm: float | None
    """The least depth at which modes couple without the delay (Pan); beside the others, never instead of them."""

    pan_hz: float | None
    """Its frequency; 0 where the arm gives way."""

    drawn: list[str] | None
    """What the intervals are over: drives, damping, both or neither."""

    modes_looked_at: list[float] | None
    """Frequencies of the robot's modes that were looked at, Hz; none where the robot is in what was measured.
    Nothing is known above the last of these and of what was measured."""

    robot_modes: str
    """Of the robot with what was measured at its tip: calm where the cut swings neither at the nominal stiffness
    and damping nor in more than 5 of 100 draws, limit where it swings at the nominal and in 95 of 100 or
    more, else not decided; not covered of a path without a cut of which anything is known."""

    spindle_modes: str
    """unknown where nothing was measured at the tip, else measured; those of the work are never looked at."""

    frf: str | None
    """The table of what was measured at the tip; null where there is none."""

    frf_on: str | None
    """What held the tip while it was measured: rigid (spindle, holder and cutter alone) or robot (it takes the
    place of the model); null without a table."""

    measured_modes: list[float] | None
    """Frequencies of the modes of the table, Hz; null without a table of modes."""

    measured_between: list[float] | None
    """From where to where the table tells frequency by frequency, Hz; null without one."""

    deepest_roll_deg: float | None
    """Of the rolls, in steps of 5 deg, that keep the margins and touch nothing at the worst sample in its
    configuration: the one with which its cut goes deepest; null where nothing is known."""

    deepest_depth_mm: float | None
    """From which depth it then swings, by the mean of the teeth over a revolution; null where none up to 300 mm
    does."""

    deepest_error_mm: float | None
    """The error of that sample, so rolled."""

    rolled_reserve: float | None
    """The whole path so rolled: its least critical depth in parts of that of the cut, by the mean; null where it
    is not followed so, or no edge swings."""

    rolled_at_line: int | None
    """The line of the file on which that is; null where the path is not followed so."""

    rolled_error_mm: float | None
    """The largest error along the path so rolled."""


class CompensatedPath(TypedDict):
    """What compensation makes of a path."""

    largest_correction_mm: float
    """By how much a tip is led aside at most."""

    left_by_joints_mm: float
    """The largest error that is left by the model where joints, or whole poses, are commanded."""

    left_by_tips_mm: float | None
    """The same where tips alone are, the tool turned as in the path; null where one is not reached."""

    left_median_mm: float | None
    """Median over draws of the drive stiffness; null where its uncertainty is not known."""

    left_p95_mm: float | None
    """95th percentile over these draws."""

    uncertainty: str | None
    """The source of the uncertainty of the drive stiffness."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    beyond_limits: int
    """Samples at which a joint is commanded beyond its range."""


class TrueArm(TypedDict):
    """The largest error of a calibrated arm, geometry and load together."""

    uncorrected_mm: float
    """Where nothing is corrected."""

    by_stiffness_mm: float | None
    """Where the deflection alone is; null under a force that may point anywhere."""

    by_geometry_mm: float
    """Where the geometry alone is."""

    by_both_mm: float | None
    """Where both are, by the model; null under a force that may point anywhere."""

    calibration_left_mm: float | None
    """What the calibration leaves where it was not measured, rms."""

    beyond_limits: int
    """Samples at which a joint is commanded beyond its range."""


class ArmError(TypedDict):
    """The geometric error of arms that nobody has calibrated."""

    median_mm: float
    """Median of the distances."""

    p95_mm: float
    """95th percentile of the distances."""


class MilledDict(_Pass):
    """What `mill` answers of a path."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    path: str
    """The toolpath as it was asked for."""

    only_tool: int | None
    """The number of the only tool that mills, of several; null where all of the path is milled, and in
    `by_tool`."""

    force: str
    """Where the force on the tool comes from."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    part: PathLength
    """The path as it was cut: samples, lengths and time."""

    roll: RollChoice
    """How the tool is turned about its axis."""

    error: str
    """What of the displacement counts: total, across, axial or normal."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    speed_share: float | None
    """Of the joints' speeds what is used at most; null where the robot file tells none."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    cell: CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    at_m: list[float] | None
    """Where the path's origin stands, from the robot's base."""

    at_yaw_deg: float | None
    """By how much the part is turned about the vertical from straight ahead of the robot; null of a base that
    leans."""

    cell_m: list[float] | None
    """Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell."""

    cell_yaw_deg: float | None
    """By how much the part is turned about the vertical from the cell's x axis; null without a cell."""

    feasible: bool
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    worst_mm: float | None
    """The largest error along the path."""

    worst_mm_p05: float | None
    """5th percentile over draws of the drive stiffness, in the postures of the answer; null where the
    uncertainty of the drives is not known."""

    worst_mm_p50: float | None
    """Median."""

    worst_mm_p95: float | None
    """95th percentile."""

    lower_bound_mm: float | None
    """No rolls of the mode that was asked for, through the pins where there are some, and where the best place
    was asked for no place, have less."""

    roll_lower_bound_mm: float | None
    """No rolls of that mode have less at this place."""

    rms_mm: float | None
    """The root mean square of the error over what feeds."""

    worst_sample: int | None
    """The sample with the largest error, from 0."""

    worst_line: int | None
    """Its line in the file; 0 of a path built in."""

    worst_joints_deg: list[float] | None
    """Joint angles at the worst point as the robot reports them."""

    worst_shares: list[float] | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_by: list[str] | None
    """By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot
    file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and
    what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the
    `stock`."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    error_without_wide_mm: float | None
    """The largest error of the best path, where `clearance_wide_mm` ruled it out and this one is worse."""

    asked_clearance_mm: float | None
    """What the arm was to keep from everything; null where nobody looked."""

    contacts: list[PathContact] | None
    """Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody
    looked."""

    unavoidable: PathContact | None
    """Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every
    configuration, as the one that is farthest from it has it. Null where nothing of that kind is known."""

    misplaced: list[Misplaced] | None
    """What of the work (part, stock, fixture) stands more than 1 mm deep in a keep-out or below the floor; null
    where nobody looked."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    fed_back: FedBackDict | None
    """What becomes of the largest error as width and depth of the cut change with the displacement; null where
    no cut is known."""

    chatter: PathChatter | None
    """Whether the cuts swing with the arm, at the sample at which the critical depth is least in proportion to
    the cut; null where that was not asked, or the path is not followed."""

    compensation: CompensatedPath | None
    """What compensation makes of the path; null where it was not asked for."""

    search: PlaceSearch | None
    """How finely a place was looked for; null where it was given."""

    work_frame: str | None
    """How the place of the work was found: measured or touched; null where nothing is followed."""

    true_arm: TrueArm | None
    """The largest error of the calibrated arm, geometry and load together; null of an arm that was not
    calibrated."""

    arm_error: ArmError | None
    """The largest geometric error along the path of arms that nobody has calibrated: median and 95th percentile;
    null of one that was calibrated."""

    remarks: list[str]
    """What is odd."""


class MilledWithTool(_Pass):
    """What one tool of several mills."""

    tool_number: int
    """The number of the tool in the file of the path."""

    tool_mm: list[float]
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    robot: str
    """The maker's name for the robot."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    path: str
    """The toolpath as it was asked for."""

    only_tool: int | None
    """The number of the only tool that mills, of several; null where all of the path is milled, and in
    `by_tool`."""

    force: str
    """Where the force on the tool comes from."""

    payload_kg: float | None
    """Nominal payload."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    overloaded: bool | None
    """The tool and a mass that weighs as much as the force are more than the payload together; null where no
    payload is known."""

    wrist_moment_nm: list[float] | None
    """Moments about axes 4, 5 and 6 at worst over the angles of these joints and the directions: of the tool's
    weight where its mass centre was given, and in the spatial model of the force at the tool tip."""

    wrist_limit_nm: list[float] | None
    """The largest that are allowed; null where the robot file has none."""

    wrist_limit_by: str | None
    """What says so: `allowed by the maker`, or `torque limits of the drives`, above which they do not hold the
    load even at rest."""

    wrist_exceeded: bool | None
    """A moment about axis 4, 5 or 6 is above its limit; null where no limit is known."""

    part: PathLength
    """The path as it was cut: samples, lengths and time."""

    roll: RollChoice
    """How the tool is turned about its axis."""

    error: str
    """What of the displacement counts: total, across, axial or normal."""

    asked_limit_margin_deg: float
    """What every joint was to keep from its limits."""

    asked_singular_margin_deg: float
    """What wrist and arm were to keep from straight."""

    speed_share: float | None
    """Of the joints' speeds what is used at most; null where the robot file tells none."""

    clear_of_base_m: float | None
    """What the zone was to keep from the joint-1 axis; null where it is not known where that stands."""

    cell: CellDict | None
    """The cell as it was asked for: mount, windows, what is kept free, and which of that (from 1) the base
    stands in or on, so that it is taken as what carries it; null where there is none."""

    at_m: list[float] | None
    """Where the path's origin stands, from the robot's base."""

    at_yaw_deg: float | None
    """By how much the part is turned about the vertical from straight ahead of the robot; null of a base that
    leans."""

    cell_m: list[float] | None
    """Where the path's origin stands in the axes of the cell, its floor at 0; null without a cell."""

    cell_yaw_deg: float | None
    """By how much the part is turned about the vertical from the cell's x axis; null without a cell."""

    feasible: bool
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    worst_mm: float | None
    """The largest error along the path."""

    worst_mm_p05: float | None
    """5th percentile over draws of the drive stiffness, in the postures of the answer; null where the
    uncertainty of the drives is not known."""

    worst_mm_p50: float | None
    """Median."""

    worst_mm_p95: float | None
    """95th percentile."""

    lower_bound_mm: float | None
    """No rolls of the mode that was asked for, through the pins where there are some, and where the best place
    was asked for no place, have less."""

    roll_lower_bound_mm: float | None
    """No rolls of that mode have less at this place."""

    rms_mm: float | None
    """The root mean square of the error over what feeds."""

    worst_sample: int | None
    """The sample with the largest error, from 0."""

    worst_line: int | None
    """Its line in the file; 0 of a path built in."""

    worst_joints_deg: list[float] | None
    """Joint angles at the worst point as the robot reports them."""

    worst_shares: list[float] | None
    """What each drive gives of the worst deflection; adds up to 1."""

    limit_margin_deg: float | None
    """The smallest distance of any joint to its limits in the zone."""

    singular_margin_deg: float | None
    """The smallest angle to a singular posture in the zone."""

    clearance_mm: float | None
    """The nearest that the arm comes to anything, links as capsules; negative where they overlap."""

    clearance_of: str | None
    """Which link to what."""

    clearance_by: list[str] | None
    """By which bodies that is known: those of the arm are `enclosing`, `estimated` or `stated` by the robot
    file, its tool `estimated` where nothing says how thick it is, its cutter `stated` by the process, and
    what it comes near to may be a `keep-out`, the `mesh` of a part or fixture, or what is left of the
    `stock`."""

    clearance_outside_mm: float | None
    """By how much real links may stand out of the estimated ones in it, as in nine arms of ten at most; 0 where
    none is estimated."""

    clearance_wide_mm: float | None
    """The nearest that bodies, inside of which nine known arms in ten lie, come to anything but the arm;
    negative where they overlap, so that the arm may touch; null where its bodies are known."""

    clearance_wide_of: str | None
    """Which of those to what."""

    error_without_wide_mm: float | None
    """The largest error of the best path, where `clearance_wide_mm` ruled it out and this one is worse."""

    asked_clearance_mm: float | None
    """What the arm was to keep from everything; null where nobody looked."""

    contacts: list[PathContact] | None
    """Stretches of the path along which the arm is nearer to something than it was to keep; null where nobody
    looked."""

    unavoidable: PathContact | None
    """Of a path that is not clear: what is nearer than was asked at some place of it at every roll and in every
    configuration, as the one that is farthest from it has it. Null where nothing of that kind is known."""

    misplaced: list[Misplaced] | None
    """What of the work (part, stock, fixture) stands more than 1 mm deep in a keep-out or below the floor; null
    where nobody looked."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    fed_back: FedBackDict | None
    """What becomes of the largest error as width and depth of the cut change with the displacement; null where
    no cut is known."""

    chatter: PathChatter | None
    """Whether the cuts swing with the arm, at the sample at which the critical depth is least in proportion to
    the cut; null where that was not asked, or the path is not followed."""

    compensation: CompensatedPath | None
    """What compensation makes of the path; null where it was not asked for."""

    search: PlaceSearch | None
    """How finely a place was looked for; null where it was given."""

    work_frame: str | None
    """How the place of the work was found: measured or touched; null where nothing is followed."""

    true_arm: TrueArm | None
    """The largest error of the calibrated arm, geometry and load together; null of an arm that was not
    calibrated."""

    arm_error: ArmError | None
    """The largest geometric error along the path of arms that nobody has calibrated: median and 95th percentile;
    null of one that was calibrated."""

    remarks: list[str]
    """What is odd."""


class MilledByToolDict(_Pass):
    """What `mill` answers of a path with several tools."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    path: str
    """The toolpath as it was asked for."""

    feasible: bool
    """There is a place; null where it is not known."""

    reason: str | None
    """Why there is no place, or it is not known."""

    worst_mm: float | None
    """The largest error along the path."""

    worst_tool: int | None
    """The tool with the largest error, of a path that is milled with several."""

    worst_line: int | None
    """Its line in the file; 0 of a path built in."""

    tolerance_mm: float | None
    """The largest deflection that is acceptable."""

    verdict: str | None
    """pass where the tolerance is kept so and with a probability of 0.95 or more, pass, not sure where it is
    kept so (of `mill` also where the deflection is within the tolerance and beyond it together with what the
    geometry of an arm errs that was not calibrated, and where it is not decided whether the cuts swing; in
    the plane also where the arm may collide), else fail; of the elastic deflection of the drives under the
    mean force and of nothing else. Where the answer is no whatever the deflection it is what says so:
    collision, load exceeded, or of `mill` chatter."""

    probability: float | None
    """Probability that the tolerance is kept, over draws of the drive stiffness and of the residual of an
    identified model; null where neither uncertainty is known."""

    margin_mm: float | None
    """What is left of the tolerance."""

    compensation: CompensatedPath | None
    """What compensation makes of the path; null where it was not asked for."""

    by_tool: list[MilledWithTool]
    """What each tool of the path does, in the order in which they mill: the keys of a path with one tool, its
    number and its tip."""

    remarks: list[str]
    """What is odd."""


class MapDict(TypedDict):
    """What `map` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    force_n: float
    """The cutting force."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str
    """What of the displacement counts: total, normal (to the face) or along (the force)."""

    direction_deg: float | None
    """Of the force in the arm plane, from straight ahead."""

    elbow: str | None
    """The one side of the elbow that was asked for, up or down; null where the stiffer of each point is mapped."""

    tool_mm: list[float] | None
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float | None
    """The tool axis above the horizontal."""

    roll_tolerance: float | None
    """How much more than at the best roll a point may tell, relative."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    slowest_hz_p05: float | None
    """5th percentile, over draws of the drive stiffness, of the first frequency at the slowest point of the map;
    null where its uncertainty is not known, and where frequencies are not mapped."""

    zone: Placed | None
    """The best placement of the task that was given."""

    x_m: list[float]
    """Ahead, from the base: of each column of cells."""

    z_m: list[float]
    """Up, from the base: of each row of cells."""

    worst_mm: list[list[float | None]] | None
    """Deflection under the force in its worst direction, row by row; null where a cell is not reached, and
    without rows where the force has a direction."""

    deflection_mm: list[list[float | None]] | None
    """Deflection under the force in the direction asked for, row by row; null without rows where none was."""

    limit_margin_deg: list[list[float | None]] | None
    """The distance to the nearest joint limit, row by row; in space."""

    singular_margin_deg: list[list[float | None]] | None
    """The angle to the nearest singular posture, row by row; in space."""

    posture: list[list[str | None]] | None
    """The configuration that holds each cell, row by row; in space."""

    roll_deg: list[list[float | None]] | None
    """The roll about the tool axis, row by row; in space."""

    first_frequency_hz: list[list[float | None]] | None
    """The first natural frequency, row by row, where that was asked."""


class ComplianceDict(TypedDict):
    """What `compliance` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""

    joints_beyond_limits: list[int]
    """Joints beyond their limits at these angles, 0 for the angle between the links."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tcp_m: list[float]
    """The tool point."""

    compliance_um_per_n: list[list[float]]
    """From force to translation, base axes."""

    compliance_6x6_si: list[list[float]]
    """From wrench to translation and rotation, base axes, SI."""

    principal_um_per_n: list[float]
    """Principal compliances, ascending."""

    worst_direction: list[float]
    """The unit direction of the last of them."""

    worst_shares: list[float]
    """What each drive gives of the worst deflection; adds up to 1."""

    force_n: list[float] | None
    """The force at the tool point, base axes: as given, or of those that it may be the one that does most."""

    deflection_mm: list[float] | None
    """The translation under it."""

    rotation_mrad: list[float] | None
    """The rotation under it."""

    largest_mm: float | None
    """What counts of the translation, the largest that the force may cause."""

    deflection_mm_p05: float | None
    """5th percentile of the deflection there over draws of the drive stiffness; null where its uncertainty is
    not known."""

    deflection_mm_p50: float | None
    """Their median; mostly more than at the nominal stiffness, as a soft drive adds more than a stiff one takes
    away."""

    deflection_mm_p95: float | None
    """Their 95th percentile."""

    force_axes: str | None
    """Along which axes its direction is given: base (ahead, left, up) or tool (feed, across, axial); null for
    the worst."""

    force_direction: list[float] | None
    """Its unit direction along these axes."""

    force_cone_deg: float | None
    """By how much it may point aside."""

    feed_deg: float | None
    """Direction of the feed from the first side of the zone, of one posture from the x axis of the tool; null
    where it may go any way."""

    component: str | None
    """What of the displacement counts: total, normal (to the face) or along (the force)."""


class SwingMode(TypedDict):
    """One way in which an arm swings."""

    mode: int
    """Which mode, from 1."""

    frequency_hz: float
    """With the motors held still."""

    frequency_hz_p05: float | None
    """5th percentile over draws of the drive stiffness; null where its uncertainty is not known."""

    frequency_hz_p95: float | None
    """95th percentile."""

    frequency_motors_free_hz: float | None
    """Of the same rank with motors that only the inertia of their rotors holds; null where rotors are not known."""

    damping_ratio: float
    """Share of the critical damping."""

    tip_shape: list[float]
    """How the tool point moves, base axes, in m per root of kg m2 of modal mass: its square over (2 pi f)^2 is
    what the mode gives of the compliance."""

    drive_shares: list[float]
    """What each drive stores of the energy; adds up to 1."""


class ModesDict(TypedDict):
    """What `modes` answers of a posture."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tcp_m: list[float]
    """The tool point."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    damping_source: str
    """Where the damping is from: assumed, given or robot file."""

    masses_left_out: list[str]
    """Moving parts whose masses the robot file does not have."""

    modes: list[SwingMode]
    """How the arm swings, the lowest frequency first."""


class ModeOverZone(TypedDict):
    """One mode over a zone; modes are counted by their frequencies at each point."""

    mode: int
    """Which mode, from 1."""

    least_frequency_hz: float
    """The least frequency of the points of the zone that were looked at, motors held still."""

    frequency_hz_p05: float | None
    """5th percentile over draws of the drive stiffness; null where its uncertainty is not known."""

    frequency_hz_p95: float | None
    """95th percentile."""

    least_at_m: list[float]
    """Where, from the base."""

    largest_frequency_hz: float
    """The largest frequency of the points of the zone that were looked at."""

    largest_at_m: list[float]
    """Where, from the base."""


class ModesOverZoneDict(TypedDict):
    """What `modes --task` answers of a zone."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    task: str
    """The zone as it was asked for."""

    tool_mm: list[float]
    """The tool frame in the flange frame: x, y, z, mm, and the turns about fixed axes, deg."""

    tool_direction_deg: float
    """The tool axis above the horizontal."""

    x_m: float
    """Ahead, from the base; of a place that is turned about the joint-1 axis before it is turned (`bearing_deg`,
    `cell_m`)."""

    z_m: float
    """Up, from the base."""

    bearing_deg: float | None
    """Where about the joint-1 axis the zone stands."""

    yaw_deg: float | None
    """Of the zone's plane about the vertical."""

    angle_deg: float
    """Of the first side of a rectangle: below 180, or below 360 where the feed of a known force counts from it.
    Counted from the direction in which the zone lies from the joint-1 axis (on a wall from upright; for a
    tool that points up from the opposite direction); where the side then points is told beside it."""

    roll_deg: float | None
    """About the tool axis."""

    shoulder: str | None
    """front or back."""

    elbow: str
    """up or down."""

    wrist: str | None
    """no flip or flip."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    masses_left_out: list[str]
    """Moving parts whose masses the robot file does not have."""

    first_at_least_hz: float | None
    """Nowhere in the zone the first frequency is lower, motors held still: proved at the nominal stiffness, and
    no promise where that is not measured; null where the proof did not end."""

    first_at_least_hz_p05: float | None
    """5th percentile of the least first frequency over draws of the drive stiffness: drawn, not proved; null
    where its uncertainty is not known."""

    zone_parts: int
    """Into how many parts the zone was cut for the proof."""

    samples: int
    """How many they are."""

    sample_step_m: float
    """Distance between the poses in the zone."""

    modes: list[ModeOverZone]
    """How the arm swings, the lowest frequency first."""


class Lobe(TypedDict):
    """From which depth a cut swings at a speed of the spindle."""

    spindle_rpm: float
    """Speed of the spindle."""

    depth_mm: float | None
    """The least axial depth that swings at a speed; null where none up to 300 mm does."""

    depth_mm_p05: float | None
    """5th percentile over draws of drive stiffness and damping; null beyond 300 mm, and where teeth are counted
    one by one."""

    depth_mm_p95: float | None
    """95th percentile."""

    chatter_hz: float | None
    """The frequency of the swing at that depth."""


class ChatterDict(TypedDict):
    """What `chatter` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    tcp_m: list[float]
    """The tool point."""

    tool_mass_kg: float | None
    """Mass of the tool, where it was given: it is held against the payload, bends nothing, and lowers
    frequencies."""

    tool_com_mm: list[float] | None
    """Mass centre of the tool in the flange frame."""

    tool_inertia_kg_m2: list[float] | None
    """Inertia of the tool about its mass centre, along flange axes."""

    process: str
    """The process file."""

    spindle_rpm: float
    """Speed of the spindle."""

    cut_depth_mm: float
    """Axial depth of the cut, as the process has it."""

    entry_deg: float
    """Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns
    counter-clockwise from its right."""

    exit_deg: float
    """Where a tooth leaves."""

    method: str
    """How teeth are counted: mean (over a revolution) or teeth (one by one)."""

    critical_depth_mm: float | None
    """The least axial depth that swings with the robot at the speed of the spindle; null where none up to 300 mm
    does."""

    critical_depth_mm_p05: float | None
    """5th percentile over draws of drive stiffness and damping; null beyond 300 mm."""

    critical_depth_mm_p95: float | None
    """95th percentile; null beyond 300 mm."""

    depth_reserve: float | None
    """The least depth that swings at the speed of the spindle, in parts of that of the cut; null where none up
    to 300 mm does."""

    chatter_hz: float | None
    """The frequency of the swing at that depth."""

    tooth_phase_rad: float | None
    """By how much the swing turns from tooth to tooth; far below 1 the cut is a damper, which calms or drives."""

    any_speed_depth_mm: float | None
    """Less deep no speed swings, by the mean of the teeth, and never deeper than at the speed of the cut; null
    where none up to 300 mm does."""

    any_speed_depth_mm_p05: float | None
    """5th percentile over the same draws."""

    any_speed_depth_mm_p95: float | None
    """95th percentile."""

    any_speed_hz: float | None
    """The frequency of the swing at that depth."""

    other_way_depth_mm: float | None
    """The least axial depth that swings at the speed of the spindle where the cut is fed the other way, up for
    down; null where none up to 300 mm does."""

    other_way_hz: float | None
    """The frequency of the swing at that depth."""

    calm_rpm: list[list[float]] | None
    """Speeds of the spindle within 0.5 to 1.5 of its own at which the cut swings neither at the nominal
    stiffness and damping nor in more than 5 of 100 draws: pairs of from and to; null where teeth are counted
    one by one, of drives that are nobody's, and where a measured table decides nothing."""

    pan_depth_mm: float | None
    """The least depth at which modes couple without the delay (Pan); beside the others, never instead of them."""

    pan_hz: float | None
    """Its frequency; 0 where the arm gives way."""

    drawn: list[str]
    """What the intervals are over: drives, damping, both or neither."""

    modes_looked_at: list[float]
    """Frequencies of the robot's modes that were looked at, Hz; none where the robot is in what was measured.
    Nothing is known above the last of these and of what was measured."""

    robot_modes: str
    """Of the robot with what was measured at its tip: calm where the cut swings neither at the nominal stiffness
    and damping nor in more than 5 of 100 draws, limit where it swings at the nominal and in 95 of 100 or
    more, else not decided; not covered of a path without a cut of which anything is known."""

    spindle_modes: str
    """unknown where nothing was measured at the tip, else measured; those of the work are never looked at."""

    frf: str | None
    """The table of what was measured at the tip; null where there is none."""

    frf_on: str | None
    """What held the tip while it was measured: rigid (spindle, holder and cutter alone) or robot (it takes the
    place of the model); null without a table."""

    measured_modes: list[float] | None
    """Frequencies of the modes of the table, Hz; null without a table of modes."""

    measured_between: list[float] | None
    """From where to where the table tells frequency by frequency, Hz; null without one."""

    verdict: str
    """What is reported of robot modes and of what was measured at the tip, in words."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""

    lobes: list[Lobe]
    """By the speed of the spindle: the least depth that swings."""


class StudyRow(TypedDict):
    """One contender at one size."""

    task: str
    """The zone as it was asked for."""

    d: float
    """The size over l2 + l3."""

    mu_l3_over_l2: float | None
    """The link ratio; null where every contender has its best."""

    best: bool
    """The link ratio is the best."""

    architecture: str
    """serial or quasi-serial."""

    k2: float
    """Compliance of drive 2 over the reference."""

    k3: float
    """Compliance of drive 3 over the reference."""

    accuracy: float | None
    """The worst deflection over k F (l2 + l3)^2; null where the zone does not fit."""


class Boundary(TypedDict):
    """A size at which the better one changes."""

    task: str
    """The zone as it was asked for."""

    mu_l3_over_l2: float | None
    """The link ratio; null where every contender has its best."""

    d: float
    """The size over l2 + l3."""

    better_below: str
    """The better contender for smaller tasks."""

    better_above: str
    """The better contender for larger tasks."""


class StudyMark(TypedDict):
    """A robot with its task among what was studied."""

    robot: str
    """The maker's name for the robot."""

    task: str
    """The zone as it was asked for."""

    mu_l3_over_l2: float
    """The link ratio; null where every contender has its best."""

    d: float
    """The size over l2 + l3."""

    accuracies: list[float | None]
    """What either contender would have there; null where the task does not fit."""

    stiffer: str | None
    """The contender that has less."""


class StudyDict(TypedDict):
    """What `study` answers."""

    schema: Schema

    rows: list[StudyRow]
    """One entry per row."""

    boundaries: list[Boundary]
    """Sizes at which the better architecture changes."""

    mark: StudyMark | None
    """Where the robot with its task stands among what was studied."""


class ComparisonDict(TypedDict):
    """What `compare` answers."""

    schema: Schema

    a: Placed
    """The first setup, as place tells it."""

    b: Placed
    """The second setup."""

    ratio: float | None
    """The deflection of the second over that of the first; null where one has no place."""

    told_apart: bool
    """It is proved that no other is as good, at the nominal stiffness."""

    better: str | None
    """Which of the two is better, a or b, which is proved at the nominal stiffness; null where they cannot be
    distinguished."""

    win_probability: list[float | None] | None
    """In which share of the draws of the drive stiffness it has the least deflection, of each task; null where
    it has no place, is estimated, is not to be taken (its arm collides, it carries more than it may), or the
    uncertainty of its drives is not known."""

    differ_in: list[str]
    """What is not the same of both besides the answer: robot, stiffness, model, tool, tool mass, tool direction,
    force, component, task, tolerance, margins, mount, allowed place, angle, gap."""

    summary: list[str]
    """What a manager would read."""


class ForceDict(TypedDict):
    """What `force` answers."""

    schema: Schema

    process: str
    """The process file."""

    law: str
    """Where the force comes from."""

    material: str | None
    """The material whose numbers come with the program; null where they are given."""

    material_status: str | None
    """How well its numbers are known: published or unverified."""

    material_source: str | None
    """Who says so."""

    mean_n: list[float] | None
    """Mean force over a revolution, on the tool: along the feed, across (left of it), axial (away from the
    work); null where it may point anywhere."""

    max_n: list[float] | None
    """The largest of each over a revolution."""

    min_n: list[float] | None
    """The smallest of each over a revolution."""

    largest_n: float
    """The largest size of the force over a revolution."""

    moment_nm: float
    """Mean moment on the tool about its axis, positive about the axis away from the work."""

    power_w: float | None
    """Mean power of the spindle; null where its speed or the moment is not known."""

    spindle_rpm: float | None
    """Speed of the spindle."""

    entry_deg: float | None
    """Where a tooth enters, in the sense of the rotation from the left of the feed, of a spindle that turns
    counter-clockwise from its right."""

    exit_deg: float | None
    """Where a tooth leaves."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""


class ToolpathDict(TypedDict):
    """What `mill --dry` answers."""

    schema: Schema

    path: str
    """The toolpath as it was asked for."""

    format: str
    """How it is written: gcode, apt, csv or built-in."""

    lines: int | None
    """Lines that were read."""

    feed_length_m: float
    """Length of all moves at a feed rate."""

    rapid_length_m: float
    """Length of all rapid moves whose beginning is known."""

    feed_moves: int
    """Moves at a feed rate."""

    rapid_moves: int
    """Rapid moves whose beginning is known."""

    tools: list[int | None]
    """Numbers of the tools that feed, in the order in which they come; null where none is named."""

    machine_moves: int
    """Moves that are no part of the path: from where the file does not tell, or by coordinates of the machine."""

    arcs: int
    """Feed moves that are arcs or helices."""

    full_circles: int
    """Of these, those of a whole turn or more."""

    arc_length_m: float
    """Length of the arcs."""

    box_m: list[list[float]] | None
    """Two corners of the box about all feed moves, in the axes of the path."""

    rapid_box_m: list[list[float]] | None
    """Two corners of the box about the ends of all rapid moves whose beginning is known, in the axes of the
    path; null where there is none."""

    feed_mm_per_min: list[float] | None
    """The smallest and the largest feed rate; null where none is said."""

    time_s: float | None
    """Time of all feed moves; null where a feed rate is missing."""

    spindle_speeds_rpm: list[float] | None
    """The slowest and the fastest that the spindle turns while it feeds; null where it is not said."""

    tilt_deg: float
    """The largest angle between tool axis and z while it feeds."""

    turn_deg: float
    """The largest angle of the tool axis to where it first feeds."""

    samples: int
    """Samples along the path."""

    chord_error_mm: float
    """By how much chords between samples are off the arcs at most."""

    arc_miss_mm: float
    """By how much the ends of an arc miss one radius at most."""

    assumed: list[str]
    """What the file leaves open and how it was taken, with the line that came first."""

    ignored: list[str]
    """Words of the file that move nothing, each kind once."""


class ExpectedDrive(TypedDict):
    """How well a drive will be known."""

    drive: int
    """Which drive, from 1."""

    compliance_urad_per_nm: float
    """The compliance found; null where it is not seen."""

    standard_error_urad_per_nm: float | None
    """The larger of that from the scatter of all remainders and that from leaving out each posture."""


class MeasurementRun(TypedDict):
    """A posture and a load."""

    run: int
    """Its number, from 1."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""

    load: str
    """In which direction is loaded."""

    force_n: list[float]
    """The force at the tool point, base axes: as given, or of those that it may be the one that does most."""

    expected_mm: float
    """How far the marker is expected to move."""


class ComparedTable(TypedDict):
    """What a table of one's own is worth."""

    file: str
    """The table."""

    runs: int
    """How many runs it has."""

    value: float
    """By the criterion: mean variance of the displacement under 1 N over the work, (um/N)^2, or a variance in
    parts of the compliances."""

    efficiency: float
    """The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of
    what no measurement takes away."""


class MeasurementPlanDict(TypedDict):
    """What `measure` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    architecture: str
    """serial or quasi-serial."""

    architecture_assumed: bool
    """Nothing says that it is of this architecture."""

    status: str
    """How well the robot's numbers are known."""

    stiffness_source: str
    """Who says how stiff the drives are: assumed, prior, published, robot file, identified or given."""

    drive_urad_per_nm: list[float | None]
    """The compliance of each drive; null where a robot of two links has none."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    criterion: str
    """What a plan is judged by."""

    value: float
    """By the criterion: mean variance of the displacement under 1 N over the work, (um/N)^2, or a variance in
    parts of the compliances."""

    lower_bound: float
    """No plan of so many runs of the candidates has less."""

    efficiency: float
    """The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of
    what no measurement takes away."""

    random_efficiency: float | None
    """The same of the median random choice; null where that leaves some drive unseen."""

    candidates: int
    """Among so many was chosen."""

    drives: list[ExpectedDrive]
    """One entry per drive."""

    unseen_drives: list[int]
    """Drives that no candidate shows."""

    unseen_share: float
    """What part of the variance of the prediction is the prior of these drives."""

    advised_loads: list[str]
    """Directions of loads that show them, where some do."""

    runs: list[MeasurementRun]
    """One entry per run, in the order in which they are made."""

    compared: ComparedTable | None
    """What the table that was given is worth."""


class PlannedAtWork(TypedDict):
    """The error that a calibration leaves at the work."""

    expected_mm: float
    """Root mean square of the error that remains at the work, where it is found by the tracker; in a plan that
    of its first point."""

    lower_bound_mm: float
    """No choice of as many of the candidates leaves less."""

    random_mm: float
    """What the median random choice leaves."""

    as_drawn_mm: float
    """Without a calibration."""

    unexplained_mm: float
    """The part of all of these that no error of the arm explains, and no calibration takes away."""

    postures: int
    """Postures over which it is computed."""


class CalibrationLeaves(TypedDict):
    """What so many postures leave."""

    postures: int
    """So many."""

    expected_mm: float
    """Root mean square of the error that remains at the work, where it is found by the tracker; in a plan that
    of its first point."""


class PlannedPosture(TypedDict):
    """A posture in which points are measured."""

    run: int
    """Its number, from 1."""

    joints_deg: list[float]
    """Joint angles as the robot reports them, deg."""


class CalibrationPlanDict(TypedDict):
    """What `measure --geometry` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    pendant: str
    """Whether the pendant shows the joints so: as-file (published), verified (read on the robot), given (by
    whoever asks), unknown."""

    points_mm: list[list[float]]
    """The points that were looked at, in the flange frame, mm."""

    at_work: PlannedAtWork
    """The error that remains at the work: expected, with its interval, and over how many postures; null where
    the arm does not reach it."""

    efficiency: float
    """The bound over the value: 1 is proved best. Of a plan with --geometry both are squared, less the square of
    what no measurement takes away."""

    random_efficiency: float
    """The same of the median random choice; null where that leaves some drive unseen."""

    candidates: int
    """Among so many was chosen."""

    by_count: list[CalibrationLeaves]
    """What so many postures leave, each chosen after those before."""

    runs: list[PlannedPosture]
    """One entry per run, in the order in which they are made."""


class IdentifiedDrive(TypedDict):
    """What is found of a drive."""

    drive: int
    """Which drive, from 1."""

    compliance_urad_per_nm: float | None
    """The compliance found; null where it is not seen."""

    standard_error_urad_per_nm: float | None
    """The larger of that from the scatter of all remainders and that from leaving out each posture."""

    ci95_urad_per_nm: list[float] | None
    """Where it lies with 95 %."""

    stiffness_nm_per_rad: float | None
    """One over the compliance found."""

    robust_urad_per_nm: float | None
    """The compliance by Huber's estimate."""

    identified: bool
    """The measurements show it, to half of itself or better."""

    why_not: str | None
    """Why they do not."""

    used_urad_per_nm: float
    """What the robot file has: found with all that is not identified held, or as it was before."""


class FurtherSpring(TypedDict):
    """What is found of what springs besides the drives."""

    spring: str
    """Its name."""

    joint_2_deg: list[float] | None
    """Where joint 2 stood, as reported, deg; null of what is no region of joint 2."""

    compliance_urad_per_nm: float | None
    """The compliance found; null where it is not seen."""

    standard_error_urad_per_nm: float | None
    """The larger of that from the scatter of all remainders and that from leaving out each posture."""

    ci95_urad_per_nm: list[float] | None
    """Where it lies with 95 %."""

    stiffness_nm_per_rad: float | None
    """One over the compliance found."""

    robust_urad_per_nm: float | None
    """The compliance by Huber's estimate."""

    identified: bool
    """The measurements show it, to half of itself or better."""

    why_not: str | None
    """Why they do not."""

    used_urad_per_nm: float
    """What the robot file has: found with all that is not identified held, or as it was before."""


class FoundCompensator(TypedDict):
    """What is found of a gravity compensator."""

    spring: str
    """Its name."""

    unit: str
    """The unit of its numbers."""

    found: float | None
    """What is found; null where it is not seen."""

    standard_error: float | None
    """Its standard error."""

    ci95: list[float] | None
    """Where it lies with 95 %."""

    identified: bool
    """The measurements show it, to half of itself or better."""

    why_not: str | None
    """Why they do not."""

    used: float
    """What the robot file has."""


class UpdatedDrive(TypedDict):
    """What measurements make of the prior of a drive."""

    drive: int
    """Which drive, from 1."""

    prior_urad_per_nm: float
    """Median of the prior."""

    prior_sd_ln: float
    """Standard deviation of its logarithm."""

    posterior_urad_per_nm: float
    """Where the posterior of its logarithm is densest; the interval is that of the normal distribution about it
    (Laplace)."""

    posterior_sd_ln: float
    """Standard deviation of its logarithm."""

    ci95_urad_per_nm: list[float]
    """Where it lies with 95 %."""

    moved_sd: float
    """How far the measurements moved it, in standard deviations of the prior."""

    learned: float
    """What part of the variance of the prior the measurements took away."""

    shown: bool
    """The measurements tell more of it than the prior, and it is known to half of itself."""


class TriedModel(TypedDict):
    """A model that was tried."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    rms_left_out_mm: float | None
    """The same of each posture by the others; null where a posture alone shows some drive."""

    bic: float | None
    """Schwarz's criterion; less is better."""

    why_not: str | None
    """Why they do not."""


class ReadingRemainder(TypedDict):
    """What remains of a row of the measurements."""

    row: int
    """Its number, from 1."""

    posture: int
    """Its posture, from 1."""

    measured_mm: list[float]
    """The displacement along base axes."""

    remains_mm: list[float]
    """What the compliances found leave of it."""

    left_out_mm: float | None
    """Length of what those leave that are found without its posture."""

    sigmas: float
    """What Huber's estimate leaves of it, in standard deviations of a coordinate."""


class IdentificationDict(TypedDict):
    """What `identify` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    date: str | None
    """When was measured."""

    fit: str
    """least-squares or huber."""

    postures: int
    """How many postures."""

    readings: int
    """How many rows."""

    model: str
    """planar or spatial; of an identification what springs: drives, base, tool or base-and-tool."""

    drives: list[IdentifiedDrive]
    """One entry per drive."""

    springs: list[FurtherSpring]
    """What springs besides the drives."""

    compensator: list[FoundCompensator]
    """What is found of a gravity compensator: its spring, and its preload."""

    posterior: list[UpdatedDrive] | None
    """What the measurements make of the prior, drive by drive; null where that was not asked for."""

    models: list[TriedModel]
    """The models that were tried."""

    rms_before_mm: float
    """How far a coordinate moved, root mean square."""

    rms_after_mm: float
    """What the compliances found leave of that."""

    rms_left_out_mm: float | None
    """The same of each posture by the others; null where a posture alone shows some drive."""

    rms_used_mm: float
    """What the compliances of the robot file leave of that."""

    explained: float
    """1 - rms after / rms before."""

    explained_left_out: float | None
    """The same of each posture by the others."""

    noise_ratio: float | None
    """How many times the noise that the table tells the remainders are."""

    condition: float | None
    """The largest singular value over the smallest; null where some drive is not seen."""

    singular_values: list[float]
    """Of all rows, mm per urad/(N m), descending."""

    least_seen: list[float]
    """The combination of drives that is seen worst; its squares add up to 1."""

    correlation: list[list[float]]
    """Correlation of the compliances found."""

    outliers: list[int]
    """Rows that do not fit, from 1, the worst first."""

    residuals: list[ReadingRemainder]
    """What remains of every row."""

    remarks: list[str]
    """What is odd."""


class LevelFit(TypedDict):
    """What a level leaves."""

    level: str
    """How much of the arm may differ from its drawing: zeros, geometry, weight, gears; of a list also as drawn."""

    own_weight: str | None
    """How the own weight is computed: `terms` of the joint angles, or `masses` of the robot file, with the
    compliance of each drive (`drives`) as all that is unknown; null of levels without it."""

    rms_mm: float
    """The root mean square of these distances."""

    median_mm: float
    """Median of the distances."""

    p95_mm: float
    """95th percentile of the distances."""

    largest_mm: float
    """The largest distance between what was read and what the file says."""

    left_out_rms_mm: float | None
    """Root mean square of the distances that are predicted where a third of a joint's range is left out; null
    where none can be."""

    shown: float
    """How many parameters the rows show: the trace of one less posterior over prior."""

    log_evidence: float
    """Logarithm of the marginal likelihood, up to what all levels share."""


class WrongRow(TypedDict):
    """A point that was left out."""

    line: int
    """From 1."""

    point: int
    """Which point of the row, from 1; 0 is all of it."""

    distance_mm: float
    """How far it is off."""


class NarrowJoint(TypedDict):
    """A joint that moved over less than a third of its range."""

    joint: int
    """Which joint, from 1."""

    share: float
    """Over which part of its range it moved."""


class CalibratedAtWork(TypedDict):
    """The error that remains at the work."""

    expected_mm: float
    """Root mean square of the error that remains at the work, where it is found by the tracker; in a plan that
    of its first point."""

    ci95_mm: list[float]
    """Where that root mean square lies with 95 %."""

    work_p95_mm: float
    """95th percentile of the error at the work."""

    postures: int
    """Postures over which it is computed."""


class CalibrationDict(TypedDict):
    """What `calibrate` answers."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    level: str
    """How much of the arm may differ from its drawing: zeros, geometry, weight, gears; of a list also as drawn."""

    own_weight: str | None
    """How the own weight is computed: `terms` of the joint angles, or `masses` of the robot file, with the
    compliance of each drive (`drives`) as all that is unknown; null of levels without it."""

    rows: int
    """Postures that were read."""

    nominal_rms_mm: float
    """Root mean square of the distances of the arm as drawn."""

    sigma_mm: float
    """Standard deviation of a coordinate of a reading about the level taken; of single points with how the arm
    repeats a posture."""

    posture_sigma_mm: float | None
    """The same of where the arm stands at a posture, which all of its points share; null of single points, of
    which nothing tells it from `sigma_mm`."""

    levels: list[LevelFit]
    """Every level: what it leaves."""

    wrong_rows: list[WrongRow]
    """Points that were left out: line of the file, point (0: all of the row) and distance, mm."""

    tracker_in_base: list[list[float]]
    """Each stand of the tracker in the base: x, y, z mm and turns about fixed x, y, z deg."""

    points_mm: list[list[float]]
    """The points that were looked at, in the flange frame, mm."""

    zero_deg: list[float]
    """What is to be added to each reported angle."""

    frames_mm_mrad: list[list[float]]
    """Of each joint's frame three shifts, mm, and three turns, mrad, in the base's axes at model zero; the zeros
    are left out."""

    weight_mrad: list[float] | None
    """How drives yield under the arm's own weight, null where it is that of masses: of drive 2 on sin t2, cos
    t2, sin t23, cos t23, of drive 3 on sin t23, cos t23, of drive 5 on two arms of the tool."""

    weight_ci95_mrad: list[list[float]] | None
    """Where each lies with 95 %."""

    drives: list[UpdatedDrive] | None
    """One entry per drive."""

    gears_mrad: list[list[float]]
    """Once per turn of each joint: sine, cosine."""

    narrow: list[NarrowJoint]
    """Joints that moved over less than a third of their range, with that share."""

    at_work: CalibratedAtWork | None
    """The error that remains at the work: expected, with its interval, and over how many postures; null where
    the arm does not reach it."""


class WayOfCounting(TypedDict):
    """A way of counting the joints."""

    robot: str
    """The maker's name for the robot."""

    vendor: str
    """The maker."""

    third_axis: str
    """What joint 3 counts from: elbow, the upper arm; forearm, the horizontal."""

    sign: list[float]
    """Of each joint, as in a robot file."""

    zero_deg: list[float]
    """Zero offset of each joint, as a robot file has it."""

    carried: list[float]
    """By how much joints of the wrist carry others along: 4 turns 5, 4 turns 6, 5 turns 6."""

    rms_mm: float
    """The root mean square of these distances."""

    largest_mm: float
    """The largest distance between what was read and what the file says."""

    largest_deg: float | None
    """The largest turn between orientations; null where none was read."""

    differs: str
    """The same in a line."""

    differences: list[str]
    """In what it differs from its robot file, in words."""


class WrongReading(TypedDict):
    """The row that does not agree."""

    line: int
    """From 1."""

    distance_mm: float
    """How far it is off."""


class VerificationDict(TypedDict):
    """What `robots verify` answers of a robot."""

    schema: Schema

    robot: str
    """The maker's name for the robot."""

    verified: bool
    """The readings agree with the robot file, and with no other way of counting the joints."""

    rows: int
    """Postures that were read."""

    measured: bool
    """Points were measured by an instrument; else the controller computed them."""

    largest_mm: float
    """The largest distance between what was read and what the file says."""

    rms_mm: float
    """The root mean square of these distances."""

    largest_deg: float | None
    """The largest turn between orientations; null where none was read."""

    base_mm_deg: list[list[float]]
    """The base of the robot file in the frame of the readings: x, y, z mm and turns about fixed x, y, z deg; one
    for each stand."""

    points_mm: list[list[float]]
    """The points that were looked at, in the flange frame, mm."""

    fits: list[WayOfCounting]
    """Robots and ways of counting the joints, the best first."""

    alike: list[str]
    """What the readings do not tell apart, in words."""

    zeros_not_seen: list[int]
    """Joints whose zeros were not looked at, as a base or a tool that is fitted takes them up."""

    postures_deg: list[list[float]]
    """Postures that would tell it apart: joint angles."""

    wrong_row: WrongReading | None
    """The row that is off where all others agree: its line in the file and its distance, mm; null where there is
    none."""


class FittingRobotsDict(TypedDict):
    """What `robots verify` answers without a robot."""

    schema: Schema

    verified: bool
    """The readings agree with the robot file, and with no other way of counting the joints."""

    rows: int
    """Postures that were read."""

    fits: list[WayOfCounting]
    """Robots and ways of counting the joints, the best first."""


class PublishedNumber(TypedDict):
    """A published number."""

    source: str
    """Where it is published."""

    item: str
    """What it is of."""

    cell: str
    """Which number."""

    printed: str
    """As it is printed."""

    computed: float | None
    """As it is computed."""

    agrees: bool
    """The two agree to the digits that are printed."""

    note: str | None
    """Why they do not."""


class LedgerDict(TypedDict):
    """What `validate` answers."""

    schema: Schema

    rows: list[PublishedNumber]
    """One entry per row."""
