"""A catalogue built by worker processes on this machine, of which one is killed."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time

import pytest

import ozols
from ozols import _parts

distributed = pytest.importorskip("distributed")

#: Sixty structures of up to eight links.
SPEC = {"links": "4..8", "symmetries": ["mirror"], "ideas": 2}
SHARDS = 12


@pytest.fixture
def cluster(tmp_path):
    """Three worker processes of one thread each, on 127.0.0.1."""
    with distributed.LocalCluster(
        n_workers=3,
        threads_per_worker=1,
        processes=True,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        local_directory=str(tmp_path / "dask"),
    ) as made:
        yield made


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The same catalogue by this process alone."""
    with ozols.catalog.build(SPEC, out=tmp_path_factory.mktemp("alone") / "alone.db") as made:
        return made.digest()


def kill_a_busy_worker(client, pids, enough):
    """Kills a worker that is at a part once there is enough; its process. `pids` are asked before: a part is soon done."""
    for _ in range(30_000):
        busy = [pids[w] for w, tasks in client.processing().items() if tasks and w in pids]
        if busy and enough():
            os.kill(busy[0], signal.SIGKILL)
            return busy[0]
        time.sleep(0.002)
    raise AssertionError("no worker has anything to do")


def test_rows_survive_the_death_of_a_worker(cluster, alone, in_tmp):
    killed, ready, parts = [], threading.Event(), in_tmp / "all.db.parts"

    def kill():
        with distributed.Client(cluster) as watching:
            pids = watching.run(os.getpid)
            ready.set()
            killed.append(kill_a_busy_worker(watching, pids, lambda: len(list(parts.glob("*.json"))) >= 2))

    killer = threading.Thread(target=kill)
    killer.start()
    ready.wait()
    heard = []
    with distributed.Client(cluster) as client:
        made = ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS, progress=lambda *p: heard.append(p))
        killer.join()
        assert killed and killed[0] not in client.run(os.getpid).values()
    with made:
        assert made.digest() == alone
    assert heard[-1] == (SHARDS, SHARDS)
    assert not parts.exists()


def test_an_error_of_a_task_is_not_taken_for_a_lost_scheduler(cluster, in_tmp):
    def full(*_):
        raise OSError(28, "No space left on device")

    began = time.monotonic()
    with distributed.Client(cluster) as client, pytest.raises(OSError, match="No space left"):
        _parts.build(
            client, full, None, what="test", name="full", out=in_tmp / "x.db", merge=None, shards=2, threads=1, progress=None
        )
    assert time.monotonic() < began + _parts.RESTART / 2


def test_what_is_finished_is_not_made_again(cluster, alone, in_tmp, monkeypatch):
    parts = in_tmp / "all.db.parts"

    def enough(done, _):
        if done == 4:
            raise KeyboardInterrupt

    with distributed.Client(cluster) as client, pytest.raises(KeyboardInterrupt):
        ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS, progress=enough)
    first = {p.name: p.stat().st_mtime_ns for p in parts.glob("*.db") if p.with_suffix(".json").exists()}
    assert len(first) >= 4
    # What a killed process leaves is in nobody's way.
    (parts / "left-1-of-12.db.tmp").write_text("half of a part")

    # Another scheduler, with other workers.
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, host="127.0.0.1", dashboard_address="127.0.0.1:0") as other,
        distributed.Client(other) as client,
    ):
        seen = {}

        def look(*_):
            seen.update({p.name: p.stat().st_mtime_ns for p in parts.glob("*.db") if p.exists()})

        with ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS, progress=look) as made:
            assert made.digest() == alone
        assert {name: seen[name] for name in first} == first

        # A second run does nothing.
        before = os.stat("all.db")
        monkeypatch.setattr(client, "submit", None)
        with ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS) as made:
            assert made.digest() == alone
        assert os.stat("all.db") == before


def test_a_part_that_was_spoilt_is_noticed(cluster, in_tmp):
    import sqlite3

    def spoil(done, of):
        if done == of:
            for part in (in_tmp / "all.db.parts").glob("*.db"):
                with sqlite3.connect(part) as db:
                    db.execute("UPDATE layouts SET area = area + 1")

    spec = {"links": "4..6", "symmetries": ["mirror"], "ideas": 0}
    with distributed.Client(cluster) as client, pytest.raises(ozols.Error, match="do not make the whole"):
        ozols.catalog.build(spec, out="all.db", client=client, shards=3, progress=spoil)
    assert not (in_tmp / "all.db").exists()


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


def started(what, *words):
    """A process of Dask on 127.0.0.1."""
    words = [sys.executable, "-m", f"distributed.cli.dask_{what}", *words, "--host", "127.0.0.1", "--no-dashboard"]
    return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def test_rows_survive_the_death_of_the_scheduler_and_of_a_worker(alone, in_tmp, monkeypatch):
    port = str(free_port())
    address = f"tcp://127.0.0.1:{port}"
    there = []

    def scheduler():
        there.append(started("scheduler", "--port", port))
        return there[-1]

    def worker():
        there.append(started("worker", address, "--nthreads", "1", "--no-nanny", "--local-directory", str(in_tmp)))
        return there[-1]

    parts, restarted = in_tmp / "all.db.parts", []

    def done():
        return {p.name: p.stat().st_mtime_ns for p in parts.glob("*.db") if p.with_suffix(".json").exists()}

    def kill(first, workers):
        while len(done()) < 2:
            time.sleep(0.02)
        workers[0].kill()
        while len(done()) < 4:
            time.sleep(0.02)
        first.kill()
        first.wait()
        restarted.append(done())
        scheduler()
        for _ in range(3):
            worker()

    try:
        first, workers = scheduler(), [worker() for _ in range(3)]
        with distributed.Client(address, timeout=60) as client:
            client.wait_for_workers(3, timeout=60)
            killer = threading.Thread(target=kill, args=(first, workers))
            killer.start()
            seen, refused, wait = {}, [], client.wait_for_workers

            def look(*_):
                seen.update({p.name: p.stat().st_mtime_ns for p in parts.glob("*.db") if p.exists()})

            def cut_at_first(*args, **named):
                # A scheduler that comes up may cut the first connections.
                if len(refused) < 2:
                    refused.append(args)
                    raise distributed.comm.CommClosedError("Connection reset by peer")
                return wait(*args, **named)

            monkeypatch.setattr(client, "wait_for_workers", cut_at_first)
            with ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS, progress=look) as made:
                assert made.digest() == alone
            killer.join()
            assert len(refused) == 2
            # What was finished before was not made again.
            assert len(restarted[0]) >= 4
            assert {name: seen[name] for name in restarted[0]} == restarted[0]
            # A second run does nothing.
            before = os.stat("all.db")
            ozols.catalog.build(SPEC, out="all.db", client=client, shards=SHARDS).close()
            assert os.stat("all.db") == before
    finally:
        for process in there:
            process.kill()
            process.wait()
