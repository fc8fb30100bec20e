"""Closed-loop models as MJCF: kinds of mechanisms, joined in each way that MuJoCo has, turned at random, rounded on purpose."""

import numpy as np


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


class Tree:
    """Bodies whose frames are the world's, turned and moved as a whole, each number rounded where it is written."""

    def __init__(self, rotation, digits):
        self.rotation, self.digits = rotation, digits
        self.bodies = {}
        self.children = {"": []}
        self.equalities = []
        self.couplings = []

    def numbers(self, v):
        return " ".join(f"{round(float(x), self.digits):.17g}" for x in v)

    def body(self, name, on, at, joints):
        self.bodies[name] = (np.array(at, float), joints)
        self.children.setdefault(on, []).append(name)
        self.children.setdefault(name, [])
        self.on = getattr(self, "on", {})
        self.on[name] = on

    def join(self, a, b, at, how):
        self.equalities.append((a, b, np.array(at, float), how))

    def write(self, name, sites):
        out = [f"  <body name='{name}' pos='{self.numbers(self.local(name))}'>"]
        out.append("    <inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>")
        for kind, axis in self.bodies[name][1]:
            along = "" if axis is None else f" axis='{self.numbers(self.rotation @ np.array(axis, float))}'"
            out.append(f"    <joint name='{name}_{len(out)}' type='{kind}'{along}/>")
        out += sites.get(name, [])
        for c in self.children[name]:
            out.append(self.write(c, sites))
        out.append("  </body>")
        return "\n".join(out)

    def local(self, name):
        at, _ = self.bodies[name]
        on = self.on[name]
        from_ = self.bodies[on][0] if on else np.zeros(3)
        return self.rotation @ (at - from_)

    def text(self):
        sites, lines = {}, []
        for i, (a, b, at, how) in enumerate(self.equalities):
            here = {n: self.rotation @ (at - (self.bodies[n][0] if n else np.zeros(3))) for n in (a, b)}
            if how == "site":
                for end, n in enumerate((a, b)):
                    sites.setdefault(n, []).append(f"    <site name='s{i}_{end}' pos='{self.numbers(here[n])}'/>")
                lines.append(f"    <connect site1='s{i}_0' site2='s{i}_1'/>")
            elif how == "connect":
                second = f"body2='{b}'" if b else ""
                lines.append(f"    <connect body1='{a}' {second} anchor='{self.numbers(here[a])}'/>")
            else:
                second = f"body2='{b}'" if b else ""
                lines.append(f"    <weld body1='{a}' {second}/>")
        world = "\n".join([*sites.get("", []), *(self.write(c, sites) for c in self.children[""])])
        return (
            "<mujoco>\n  <compiler angle='radian'/>\n  <worldbody>\n"
            + world
            + "\n  </worldbody>\n  <equality>\n"
            + "\n".join(lines)
            + "\n  </equality>\n</mujoco>\n"
        )


Z = (0, 0, 1)


def four_bar(t, how):
    t.body("a", "", (0, 0, 0), [("hinge", Z)])
    t.body("b", "a", (0.2, 0.9, 0), [("hinge", Z)])
    t.body("c", "", (2, 0, 0), [("hinge", Z)])
    if how == "weld":
        t.body("d", "c", (2.3, 1.4, 0), [("hinge", Z)])
        t.join("b", "d", (2.3, 1.4, 0), how)
    else:
        t.join("b", "c", (2.3, 1.4, 0), how)


def slider_crank(t, how):
    t.body("crank", "", (0, 0, 0), [("hinge", Z)])
    t.body("rod", "crank", (0.3, 0.4, 0), [("hinge", Z)])
    t.body("slider", "", (1.5, 0, 0), [("slide", (1, 0, 0))])
    if how == "weld":
        t.body("pin", "slider", (1.5, 0, 0), [("hinge", Z)])
        t.join("rod", "pin", (1.5, 0, 0), how)
    else:
        t.join("rod", "slider", (1.5, 0, 0), how)


