"""Files that are there are complete."""

from __future__ import annotations

import contextlib
import os
import uuid
from pathlib import Path


def written_whole(path: Path, data: bytes) -> None:
    """A file gets its name only when all of it is on the disk."""
    beside = path.with_name(f"_{path.name}.{uuid.uuid4().hex}")
    try:
        with open(beside, "xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, path)
    finally:
        with contextlib.suppress(OSError):
            beside.unlink()
