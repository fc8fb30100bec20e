"""Converts models with ozols, by way of each format and into MJCF, and asks MuJoCo whether they came back: W, redundant rows, and
where the links are after a second under gravity. Pinocchio and sdformat have to take what is written on the way.

usage: converted.py OZOLS MODELS [PATTERN]
Prints the share of conversions that came back, and ends with 1 where it is less than WANTED.
"""

import json
import multiprocessing
import pathlib
import re
import subprocess
import sys
import tempfile

import compare
import generate
import loading
import mujoco
import mujoco_figures
import numpy as np

# The share that has to come back, and how far links may be apart after a second, in metres.
WANTED = 0.95
APART = 1e-4
STEP = 2e-4
# When links are looked at, in seconds, and the push by which chaos is told, in rad/s and m/s.
TIMES = (0.05, 0.1, 0.2, 0.5, 1.0)
PUSH = 1e-9
# What the words on the command line are, and the ending of what they write.
WAYS = {"mjcf": ".xml", "sdf": ".sdf", "urdf": ".urdf", "urdf-yaml": ".urdf", "drake": ".urdf"}
OPEN = 1e-6
LIGHT = 1e-3


def ozols(*words):
    return subprocess.run([compare.OZOLS, *map(str, words)], capture_output=True, text=True, check=False)


def convert(file, way, out, more=()):
    """The report, or why there is none."""
    found = ozols("convert", file, *more, "--to", way, "-o", out, "--format", "json")
    if found.returncode != 0:
        return None, (found.stderr.strip() or "?").splitlines()[0]
    return json.loads(found.stdout), None


def bare(path):
    """A file of MJCF without meshes, which are not there."""
    text = pathlib.Path(path).read_text()
    text = re.sub(r'<geom [^>]*type="mesh"[^>]*/>', "", text)
    pathlib.Path(path).write_text(re.sub(r"<mesh [^>]*/>", "", text))
    return path


def drawn(model):
    """The pose of its keyframe, else that in which it is drawn."""
    m = model.model
    return (m.key_qpos[0] if m.nkey else m.qpos0).copy()


def still(model, q, lost=()):
    """Without what moves it or pulls at it by itself, and without what was told to be lost."""
    m = model.model
    m.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_ACTUATION) | int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    m.opt.enableflags = 0
    m.opt.timestep = STEP
    m.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    m.opt.gravity[:] = [0, 0, -9.81]
    m.opt.wind[:], m.opt.density, m.opt.viscosity = 0, 0, 0
    m.opt.tolerance, m.opt.iterations = 1e-14, 200
    m.eq_solref[:] = [2 * STEP, 1]
    m.eq_solimp[:] = [0.9999, 0.9999, 0.001, 0.5, 2]
    m.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_FRICTIONLOSS)
    m.body_gravcomp[:] = 0
    if m.ntendon:
        m.tendon_stiffness[:], m.tendon_damping[:] = 0, 0
    if "tendon of <equality>" in lost:
        model.data.eq_active[m.eq_type == mujoco.mjtEq.mjEQ_TENDON] = 0
        m.eq_active0[m.eq_type == mujoco.mjtEq.mjEQ_TENDON] = 0
    if "polynomial of a coupling" in lost:
        # Its tangent at the pose stands for it.
        for i in np.flatnonzero(m.eq_type == mujoco.mjtEq.mjEQ_JOINT):
            x = 0.0
            if (other := m.eq_obj2id[i]) >= 0:
                at = m.jnt_qposadr[other]
                x = q[at] - m.qpos0[at]
            powers = np.polynomial.Polynomial(m.eq_data[i, :5])
            slope = powers.deriv()(x)
            m.eq_data[i, :5] = [powers(x) - slope * x, slope, 0, 0, 0]
    if "armature of a joint" in lost:
        m.dof_armature[:] = 0
    if "spring of a joint" in lost:
        m.jnt_stiffness[:] = 0
    mujoco.mj_setConst(m, model.data)


