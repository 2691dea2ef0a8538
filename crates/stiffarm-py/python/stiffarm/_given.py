"""What was given, read: arguments of any type to numbers and texts, or the package's error that names the argument."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Union

import numpy as np
import numpy.typing as npt

from . import _stiffarm
from ._stiffarm import Robot, StiffarmError

Array = npt.NDArray[np.float64]

#: A robot, its name in the catalogue, or the path of its file.
RobotLike = Union[Robot, str, "os.PathLike[str]"]
#: Both ends, None for an open one, or such as ``"0.5..2"``.
RangeLike = Union[str, Sequence[Union[float, None]]]


def number(name: str, value: object) -> float:
    """One number."""
    _refuse_masked(name, value)
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError) as error:
        raise StiffarmError(f"{name}: {error}; expected a number") from None


def whole(name: str, value: object, least: int, most: int) -> int:
    """One whole number, of whichever type."""
    expected = f"expected a whole number from {least} to {most}"
    if isinstance(value, (bool, np.bool_)):
        raise StiffarmError(f"{name}={value}; {expected}")
    try:
        found = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise StiffarmError(f"{name}={_short(value)}; {expected}") from None
    if not least <= found <= most:
        raise StiffarmError(f"{name}={_short(found)}; {expected}")
    return found


def truth(name: str, value: object) -> bool:
    """Yes or no."""
    if not isinstance(value, (bool, np.bool_)):
        raise StiffarmError(f"{name}={_short(value)}; expected True or False")
    return bool(value)


def numbers(name: str, values: object) -> Array:
    """Float64 in one aligned piece; copied only where it is not that already."""
    _refuse_masked(name, values)
    try:
        array = np.asarray(values)
    except (TypeError, ValueError, OverflowError) as error:
        raise StiffarmError(f"{name}: {error}") from None
    if array.dtype.kind not in "fiu" and array.size:
        raise StiffarmError(f"{name} of type {array.dtype}; expected numbers")
    return np.require(array, np.float64, ["C", "ALIGNED"])


def row(name: str, values: object) -> list[float]:
    """One number or several."""
    if isinstance(values, Iterable) and not isinstance(values, (str, bytes, Mapping, np.ndarray)):
        values = list(values)
    found = np.atleast_1d(numbers(name, values))
    if found.ndim != 1:
        raise StiffarmError(f"{name} of shape {found.shape}; expected numbers in a row")
    return [float(value) for value in found]


def spelt(value: float) -> str:
    """A number as one types it: 300, and not 300.0; none of its digits is lost."""
    return repr(value).removesuffix(".0")


def joints(values: object) -> str:
    """Six angles as the command line spells them."""
    return ",".join(spelt(angle) for angle in row("joints_deg", values))


def text(name: str, value: object) -> str:
    if not isinstance(value, str):
        raise StiffarmError(f"{name}={_short(value)}; expected a text")
    return value


def texts(name: str, value: object) -> list[str]:
    """One text or several."""
    items = [value] if isinstance(value, str) else value
    if not isinstance(items, Iterable):
        raise StiffarmError(f"{name}={_short(value)}; expected a text, or several")
    return [text(name, item) for item in items]


def listed(name: str, value: object) -> str | None:
    """Texts with commas between, as the command line spells them; None where there are none."""
    return ",".join(texts(name, value)) or None


def files(value: object) -> object:
    """Paths as texts, wherever they stand."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return {key: files(of) for key, of in value.items()}
    if isinstance(value, Iterable) and not isinstance(value, str):
        return [files(item) for item in value]
    return value


def of_tools(name: str, value: object) -> str | None:
    """What each tool of a path has, by its number, 1 or "T1"; as texts ``T1=...``, or one for all."""
    if isinstance(value, Mapping):
        value = [f"T{str(tool).removeprefix('T')}={of}" for tool, of in value.items()]
    return listed(name, value)


def tasks(value: object) -> list[str]:
    """Tasks by their notation; a text may be a list with commas."""
    return [part.strip() for given in texts("tasks", value) for part in given.split(",")]


def path(name: str, value: object) -> Path:
    try:
        return Path(value)  # type: ignore[arg-type]
    except TypeError:
        raise StiffarmError(f"{name}={_short(value)}; expected a path") from None


