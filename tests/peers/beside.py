"""What ozols and other tools say of the same ten mechanisms, side by side, with the time each takes.

usage: beside.py OZOLS MODELS PAGE [--write]
Compares the answers with the table of the guide's page, ending with 1 where one differs; with --write, puts the table there.
"""

import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

import generate
import mujoco_figures
import numpy as np
import other_figures
import pinocchio_figures

RUNS = 5
HEAD = ["mechanism", "ozols", "MuJoCo", "Pinocchio", "Exudyn", "pylinkage"]
# Planar linkages as bars between pins, for pylinkage; a rigid link of three pins is three bars.
BARS = {
    "four-bar": ["Aa", "ab", "bB"],
    "gripper": ["Aa", "ab", "bB", "Cc", "cd", "dD"],
}
REAL = {
    "Robotiq 2F-85": "robotiq_2f85_v4/2f85.nomesh.xml",
    "ToddlerBot": "toddlerbot_2xc/toddlerbot_2xc.nomesh.xml",
}
URDF = {"spatial five-bar (URDF)": "epr_5bar_linkage"}


def timed(ask):
    """An answer, and the median of its times in milliseconds; a dash where there is none."""
    took = []
    for _ in range(RUNS):
        began = time.perf_counter()
        found = ask()
        took.append(1000 * (time.perf_counter() - began))
    if found is None:
        return "—"
    return f"{found}; {in_words(statistics.median(took))}"


def in_words(ms):
    return f"{ms:.0f} ms" if ms >= 1 else f"{max(ms, 0.1):.1f} ms"


def figures(w, redundant):
    return f"W {w}, σ {redundant}"


def ozols(file, *more):
    words = [OZOLS, "lint", str(file), "--format", "json", *map(str, more)]
    out = subprocess.run(words, capture_output=True, text=True, check=False)
    found = json.loads(out.stdout)["files"][0]
    return f"{figures(found['mobility'], found['redundant'])} ({found['certainty_kind']})"


def ranked(j, nv):
    """By NumPy's rank of the Jacobian, as it comes."""
    rank = int(np.linalg.matrix_rank(j)) if len(j) else 0
    return figures(nv - rank, len(j) - rank)


def coupled(file):
    """What a tool that does not get the couplings of joints leaves out."""
    return " without couplings" if "<joint joint1" in pathlib.Path(file).read_text() else ""


def by_pinocchio(file):
    """In a process of its own, which some files end; Pinocchio reads one body of the world, so that all are put into one."""
    text = pathlib.Path(file).read_text()
    base = "<body name='the-base'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>"
    text = text.replace("<worldbody>", "<worldbody>" + base).replace("</worldbody>", "</body></worldbody>")
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as t:
        t.write(text)
        t.flush()
        words = [sys.executable, pathlib.Path(__file__).parent / "pinocchio_figures.py", t.name, str(RUNS)]
        out = subprocess.run(words, capture_output=True, text=True, check=False)
    if out.returncode:
        return "no answer"
    velocities, rows, rank, ms = out.stdout.split()
    found = figures(int(velocities) - int(rank), int(rows) - int(rank))
    return f"{found}{coupled(file)}; {in_words(float(ms))}"


def by_mujoco(file):
    model = mujoco_figures.Model(file)
    q, _ = model.close(model.model.qpos0)
    return ranked(model.jacobian(q)[0], model.model.nv)


def by_exudyn(file):
    model = mujoco_figures.Model(file)
    found = other_figures.exudyn(model, model.close(model.model.qpos0)[0])
    return figures(*found) + coupled(file)


def row(name, file, last):
    """What each says of a file."""
    return [
        name,
        timed(lambda: ozols(file)),
        timed(lambda: by_mujoco(file)),
        by_pinocchio(file),
        timed(lambda: by_exudyn(file)),
        last(),
    ]


def rows(models):
    with tempfile.TemporaryDirectory() as t:
        for name in list(generate.KINDS)[:7]:
            file = pathlib.Path(t) / "model.xml"
            file.write_text(generate.plain(name))
            bars = BARS.get(name)
            yield row(name, file, lambda: timed(lambda: bars and f"W {other_figures.pylinkage(bars)}"))
    for name, file in REAL.items():
        yield row(name, models / file, lambda: "—")
    for name, folder in URDF.items():
        file, side = (models / folder / f"robot.{e}" for e in ("urdf", "yaml"))

        def pinocchio():
            model = pinocchio_figures.Model(file, side)
            return ranked(model.jacobian(model.start()[0])[0], model.model.nv)

        yield [name, timed(lambda: ozols(file, "--loops", side)), "—", timed(pinocchio), "—", "—"]


def answers(text):
    """Tables without their times."""
    return re.findall(r"^\|.*\|$", re.sub(r"; [\d.]+ ms", "", text), re.MULTILINE)


def main():
    lines = [HEAD, ["---"] * len(HEAD), *rows(pathlib.Path(MODELS))]
    table = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    print(table)
    text = PAGE.read_text()
    old = re.search(r"^\| mechanism \|.*?\n(?!\|)", text, re.MULTILINE | re.DOTALL)
    if sys.argv[4:] == ["--write"]:
        PAGE.write_text(text.replace(old.group(0), table + "\n"))
        return 0
    differ = [b for a, b in zip(answers(old.group(0)), answers(table + "\n")) if a != b]
    for line in differ:
        print("FAILED, not in the guide:", line)
    return 1 if differ or len(answers(table)) != len(answers(old.group(0))) else 0


if __name__ == "__main__":
    OZOLS, MODELS, PAGE = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    sys.exit(main())