def fallen(model, q, push=0.0):
    """The poses after so many seconds, from rest or pushed by so much in all freedoms; fewer where the numbers ran away."""
    m, d = model.model, model.data
    mujoco.mj_resetData(m, d)
    d.qpos[:], d.qvel[:] = q, push
    poses = {}
    for step in range(1, round(TIMES[-1] / STEP) + 1):
        mujoco.mj_step(m, d)
        if any(w.number for w in d.warning):
            break
        if step in (steps := {round(t / STEP): t for t in TIMES}):
            poses[steps[step]] = d.qpos.copy()
    return poses


def moved(before, after, q, there, lost):
    """How far named links are apart after a second, in metres, by three points of each, and a note. Where the model as it was,
    pushed by a billionth, comes out far from itself by then (it is chaotic), as long before as it does not."""
    names = [n for n in before.places(q) if n in after.places(there) and n != "world"]
    reach = before.reach(q)
    corners = np.vstack([np.zeros(3), np.eye(3)[:2]])
    points = {n: [p + max(reach[n], 1e-3) * c for c in corners] for n, p in before.places(q).items() if n in names}
    ours, theirs = before.marks(q, points), after.marks(there, points)
    still(before, q, lost)
    still(after, there, lost)
    own, other = fallen(before, q), fallen(after, there)

    def apart(poses, model, marks, t):
        a, b = before.seen(own[t], ours), model.seen(poses[t], marks)
        return max((float(np.abs(x - y).max()) for n in names for x, y in zip(a[n], b[n])), default=0.0)

    last = TIMES[-1]
    if last in own and last in other and (far := apart(other, after, theirs, last)) <= APART:
        return far, None
    pushed = fallen(before, q, PUSH)
    sure = [t for t in TIMES if t in own and t in pushed and apart(pushed, before, ours, t) < APART / 10]
    if not sure:
        return None, "not judged: MuJoCo does not hold the model as it was"
    t = sure[-1]
    far = apart(other, after, theirs, t) if t in other else np.inf
    return far, None if t == last else f"compared over {t} s: the model as it was is chaotic beyond"


def original(file):
    """MuJoCo's own reading of a model, where it reads it."""
    try:
        return mujoco_figures.Model(file) if str(file).endswith(".xml") else None
    except ValueError:
        return None


def refused(path, ending, of):
    """What engines have against a file, but for what they have against its owner's, of whatever format."""
    own = set(loading.refused(of, pathlib.Path(of).suffix)) if not str(of).endswith(".xml") else set()
    if any("sdformat complains" in o for o in own):
        return
    # A joint of Drake's own is none to others.
    if "<drake:joint" not in pathlib.Path(path).read_text():
        yield from (w for w in loading.refused(path, ending) if w not in own)


def one(task):
    """For each way of a model: its name, whether it came back, and why not."""
    name, file, more = task
    out = []
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        if callable(file):
            file, side = file(folder)
            more = ["--loops", side] if side else []
        found = ozols("lint", file, *more, "--format", "json")
        if found.returncode == 2:
            return [(name, None, "not readable: " + (found.stderr.strip() or "?").splitlines()[0])]
        figures = json.loads(found.stdout)["files"][0]
        direct = folder / "direct.xml"
        report, why = convert(file, "mjcf", direct, more)
        if report is None:
            return [(f"{name} -> mjcf", False, why)]
        for way, ending in WAYS.items():
            label = f"{name} -> {way}" + (" -> mjcf" if way != "mjcf" else "")
            try:
                out.append((label, *through(way, ending, (file, more), figures, direct)))
            except Exception as e:  # A model that breaks the comparison did not come back.
                out.append((label, False, f"{type(e).__name__}: {e}"))
    return out


