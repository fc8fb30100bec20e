"""Whether OndselSolver, FreeCAD's solver, moves an assembly with other joint types as it moved the one that was written.

usage: assemblies.py OZOLS FOLDER. Takes generated four-bars, and the .asmt files below FOLDER that have a motion and no contacts, if it
is there: each is mended by `ozols fix`, both are solved over their motion, and every part has to be in the same place at every time.
"""

import json
import random
import subprocess
import sys
import tempfile
from math import dist, hypot
from pathlib import Path

from pyondsel.asmt_solver import AsmtSolver
from pyondsel.model.asmt_model import AsmtModel
from pyondsel.model.joint import Joint
from pyondsel.model.marker import Marker
from pyondsel.model.motion import Motion
from pyondsel.model.part import Part
from pyondsel.model.simulation import Simulation

GENERATED = 10
# Of an assembly's size; the solver stops at 1e-6.
APART = 1e-5


def four_bar(seed):
    """A crank that goes all round, in mm, each part with its origin at its first hinge: W = 1, three rows held twice."""
    rng = random.Random(seed)
    crank, ground = rng.uniform(5, 15), rng.uniform(60, 90)
    elbow, top, foot = (0.0, crank, 0.0), (ground * rng.uniform(0.8, 1.1), rng.uniform(40, 60), 0.0), (ground, 0.0, 0.0)
    model = AsmtModel(name="Bar")
    for name, at in (("A0", (0.0, 0.0, 0.0)), ("D0", foot)):
        model.add_ground_marker(Marker(name, at))
    places = {"Crank": ((0.0, 0.0, 0.0), elbow), "Rod": (elbow, top), "Rocker": (foot, top)}
    for name, (begin, end) in places.items():
        part = model.add_part(Part(name, mass=1.0, position=begin))
        part.add_marker(Marker("begin"))
        part.add_marker(Marker("end", tuple(e - b for b, e in zip(begin, end))))
    path = model.part_path
    for name, i, j in (
        ("A", model.ground_path("A0"), path("Crank", "begin")),
        ("B", path("Crank", "end"), path("Rod", "begin")),
        ("C", path("Rod", "end"), path("Rocker", "end")),
        ("D", path("Rocker", "begin"), model.ground_path("D0")),
    ):
        model.add_joint(Joint(name, "revolute", i, j))
    model.add_motion(Motion.constant_speed("spin", "A", turns_per_time=1.0))
    model.simulation = Simulation(t_start=0.0, t_end=1.0, frames=20)
    return model.to_asmt()


def assemblies(folder):
    """Names and texts."""
    for seed in range(GENERATED):
        yield f"four-bar-{seed}.asmt", four_bar(seed)
    for path in sorted(Path(folder).rglob("*.asmt")):
        text = path.read_text(encoding="utf-8")
        if "Motion\n" in text.replace("\r", "") and not any(w in text for w in ("ContactJoint", "CurveCurve", "LimitJoint", "RotationLimit")):
            yield path.name, text


def compared(ozols, name, text, folder):
    """What is wrong with an assembly that was mended; nothing where all is well, and none where there is nothing to mend."""
    old, new = Path(folder) / name, Path(folder) / f"fixed-{name}"
    old.write_text(text, encoding="utf-8")
    said = subprocess.run([ozols, "lint", old, "--format", "json"], capture_output=True, check=False)
    # What is open in the file has no one motion: the solver drops what does not fit.
    if said.returncode != 1 or json.loads(said.stdout)["files"][0]["approximated"]:
        return None
    done = subprocess.run([ozols, "fix", old, "-o", new], capture_output=True, text=True, check=False)
    if done.returncode:
        return f"not mended: {done.stderr}"
    if subprocess.run([ozols, "lint", new], capture_output=True, check=False).returncode:
        return "something is redundant still"
    before, after = (AsmtSolver().solve(p.read_text(encoding="utf-8")) for p in (old, new))
    if before.times != after.times or len(before.times) < 2:
        return "not solved at the same times"
    places = [p for part in before.parts.values() for p in part.positions]
    size = max(hypot(*p) for p in places) or 1.0
    gap = max(
        dist(p, q) for name, part in before.parts.items() for p, q in zip(part.positions, after.parts[name].positions, strict=True)
    )
    return f"parts are {gap:.1e} apart in a size of {size:.1e}" if gap > APART * size else ""


def main():
    ozols, folder = sys.argv[1:3]
    wrong, well = [], 0
    with tempfile.TemporaryDirectory() as scratch:
        for name, text in assemblies(folder):
            found = compared(str(Path(ozols).resolve()), name, text, scratch)
            well += found == ""
            if found:
                wrong.append(f"{name}: {found}")
    print(f"assemblies: OndselSolver moves {well} as before with other joint types", *wrong, sep="\n")
    sys.exit(1 if wrong or well < GENERATED else 0)


main()
