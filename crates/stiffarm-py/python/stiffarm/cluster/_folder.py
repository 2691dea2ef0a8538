"""The folder of a sweep: files that appear whole, each with its digest in a manifest, and what is left of killed writers."""

from __future__ import annotations

import contextlib
import errno
import hashlib
import os
import re
import uuid
from collections.abc import Iterable, Mapping
from pathlib import Path

from .._stiffarm import StiffarmError
from .._whole import written_whole

#: Names that begin so are passed over by whoever reads a folder of Parquet files.
ASKED, SCENARIOS, SUMS, LOCK = "_question.json", "_scenarios.npy", "_sha256sums", "_lock"
HEAD = (ASKED, SCENARIOS, SUMS)

_PART = r"part-\d{9,}-[0-9a-f]{16}\.parquet"
#: What `write_whole` writes before it gives a file its name.
_HALF = re.compile(rf"_(?:{'|'.join(map(re.escape, HEAD))}|{_PART})\.[0-9a-f]{{32}}")
_SUM = re.compile(rf"([0-9a-f]{{64}})  ({'|'.join(map(re.escape, HEAD))}|{_PART})")


def part_name(chunk: int, fingerprint: str) -> str:
    return f"part-{chunk:09d}-{fingerprint}.parquet"


def write_whole(path: Path, data: bytes) -> str:
    """A file that is there is complete: it gets its name only when all of it is on the disk. Gives its digest."""
    try:
        written_whole(path, data)
    except OSError as error:
        raise _unwritten(path, error) from None
    return hashlib.sha256(data).hexdigest()


def _unwritten(path: Path, error: OSError) -> StiffarmError:
    full = error.errno in (errno.ENOSPC, errno.EDQUOT)
    return StiffarmError(
        f"cannot write {path}: {error.strerror or error}; {'make room there' if full else 'see to it'} and ask again with "
        "the same folder: finished parts are kept"
    )


def holds_something_else(folder: Path) -> str | None:
    """The first name in a folder without a question that no sweep has made."""
    names = sorted(path.name for path in folder.iterdir())
    if ASKED in names:
        return None
    return next((name for name in names if name not in (*HEAD, LOCK) and not _HALF.fullmatch(name)), None)


def clear_halves(folder: Path) -> None:
    """Removes what killed writers have left half written, and nothing that a sweep has not made."""
    try:
        halves = [path for path in folder.iterdir() if _HALF.fullmatch(path.name) and path.is_file()]
    except OSError as error:
        raise StiffarmError(f"cannot read {folder}: {error.strerror or error}") from None
    for half in halves:
        try:
            half.unlink(missing_ok=True)
        except OSError as error:
            raise StiffarmError(
                f"cannot remove {half}, which a killed run has left half written: {error.strerror or error}; remove it"
            ) from None


def listed(sums: Mapping[str, str]) -> bytes:
    """A manifest as ``sha256sum`` prints it and ``sha256sum --check`` reads it."""
    return "".join(f"{digest}  {name}\n" for name, digest in sorted(sums.items())).encode()


def append(folder: Path, sums: Mapping[str, str]) -> None:
    """Adds to the manifest of a run that goes on."""
    path = folder / SUMS
    try:
        with open(path, "ab") as file:
            file.write(listed(sums))
    except OSError as error:
        raise _unwritten(path, error) from None


def read_sums(folder: Path) -> tuple[dict[str, str], int | None]:
    """The manifest, and the number of the first line that is damaged.

    A last line that does not end is one that a killed run was writing: its part counts as missing.
    """
    path = folder / SUMS
    try:
        *lines, _ = path.read_bytes().decode(errors="replace").split("\n")
    except FileNotFoundError:
        raise StiffarmError(
            f"{path} is not there, so nothing shows that the files beside it are whole; restore it from a copy, or ask "
            "again with another folder"
        ) from None
    except OSError as error:
        raise StiffarmError(f"cannot read {path}: {error.strerror or error}") from None
    read = [_SUM.fullmatch(line) for line in lines]
    damaged = next((number for number, line in enumerate(read, start=1) if line is None), None)
    return {line[2]: line[1] for line in read if line is not None}, damaged


def digest_of(path: Path) -> str:
    """SHA-256 of a file."""
    found = hashlib.sha256()
    try:
        with open(path, "rb") as file:
            for block in iter(lambda: file.read(1 << 20), b""):
                found.update(block)
    except OSError as error:
        raise StiffarmError(f"cannot read {path}: {error.strerror or error}") from None
    return found.hexdigest()


def read_whole(path: Path, digest: str | None) -> bytes:
    """The bytes of a file; refuses others than those that were written. None where no digest was kept."""
    try:
        data = path.read_bytes()
    except OSError as error:
        raise StiffarmError(f"cannot read {path}: {error.strerror or error}") from None
    if digest is not None and hashlib.sha256(data).hexdigest() != digest:
        raise StiffarmError(changed(path))
    return data


def changed(path: Path) -> str:
    if path.name in HEAD:
        todo = "restore it from a copy, or ask again with another folder"
    else:
        todo = "ask the same with the same folder, and it is computed again"
    return f"{path} was changed since it was written: its SHA-256 is not the one in {SUMS}; {todo}"


def check(folder: Path, sums: Mapping[str, str], names: Iterable[str]) -> None:
    """Refuses files that are not those that were written."""
    for name in names:
        path = folder / name
        if name not in sums:
            raise StiffarmError(f"{path} is not listed in {SUMS}; ask the same with the same folder, and it is computed again")
        if digest_of(path) != sums[name]:
            raise StiffarmError(changed(path))