def gripper(t, how):
    for side in (-1, 1):
        n = "l" if side < 0 else "r"
        t.body(f"{n}1", "", (side * 0.3, 0, 0), [("hinge", Z)])
        t.body(f"{n}2", "", (side * 0.6, 0.1, 0), [("hinge", Z)])
        t.body(f"{n}3", f"{n}1", (side * 0.5, 0.8, 0), [("hinge", Z)])
        t.join(f"{n}3", f"{n}2", (side * 0.9, 0.7, 0), "connect" if how == "weld" else how)


def delta(t, how):
    """Three arms; each forearm is one rod pair taken for a universal joint at either end."""
    for i in range(3):
        a = 2 * np.pi * i / 3
        out, across = np.array([np.cos(a), np.sin(a), 0]), np.array([-np.sin(a), np.cos(a), 0])
        t.body(f"arm{i}", "", out * 1.0, [("hinge", across)])
        t.body(f"fore{i}", f"arm{i}", out * 1.4 - np.array([0, 0, 0.3]), [("hinge", across), ("hinge", (0, 0, 1))])
    t.body("platform", "", (0, 0, -1.5), [("slide", (1, 0, 0)), ("slide", (0, 1, 0)), ("slide", Z)])
    for i in range(3):
        a = 2 * np.pi * i / 3
        out, across = np.array([np.cos(a), np.sin(a), 0]), np.array([-np.sin(a), np.cos(a), 0])
        at = out * 0.3 + np.array([0, 0, -1.5])
        if how == "weld":
            t.body(f"wrist{i}", f"fore{i}", at, [("hinge", (0, 0, 1)), ("hinge", across)])
            t.join(f"wrist{i}", "platform", at, how)
        else:
            t.join(f"fore{i}", "platform", at, how)


def stewart(t, how):
    t.body("top", "", (0, 0, 1), [("free", None)])
    for i in range(6):
        a, b = np.pi / 3 * i + 0.2 * (-1) ** i, np.pi / 3 * i - 0.35 * (-1) ** i
        foot = np.array([np.cos(a), np.sin(a), 0])
        head = np.array([0.6 * np.cos(b), 0.6 * np.sin(b), 1])
        along = head - foot
        along = along / np.linalg.norm(along)
        first = np.cross(along, (0, 0, 1))
        first = first / np.linalg.norm(first)
        t.body(f"leg{i}", "", foot, [("hinge", first), ("hinge", np.cross(along, first)), ("slide", along)])
        t.join(f"leg{i}", "top", head, "connect" if how == "weld" else how)


def ankle(t, how):
    t.body("foot", "", (0, 0, 0), [("hinge", (1, 0, 0)), ("hinge", (0, 1, 0))])
    for side in (-1, 1):
        n = "l" if side < 0 else "r"
        t.body(f"{n}crank", "", (0.05, side * 0.06, 0.4), [("hinge", (0, 1, 0))])
        t.body(f"{n}rod", f"{n}crank", (-0.05, side * 0.06, 0.4), [("ball", None)])
        if how == "weld":
            t.body(f"{n}end", f"{n}rod", (-0.06, side * 0.06, 0.02), [("hinge", (1, 0, 0)), ("hinge", (0, 1, 0)), ("hinge", Z)])
            t.join(f"{n}end", "foot", (-0.06, side * 0.06, 0.02), how)
        else:
            t.join(f"{n}rod", "foot", (-0.06, side * 0.06, 0.02), how)


KINDS = [four_bar, slider_crank, gripper, delta, stewart, ankle]
FULL = 17


def models():
    """Name, text, and the text in full digits where this one is rounded."""
    seed = 0
    for kind in KINDS:
        for how in ("connect", "weld", "site"):
            for digits in (FULL, 8, 4):
                # Rounded ones in one way of joining are enough.
                if digits != FULL and how != "connect":
                    continue
                seed += 1
                rotation = turn(np.random.default_rng(seed)) if digits != FULL or seed % 2 else np.eye(3)
                texts = []
                for d in {digits, FULL}:
                    t = Tree(rotation, d)
                    kind(t, how)
                    texts.append((d, t.text()))
                texts = dict(texts)
                exact = None if digits == FULL else texts[FULL]
                yield f"{kind.__name__}-{how}-{digits}", texts[digits], exact
