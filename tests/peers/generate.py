"""Closed-loop models of the kinds of mechanisms, each in a random pose that MuJoCo moved it to, turned at random, joined in each
way that MJCF, URDF and SDF have, and rounded on purpose."""

import tempfile
import zlib

import mujoco
import mujoco_figures
import numpy as np
from kinds import GROUND, KINDS, X, Y, Z, Kind

FULL = 17
# What is built in what order, so that balls close the loops where there are some.
ORDER = "FTPCURS"
MASS = "mass='1' diaginertia='1 1 1'"


def turn(random):
    """A random rotation."""
    q = random.normal(size=4)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def freedoms(joint, on=None):
    """Names, kinds and axes of the turns and slides of a joint, in series from one of its links; a ball is three turns."""
    each = {"R": "h", "P": "s", "C": "sh", "U": "hh", "S": "hhh", "T": "sss", "F": "f"}[joint.kind]
    axes = {"C": joint.axes * 2, "S": [X, Y, Z], "T": [X, Y, Z], "F": [X]}.get(joint.kind, joint.axes)
    word = {"h": "hinge", "s": "slide", "f": "free"}
    found = [(joint.name + f"_{i}" * (i > 0), word[k], a) for i, (k, a) in enumerate(zip(each, axes))]
    return found if on in (None, joint.links[0]) else found[::-1]


