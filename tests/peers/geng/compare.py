"""Chains of ozols beside those that nauty's geng makes and sparse.rs leaves: the same sets, and what both take.

usage: compare.py OZOLS NAUTY LINKS [GUIDE]

NAUTY is the folder with geng, labelg and sparse, LINKS a number or a range such as 4..12. Up to 14 links the sets are compared,
under nauty's own canonical numbering; beyond, their sizes. With a mobility of 1 times are taken, the least of some runs. GUIDE is
a Markdown file whose table below the marks is written anew.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# ozols lists no more, and counts them.
MOST_LISTED = 14
BEGIN, END = "<!-- chains and geng -->", "<!-- end -->"


def timed(command: str, times: int) -> tuple[str, float, float]:
    """What a shell command writes, its processor time and its time on the clock, the least of some runs."""
    best = (float("inf"), float("inf"))
    for _ in range(times):
        before, begun = os.times(), time.monotonic()
        done = subprocess.run(["bash", "-o", "pipefail", "-c", command], stdout=subprocess.PIPE, text=True, check=True)
        after, clock = os.times(), time.monotonic() - begun
        used = (after.children_user - before.children_user) + (after.children_system - before.children_system)
        best = min(best, (used, clock))
    return done.stdout, *best


def chains_of_both(ozols: str, nauty: Path, links: int, mobility: int) -> tuple[int, int, str]:
    """How many chains ozols and geng have, and whether they are the same: "yes", "no", or "as many"."""
    geng, label = made_by_geng(nauty, links, mobility), nauty / "labelg"
    with tempfile.TemporaryDirectory() as folder:
        ours, theirs = Path(folder, "ours"), Path(folder, "theirs")
        listed = f"{ozols} catalog chains --links {links} --mobility {mobility} --format csv | tail -n +2 | cut -d, -f1"
        timed(f"{listed} | tr -d '\"' | {label} -q | LC_ALL=C sort > {ours}", 1)
        timed(f"{geng} | {label} -q | LC_ALL=C sort > {theirs}", 1)
        lists = [f.read_text().splitlines() for f in (ours, theirs)]
    same = lists[0] == lists[1] and len(set(lists[0])) == len(lists[0])
    return len(lists[0]), len(lists[1]), "yes" if same else "no"


def joints(links: int, mobility: int) -> int | None:
    twice = 3 * (links - 1) - mobility
    return twice // 2 if twice % 2 == 0 and twice >= 2 * links else None


def made_by_geng(nauty: Path, links: int, mobility: int, more: str = "") -> str:
    """No triangles, two joints a link, no link that holds the rest together alone."""
    e = joints(links, mobility)
    return f"{nauty}/geng -Ctd2q {links} {e}:{e} | {nauty}/sparse {more}"


def main() -> None:
    ozols, nauty, links = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
    first, last = (int(n) for n in (links.split("..") * 2)[:2])
    wrong = []
    rows = ["| links | chains | geng, filtered | the same | ozols, one thread | two | geng and filter |", "|---|---|---|---|---|---|---|"]
    for n in range(first, last + 1):
        for w in (1, 2, 3) if n <= 11 else (1,):
            if joints(n, w) is None:
                continue
            if n <= MOST_LISTED:
                ours, theirs, same = chains_of_both(ozols, nauty, n, w)
            if w > 1:
                print(f"{n} links, W = {w}: {ours} and {theirs}, the same: {same}")
                if same == "no":
                    wrong.append((n, w))
                continue
            times = 5 if n <= 12 else 1
            count = f"{ozols} --quiet catalog count --chains --links {n} --format csv"
            text, one, _ = timed(f"{count} --threads 1", times)
            _, _, clock = timed(f"{count} --threads 2", times)
            theirs_text, used, _ = timed(made_by_geng(nauty, n, w, "--count"), times)
            counted, by_geng = int(text.splitlines()[1].split(",")[2]), int(theirs_text)
            if n > MOST_LISTED:
                same = "as many" if counted == by_geng else "no"
            elif (ours, theirs) != (counted, by_geng):
                same = "no"
            if same == "no":
                wrong.append((n, w))
            rows.append(f"| {n} | {counted:,} | {by_geng:,} | {same} | {one:.2f} s | {clock:.2f} s | {used:.2f} s |")
    print("\n".join(rows))
    if len(sys.argv) > 4:
        guide = Path(sys.argv[4])
        between = re.compile(f"(?<={re.escape(BEGIN)}\n).*?(?={re.escape(END)})", re.DOTALL)
        text, count = between.subn(lambda _: "\n".join(rows) + "\n", guide.read_text())
        if count != 1:
            sys.exit(f"{guide} has no place for the table: {BEGIN} and {END}")
        guide.write_text(text)
    if wrong:
        sys.exit(f"not the same: {', '.join(f'{n} links, W = {w}' for n, w in wrong)}")


main()
