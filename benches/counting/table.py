"""How one without ozols would count the variants without redundant constraints, and the processor time of each way.

usage: table.py OZOLS PAGE [--write] [--seconds N]
Every way is a command of its own, timed from start to end; all must find the same number. With --write the table goes into the page.
"""

import argparse
import csv
import json
import os
import pathlib
import re
import resource
import subprocess
import sys

import space as spaces
import ways

MECHANISMS = ["four-bar", "watt-six-bar", "scissor-lift-3", "gripper-10"]
OPTIONS = ["--options", ",".join(spaces.OPTIONS)]


def timed(command, seconds):
    """What a command prints, and its processor time; nothing where it takes longer than the seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 5))
    run = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    took = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if run.returncode < 0 and took >= seconds:
        return None, took
    if run.returncode:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    return run.stdout, took


def by_ozols(ozols, name, *more):
    """A search's count of variants without redundant constraints."""
    return [ozols, "search", name, "--count", *OPTIONS, "--format", "json", "--threads", "1", *more]


def counted(said):
    return int(json.loads(said)["determinate"])


def pruned(name):
    """The search without a diagram that `cargo bench --bench ways` has, within a running program and one thread, in seconds."""
    request = json.dumps({"options": list(spaces.OPTIONS)})
    command = ["cargo", "bench", "--quiet", "--bench", "ways", "--", "--quick", "--request", request, name]
    threads = {**os.environ, "RAYON_NUM_THREADS": "1"}
    lines = subprocess.run(command, capture_output=True, text=True, check=True, env=threads).stdout.splitlines()
    return float(next(row["median_seconds"] for row in csv.DictReader(lines) if row["way"] == "pruned"))


def in_words(seconds):
    if seconds is None:
        return "over the limit"
    if seconds < 0.0005:
        return "under 1 ms"
    return f"{1000 * seconds:.0f} ms" if seconds < 0.995 else f"{seconds:.3g} s"


def column(ozols, name, seconds):
    """A mechanism's number of variants, the number without redundant constraints, and the time of each way."""
    said, took = timed(by_ozols(ozols, name), seconds)
    truth = counted(said)
    times = {"ozols": took}
    said, times["ozols, every variant by itself"] = timed(by_ozols(ozols, name, "--method", "brute"), seconds)
    found = {"brute": counted(said)} if said else {}
    times["ozols, depth first with cuts (*)"] = pruned(name)
    for way in ways.WAYS:
        said, times[way] = timed([sys.executable, __file__, "--way", way, "--of", name, ozols, "-"], seconds)
        if said is None:
            times[way] = None
        else:
            found[way] = int(said)
        print(f"{name}: {way}: {in_words(times[way])}", file=sys.stderr)
    for way, number in found.items():
        if number != truth:
            sys.exit(f"{name}: {way} finds {number}, ozols {truth}")
    return {"variants": spaces.of(ozols, name).size(), "without": truth, "times": times}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ozols")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--seconds", type=int, default=600)
    parser.add_argument("--way", help=argparse.SUPPRESS)
    parser.add_argument("--of", help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.way:
        print(ways.WAYS[asked.way](spaces.of(asked.ozols, asked.of)))
        return
    columns = {name: column(asked.ozols, name, asked.seconds) for name in MECHANISMS}
    rows = [["way", *columns], ["---"] * (1 + len(columns))]
    rows.append(["variants", *(f"{c['variants']:,}" for c in columns.values())])
    rows.append(["without redundant constraints", *(f"{c['without']:,}" for c in columns.values())])
    for way in next(iter(columns.values()))["times"]:
        rows.append([way, *(in_words(c["times"][way]) for c in columns.values())])
    table = "\n".join(f"| {' | '.join(row)} |" for row in rows)
    print(table)
    if asked.write:
        text = asked.page.read_text()
        marks = re.compile(r"(<!-- ways to count -->\n).*?(<!-- end -->)", re.S)
        asked.page.write_text(marks.sub(lambda m: f"{m[1]}{table}\n{m[2]}", text, count=1))


main()
