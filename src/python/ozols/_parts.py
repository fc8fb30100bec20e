"""Parts of a long work as tasks of Dask: pure, written under a name of their own and renamed when whole, never made twice."""

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

#: How long a scheduler that was lost has to come back, with workers, in seconds.
RESTART = 60
#: Makes part (i, n) of a work at a path, with so many threads; numbers of its rows by table, and the digest of them all.
Make = Callable[[Any, Path, tuple[int, int], int], "Digest"]


class Digest:
    """Numbers of rows by table, and the sum of the SHA-256 of all rows modulo 2^256: those of parts add up to the whole's."""

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
    """Makes the parts of a work in the folder ``OUT.parts`` and puts them together as ``out``; their digests must add up.

    ``name`` tells works of one kind apart, as a hash of all that decides their rows.
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
    # A worker that was given up may still be at a part.
    shutil.rmtree(folder, ignore_errors=True)


class _Lost(Exception):
    """The scheduler that had the tasks is gone, or knows nothing of them; the cause says how that was noticed."""


def _attempt(
    client: distributed.Client, tasks: Mapping[str, tuple[Any, ...]], progress: Callable[[int, int], object] | None
) -> list[tuple[str, dict[str, int], str]]:
    """The tasks once; errors of their own are raised as they are."""
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
    """Returns when the scheduler answers and has a worker; it may refuse, or cut connections, while it comes up."""
    while True:
        # Not at once again, either, where the client has yet to notice that its tasks are gone.
        time.sleep(0.1)
        try:
            client.wait_for_workers(1, timeout=max(1, math.ceil(until - time.monotonic())))
            return
        except OSError:
            if time.monotonic() > until:
                raise


def shared_out(client: distributed.Client, pieces: int) -> int:
    """Parts so many that slow ones do not keep all others waiting at the end."""
    threads: int = sum(client.nthreads().values())
    return max(1, min(pieces, 8 * threads))


def part(make: Make, asked: Any, at: str, part: tuple[int, int], threads: int) -> tuple[str, dict[str, int], str]:
    """Makes a part at a path; the path and the digest. A finished one stays.

    It is written under a name of its own and renamed when it is whole, so that the same part may be made twice at a time.
    """
    path = Path(at)
    mark = path.with_suffix(".json")
    if path.exists() and mark.exists():
        rows, total = json.loads(mark.read_text())
        return at, rows, total
    own = f"{socket.gethostname()}-{os.getpid()}-{uuid.uuid4().hex[:8]}.tmp"
    made, told = (Path(f"{p}.{own}") for p in (path, mark))
    try:
        digest = make(asked, made, part, threads)
        found = digest.rows, f"{digest.total:064x}"
        told.write_text(json.dumps(found))
        os.replace(made, path)
        os.replace(told, mark)
    finally:
        for left in (made, told, Path(f"{made}-journal")):
            left.unlink(missing_ok=True)
    return at, *found
