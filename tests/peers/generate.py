"""Closed-loop models as MJCF: kinds of mechanisms in random poses, joined in each way that MuJoCo has, turned at random,
rounded on purpose."""

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


def turn_about(axis, angle):
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


class Tree:
    """Bodies whose frames are the world's, turned as a whole, each number rounded where it is written."""

    def __init__(self, rotation, digits, seed):
        self.rotation, self.digits = rotation, digits
        self.random = np.random.default_rng(seed)
        self.bodies = {}
        self.children = {"": []}
        self.on = {}
        self.equalities = []
        self.couplings = []

    def angle(self, most=0.4):
        """Some angle, for a pose."""
        return self.random.uniform(-most, most)

    def near(self, x, y):
        """A place in the plane near one."""
        return np.array([x, y, 0]) + np.append(self.random.uniform(-0.1, 0.1, size=2), 0)

    def numbers(self, v):
        return " ".join(f"{round(float(x), self.digits):.17g}" for x in v)

    def body(self, name, on, at, joints):
        self.bodies[name] = (np.array(at, float), joints)
        self.children.setdefault(on, []).append(name)
        self.children.setdefault(name, [])
        self.on[name] = on

    def couple(self, follows, leads, ratio):
        """The joint of one body turns `ratio` times as fast as that of another."""
        self.couplings.append((follows, leads, ratio))

    def join(self, a, b, at, how):
        self.equalities.append((a, b, np.array(at, float), how))

    def write(self, name, sites):
        out = [f"  <body name='{name}' pos='{self.numbers(self.local(name))}'>"]
        out.append("    <inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>")
        for kind, axis in self.bodies[name][1]:
            along = "" if axis is None else f" axis='{self.numbers(self.rotation @ np.array(axis, float))}'"
            out.append(f"    <joint name='{name}_{len(out) - 1}' type='{kind}'{along}/>")
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
        for follows, leads, ratio in self.couplings:
            lines.append(f"    <joint joint1='{follows}_1' joint2='{leads}_1' polycoef='0 {ratio} 0 0 0'/>")
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
    elbow, end = t.near(0.2, 0.9), t.near(2.3, 1.4)
    t.body("a", "", (0, 0, 0), [("hinge", Z)])
    t.body("b", "a", elbow, [("hinge", Z)])
    t.body("c", "", (2, 0, 0), [("hinge", Z)])
    if how == "weld":
        t.body("d", "c", end, [("hinge", Z)])
        t.join("b", "d", end, how)
    else:
        t.join("b", "c", end, how)


def slider_crank(t, how):
    elbow = t.near(0.3, 0.4)
    t.body("crank", "", (0, 0, 0), [("hinge", Z)])
    t.body("rod", "crank", elbow, [("hinge", Z)])
    t.body("slider", "", (1.5, 0, 0), [("slide", (1, 0, 0))])
    if how == "weld":
        t.body("pin", "slider", (1.5, 0, 0), [("hinge", Z)])
        t.join("rod", "pin", (1.5, 0, 0), how)
    else:
        t.join("rod", "slider", (1.5, 0, 0), how)


def gripper(t, how):
    """Two fingers, a four-bar each."""
    for n, side in (("l", -1), ("r", 1)):
        outer, inner = t.near(side * 0.5, 0.8), t.near(side * 0.9, 0.7)
        t.body(f"{n}1", "", (side * 0.3, 0, 0), [("hinge", Z)])
        t.body(f"{n}2", "", (side * 0.6, 0.1, 0), [("hinge", Z)])
        t.body(f"{n}3", f"{n}1", outer, [("hinge", Z)])
        if how == "weld":
            t.body(f"{n}4", f"{n}2", inner, [("hinge", Z)])
            t.join(f"{n}3", f"{n}4", inner, how)
        else:
            t.join(f"{n}3", f"{n}2", inner, how)


def delta(t, how):
    """Three arms on a platform that cannot turn; each forearm stands for a parallelogram, with a universal joint at either end."""
    for i in range(3):
        a = 2 * np.pi * i / 3
        out, across = np.array([np.cos(a), np.sin(a), 0]), np.array([-np.sin(a), np.cos(a), 0])
        lift = t.angle() - 0.6
        t.body(f"arm{i}", "", out, [("hinge", across)])
        elbow = out * (1 + 0.5 * np.cos(lift)) + np.array([0, 0, 0.5 * np.sin(lift)])
        t.body(f"fore{i}", f"arm{i}", elbow, [("hinge", across), ("hinge", Z)])
    t.body("platform", "", (0, 0, -1.5), [("slide", (1, 0, 0)), ("slide", (0, 1, 0)), ("slide", Z)])
    for i in range(3):
        a = 2 * np.pi * i / 3
        out, across = np.array([np.cos(a), np.sin(a), 0]), np.array([-np.sin(a), np.cos(a), 0])
        at = out * 0.3 + np.array([0, 0, -1.5])
        if how == "weld":
            t.body(f"wrist{i}", f"fore{i}", at, [("hinge", Z), ("hinge", across)])
            t.join(f"wrist{i}", "platform", at, how)
        else:
            t.join(f"fore{i}", "platform", at, how)


