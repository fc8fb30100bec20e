"""Parts of long work as tasks of Dask. A part is written under a temporary name and renamed when complete."""

from __future__ import annotations

import contextlib
import hashlib
import json
import math
import os
import shutil
import socket
import time
import uuid
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native

if TYPE_CHECKING:
    import distributed

#: Time for a lost scheduler to return with workers, in seconds.
RESTART = 60
#: Builds part (i, n) at a path with a number of threads, and returns the digest of its rows.
Make = Callable[[Any, Path, tuple[int, int], int], "Digest"]


class Digest:
    """The numbers of rows by table, and the sum of the SHA-256 of all rows modulo 2^256. Digests of parts add up."""

    def __init__(self, rows: Mapping[str, int], total: int) -> None:
        self.rows = dict(rows)
        self.total = total % (1 << 256)

    def __add__(self, other: Digest) -> Digest:
        tables = dict.fromkeys([*self.rows, *other.rows])
        rows = {t: self.rows.get(t, 0) + other.rows.get(t, 0) for t in tables}
        return Digest(rows, self.total + other.total)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Digest) and (self.rows, self.total) == (other.rows, other.total)

    def __hash__(self) -> int:
        return hash(self.total)

    def __repr__(self) -> str:
        return f"Digest({self.rows}, 0x{self.total:064x})"


def build(
    client: distributed.Client,
    make: Make,
    asked: Any,
    *,
    what: str,
    name: str,
    out: Path,
    merge: Callable[[Path, list[Path]], Digest],
    shards: int,
    threads: int,
    progress: Callable[[int, int], object] | None,
) -> None:
    """Builds the parts in the folder ``OUT.parts`` and merges them into ``out``. Their digests must add up.

    ``name`` identifies the work: it has everything that decides the rows.
    """
    folder = out.with_name(out.name + ".parts").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    name = hashlib.sha256(name.encode()).hexdigest()[:8]
    paths = {i: os.fspath(folder / f"{name}-{i}-of-{shards}{out.suffix}") for i in range(1, shards + 1)}
    tasks = {
        f"ozols-{what}-part-{name}-{i}-of-{shards}": (make, asked, path, (i, shards), threads) for i, path in paths.items()
    }

    lost_at, finished = 0.0, -1
    while True:
        try:
            parts = _attempt(client, tasks, progress)
            break
        except _Lost as lost:
            done = sum(Path(path).with_suffix(".json").exists() for path in paths.values())
            if done > finished:
                lost_at, finished = time.monotonic(), done
            elif time.monotonic() > lost_at + RESTART:
                raise lost.__cause__ or lost from None
            _wait_for_a_worker(client, lost_at + RESTART)
    whole = folder / "whole.tmp"
    whole.unlink(missing_ok=True)
    made = merge(whole, [Path(path) for path, *_ in parts])
    if made != sum((Digest(rows, int(total, 16)) for _, rows, total in parts), Digest({}, 0)):
        raise _native.Error(f"the parts in {folder} do not make the whole: delete it, and build again")
    os.replace(whole, out)
    # A worker that was given up may still write a part.
    shutil.rmtree(folder, ignore_errors=True)


class _Lost(Exception):
    """The scheduler of the tasks is lost or has forgotten them; the cause has the error."""


def _attempt(
    client: distributed.Client, tasks: Mapping[str, tuple[Any, ...]], progress: Callable[[int, int], object] | None
) -> list[tuple[str, dict[str, int], str]]:
    """Runs the tasks once. Raises their errors, and :class:`_Lost` if the scheduler is lost."""
    from concurrent.futures import CancelledError

    from distributed import as_completed

    futures: list[Any] = []
    try:
        futures.extend(client.submit(part, *arguments, key=key) for key, arguments in tasks.items())
        for done, task in enumerate(as_completed(futures), 1):
            task.result()
            if progress is not None:
                progress(done, len(futures))
        parts: list[tuple[str, dict[str, int], str]] = client.gather(futures)
        return parts
    except (CancelledError, OSError) as error:
        if any(task.status == "error" for task in futures):
            raise
        raise _Lost from error
    finally:
        with contextlib.suppress(OSError):
            client.cancel(futures)


def _wait_for_a_worker(client: distributed.Client, until: float) -> None:
    """Waits until the scheduler answers and has a worker. It may refuse connections while it starts."""
    while True:
        # The client may not have noticed yet that its tasks are lost.
        time.sleep(0.1)
        try:
            client.wait_for_workers(1, timeout=max(1, math.ceil(until - time.monotonic())))
            return
        except OSError:
            if time.monotonic() > until:
                raise


def shared_out(client: distributed.Client, pieces: int) -> int:
    """Returns a number of parts such that slow parts do not delay the end."""
    threads: int = sum(client.nthreads().values())
    return max(1, min(pieces, 8 * threads))


def part(make: Make, asked: Any, at: str, part: tuple[int, int], threads: int) -> tuple[str, dict[str, int], str]:
    """Builds a part and returns its path and digest. A finished part is kept.

    It is written under a temporary name and renamed when complete, so that two workers may build the same part.
    """
    path = Path(at)
    mark = path.with_suffix(".json")
    if path.exists() and mark.exists():
        rows, total = json.loads(mark.read_text())
        return at, rows, total
    own = f"{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex[:8]}.tmp"
    built, mark_file = (Path(f"{p}.{own}") for p in (path, mark))
    try:
        digest = make(asked, built, part, threads)
        found = digest.rows, f"{digest.total:064x}"
        mark_file.write_text(json.dumps(found))
        os.replace(built, path)
        os.replace(mark_file, mark)
    finally:
        for left in (built, mark_file, Path(f"{built}-journal")):
            left.unlink(missing_ok=True)
    return at, *found
