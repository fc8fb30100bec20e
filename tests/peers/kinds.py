"""Kinds of closed-loop mechanisms, as tables: of planar linkages the pins and the links between them, of loops the joints in
their order, of platforms one leg.

Joints are R (turns), P (slides), C (both along one line), U (turns about two axes), S (ball), T (slides in all directions) and
F (free). Places are in metres, and shifted at random where the kind does not rest on them.
"""

from typing import NamedTuple

import numpy as np

X, Y, Z = np.eye(3)
GROUND = "ground"


class Joint(NamedTuple):
    name: str
    kind: str
    links: tuple
    at: np.ndarray
    # As many directions as the joint has turns and slides; C has one, S, T and F none.
    axes: list


class Kind(NamedTuple):
    joints: list
    # Names of a joint, of one that leads it, and how many times as fast it turns.
    couplings: list


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


def along(axis, at):
    """A direction of a table: a letter, or coordinates."""
    return {"x": X, "y": Y, "z": Z}[axis] if isinstance(axis, str) else unit(axis)


def planar(links, slides=(), couple=(), shift=0.1, **pins):
    """A linkage in the plane of x and y. `links` are words of the pins on them, the first the ground's, `.` without any;
    `slides` are two links by number, the pin where one slides on the other, and the way, by two pins or a letter."""

    def make(random):
        at = {p: np.array([x, y, 0.0]) + shift * np.append(random.uniform(-1, 1, 2), 0) for p, (x, y) in pins.items()}
        words = links.split()
        names = [GROUND, *(f"link{i}" for i in range(1, len(words)))]
        joints = []
        for p in at:
            here = [names[i] for i, w in enumerate(words) if p in w]
            joints += [Joint(f"{p}{i}", "R", (here[0], other), at[p], [Z]) for i, other in enumerate(here[1:], 1)]
        for i, (a, b, p, way) in enumerate(slides):
            way = along(way, at) if len(way) == 1 else unit(at[way[1]] - at[way[0]])
            joints.append(Joint(f"slide{i}", "P", (names[a], names[b]), at[p], [way]))
        return Kind(joints, list(couple))

    return make


def chain(*joints, shift=0.1):
    """One loop: kinds, places and axes of its joints, in order from the ground round to it."""

    def make(random):
        links = [GROUND, *(f"link{i}" for i in range(1, len(joints))), GROUND]
        return Kind(
            [
                Joint(
                    f"{kind}{i}".lower(), kind, (links[i], links[i + 1]),
                    np.array(at, float) + shift * random.uniform(-1, 1, 3), [along(a, at) for a in axes],
                )
                for i, (kind, at, *axes) in enumerate(joints)
            ],
            [],
        )

    return make


def through_a_point(*legs):
    """Hinges whose axes meet at one point: each leg a list of axes from the ground to the last link."""

    def make(random):
        joints = []
        for i, axes in enumerate(legs):
            links = [GROUND, *(f"arm{i}_{k}" for k in range(1, len(axes))), "top"]
            for k, axis in enumerate(axes):
                axis = unit(np.array(axis) + random.uniform(-0.15, 0.15, 3))
                joints.append(Joint(f"turn{i}_{k}", "R", (links[k], links[k + 1]), axis, [axis]))
        return Kind(joints, [])

    return make


def line_symmetric(*lines):
    """A loop of hinges and of their images, turned by half about z; where there are two, square to their neighbours (Bennett)."""

    def make(random):
        half = np.diag([-1.0, -1.0, 1.0])
        points = [np.array(p, float) + random.uniform(-0.1, 0.1, 3) for p, _ in lines]
        points += [half @ p for p in points]
        n = len(points)
        axes = [unit(a) for _, a in lines if a is not None]
        axes += [half @ a for a in axes]
        if not axes:
            axes = [unit(np.cross(points[(i + 1) % n] - p, points[i - 1] - p)) for i, p in enumerate(points)]
        return chain(*(("R", p, a) for p, a in zip(points, axes)), shift=0)(random)

    return make