class Tree:
    """A mechanism as bodies that hang on one another, each with its frame at the joint that holds it and parallel to the world,
    and the joints that close its loops; numbers are rounded where they are written."""

    def __init__(self, kind, digits=FULL):
        self.kind, self.digits = kind, digits
        self.origin, self.holds, self.closing = {GROUND: np.zeros(3)}, {}, []
        group = {link: link for j in kind.joints for link in j.links}

        def root(link):
            return link if group[link] == link else root(group[link])

        tree = []
        for j in sorted(kind.joints, key=lambda j: ORDER.index(j.kind)):
            a, b = map(root, j.links)
            if a == b:
                self.closing.append(j)
            else:
                group[a] = b
                tree.append(j)
        waiting = [GROUND]
        for link in waiting:
            for j in tree:
                if link in j.links and j not in self.holds.values():
                    other = j.links[j.links[0] == link]
                    self.holds[other] = j
                    self.origin[other] = j.at
                    waiting.append(other)
        self.on = {c: j.links[j.links[0] == c] for c, j in self.holds.items()}
        # A mimic joint follows one other; couplings that cannot be said so are counted.
        self.mimics, self.unsaid = {}, 0
        for a, b, ratio in kind.couplings:
            ways = [(f, w) for f, w in ((a, (b, ratio)), (b, (a, 1 / ratio))) if f not in self.mimics]
            self.mimics.update(ways[:1])
            self.unsaid += not ways

    def numbers(self, v):
        return " ".join(f"{round(float(x), self.digits):.17g}" for x in v)

    def local(self, link, at):
        return self.numbers(at - self.origin[link])

    def mjcf_joints(self, j, on):
        if j.kind in "SF":
            return [f"<joint name='{j.name}' type='{'ball' if j.kind == 'S' else 'free'}'/>"]
        return [f"<joint name='{n}' type='{k}' axis='{self.numbers(a)}'/>" for n, k, a in freedoms(j, on)]

    def mjcf(self, how):
        """With `connect` at bodies or at sites, or with `weld` of a small body on the joint that closes."""
        inside, lines = {link: [] for link in self.origin}, []
        for i, j in enumerate(self.closing):
            a, b = j.links
            if how == "weld" or j.kind not in "RUS":
                body = [f"<body name='{j.name}_end' pos='{self.local(b, j.at)}'>", f"<inertial pos='0 0 0' {MASS}/>"]
                inside[b] += [*body, *self.mjcf_joints(j, b), "</body>"]
                second = "" if a == GROUND else f"body2='{a}'"
                lines.append(f"<weld body1='{j.name}_end' {second}/>")
            elif how == "site":
                for link in j.links:
                    inside[link].append(f"<site name='s{i}_{link}' pos='{self.local(link, j.at)}'/>")
                lines.append(f"<connect site1='s{i}_{a}' site2='s{i}_{b}'/>")
            else:
                first, second = (b, a) if a == GROUND else (a, b)
                second = "" if second == GROUND else f"body2='{second}'"
                lines.append(f"<connect body1='{first}' {second} anchor='{self.local(first, j.at)}'/>")
        for follows, leads, ratio in self.kind.couplings:
            lines.append(f"<joint joint1='{follows}' joint2='{leads}' polycoef='0 {ratio} 0 0 0'/>")

        def below(link):
            own = []
            if link != GROUND:
                own = [f"<body name='{link}' pos='{self.local(self.on[link], self.origin[link])}'>", f"<inertial pos='0 0 0' {MASS}/>"]
                own += self.mjcf_joints(self.holds[link], self.on[link])
            own += inside[link]
            for c, on in self.on.items():
                own += below(c) if on == link else []
            return own + ["</body>"] * (link != GROUND)

        world, closed = "\n".join(below(GROUND)), "\n".join(lines)
        return f"<mujoco>\n<compiler angle='radian'/>\n<worldbody>\n{world}\n</worldbody>\n<equality>\n{closed}\n</equality>\n</mujoco>\n"

    def urdf_link(self, name):
        inertia = "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>"
        return f"<link name='{name}'><inertial>{inertia}</inertial></link>"

    def urdf_joints(self, j, on, link, leave=0, mimics=()):
        """The joints in series from one link to another, without the last ones; the link that they end at."""
        out, at = [], self.local(on, j.at)
        all = freedoms(j, on)
        word = {"hinge": "continuous", "slide": "prismatic", "free": "floating"}
        for i, (name, k, a) in enumerate(all[: len(all) - leave]):
            child = link if link and i + 1 == len(all) else f"{name}_end"
            if child != link:
                out.append(self.urdf_link(child))
            more = "<limit lower='-9' upper='9' effort='1' velocity='1'/>" if k == "slide" else ""
            if name in mimics:
                more += "<mimic joint='{}' multiplier='{}'/>".format(*mimics[name])
            out.append(
                f"<joint name='{name}' type='{word[k]}'><parent link='{on}'/><child link='{child}'/>"
                f"<origin xyz='{at}'/><axis xyz='{self.numbers(a)}'/>{more}</joint>"
            )
            on, at = child, "0 0 0"
        return out, on, at

    def urdf(self, beside=False):
        """With `<loop_joint>`, or `beside` it a robot.yaml, where a ball stands for what turns; then without couplings, which
        Pinocchio leaves out."""
        out, pairs, types = [self.urdf_link(link) for link in self.origin], [], []
        for link, j in self.holds.items():
            out += self.urdf_joints(j, self.on[link], link, mimics={} if beside else self.mimics)[0]
        for i, j in enumerate(self.closing):
            a, b = j.links
            ball = j.kind == "S" or beside and j.kind in "RU"
            more, a, at = ([], a, self.local(a, j.at)) if ball else self.urdf_joints(j, a, "", leave=0 if beside else 1)
            out += more
            if beside:
                ends = [(a, at), (b, self.local(b, j.at))]
                for end, (link, place) in zip("ab", ends):
                    out.append(f"<link name='end{i}{end}'/>")
                    out.append(
                        f"<joint name='cut{i}{end}' type='fixed'><parent link='{link}'/><child link='end{i}{end}'/>"
                        f"<origin xyz='{place}'/></joint>"
                    )
                pairs.append([f"cut{i}a", f"cut{i}b"])
                types.append("3d" if ball else "6d")
                continue
            _, k, axis = ("", "ball", X) if ball else freedoms(j)[-1]
            word = {"ball": "spherical", "hinge": "revolute", "slide": "prismatic"}[k]
            out.append(
                f"<loop_joint name='{j.name}' type='{word}'><link1 link='{a}' xyz='{at}' rpy='0 0 0'/>"
                f"<link2 link='{b}' xyz='{self.local(b, j.at)}' rpy='0 0 0'/><axis xyz='{self.numbers(axis)}'/></loop_joint>"
            )
        text = "<robot name='kind'>\n" + "\n".join(out) + "\n</robot>\n"
        return text, f"closed_loop: {pairs}\ntype: {types}\n"

    def sdf(self):
        """With every joint as it is, or in series."""
        out = []
        for link in self.origin:
            if link != GROUND:
                out.append(f"<link name='{link}'><pose>{self.numbers(self.origin[link])} 0 0 0</pose></link>")
        words = {"R": "revolute", "P": "prismatic", "U": "universal", "S": "ball", "hinge": "revolute", "slide": "prismatic"}
        for j in self.kind.joints:
            a, b = ["world" if link == GROUND else link for link in j.links]
            if j.kind == "F":
                continue
            series = [(j.name, j.kind, j.axes)] if j.kind in words else [(n, k, [x]) for n, k, x in freedoms(j)]
            for i, (name, k, axes) in enumerate(series):
                child = b if i + 1 == len(series) else f"{name}_end"
                if child != b:
                    out.append(f"<link name='{child}'><pose>{self.numbers(j.at)} 0 0 0</pose></link>")
                tags = zip(["axis", "axis2"], axes)
                follows = "<mimic joint='{}' axis='axis'><multiplier>{}</multiplier></mimic>"
                follows = follows.format(*self.mimics[name]) if name in self.mimics else ""
                ways = "".join(f"<{t}><xyz expressed_in='__model__'>{self.numbers(x)}</xyz>{follows}</{t}>" for t, x in tags)
                out.append(
                    f"<joint name='{name}' type='{words[k]}'><pose relative_to='__model__'>{self.numbers(j.at)} 0 0 0</pose>"
                    f"<parent>{a}</parent><child>{child}</child>{ways}</joint>"
                )
                a = child
        return "<sdf version='1.11'>\n<model name='kind'>\n" + "\n".join(out) + "\n</model>\n</sdf>\n"


