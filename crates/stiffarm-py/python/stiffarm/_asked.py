"""One question to the library: what it names goes with it, and its answer comes back in every form that is wanted."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Union

from . import _given, _stiffarm
from ._progress import ProgressLike, reporting
from ._stiffarm import Robot, StiffarmError
from ._whole import written_whole

#: Files to which an answer is written as well; the ending chooses the form.
OutputLike = Union[str, "os.PathLike[str]", Iterable[Union[str, "os.PathLike[str]"]], None]


class Question(NamedTuple):
    """A verb, its options as the command line spells them, and the robots and texts that they name."""

    verb: str
    given: list[tuple[str, str]]
    robots: list[tuple[str, Robot]]
    texts: dict[str, str]

    def with_given(self, **given: str) -> Question:
        """The same question with other values of some options."""
        return self._replace(given=[pair for pair in self.given if pair[0] not in given] + list(given.items()))

    def without(self, *keywords: str) -> Question:
        """The same question without some options."""
        return self._replace(given=[pair for pair in self.given if pair[0] not in keywords])


class Wanted(NamedTuple):
    """What is wanted of an answer besides its keys and columns."""

    #: Names whose endings say in which further forms.
    forms: Sequence[str] = ()
    #: Files that will be written.
    written: Sequence[str] = ()
    #: What would keep a tolerance.
    advice: bool = True
    #: What a figure shows, with so many points along the longer side of its map.
    points: int | None = None


class _Named:
    """Robots under names that mean one robot each, and can stand in a list with commas."""

    def __init__(self, taken: Iterable[str]) -> None:
        self.robots: dict[str, Robot] = {}
        #: What means a file or a robot of the catalogue.
        self._taken = set(taken)

    def name(self, robot: Robot) -> str:
        plain = robot.name.replace(",", ";").strip() or "robot"
        name, count = plain, 1
        while name in self._taken or self.robots.setdefault(name, robot) != robot:
            count += 1
            name = f"{plain} ({count})"
        return name


def question(
    verb: str,
    given: Mapping[str, str],
    *,
    texts: Mapping[str, str] | None = None,
    **named: Robot | str | Sequence[Robot | str] | None,
) -> Question:
    """A question; `named` are options that take robots, or texts as they are; None is not given."""
    several = {keyword: [value] if isinstance(value, (Robot, str)) else value or [] for keyword, value in named.items()}
    names = _Named(value for values in several.values() for value in values if isinstance(value, str))
    pairs = [
        (keyword, names.name(value) if isinstance(value, Robot) else value) for keyword, values in several.items() for value in values
    ]
    return Question(verb, [*pairs, *given.items()], list(names.robots.items()), dict(texts or {}))


def answered(
    asked: Question, doing: str, *, output: OutputLike = None, advice: bool = True, points: int | None = None, progress: ProgressLike = None
) -> dict[str, Any]:
    """The answer, written to files as well."""
    files = _files(output)
    wanted = Wanted([str(file) for file in files], [str(file) for file in files], advice, points)
    with reporting(doing, progress) as tell:
        reply = _stiffarm.answered(asked, wanted, tell)
    for file, text in zip(files, reply["files"]):
        written(file, text)
    return reply


def placed(robot: Robot, task: str, options: Mapping[str, str]) -> dict[str, Any]:
    """One placement without advice."""
    asked = question("place", {"task": task, **options}, robot=robot)
    found: dict[str, Any] = answered(asked, "searching places", advice=False)["answer"]
    return found


def text(asked: Question, name: str) -> str:
    """The answer in the form that a name asks for."""
    (found,) = _stiffarm.answered(asked, Wanted([name]))["files"]
    return str(found, "utf-8")


def _files(output: OutputLike) -> list[Path]:
    """Files that can be written, each once; no answer is computed for one that cannot."""
    if output is None:
        return []
    several = [output] if isinstance(output, (str, os.PathLike)) or not isinstance(output, Iterable) else output
    files = [_given.path("output", one) for one in several]
    for file in files:
        if not file.absolute().parent.is_dir():
            raise StiffarmError(f"cannot write {file}: there is no folder {file.absolute().parent}")
        if file.is_dir():
            raise StiffarmError(f"cannot write {file}: it is a folder")
        if not os.access(file.absolute().parent, os.W_OK):
            raise StiffarmError(f"cannot write {file}: its folder may not be written to")
    if len({file.resolve() for file in files}) < len(files):
        raise StiffarmError("output names one file twice")
    return files


def written(file: Path, text: bytes) -> None:
    """Whole or not at all."""
    try:
        written_whole(file.resolve(), text)
    except OSError as error:
        raise StiffarmError(f"cannot write {file}: {error.strerror or error}") from None