def legs(n, table, top=None, twist=0.0, shift=0.04):
    """A platform on `n` equal legs. A row of the table is a kind, its axes, radius, turn about z (as many `twist`s, by turns one
    way and the other) and height; axes are r (radial), t (across), z, l (along the leg), s (level and square to the leg) and n
    (square to both). `top` is the kind of a joint between the ground and the platform."""
    rows = [row.split() for row in table.split(",")]

    def make(random):
        joints = []
        for i in range(n):
            turn = 2 * np.pi * i / n
            r, t = np.array([np.cos(turn), np.sin(turn), 0]), np.array([-np.sin(turn), np.cos(turn), 0])
            at = []
            for _, _, radius, turns, height in rows:
                a = turn + float(turns) * twist * (-1) ** i
                place = np.array([np.cos(a), np.sin(a), 0]) * (float(radius) + shift * random.uniform(-1, 1))
                at.append(place + (float(height) + shift * random.uniform(-1, 1)) * Z)
            links = [GROUND, *(f"leg{i}_{k}" for k in range(1, len(rows))), "platform"]
            for k, (kind, axes, *_) in enumerate(rows):
                l = unit(at[k + 1] - at[k] if k + 1 < len(rows) else at[k] - at[k - 1])
                s = unit(np.cross(l, Z)) if abs(l @ Z) < 0.99 else t
                known = {"r": r, "t": t, "z": Z, "l": l, "s": s, "n": np.cross(l, s)}
                ways = [known[a] for a in axes.strip("-")]
                joints.append(Joint(f"{kind.lower()}{i}_{k}", kind, (links[k], links[k + 1]), at[k], ways))
        if top:
            joints.append(Joint("top", top, (GROUND, "platform"), float(rows[-1][4]) * Z, []))
        return Kind(joints, [])

    return make


def joints(*rows, couple=(), shift=0.02):
    """Any joints: a kind, its two links, place and axes."""

    def make(random):
        return Kind(
            [
                Joint(
                    f"{kind.lower()}{i}", kind, (a, b),
                    np.array(at, float) + shift * random.uniform(-1, 1, 3), [along(x, at) for x in axes],
                )
                for i, (kind, a, b, at, *axes) in enumerate(rows)
            ],
            list(couple),
        )

    return make


def rungs(m):
    """Cranks side by side, each joined to the next by a rod: a linkage of m contours."""
    pins = {f"{chr(65 + i)}": (i, 0.2 * (i % 2)) for i in range(m + 1)}
    pins |= {f"{chr(97 + i)}": (i + 0.2, 1 + 0.1 * (i % 3)) for i in range(m + 1)}
    cranks = [chr(65 + i) + chr(97 + i) for i in range(m + 1)]
    rods = [chr(97 + i) + chr(98 + i) for i in range(m)]
    return planar(" ".join(["".join(c[0] for c in cranks), *cranks, *rods]), shift=0.05, **pins)


G = GROUND
FOUR = {"A": (0, 0), "B": (0.2, 0.9), "C": (2.3, 1.4), "D": (2, 0)}
LEFT = {"A": (-0.3, 0), "B": (-0.5, 0.8), "C": (-0.9, 0.7), "D": (-0.6, 0.1)}
RIGHT = {p.lower(): (-x, y) for p, (x, y) in LEFT.items()}

