"""Lints and fixes models with ozols, and asks MuJoCo, Pinocchio and sdformat what became of them.

usage: compare.py OZOLS MODELS [PATTERN]
MODELS is a folder of published models, one folder each, which may not be there; PATTERN is of the names of those wanted. Ends
with 1 where a figure differs.
"""

import json
import multiprocessing
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import generate
import loading
import mujoco_figures
import numpy as np
import pinocchio_figures
import second
import urdf_in_mujoco

STEPS = 60
# Poses farther apart, inside the limits.
POSES = 20
# The same place, as a fraction of a model's size.
SAME = 1e-6
OWN = pathlib.Path(__file__).parent.parent / "data/robots"
HOWS = ["connect", "weld", "yaml", "loop_joint", "sdf"]

failures = []
notes = []
rows = []


def ozols(*words):
    out = subprocess.run([OZOLS, *map(str, words)], capture_output=True, text=True, check=False)
    return out.returncode, out.stdout, out.stderr


def expect(name, what, found, wanted):
    if found != wanted:
        failures.append(f"{name}: {what} is {found}, not {wanted}")


def lint(file, *more):
    code, out, err = ozols("lint", file, "--format", "json", *more)
    if code == 2:
        return None, err.strip().split("\n")[0]
    return json.loads(out)["files"][0], None


def size(peer, q):
    peer.jacobian(q)
    return max(float(np.abs(peer.data.xpos).max()), 1e-3)


def loads(name, file, ending, of=None):
    """Every engine takes what is written, and all of it."""
    for why in loading.refused(file, ending, of):
        failures.append(f"{name}: {why}")


def mjcf(name, file, exact=None, rounding=0.0):
    """One MJCF model: ours and MuJoCo's figures before and after, and the motion of one in the other. What is rounded on
    purpose closes as far as its digits do; MuJoCo's figures are those of the `exact` model then."""
    began = time.perf_counter()
    found, why = lint(file)
    took = time.perf_counter() - began
    if found is None:
        failures.append(f"{name}: not read: {why}")
        return
    # Rows that only rounding tells apart do not close what it leaves open.
    before = mujoco_figures.Model(file, max(mujoco_figures.ZERO, 30 * rounding))
    q, gap = before.close(before.model.qpos0)
    if gap > max(1e-7, 30 * rounding):
        failures.append(f"{name}: MuJoCo does not close it ({gap:.1e})")
        return
    peer = exact.figures(exact.close(exact.model.qpos0)[0]) if exact else before.figures(q)
    out = found["redundant_at_most"] - found["redundant"]
    rows.append((name, peer["w"], peer["redundant"], found["mobility"], found["redundant"], out, took))
    left = found["left_out"]
    if out:
        # Undecided: the truth is within what is said.
        inside = found["redundant"] <= peer["redundant"] <= found["redundant_at_most"]
        expect(name, "the range of redundant", inside, True)
        return
    if left:
        notes.append(f"{name}: {left} rows of MuJoCo's between joints are no mechanism's; ozols leaves them out and says so")
    expect(name, "W", found["mobility"], peer["w"] + left)
    expect(name, "redundant", found["redundant"], peer["redundant"])
    if found["redundant"] == 0:
        return
    with tempfile.NamedTemporaryFile(suffix=".xml", dir=pathlib.Path(file).parent if exact else None) as t:
        code, _, err = ozols("fix", file, "-o", t.name)
        if code != 0:
            failures.append(f"{name}: not fixed: {err.strip().splitlines()[0]}")
            return
        loads(f"{name}, fixed", t.name, ".xml", file)
        after = mujoco_figures.Model(t.name)
    follow(name, before, after, q, peer, exact=exact)