def load(text):
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as t:
        t.write(text)
        t.flush()
        return mujoco_figures.Model(t.name)


def moved(kind, random, steps=25):
    """The mechanism where a random motion leads it."""
    m = load(Tree(kind).mjcf("weld"))
    q, gap = m.close(m.model.qpos0)
    assert gap < 1e-12, f"its table is open by {gap}"
    v = random.normal(size=m.model.nv)
    for _ in range(steps):
        j, _ = m.jacobian(q)
        v = v - np.linalg.pinv(j, rcond=1e-6) @ (j @ v)
        if np.abs(v).max() < 1e-9:
            break
        v = v / np.abs(v).max()
        mujoco_figures.integrate(m.model, q, 0.02 * v)
        q, _ = m.close(q)
    m.jacobian(q)

    def now(j):
        names = [j.name, *(f"{j.name}_{i}" for i in range(1, 3))]
        found = [mujoco.mj_name2id(m.model, mujoco.mjtObj.mjOBJ_JOINT, n) for n in names]
        found = [i for i in found if i >= 0]
        axes = [m.data.xaxis[i].copy() for i in found][: len(j.axes)]
        return j._replace(at=m.data.xanchor[found[-1]].copy(), axes=axes)

    return Kind([now(j) for j in kind.joints], kind.couplings)


def turned(kind, rotation):
    """The mechanism turned as a whole; what slides in all directions or is free stays so."""
    each = [j._replace(at=rotation @ j.at, axes=[rotation @ a for a in j.axes]) for j in kind.joints]
    return Kind(each, kind.couplings)


def plain(name):
    """A kind as its table has it."""
    return Tree(KINDS[name](np.random.default_rng(1))).mjcf("connect")


def tree(name, number, digits=FULL):
    """A kind in its pose of a number; the first is not turned."""
    random = np.random.default_rng([zlib.crc32(name.encode()), number])
    kind = moved(KINDS[name](random), random)
    return Tree(turned(kind, turn(random)) if number else kind, digits)