def table(name: str, value: object) -> tuple[str, str | None]:
    """The name of a table, and its text where it is none of a file."""
    for method, options in (("to_csv", {"index": False}), ("write_csv", {})):
        write = getattr(value, method, None)
        if write is not None:
            return "the data frame", str(write(**options))
    return str(path(name, value)), None


def between(name: str, value: RangeLike | None) -> str | None:
    """A range, as the command line spells it."""
    if value is None or isinstance(value, str):
        return value
    try:
        low, high = value
    except (TypeError, ValueError):
        raise StiffarmError(f"{name}: {_short(value)} is not a range; expected both ends, None for an open one") from None
    ends = [None if end is None else number(name, end) for end in (low, high)]
    return "..".join("" if end is None or abs(end) == float("inf") else spelt(end) for end in ends)


def within(value: str | Sequence[RangeLike | None] | None) -> str | None:
    """The ranges of x and z, or of x, y and z, or several windows as texts, as the command line spells them."""
    if value is None or isinstance(value, str):
        return value
    try:
        parts = list(value)
    except TypeError:
        parts = []
    if parts and all(isinstance(part, str) and "," in part for part in parts):
        return ";".join(str(part) for part in parts)
    if len(parts) not in (2, 3):
        raise StiffarmError(f"within_m={_short(value)}; expected two ranges, ((x0, x1), (z0, z1)), or three with y")
    return ",".join(between("within_m", part) or ".." for part in parts)


def blocks(name: str, value: str | Iterable[str | Sequence[RangeLike | None]]) -> str:
    """Boxes of three ranges each, as the command line spells them."""
    if isinstance(value, str):
        return value
    expected = f"{name}={_short(value)}; expected boxes, [((x0, x1), (y0, y1), (z0, z1)), ...]"
    try:
        boxes = [box if isinstance(box, str) else list(box) for box in value]
    except TypeError:
        raise StiffarmError(expected) from None
    if any(not isinstance(box, str) and len(box) != 3 for box in boxes):
        raise StiffarmError(expected)
    return ";".join(box if isinstance(box, str) else ",".join(between(name, part) or ".." for part in box) for box in boxes)


def robot(value: RobotLike) -> Robot:
    return value if isinstance(value, Robot) else Robot(value)


def named(name: str, value: RobotLike) -> Robot | str:
    """A robot, or its name or path, which the library follows itself: so it knows the file."""
    if isinstance(value, Robot):
        return value
    return text(name, os.fspath(value) if isinstance(value, os.PathLike) else value)


def named_robots(value: RobotLike | Iterable[RobotLike]) -> list[Robot | str]:
    """The same of several: names, patterns, paths, sets. What a list with commas would part is read here."""
    several = [named("robots", item) for item in each_robot(value)]
    if not several:
        raise StiffarmError("robots: none is given; expected a Robot, its name or the path of its file, or several")
    return [Robot(item) if isinstance(item, str) and "," in item else item for item in several]


def robots(value: RobotLike | Iterable[RobotLike]) -> list[Robot]:
    """Each once, in the order given; a text may be a name, a pattern, a path, a list with commas, ``paper`` or ``all``."""
    found: dict[Robot, None] = {}
    for item in each_robot(value):
        found.update({item: None} if isinstance(item, Robot) else dict.fromkeys(_stiffarm.select(os.fspath(item))))
    return list(found)


def each_robot(value: RobotLike | Iterable[RobotLike]) -> list[RobotLike]:
    """What was given, one by one: robots, names, paths."""
    expected = "expected a Robot, its name or the path of its file, or several"
    items = [value] if isinstance(value, (Robot, str, os.PathLike)) else value
    if not isinstance(items, Iterable):
        raise StiffarmError(f"robots={_short(value)}; {expected}")
    found: list[RobotLike] = []
    for item in items:
        if isinstance(item, str):
            found += [name.strip() for name in item.split(",")]
        elif isinstance(item, (Robot, os.PathLike)):
            found.append(item)
        else:
            raise StiffarmError(f"{_short(item)} among the robots; {expected}")
    return found


def _refuse_masked(name: str, values: object) -> None:
    among = isinstance(values, (list, tuple)) and any(value is np.ma.masked for value in values)
    if among or np.ma.is_masked(values):
        raise StiffarmError(f"{name}: numbers are masked; fill them, or leave them out")


def _short(value: object) -> str:
    """A value in few words; a number of many digits has none."""
    try:
        words = repr(value)
    except ValueError:
        words = ""
    return words if 0 < len(words) <= 60 else f"<{type(value).__name__}>"