def follow(name, before, after, q, peer, by_places=False, steps=STEPS, exact=None):
    """The way of the model as it was, step by step, in the model as it is: closed there, of full rank, and nowhere else. Then it
    falls for a second as the model as it was does, or as the `exact` one where rounding makes redundant rows contradict each
    other: MuJoCo holds on to such rows as far as it can, which moves links by up to a fifth of the size (agile-eye, 4 digits).

    "The same" is to a millionth of the model's size, and ten times what the model as it was is open by where it does not close.
    The poses are told by the joints that both have; where ozols wrote both, which may cut loops elsewhere, by the places of
    their links.
    """
    random = np.random.default_rng(7)
    v = random.normal(size=before.model.nv)
    whole, there = size(before, q), after.model.qpos0.copy()
    first = q.copy()
    links = [n for n in before.places(q) if n in after.places(there) and "~" not in n]
    # Three points of each link, as far out as it reaches.
    corners = np.vstack([np.zeros(3), np.eye(3)[:2]])
    reach = before.reach(q)
    points = {n: [p + max(reach[n], 1e-3 * whole) * c for c in corners] for n, p in before.places(q).items() if n in links}
    start = there if by_places else after.embed(before, q)
    ours, theirs = before.marks(q, points), after.marks(start, points)

    def apart(pose, wanted):
        found = after.seen(pose, theirs)
        gaps = [np.abs(a - b).max() for n in links for a, b in zip(found[n], wanted[n])]
        return float(max(gaps, default=0.0))

    for step in range(steps):
        j, _ = before.jacobian(q)
        v = v - np.linalg.pinv(j, rcond=before.zero) @ (j @ v)
        if np.abs(v).max() < 1e-9:
            break
        v = v / np.abs(v).max()
        mujoco_figures.integrate(before.model, q, v * 0.003)
        q, own = before.close(q)
        # What rounded coordinates leave open in the model as it was is open in the other, too.
        near = SAME * whole + 10 * own
        wanted = before.seen(q, ours)
        at = f"{name}, step {step}"
        if by_places:
            there = after.match(theirs, wanted, there)
        else:
            there = after.embed(before, q)
        expect(at, "the same place", bool(apart(there, wanted) < near), True)
        figures = after.figures(there)
        _, gap = after.jacobian(there)
        expect(at, "W", figures["w"], peer["w"])
        expect(at, "redundant", figures["redundant"], 0)
        expect(at, "closed", bool(np.abs(gap).max() < near), True)
        # From beside it, with as many coordinates held as there are motions, back to the same pose.
        if step % 10 == 0:
            held = after.independent(there, figures["w"])
            aside = there.copy()
            shift = 1e-3 * random.normal(size=after.model.nv)
            shift[held] = 0
            mujoco_figures.integrate(after.model, aside, shift)
            back, _ = after.close(aside, held)
            expect(at, "the pose it closes to again", bool(apart(back, wanted) < near), True)
        if any(f.startswith(name) for f in failures):
            return
    for number, q in enumerate(before.wander(first, POSES, random)):
        wanted = before.seen(q, ours)
        there = after.match(theirs, wanted, there) if by_places else after.embed(before, q)
        at = f"{name}, pose {number}"
        expect(at, "the same place", bool(apart(there, wanted) < SAME * whole + 10 * before.zero), True)
        figures = after.figures(there)
        expect(at, "W", figures["w"], peer["w"])
        expect(at, "redundant", figures["redundant"], 0)
        if any(f.startswith(name) for f in failures):
            return
    # Of places alone, the format between knows no masses.
    fell = second.apart(exact or before, after, first, start, (ours, theirs), whole, own=not by_places)
    if fell is None:
        notes.append(f"{name}: MuJoCo does not keep its loops closed for a second")
        return
    off, went = fell
    near = second.APART * max(1.0, went)
    expect(name, f"a second later {off:.1e} of its size apart (it went {went:.1e})", bool(off < near), True)


def urdf(name, file, side):
    """One URDF model with its loops in a file beside it: ours and Pinocchio's."""
    more = ["--loops", side]
    began = time.perf_counter()
    found, why = lint(file, *more)
    took = time.perf_counter() - began
    if found is None:
        failures.append(f"{name}: not read: {why}")
        return
    before = pinocchio_figures.Model(file, side)
    peer, gap = before.figures()
    if gap > 1e-9:
        failures.append(f"{name}: Pinocchio does not close it ({gap:.1e})")
        return
    rows.append((name, peer["w"], peer["redundant"], found["mobility"], found["redundant"], 0, took))
    expect(name, "W", found["mobility"], peer["w"])
    expect(name, "redundant", found["redundant"], peer["redundant"])
    if found["redundant"] == 0:
        return
    with tempfile.NamedTemporaryFile(suffix=".urdf") as t:
        code, _, err = ozols("fix", file, *more, "-o", t.name)
        if code != 0:
            failures.append(f"{name}: not fixed: {err.strip().splitlines()[0]}")
            return
        loads(f"{name}, fixed", t.name, ".urdf", file)
        after = pinocchio_figures.Model(t.name, side)
        figures, _ = after.figures()
        expect(f"{name}, fixed", "W", figures["w"], peer["w"])
        expect(f"{name}, fixed", "redundant", figures["redundant"], 0)
        for step, (w, redundant, apart) in enumerate(before.along(after, STEPS, POSES)):
            expect(f"{name}, step {step}", "W", w, peer["w"])
            expect(f"{name}, step {step}", "redundant", redundant, 0)
            expect(f"{name}, step {step}", "the same place", bool(apart < SAME), True)
        # The same in MuJoCo, with its loops, but for the small steps.
        models = [mujoco_figures.Model(urdf_in_mujoco.model(f, side)) for f in (file, t.name)]
        q, gap = models[0].close(models[0].model.qpos0)
        if gap > 1e-7:
            notes.append(f"{name}: MuJoCo does not close it from where it is drawn")
            return
        follow(f"{name} in MuJoCo", *models, q, models[0].figures(q), steps=0)


