"""Shares out the chunks that are missing, and waits for them."""

from __future__ import annotations

import asyncio
import concurrent.futures
import contextlib
import json
import logging
import multiprocessing
import os
import sys
import time
import uuid
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._stiffarm import StiffarmError
from ._question import ASKED, LOCK, Question, answer_chunk, read_question, write_question

if TYPE_CHECKING:
    from distributed import Client

#: Chunks that are with the scheduler at once: some for every thread, and never all of a long run.
_PER_THREAD, _AT_LEAST = 4, 16


def run(
    question: Question,
    folder: Path,
    client: Client | str | None,
    workers: int | None,
    timeout_s: float,
    progress: bool | None,
) -> None:
    """Answers what the folder lacks."""
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise StiffarmError(_GUARD)
    with _held(folder):
        begun = _is_begun(folder, question)
        missing = [chunk for chunk in range(question.chunks) if not _is_whole(question, folder, chunk)]
        if not missing:
            return
        with _connected(client, workers, timeout_s) as connected, _told(question, len(missing), progress) as tell:
            if not begun:
                write_question(folder, question)
            _share_out(question, folder, missing, connected, timeout_s, tell)


@contextlib.contextmanager
def _held(folder: Path) -> Iterator[None]:
    """One run at a time in a folder; the system lets go when a run dies."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        others = sorted(path.name for path in folder.iterdir() if path.name != LOCK)
        if others and ASKED not in others and not all(name.startswith(("_question", "_scenarios")) for name in others):
            raise StiffarmError(f"{folder} holds something else ({others[0]}); give a new or an empty folder")
        file = open(folder / LOCK, "a")  # noqa: SIM115
    except OSError as error:
        raise StiffarmError(f"cannot write into {folder}: {error.strerror or error}; give another folder") from None
    with file:
        try:
            import fcntl
        except ImportError:
            # Without locks two runs do the same work twice: their parts have the same bytes.
            yield
            return
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if not isinstance(error, BlockingIOError):
                raise StiffarmError(f"cannot lock {folder / LOCK}: {error.strerror}; give another folder") from None
            raise StiffarmError(f"another run is writing into {folder}: wait for it, or give another folder") from None
        yield


def _is_begun(folder: Path, question: Question) -> bool:
    """Whether the question stands in the folder; refuses another."""
    # What a killed run left half written.
    for left in folder.glob("_*.*.*"):
        left.unlink(missing_ok=True)
    if not (folder / ASKED).exists():
        return False
    held = read_question(folder)
    if held.fingerprint != question.fingerprint:
        other = json.loads(json.dumps(question.written))
        differ = ", ".join(key for key, value in json.loads(json.dumps(held.written)).items() if other[key] != value)
        raise StiffarmError(f"{folder} answers another question ({differ} differ); give another folder")
    return True


def _is_whole(question: Question, folder: Path, chunk: int) -> bool:
    """Whether a part is there with all its rows: disks lose the ends of files when the power fails."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    path = question.part(folder, chunk)
    rows = min(question.chunk_rows, question.rows - chunk * question.chunk_rows)
    try:
        return path.is_file() and bool(pq.read_metadata(path).num_rows == rows)
    except (OSError, pa.ArrowInvalid):
        return False


@contextlib.contextmanager
def _connected(client: Client | str | None, workers: int | None, timeout_s: float) -> Iterator[Client]:
    from distributed import Client, LocalCluster

    if client is None:
        count = (os.cpu_count() or 1) if workers is None else workers
        if isinstance(count, bool) or not isinstance(count, int) or not 1 <= count <= 1024:
            raise StiffarmError(f"workers={workers!r}; expected a whole number from 1 to 1024")
        try:
            cluster = LocalCluster(
                n_workers=count, threads_per_worker=1, processes=True, dashboard_address="127.0.0.1:0",
                silence_logs=logging.CRITICAL,
            )  # fmt: skip
        except (RuntimeError, OSError) as error:
            raise StiffarmError(f"workers cannot be started ({error}). In a script: {_GUARD}") from None
        with cluster, Client(cluster) as made:
            yield made
        return
    if workers is not None:
        raise StiffarmError("workers are those of the client; leave one of the two out")
    own = None
    if isinstance(client, str):
        try:
            own = client = Client(client, timeout=timeout_s)
        except (OSError, TimeoutError, ValueError) as error:
            words = f"no scheduler answers at {client} within {timeout_s:g} s ({type(error).__name__})"
            raise StiffarmError(words + ": is the address right, and does it run?") from None
    try:
        try:
            client.wait_for_workers(1, timeout=timeout_s)
        except TimeoutError:
            raise StiffarmError(f"the scheduler has no workers after {timeout_s:g} s; start some") from None
        yield client
    finally:
        if own is not None:
            own.close()


def _share_out(
    question: Question, folder: Path, missing: list[int], client: Client, timeout_s: float, tell: Any
) -> None:
    from distributed import wait
    from distributed.comm.core import CommClosedError
    from distributed.scheduler import KilledWorker

    run_id = uuid.uuid4().hex[:8]
    left = iter(missing)
    flying: set[Any] = set()
    alone_since: float | None = None
    threads, looked = 0, -1.0
    try:
        while True:
            now = time.monotonic()
            if now - looked > 5.0:
                threads, looked = sum(client.nthreads().values()), now
                alone_since = None if threads else alone_since or now
                if alone_since is not None and now - alone_since > timeout_s:
                    raise StiffarmError(f"the scheduler has lost all workers; {_KEPT}")
            for chunk in left:
                arguments = (str(folder), question.fingerprint, chunk, os.getpid())
                flying.add(client.submit(answer_chunk, *arguments, key=f"stiffarm-{run_id}-{chunk}", pure=False))
                if len(flying) >= max(_AT_LEAST, _PER_THREAD * threads):
                    break
            if not flying:
                return
            try:
                done = list(wait(list(flying), timeout=1.0, return_when="FIRST_COMPLETED").done)
            except TimeoutError:
                done = []
            if client.status != "running":
                raise CommClosedError
            # One answer from the scheduler for all of them.
            for future, (rows, errors) in zip(done, client.gather(done)):
                flying.remove(future)
                tell(rows, errors)
    except KilledWorker as error:
        number = str(error.task).rpartition("-")[2]
        words = f"chunk {number} ended every worker that tried it (out of memory?); {_KEPT}"
        raise StiffarmError(words) from None
    except (CommClosedError, asyncio.CancelledError, concurrent.futures.CancelledError):
        raise StiffarmError(f"the scheduler is gone; {_KEPT}") from None
    finally:
        if flying and client.status == "running":
            with contextlib.suppress(Exception):
                client.cancel(list(flying), force=True)


_GUARD = 'workers import it first, so put the call under if __name__ == "__main__":'
_KEPT = "finished parts are kept: ask again with the same folder"


@contextlib.contextmanager
def _told(question: Question, chunks: int, progress: bool | None) -> Iterator[Any]:
    """A line on a terminal that says how far it is."""
    start, done, rows, errors = time.monotonic(), 0, 0, 0
    shown = sys.stderr.isatty() if progress is None else progress

    def tell(more: int, wrong: int) -> None:
        nonlocal done, rows, errors
        done, rows, errors = done + 1, rows + more, errors + wrong
        if shown:
            took = time.monotonic() - start
            bar = "#" * (30 * done // chunks)
            words = f"{done}/{chunks} chunks, {rows / took:.3g} rows/s, {took * (chunks - done) / done:.0f} s left"
            print(f"\r[{bar:30}] {words}{f', {errors} errors' if errors else ''}   ", end="", file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        if shown and done:
            print(file=sys.stderr)