KINDS = {
    # Those that the guide's page beside other tools shows.
    "four-bar": planar("AD AB BC CD", **FOUR),
    "slider-crank": planar("A AB BC C", [(0, 3, "C", "x")], A=(0, 0), B=(0.3, 0.4), C=(1.5, 0)),
    "gripper": planar("ADad AB BC CD ab bc cd", **LEFT, **RIGHT),
    "delta": legs(3, "R t 1 0 0, U tz 1.4 0 -0.3, S - 0.3 0 -1.5", top="T"),
    "stewart": legs(6, "U sn 1 1 0, P l 0.8 1.5 0.5, S - 0.6 2 1", top="F", twist=0.17),
    "ankle": joints(
        ("U", G, "foot", (0, 0, 0), "x", "y"),
        *(
            row
            for n, y in (("l", -0.06), ("r", 0.06))
            for row in (
                ("R", G, f"{n}crank", (0.05, y, 0.4), "y"),
                ("S", f"{n}crank", f"{n}rod", (-0.05, y, 0.42)),
                ("S", f"{n}rod", "foot", (-0.06, y, 0.02)),
            )
        ),
    ),
    "differential": joints(
        ("R", G, "carrier", (0, 0, 0), "x"),
        ("R", "carrier", "left", (-0.3, 0, 0), "x"),
        ("R", "carrier", "right", (0.3, 0, 0), "x"),
        ("R", "carrier", "front", (0, 0.2, 0), "y"),
        ("R", "carrier", "back", (0, -0.2, 0), "y"),
        ("R", G, "shaft", (-0.8, 0, 0), "x"),
        ("S", "left", "shaft", (-0.5, 0.1, 0.05)),
        couple=[("r3", "r1", 1), ("r3", "r2", -1), ("r4", "r1", -1), ("r4", "r2", 1)],
        shift=0,
    ),
    # Linkages of the plane.
    "crossed-four-bar": planar("AD AB BC CD", A=(0, 0), B=(1.4, 0.9), C=(0.3, 1.2), D=(1, 0)),
    "parallelogram": planar("AD AB BC CD", shift=0, A=(0, 0), B=(0.3, 0.8), C=(1.8, 0.8), D=(1.5, 0)),
    "three-crank-parallelogram": planar(
        "ADE AB BCF CD EF", shift=0, A=(0, 0), B=(0.3, 0.8), C=(1.3, 0.8), D=(1, 0), E=(2, 0.5), F=(2.3, 1.3)
    ),
    "antiparallelogram": planar("PR PS SQ QR", shift=0, P=(0, 0), Q=(2, 0), R=(1.6, 1), S=(0.4, 1)),
    "five-bar": planar("AE AB BC CD DE", A=(0, 0), B=(-0.3, 0.8), C=(0.6, 1.5), D=(1.4, 0.9), E=(1, 0)),
    "watt": planar("AD AB BCE CDF EG FG", A=(0, 0), B=(0.2, 0.9), C=(1.6, 1.2), D=(1.4, 0), E=(1, 2), F=(2.4, 0.9), G=(2.2, 2.2)),
    "stephenson": planar("ADG AB BCE CD EF FG", A=(0, 0), B=(0.2, 0.9), C=(1.6, 1.2), D=(1.4, 0), E=(1, 2), F=(2.6, 1.7), G=(2.5, 0)),
    "jansen": planar(
        "OB OA AC BCD AE BE DF EFG",
        O=(0, 0), B=(-1.9, -0.4), A=(0.7, 0.1), C=(-1.5, 1.6), D=(-3.7, -0.2), E=(-1.2, -1.9), F=(-3, -2), G=(-1.8, -4.2),
    ),
    "peaucellier": planar("OE OA OC AP AQ CP CQ EP", shift=0, O=(0, 0), E=(0.6, 0), P=(1.2, 0), A=(2, 1), C=(2, -1), Q=(2.8, 0)),
    "pantograph": planar("O OAB BD AE DE", shift=0, O=(0, 0), A=(1, 2), B=(1.5, 3), D=(2, 2), E=(1.5, 1)),
    "scissor-lift": planar(
        "A B AMD BMC CNF DNE E F", [(0, 1, "B", "x"), (6, 7, "F", "x")], shift=0,
        A=(0, 0), B=(2, 0), M=(1, 0.5), C=(0, 1), D=(2, 1), N=(1, 1.5), E=(0, 2), F=(2, 2),
    ),
    "scotch-yoke": planar("A AB B .", [(2, 3, "B", "y"), (0, 3, "B", "x")], A=(0, 0), B=(0.3, 0.4)),
    "quick-return": planar("AD AB B D", [(2, 3, "B", "DB")], A=(0, 0), B=(0.5, 0.3), D=(0, -1)),
    "trammel": planar(". A B AB", [(0, 1, "A", "x"), (0, 2, "B", "y")], A=(0.8, 0), B=(0, 0.6)),
    "planar-platform": planar(
        "ABC AG GD BH HE CI IF DEF",
        A=(0, 0), B=(3, 0), C=(1.5, 2.6), D=(1.1, 0.7), E=(1.9, 0.7), F=(1.5, 1.4), G=(0.3, 0.9), H=(2.9, 1), I=(0.8, 2.1),
    ),
    "geared-gripper": planar("ADad AB BC CD ab bc cd", couple=[("A1", "a1", -1)], **LEFT, **RIGHT),
    "adaptive-fingers": planar(
        "ADad AB BC DE CE ab bc de ce",
        **(fingers := {"A": (-0.4, 0), "B": (-0.9, 0.3), "C": (-0.7, 1.2), "D": (-0.2, 0.1), "E": (-0.3, 1.1)}),
        **{p.lower(): (-x, y) for p, (x, y) in fingers.items()},
    ),
    "ladder-4": rungs(4),
    "ladder-9": rungs(9),
    "wedge": chain(("P", (0, 0, 0), (1, 0, 0)), ("P", (1, 0, 0), (1, 1, 0)), ("P", (1, 1, 0), "y")),
    "oldham": chain(("R", (0, 0, 0), "z"), ("P", (0, 0, 0.1), "x"), ("P", (0.1, 0, 0.2), "y"), ("R", (0.2, 0.1, 0.3), "z")),
    # Loops in space.
    "spherical-four-bar": through_a_point([(1, 0, 0), (0.7, 0.6, 0.3)], [(0, 0.2, 1), (0.1, 0.9, 0.5)]),
    "bennett": line_symmetric(((1, 0, 0.3), None), ((0.2, 0.9, -0.3), None)),
    "bricard": line_symmetric(((1, 0, 0), (0.2, 0.5, 1)), ((0.6, 0.8, 0.5), (1, -0.4, 0.3)), ((-0.4, 0.9, 0.1), (0.3, 1, -0.6))),
    "sarrus": chain(
        *(("R", p, "y") for p in ((1, 0, 0), (1.4, 0, 0.5), (1, 0, 1))), *(("R", p, "x") for p in ((0, 1, 1), (0, 1.4, 0.5), (0, 1, 0)))
    ),
    "rssr": chain(("R", (0, 0, 0), "z"), ("S", (0.5, 0.1, 0)), ("S", (1.4, 0.6, 0.9)), ("R", (1.5, 0, 1), "y")),
    "rscr": chain(("R", (0, 0, 0), "z"), ("S", (0.5, 0.1, 0)), ("C", (1.4, 0.6, 0.9), (1, 0.3, 0.2)), ("R", (1.5, 0, 1), "y")),
    "rccc": chain(
        ("R", (0, 0, 0), "z"), ("C", (0.9, 0, 0.1), (0.2, 0.5, 1)),
        ("C", (1, 1, 0.3), (1, 0.3, -0.4)), ("C", (0, 0.9, 0), (0.4, -1, 0.3)),
    ),
    "cardan-shaft": chain(
        ("R", (0, 0, 0), "x"), ("U", (0.5, 0, 0), "y", "z"), ("P", (1, 0.2, 0.1), (1, 0.3, 0.2)),
        ("U", (1.5, 0.3, 0.2), "z", "y"), ("R", (2, 0.3, 0.2), "x"),
    ),
    # Platforms and what carries them.
    "linear-delta": legs(3, "P z 1 0 0, U tz 1 0 0.1, S - 0.3 0 -0.9", top="T"),
    "delta-of-rods": joints(
        *(
            row
            for i in range(3)
            for c, s in [(np.cos(2 * np.pi * i / 3), np.sin(2 * np.pi * i / 3))]
            for row in (
                ("R", G, f"arm{i}", (c, s, 0), (-s, c, 0)),
                *(
                    row
                    for n, o in (("l", -0.1), ("r", 0.1))
                    for row in (
                        ("U", f"arm{i}", f"{n}rod{i}", (1.4 * c - o * s, 1.4 * s + o * c, -0.3), "x", "y"),
                        ("S", f"{n}rod{i}", "platform", (0.3 * c - o * s, 0.3 * s + o * c, -1.5)),
                    )
                ),
            )
        ),
        shift=0,
    ),
    "3-rps": legs(3, "R t 1 0 0, P l 0.8 0 0.5, S - 0.6 0 1"),
    "3-prs": legs(3, "P z 1 0 0, R t 1 0 0.1, S - 0.5 0 0.9"),
    "3-upu": legs(3, "U sn 1 0 0, P l 0.8 0 0.5, U ns 0.6 0 1", shift=0),
    "3-rsr": legs(3, "R t 1 0 0, S - 1.3 0 0.5, R t 1 0 1", shift=0),
    "agile-eye": through_a_point(
        [(1, 0, 0), (0, 1, 0), (0, 0, -1)], [(0, 1, 0), (0, 0, 1), (-1, 0, 0)], [(0, 0, 1), (1, 0, 0), (0, -1, 0)]
    ),
    "schoenflies": joints(
        *(
            row
            for i, x in enumerate((0, 2))
            for row in (
                ("R", G, f"upper{i}", (x, 0, 0), "z"),
                ("R", f"upper{i}", f"lower{i}", (x - 0.3 * (1 - x), 0.8, 0), "z"),
                ("R", f"lower{i}", f"nut{i}", (0.8 + 0.2 * x, 1.2, 0), "z"),
                ("P", f"nut{i}", "tool", (0.8 + 0.2 * x, 1.2, -0.2), "z"),
            )
        )
    ),
    "ankle-of-sliders": joints(
        ("U", G, "foot", (0, 0, 0), "x", "y"),
        *(
            row
            for n, y in (("l", -0.06), ("r", 0.06))
            for row in (
                ("P", G, f"{n}nut", (-0.05, y, 0.4), "z"),
                ("S", f"{n}nut", f"{n}rod", (-0.05, y, 0.4)),
                ("S", f"{n}rod", "foot", (-0.06, y, 0.02)),
            )
        ),
    ),
    "ankle-of-struts": joints(
        ("U", G, "foot", (0, 0, 0), "x", "y"),
        *(
            row
            for n, y in (("l", -0.06), ("r", 0.06))
            for row in (
                ("U", G, f"{n}tube", (-0.1, y, 0.4), "x", "y"),
                ("P", f"{n}tube", f"{n}rod", (-0.08, y, 0.2), (0.04, 0, -0.38)),
                ("S", f"{n}rod", "foot", (-0.06, y, 0.02)),
            )
        ),
    ),
    "double-wishbone": joints(
        ("R", G, "upper", (0, 0.4, 0.5), "x"),
        ("S", "upper", "knuckle", (0.02, 0.7, 0.52)),
        ("R", G, "lower", (0, 0.3, 0.2), "x"),
        ("S", "lower", "knuckle", (0, 0.75, 0.18)),
        ("U", G, "tie", (0.15, 0.35, 0.3), "x", "z"),
        ("S", "tie", "knuckle", (0.13, 0.7, 0.3)),
    ),
}