def through(way, ending, source, figures, direct):
    file, more = source
    folder = direct.parent
    last, lost, repeated = direct, {}, 0
    if way != "mjcf":
        between = folder / f"by-{way}{ending}"
        report, why = convert(file, way, between, more)
        if report is None:
            return False, why
        lost = {k["kind"] for k in report["lost"]}
        repeated = report["repeated"]
        if report["coupling_rows_lost"]:
            return False, f"{report['coupling_rows_lost']} couplings lost"
        for why in refused(between, ending, file):
            return False, why
        pose = [w for k, v in report["pose"].items() for w in ("--pose", f"{k}={','.join(map(repr, v))}")]
        beside = between.with_suffix(".yaml")
        again = pose + (["--loops", beside] if way == "urdf-yaml" and "[]" not in beside.read_text().split("\n")[0] else [])
        last = folder / f"by-{way}-back.xml"
        report, why = convert(between, "mjcf", last, again)
        if report is None:
            return False, f"back: {why}"
    after = mujoco_figures.Model(bare(last))
    there, gap = after.close(drawn(after))
    if gap > OPEN:
        return False, f"MuJoCo does not close it ({gap:.1e})"
    peer = after.figures(there)
    if figures["redundant"] == figures["redundant_at_most"]:
        # What a loop has too many rows for is counted in MuJoCo's own.
        wanted = (figures["mobility"], figures["redundant"] + repeated)
        if (peer["w"], peer["redundant"]) != wanted:
            return False, f"W and redundant are {peer['w']} and {peer['redundant']}, not {wanted[0]} and {wanted[1]}"
    # What MuJoCo does not read is held against what was written at once.
    first = mujoco_figures.Model(bare(direct))
    before = original(file)
    if before is None or before.model.nq != first.model.nq:
        before = first
    q = before.close(drawn(first))[0]
    # How what weighs next to nothing falls is up to what stands in for its mass.
    if first.model.body_mass[1:].max(initial=0) < LIGHT:
        return True, "it has no masses: only W and rows are compared"
    far, note = moved(before, after, q, there, lost)
    if far is None:
        return None, note
    if far > APART:
        return False, f"{far:.1e} m apart {note or 'after a second'}"
    return True, note


def tasks(models):
    if models.is_dir():
        for kind, name, *rest in compare.published(models):
            more = rest[1] if kind == "through" and len(rest) > 1 else (["--loops", rest[1]] if kind == "urdf" else [])
            yield name, rest[0], list(more)
    for kind, name, *rest in compare.own():
        more = rest[1] if kind == "through" and len(rest) > 1 else (["--loops", rest[1]] if kind == "urdf" else [])
        yield name, rest[0], list(more)
    for n, kind in enumerate(generate.KINDS):
        # Each kind in two of the five ways to join it, by turns.
        for how in (compare.HOWS[n % 5], compare.HOWS[(n + 2) % 5]):
            yield f"{kind}-{how}", Generated(kind, how), []


class Generated:
    """A generated model, written where it is wanted."""

    def __init__(self, kind, how):
        self.kind, self.how = kind, how

    def __call__(self, folder):
        model = generate.tree(self.kind, 1)
        if self.how == "yaml":
            text, side = model.urdf(beside=True)
            (folder / "m.yaml").write_text(side)
            (folder / "m.urdf").write_text(text)
            return folder / "m.urdf", folder / "m.yaml"
        ending, text = {
            "loop_joint": lambda: (".urdf", model.urdf()[0]),
            "sdf": lambda: (".sdf", model.sdf()),
        }.get(self.how, lambda: (".xml", model.mjcf(self.how)))()
        (folder / f"m{ending}").write_text(text)
        return folder / f"m{ending}", None


def main():
    wanted = [t for t in tasks(pathlib.Path(sys.argv[2])) if re.search(sys.argv[3] if len(sys.argv) > 3 else "", t[0])]
    came, total = 0, 0
    with multiprocessing.Pool() as pool:
        for found in pool.imap(one, wanted):
            for name, back, why in found:
                if back is None:
                    print("  note:", name, why)
                    continue
                total += 1
                came += back
                if not back:
                    print("FAILED", name, why)
                elif why:
                    print("  note:", name, why)
            sys.stdout.flush()
    share = came / max(total, 1)
    print(f"{came} of {total} conversions came back ({100 * share:.1f} %)")
    return 0 if total and share >= WANTED else 1


if __name__ == "__main__":
    compare.OZOLS = sys.argv[1]
    sys.exit(main())
