"""Whether loops stay closed in MuJoCo after `ozols fix` and in what `ozols export --to mjcf` writes: half a second under gravity. A
constraint of MuJoCo is as soft as its bodies are light, so that rank alone says nothing of it.

usage: softness.py OZOLS MODELS [PATTERN]
Prints each model whose greatest gap is more than 3 times that of the model as it was and more than 1e-3 m, or whose joints are 3e-3
rad apart, and ends with 1 where `ozols fix` wrote it. Gravity has no part along the slides that were put in: what hung on a hinge along them
hangs on the loop then, which gives way to a weight as every constraint of MuJoCo does, by about 4e-4 m. Links of a spherical four-bar that
hang on their loop by new hinges are 2e-3 rad apart for it, whatever the armature and the step.
"""

import json
import multiprocessing
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

import generate
import mujoco
import numpy as np

SECONDS = 0.5
# How much wider a gap may be than before, the least gap that counts in metres, and how far joints may be apart in radians.
WIDER, LEAST, APART = 3, 1e-3 / 3, 3e-3
# The push by which chaos is told.
PUSH = 1e-9


def ozols(*words):
    return subprocess.run([sys.argv[1], *map(str, words)], capture_output=True, text=True, check=False)


def load(file):
    """The model where its loops close best, without contacts, actuators and limits."""
    m = mujoco.MjModel.from_xml_path(str(file))
    off = mujoco.mjtDisableBit
    m.opt.disableflags |= int(off.mjDSBL_CONTACT) | int(off.mjDSBL_ACTUATION) | int(off.mjDSBL_LIMIT)
    return m


def followed(m, gravity, push=0.0, finer=1):
    """The greatest gap of the equalities, and the last values of the joints by name; nothing where the numbers ran away."""
    m.opt.gravity[:] = gravity
    d = mujoco.MjData(m)
    if m.nkey:
        mujoco.mj_resetDataKeyframe(m, d, 0)
    d.qvel[:] += push
    m.opt.timestep /= finer
    gap = 0.0
    for _ in range(int(SECONDS / m.opt.timestep)):
        mujoco.mj_step(m, d)
        if any(w.number for w in d.warning):
            return None
        gap = max(gap, float(np.abs(d.efc_pos[: d.ne]).max(initial=0)))
    one = [j for j in range(m.njnt) if m.jnt_type[j] in (2, 3)]
    return gap, {m.joint(j).name: float(d.qpos[m.jnt_qposadr[j]]) for j in one if m.joint(j).name}


def apart(a, b):
    return max((abs(a[1][n] - b[1][n]) for n in a[1] if n in b[1]), default=0.0)


def across(before, after, gravity):
    """Gravity without its parts along the slides that one model has more than the other."""
    d = mujoco.MjData(after)
    mujoco.mj_kinematics(after, d)
    known = {before.joint(j).name for j in range(before.njnt)}
    new = [j for j in range(after.njnt) if after.jnt_type[j] == 2 and after.joint(j).name not in known]
    axes = np.array([d.xaxis[j] for j in new]).reshape(-1, 3)
    return np.array(gravity) - np.linalg.pinv(axes) @ (axes @ np.array(gravity))


def judged(before, after, gravity):
    """Why the loops of a model do not stay closed as before, or nothing; and a note where that cannot be said."""
    gravity = across(load(before), load(after), gravity)
    own = followed(load(before), gravity)
    pushed = followed(load(before), gravity, PUSH)
    if own is None or pushed is None or apart(own, pushed) > APART / 10 or own[0] > 0.05:
        return None, "not judged: the model as it was is chaotic, or open"
    other = followed(load(after), gravity)
    if other is None:
        return "the numbers run away", None
    if other[0] > WIDER * max(own[0], LEAST):
        return f"gap {own[0]:.1e} -> {other[0]:.1e} m", None
    # No less than the model as it was is from itself at shorter steps.
    fine = followed(load(before), gravity, finer=4)
    allowed = APART if fine is None else max(APART, apart(own, fine))
    far = apart(own, other)
    return (f"joints {far:.1e} rad apart", None) if far > allowed else (None, None)