def stewart(t, how):
    t.body("top", "", (0, 0, 1), [("free", None)])
    shift = np.append(t.random.uniform(-0.2, 0.2, size=2), 1)
    tilt = turn_about((1, 0, 0), t.angle()) @ turn_about((0, 1, 0), t.angle())
    for i in range(6):
        a, b = np.pi / 3 * i + 0.2 * (-1) ** i, np.pi / 3 * i - 0.35 * (-1) ** i
        foot = np.array([np.cos(a), np.sin(a), 0])
        head = shift + tilt @ np.array([0.6 * np.cos(b), 0.6 * np.sin(b), 0])
        along = head - foot
        along = along / np.linalg.norm(along)
        first = np.cross(along, Z)
        first = first / np.linalg.norm(first)
        t.body(f"leg{i}", "", foot, [("hinge", first), ("hinge", np.cross(along, first)), ("slide", along)])
        if how == "weld":
            t.body(f"ball{i}", f"leg{i}", head, [("ball", None)])
            t.join(f"ball{i}", "top", head, how)
        else:
            t.join(f"leg{i}", "top", head, how)


def ankle(t, how):
    """A foot on two hinges, pushed by two cranks through rods."""
    t.body("foot", "", (0, 0, 0), [("hinge", (1, 0, 0)), ("hinge", (0, 1, 0))])
    for n, side in (("l", -1), ("r", 1)):
        swing = t.angle()
        elbow = np.array([0.05 - 0.1 * np.cos(swing), side * 0.06, 0.4 + 0.1 * np.sin(swing)])
        heel = (-0.06, side * 0.06, 0.02)
        t.body(f"{n}crank", "", (0.05, side * 0.06, 0.4), [("hinge", (0, 1, 0))])
        t.body(f"{n}rod", f"{n}crank", elbow, [("ball", None)])
        if how == "weld":
            t.body(f"{n}end", f"{n}rod", heel, [("hinge", (1, 0, 0)), ("hinge", (0, 1, 0)), ("hinge", Z)])
            t.join(f"{n}end", "foot", heel, how)
        else:
            t.join(f"{n}rod", "foot", heel, how)


def differential(t, how):
    """A carrier with two side gears and two planets between them; one shaft of two bearings is joined to its gear."""
    x, y = (1, 0, 0), (0, 1, 0)
    t.body("carrier", "", (0, 0, 0), [("hinge", x)])
    t.body("left", "carrier", (-0.3, 0, 0), [("hinge", x)])
    t.body("right", "carrier", (0.3, 0, 0), [("hinge", x)])
    for n, side in (("front", 1), ("back", -1)):
        t.body(n, "carrier", (0, 0.2 * side, 0), [("hinge", y)])
        t.couple(n, "left", side)
        t.couple(n, "right", -side)
    t.body("shaft", "", (-0.8, 0, 0), [("hinge", x)])
    t.join("left", "shaft", (-0.5, 0.1, 0.05), how)


KINDS = [four_bar, slider_crank, gripper, delta, stewart, ankle, differential]
HOWS = ["connect", "weld", "site"]
FULL = 17


def models():
    """Name, text, and the text in full digits where this one is rounded."""
    for k, kind in enumerate(KINDS):
        each = [(how, FULL) for how in HOWS]
        # Rounded ones are joined in the three ways by turns.
        each += [(HOWS[(k + digits) % 3], digits) for digits in range(4, 9)]
        for how, digits in each:
            seed = 100 * k + 10 * HOWS.index(how) + digits
            whole = digits == FULL and k % 2 == 0
            rotation = np.eye(3) if whole else turn(np.random.default_rng(seed))

            def text(digits):
                tree = Tree(rotation, digits, seed)
                kind(tree, how)
                return tree.text()

            yield f"{kind.__name__}-{how}-{digits}", text(digits), None if digits == FULL else text(FULL)
