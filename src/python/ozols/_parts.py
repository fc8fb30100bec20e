"""Parts of a long work as tasks of Dask: pure, written under a name of their own and renamed when whole, never made twice."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import socket
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
    from concurrent.futures import CancelledError

    from distributed import as_completed

    folder = out.with_name(out.name + ".parts").resolve()
    folder.mkdir(parents=True, exist_ok=True)
    name = hashlib.sha256(name.encode()).hexdigest()[:8]
    paths = {i: os.fspath(folder / f"{name}-{i}-of-{shards}{out.suffix}") for i in range(1, shards + 1)}

    def attempt() -> list[tuple[str, dict[str, int], str]]:
        tasks = [
            client.submit(part, make, asked, path, (i, shards), threads, key=f"ozols-{what}-part-{name}-{i}-of-{shards}")
            for i, path in paths.items()
        ]
        try:
            for done, task in enumerate(as_completed(tasks), 1):
                task.result()
                if progress is not None:
                    progress(done, shards)
            parts: list[tuple[str, dict[str, int], str]] = client.gather(tasks)
            return parts
        finally:
            client.cancel(tasks)

    while True:
        scheduler = client.scheduler_info()["id"]
        try:
            parts = attempt()
            break
        except (CancelledError, OSError):
            # Another scheduler in the place of the one that had the tasks knows nothing of them.
            client.wait_for_workers(1, timeout=RESTART)
            if client.scheduler_info()["id"] == scheduler:
                raise
    whole = folder / "whole.tmp"
    whole.unlink(missing_ok=True)
    made = merge(whole, [Path(path) for path, *_ in parts])
    if made != sum((Digest(rows, int(total, 16)) for _, rows, total in parts), Digest({}, 0)):
        raise _native.Error(f"the parts in {folder} do not make the whole: delete it, and build again")
    os.replace(whole, out)
    # A worker that was given up may still be at a part.
    shutil.rmtree(folder, ignore_errors=True)


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