def as_mjcf(folder, file, more):
    """A model of any format as ozols writes it in MJCF."""
    toml, xml = folder / "model.toml", folder / "model.xml"
    for words in (["export", file, *more, "--to", "toml", "-o", toml], ["export", toml, "--to", "mjcf", "-o", xml]):
        code, _, err = ozols(*words)
        if code != 0:
            return None, err.strip().splitlines()[0]
    return mujoco_figures.Model(xml), None


def through(name, file, more=(), truth=None, moves=True):
    """A model that MuJoCo does not read: as ozols writes it in MJCF, before and after it is fixed in its own format."""
    began = time.perf_counter()
    found, why = lint(file, *more)
    took = time.perf_counter() - began
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)
        before, why = as_mjcf(folder, file, more) if found else (None, why)
        if before is None:
            failures.append(f"{name}: not read: {why}")
            return
        q, gap = before.close(before.model.qpos0)
        expect(name, "closed", bool(gap < 1e-7), True)
        peer = before.figures(q)
        if truth:
            expect(name, "figures", (peer["w"], peer["redundant"]), truth)
        out = found["redundant_at_most"] - found["redundant"]
        rows.append((name, peer["w"], peer["redundant"], found["mobility"], found["redundant"], out, took))
        expect(name, "W", found["mobility"], peer["w"])
        expect(name, "redundant", found["redundant"], peer["redundant"])
        if found["redundant"] == 0 or out:
            return
        fixed = folder / f"fixed{pathlib.Path(file).suffix}"
        code, _, err = ozols("fix", file, *more, "-o", fixed)
        if code != 0:
            failures.append(f"{name}: not fixed: {err.strip().splitlines()[0]}")
            return
        loads(f"{name}, fixed", fixed, fixed.suffix, file)
        after, why = as_mjcf(folder, fixed, more)
        if after is None:
            failures.append(f"{name}: fixed, not read: {why}")
            return
        if moves:
            follow(name, before, after, q, peer, by_places=True)
            return
        # Loops that are far open in the file may close in another pose.
        r, gap = after.close(after.model.qpos0)
        figures = after.figures(r)
        expect(f"{name}, fixed", "figures", (figures["w"], figures["redundant"]), (peer["w"], 0))


def one(task):
    """What a task adds to the rows and failures."""
    for told in (rows, failures, notes):
        told.clear()
    began = time.perf_counter()
    kind, name, *rest = task
    try:
        {"mjcf": mjcf, "urdf": urdf, "through": through, "generated": generated, "unread": unread}[kind](name, *rest)
    except Exception as e:  # A model that breaks the comparison is a failure of its own.
        failures.append(f"{name}: {type(e).__name__}: {e}")
    return list(rows), list(failures), list(notes), time.perf_counter() - began


def exported(name, folder, file):
    """What ozols writes of a model in the other formats."""
    for ending in (".urdf", ".sdf", ".xml"):
        out = folder / f"exported{ending}"
        code, _, err = ozols("export", file, "--to", {".xml": "mjcf"}.get(ending, ending[1:]), "-o", out)
        if code != 0:
            notes.append(f"{name}: not written as {ending[1:]}: {err.strip().splitlines()[0]}")
            continue
        loads(f"{name}, as {ending[1:]}", out, ending)
        if ending == ".urdf" and "mimic" not in out.read_text():
            found, _ = lint(file)
            model = mujoco_figures.Model(urdf_in_mujoco.model(out))
            figures = model.figures(model.close(model.model.qpos0)[0])
            expect(f"{name}, as urdf", "W", figures["w"], found["mobility"])
            expect(f"{name}, as urdf", "redundant", figures["redundant"], found["redundant"])


def generated(name, kind, number, how, digits):
    """A generated model in one joining; the figures to be had are those of MuJoCo of the model in full digits."""
    whole, model = generate.tree(kind, number), generate.tree(kind, number, digits)
    with tempfile.TemporaryDirectory() as t:
        folder = pathlib.Path(t)

        def put(ending, text):
            file = folder / f"{name}{ending}"
            file.write_text(text)
            return file

        def exact(way):
            return mujoco_figures.Model(put("-exact.xml", whole.mjcf(way)))

        if how in ["connect", "site", "weld"]:
            rounded = digits < generate.FULL
            file = put(".xml", model.mjcf(how))
            mjcf(name, file, exact(how) if rounded else None, 10.0**-digits)
            if how == "connect" and not rounded:
                exported(name, folder, file)
            return
        if how == "yaml":
            text, side = model.urdf(beside=True)
            urdf(name, put(".urdf", text), put(".yaml", side))
            return
        peer = exact("weld")
        truth = peer.figures(peer.close(peer.model.qpos0)[0])
        if whole.unsaid:
            notes.append(f"{name}: {whole.unsaid} of its couplings cannot be said: a mimic joint follows one other")
        text = model.sdf() if how == "sdf" else model.urdf()[0]
        through(name, put(".sdf" if how == "sdf" else ".urdf", text), (), (truth["w"], truth["redundant"] - whole.unsaid))


