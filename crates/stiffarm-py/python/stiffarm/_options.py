"""The options of the verbs, from the library's table: their signatures, their help, and how their values are spelt."""

from __future__ import annotations

import difflib
import functools
import inspect
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple, TypeVar

from . import _given, _stiffarm

F = TypeVar("F", bound=Callable[..., Any])


class Option(NamedTuple):
    """A row of the table."""

    keyword: str
    #: What it takes: ``number``, ``word``, ``within``.
    kind: str
    #: Of a whole number.
    bounds: tuple[int, int] | None
    is_list: bool
    #: As it is typed.
    default: str | None
    is_required: bool
    help: str

    @property
    def value(self) -> object:
        """The default as a value of Python."""
        if self.default is None:
            return None
        parts = self.default.split(",") if self.is_list else [self.default]
        if self.kind == "flag":
            return self.default == "true"
        values = [float(part) if self.kind in ("number", "force") else int(part) if self.kind == "whole" else part for part in parts]
        return values[0] if len(values) == 1 else tuple(values)


@functools.lru_cache(maxsize=None)
def table(verb: str) -> dict[str, Option]:
    """The options of a verb by their keywords, in the order of help."""
    return {row[0]: Option(*row) for row in _stiffarm.options(verb)}


def spelt(verb: str, given: Mapping[str, object]) -> dict[str, str]:
    """What was given, as the command line spells it; None is not given."""
    known = table(verb)
    for keyword in given:
        if keyword not in known:
            near = difflib.get_close_matches(keyword, known, 1)
            hint = f"; did you mean {near[0]}?" if near else ""
            raise TypeError(f"{verb.split()[-1]}() got an unexpected keyword argument {keyword!r}{hint}")
    texts = {keyword: _text(known[keyword], value) for keyword, value in given.items() if value is not None}
    return {keyword: text for keyword, text in texts.items() if text is not None}


def _text(option: Option, value: object) -> str | None:
    name, kind = option.keyword, option.kind
    if kind in ("file", "fileoftool"):
        value = _given.files(value)
    if kind in ("fileoftool", "lengthoftool"):
        return _given.of_tools(name, value)
    if kind == "range":
        ends: Any = value
        return _given.between(name, ends)
    if kind == "within":
        ranges: Any = value
        return _given.within(ranges)
    if kind == "block":
        boxes: Any = value
        return _given.blocks(name, boxes)
    if kind == "way":
        return ",".join(_given.texts(name, value)) or None
    if kind == "marker":
        return ";".join(_given.texts(name, value)) or None
    if kind == "heading":
        pairs: Any = [f"{name}={heading}" for name, heading in value.items()] if isinstance(value, Mapping) else value
        return _given.listed(name, pairs)
    if kind == "flag":
        return str(_given.truth(name, value)).lower()
    if kind in ("text", "file", "date", "word", "robot", "task", "zone", "shape", "posture", "mount", "pin"):
        return _given.listed(name, value) if option.is_list else _given.text(name, value)
    if isinstance(value, str):
        return value
    if option.bounds is not None:
        return str(_given.whole(name, value, *option.bounds))
    if isinstance(value, bool):
        return str(value).lower()
    if kind != "number" and isinstance(value, Iterable) or option.is_list:
        return ",".join(_given.spelt(part) for part in _given.row(name, value))
    return _given.spelt(_given.number(name, value))


class _Type:
    """A type as it is written: evaluated, such as an array_like would fill lines of help."""

    def __init__(self, written: str) -> None:
        self._written = written

    def __repr__(self) -> str:
        return self._written


def takes(verb: str, options: type) -> Callable[[F], F]:
    """Gives a function that takes ``**options`` of a verb their names, types and defaults, for all to see.

    ``{options}`` in its docstring becomes their help.
    """

    def give(function: F) -> F:
        signature = inspect.signature(function)
        own = [one for one in signature.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
        types = {keyword: kind.__forward_arg__ for keyword, kind in options.__annotations__.items()}
        rows = [row for keyword, row in table(verb).items() if keyword in types]
        keywords = [
            inspect.Parameter(row.keyword, inspect.Parameter.KEYWORD_ONLY, default=row.value, annotation=_Type(types[row.keyword]))
            for row in rows
        ]
        last = [one for one in own if one.name == "progress"]
        first = [one for one in own if one.name != "progress"]
        function.__signature__ = signature.replace(parameters=[*first, *keywords, *last])  # type: ignore[attr-defined]
        described = "".join(f"{row.keyword} : {types[row.keyword]}\n{_wrapped(row.help)}\n" for row in rows)
        function.__doc__ = (function.__doc__ or "").replace("{options}\n", textwrap.indent(described, "    ").lstrip())
        return function

    return give


def _wrapped(words: str) -> str:
    text = words.replace("--model spatial", 'model="spatial"') + "."
    return textwrap.fill(text, 110, initial_indent="    ", subsequent_indent="    ", break_on_hyphens=False)