def places(file):
    """The joints and loops at which each redundant constraint can be let go."""
    found = ozols("lint", file, "--format", "json")
    if found.returncode != 1:
        return []
    names = []
    for f in json.loads(found.stdout)["files"][0]["findings"]:
        names += [f["constraint"], *f["duplicates"]]
    return sorted(set(names))


def one(task):
    name, text, gravity = task
    out = []
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        file = folder / "before.xml"
        if isinstance(text, pathlib.Path):
            file = text
        else:
            file.write_text(text)
        # By default, and at each place alone, which may not be enough: then nothing is written.
        for at in [None, *places(file)]:
            after = folder / "after.xml"
            try:
                found = ozols("fix", file, *(["--at", at] if at else []), "-o", after, "-q")
                if found.returncode == 0 and after.exists():
                    out.append((f"{name} fix {at or ''}", *judged(file, after, gravity)))
            except ValueError as e:
                out.append((f"{name} fix {at or ''}", f"MuJoCo refuses it: {e}", None))
            finally:
                after.unlink(missing_ok=True)
        # A redesign against the mechanism as it is, both with masses and moments of their own.
        whole = folder / "whole.toml"
        if ozols("export", file, "--to", "toml", "-o", whole, "-q").returncode == 0:
            weigh(whole)
            plain = folder / "plain.xml"
            if (found := ozols("export", whole, "--to", "mjcf", "-o", plain, "-q")).returncode != 0:
                out.append((f"{name} export", found.stderr.strip()[:200], None))
            else:
                for k in (1, 2, 3):
                    idea = folder / f"idea-{k}.xml"
                    words = ("export", whole, "--idea", k, "--to", "mjcf", "-o", idea, "-q")
                    if ozols(*words).returncode == 0:
                        out.append((f"{name} export idea {k}", *judged(plain, idea, gravity)))
    return out


def weigh(path):
    """Gives each link of a mechanism file 1 kg where its joints are, so that all its redesigns weigh the same."""
    text = path.read_text()
    file = tomllib.loads(text)
    unit = 1e-3 if file.get("length_unit") == "mm" else 1.0
    for link in file["link"]:
        if link.get("role") == "frame":
            continue
        at = np.mean([j["point"] for j in file["joint"] if link["id"] in j["links"]], axis=0)
        size = max(np.ptp(np.array([j["point"] for j in file["joint"]], float)) * unit, 1e-3)
        inertia = float(0.02 * size * size)
        mass = f"mass = 1.0\ncentre = {[float(x) for x in at]}\ninertia = {[inertia] * 3}\n"
        head = f'id = "{link["id"]}"\n'
        text = text.replace(f"[[link]]\n{head}", f"[[link]]\n{head}{mass}", 1)
    path.write_text(text)


def tasks(models):
    guide = pathlib.Path(__file__).parents[2] / "src/guide/robots.md"
    text = re.search(r"```xml four-bar.xml\n(.*?)```", guide.read_text(), re.DOTALL).group(1)
    plane = (0, -9.81, 0)
    yield "guide", text, plane
    yield "guide-weld", re.sub(r'<connect name="pin" (.*?) anchor="[^"]*"/>', r'<weld name="pin" \1/>', text), plane
    down = (0, 0, -9.81)
    if models.is_dir():
        import compare

        for kind, name, *rest in compare.published(models):
            if kind == "mjcf" and str(rest[0]).endswith(".xml"):
                yield name, pathlib.Path(rest[0]), down
    for kind in generate.KINDS:
        for how in ("connect", "weld", "site"):
            yield f"{kind}-{how}", generate.tree(kind, 1).mjcf(how), down


def main():
    pattern = sys.argv[3] if len(sys.argv) > 3 else ""
    wanted = [t for t in tasks(pathlib.Path(sys.argv[2])) if re.search(pattern, t[0])]
    tried, bad, soft = 0, 0, 0
    with multiprocessing.Pool() as pool:
        for found in pool.imap(one, wanted):
            for name, why, note in found:
                if note:
                    continue
                tried += 1
                if why:
                    exported = " export idea " in name
                    soft, bad = soft + exported, bad + (not exported)
                    print("  ", name, why)
    print(
        f"softness: {tried} models held against themselves; open or elsewhere: {bad} that fix wrote,",
        f"{soft} exported redesigns, whose in-between bodies are known to be light",
    )
    sys.exit(bad > 0)


if __name__ == "__main__":
    main()