def unread(name, file):
    """A model that MuJoCo 4.0 does not take for its tendon on a ball: without tendons."""
    text = re.sub(r"<tendon>.*?</tendon>|<tendon [^>]*/>", "", file.read_text(), flags=re.DOTALL)
    with tempfile.TemporaryDirectory() as t:
        other = pathlib.Path(t) / file.name
        other.write_text(text)
        mjcf(name, other)


def published(models):
    """Kind of comparison, name and the rest, the longest first."""
    beest = models / "drake_strandbeest"
    more = ["--loops", beest / "strandbeest_ball_constraints.json"]
    yield "through", "strandbeest", beest / "strandbeest_nomesh.urdf", more, None, False
    for name in ["toddlerbot_2xc/toddlerbot_2xc", "robotiq_2f85_v4/2f85", "xarm7_hand/hand"]:
        yield "mjcf", name.split("/")[0], models / f"{name}.nomesh.xml"
    yield "unread", "mujoco_constraints", models / "mujoco_constraints/constraints.xml"
    for name in ["epr_5bar_linkage", "epr_5bar_linkage_iso6d", "epr_digit_like", "epr_talos_like"]:
        yield "urdf", name, models / name / "robot.urdf", models / name / "robot.yaml"
    for name in ["epr_digit_like_2legs", "epr_battobot_6d"]:
        yield "through", name, models / name / "robot.urdf", ["--loops", models / name / "robot.yaml"]
    yield "through", "polaris", models / "gazebo_polaris_ranger_ev" / "model-1_4.sdf"
    for name in ["four_bar_loop.sdf", "four_bar_weld.sdf", "four_bar.sdf"]:
        yield "through", name, models / "drake_four_bar" / name, ["--assemble"]
    for file in sorted((models / "robotiq_ros_urdf").glob("*.urdf")):
        # One of them has no joint that moves.
        if "mesh" not in file.name:
            yield "through", file.name.split(".")[0], file


def own():
    """The models that the other tests read."""
    yield "mjcf", "gripper", OWN / "gripper.xml"
    yield "urdf", "five_bar", OWN / "five_bar.urdf", OWN / "five_bar.yaml"
    yield "through", "leg", OWN / "leg.urdf", ["--loops", OWN / "leg.yaml"]
    yield "through", "mimic_gripper", OWN / "mimic_gripper.urdf"
    for name in ["four_bar_loop", "four_bar_weld"]:
        yield "through", name, OWN / f"{name}.sdf", ["--assemble"], (1, 3)


def kinds():
    """The generated models."""
    # Each kind in a pose of its own for each way to join it, and for each number of digits, joined in MuJoCo's ways by turns.
    for k, kind in enumerate(generate.KINDS):
        ways = [(how, generate.FULL) for how in HOWS]
        ways += [(["connect", "weld", "site"][(k + digits) % 3], digits) for digits in range(4, 9)]
        for number, (how, d) in enumerate(ways):
            yield "generated", f"{kind}-{how}" + f"-{d}" * (d < generate.FULL), kind, number, how, d


def main():
    models = pathlib.Path(MODELS)
    tasks = list(published(models)) if models.is_dir() else []
    if not tasks:
        print(f"{models} is not there: no published models")
    wanted = [t for t in [*tasks, *own(), *kinds()] if re.search(ONLY, t[1])]
    total, wrong, told = 0, [], 0
    print(f"{'model':32} {'peer W':>6} {'red.':>5} {'our W':>6} {'red.':>5}  lint, all in s")
    with multiprocessing.Pool() as pool:
        for found, failed, noted, took in pool.imap(one, wanted):
            for name, w, r, our_w, our_r, out, lint_took in found:
                most = f"-{our_r + out}" if out else ""
                print(f"{name:32} {w:6} {r:5} {our_w:6} {our_r:>4}{most:2}  {lint_took:.2f} {took:.1f}")
            for f in failed[:5]:
                print("FAILED", f)
            for n in noted:
                print("  note:", n)
            sys.stdout.flush()
            told += len(noted)
            total += len(found)
            wrong += failed
    print(f"{total} models, {len(wrong)} failures, {told} notes on what a format or a peer cannot say")
    return 1 if wrong or not total else 0


if __name__ == "__main__":
    OZOLS, MODELS = sys.argv[1:3]
    ONLY = sys.argv[3] if len(sys.argv) > 3 else ""
    sys.exit(main())
