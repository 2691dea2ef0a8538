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
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._progress import bar
from .._stiffarm import StiffarmError
from ._folder import (
    ASKED, LOCK, SCENARIOS, SUMS, append, changed, clear_halves, digest_of, holds_something_else, listed, part_name, read_sums,
    write_whole,
)  # fmt: skip
from ._question import Question, answer_chunk, read_question, refuse_another_maker, write_question

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
        clear_halves(folder)
        begun = (folder / ASKED).exists()
        sums = _whole(folder, question) if begun else {}
        missing = [chunk for chunk in range(question.chunks) if part_name(chunk, question.fingerprint) not in sums]
        if not missing:
            return
        with _connected(client, workers, timeout_s) as connected, _reporting(question, len(missing), progress) as tell:
            if not begun:
                sums.update(write_question(folder, question))

            def keep(done: dict[int, str]) -> None:
                new = {part_name(chunk, question.fingerprint): digest for chunk, digest in done.items()}
                sums.update(new)
                append(folder, new)

            _share_out(question, folder, missing, connected, timeout_s, keep, tell)
        write_whole(folder / SUMS, listed(sums))
        # Of workers that died in this run.
        clear_halves(folder)


@contextlib.contextmanager
def _held(folder: Path) -> Iterator[None]:
    """One run at a time in a folder; the system lets go when a run dies."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        other = holds_something_else(folder)
        if other is not None:
            raise StiffarmError(f"{folder} holds something else ({other}); give a new or an empty folder")
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


def _whole(folder: Path, question: Question) -> dict[str, str]:
    """The digests of what stands in a begun folder as it was written; refuses another question.

    What was changed since is reported and left out, to be computed again.
    """
    held = read_question(folder)
    refuse_another_maker(folder, held)
    if held.fingerprint != question.fingerprint:
        other = json.loads(json.dumps(question.written))
        differ = ", ".join(key for key, value in json.loads(json.dumps(held.written)).items() if other[key] != value)
        raise StiffarmError(f"{folder} answers another question ({differ} differ); give another folder")
    sums, line = read_sums(folder)
    if line is not None:
        _warn(f"line {line} of {folder / SUMS} is damaged; what it named is computed again")
    # The fingerprint has proved the question.
    whole = {name: digest_of(folder / name) for name in (ASKED, SCENARIOS) if (folder / name).exists()}
    for chunk in range(question.chunks):
        path = question.part(folder, chunk)
        digest = sums.get(path.name)
        if digest is None or not path.exists():
            continue
        if digest_of(path) == digest:
            whole[path.name] = digest
        else:
            _warn(changed(path))
    write_whole(folder / SUMS, listed(whole))
    return whole


def _warn(words: str) -> None:
    warnings.warn(words, RuntimeWarning, stacklevel=5)


@contextlib.contextmanager
def _connected(client: Client | str | None, workers: int | None, timeout_s: float) -> Iterator[Client]:
    from distributed import Client, LocalCluster

    if client is None:
        count = (os.cpu_count() or 1) if workers is None else workers
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
    if not isinstance(client, Client):
        raise StiffarmError(f"client is a {type(client).__name__}; expected a distributed.Client or an address")
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
    question: Question,
    folder: Path,
    missing: list[int],
    client: Client,
    timeout_s: float,
    keep: Callable[[dict[int, str]], None],
    tell: Callable[[int, int], None],
) -> None:
    from distributed import wait
    from distributed.comm.core import CommClosedError
    from distributed.scheduler import KilledWorker

    run_id = uuid.uuid4().hex[:8]
    left = iter(missing)
    flying: dict[Any, int] = {}
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
                future = client.submit(answer_chunk, *arguments, key=f"stiffarm-{run_id}-{chunk}", pure=False)
                flying[future] = chunk
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
            answers = client.gather(done)
            keep({flying.pop(future): digest for future, (_, _, digest) in zip(done, answers)})
            for rows, errors, _ in answers:
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
def _reporting(question: Question, chunks: int, progress: bool | None) -> Iterator[Any]:
    """A line on a terminal that says how far it is."""
    start, done, rows, errors = time.monotonic(), 0, 0, 0
    shown = sys.stderr.isatty() if progress is None else progress

    def tell(more: int, wrong: int) -> None:
        nonlocal done, rows, errors
        done, rows, errors = done + 1, rows + more, errors + wrong
        if shown:
            took = time.monotonic() - start
            words = f"{done}/{chunks} chunks, {rows / took:.3g} rows/s, {took * (chunks - done) / done:.0f} s left"
            print(f"\r{bar(done, chunks)} {words}{f', {errors} errors' if errors else ''}   ", end="", file=sys.stderr, flush=True)

    try:
        yield tell
    finally:
        if shown and done:
            print(file=sys.stderr)
