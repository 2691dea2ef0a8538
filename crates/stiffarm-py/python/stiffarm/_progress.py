"""How far a long call is: given to a callable, or written on a line of a terminal."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import Optional, Union

from ._stiffarm import StiffarmError

#: Called with how many parts are done, and of how many, or None where nobody knows.
Callback = Callable[[int, Optional[int]], object]
#: None, True for a line on a terminal, or a callable.
ProgressLike = Union[bool, Callback, None]


def bar(done: int, total: int) -> str:
    """Thirty places, as many of them full as are done."""
    return f"[{'#' * (30 * done // max(total, 1)):30}]"


@contextlib.contextmanager
def reporting(doing: str, progress: ProgressLike) -> Iterator[Callback | None]:
    """What takes the progress while a call runs; a line is wiped when it ends."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        line = _Line(doing)
        try:
            yield line if sys.stderr.isatty() else None
        finally:
            line.wipe()
    elif callable(progress):
        yield progress
    else:
        raise StiffarmError(f"progress is a {type(progress).__name__}; expected None, True or a callable: progress(done, total)")


class _Line:
    """One line of a terminal, written anew and anew."""

    def __init__(self, doing: str) -> None:
        self._doing, self._start, self._width = doing, time.monotonic(), 0

    def __call__(self, done: int, total: int | None) -> None:
        took = time.monotonic() - self._start
        if total is None:
            words = f"{self._doing}, {took:.0f} s"
        else:
            left = f", {took * (total - done) / done:.0f} s left" if done else ""
            words = f"{self._doing} {bar(done, total)} {done}/{total}{left}"
        self._write(words)

    def _write(self, words: str) -> None:
        print(f"\r{words:{self._width}}", end="", file=sys.stderr, flush=True)
        self._width = len(words)

    def wipe(self) -> None:
        if self._width:
            self._write("")
            print("\r", end="", file=sys.stderr, flush=True)
