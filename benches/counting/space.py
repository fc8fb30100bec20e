"""A space of variants as an engineer would write it down: the screws that each choice of a joint allows, and their rank."""

import itertools
import math
import subprocess
import tomllib

import numpy as np

# What every joint that is not driven may become, where it still does what it does now.
OPTIONS = ["revolute", "cylindrical", "spherical"]
CHOICES = {
    "revolute": OPTIONS,
    "prismatic": ["prismatic", "cylindrical"],
    "cylindrical": ["cylindrical"],
    "spherical": ["spherical"],
}
AXES = np.eye(3)


def turn(axis, point):
    """The screw of a turn: its direction, and the velocity of the origin."""
    return np.concatenate([axis, np.cross(point, axis)])


def slide(axis):
    return np.concatenate([np.zeros(3), axis])


def screws(kind, axis, point):
    """A basis of what a joint of this type allows."""
    match kind:
        case "revolute":
            return [turn(axis, point)]
        case "prismatic":
            return [slide(axis)]
        case "cylindrical":
            return [turn(axis, point), slide(axis)]
        case "spherical":
            return [turn(a, point) for a in AXES]
    raise SystemExit(f"{kind}: no joint of this type is in these mechanisms")


def circuits(links, joints):
    """Fundamental circuits of the graph of links and joints: of each, its joints with their directions."""
    parent = {links[0]: None}
    tree = set()
    queue = [links[0]]
    while queue:
        here = queue.pop()
        for at, joint in enumerate(joints):
            for one, other in (joint["links"], joint["links"][::-1]):
                if one == here and other not in parent:
                    parent[other] = (one, at)
                    tree.add(at)
                    queue.append(other)

    def to_root(link):
        path = []
        while parent[link] is not None:
            above, at = parent[link]
            path.append((at, 1 if joints[at]["links"] == [above, link] else -1))
            link = above
        return path

    found = []
    for at, joint in enumerate(joints):
        if at not in tree:
            one, other = joint["links"]
            circuit = {at: 1}
            for sign, path in ((1, to_root(one)), (-1, to_root(other))):
                for step, direction in path:
                    circuit[step] = circuit.get(step, 0) + sign * direction
            found.append({step: sign for step, sign in circuit.items() if sign})
    return found


class Space:
    """Of each joint that may change, of each option, the columns of the closure matrix that it adds to those always there."""

    def __init__(self, text):
        mechanism = tomllib.loads(text)
        # The free state: a part that is clamped, and joints of other states, take no part.
        links = [link["id"] for link in mechanism["link"] if link.get("role") != "object"]
        joints = [j for j in mechanism["joint"] if "state" not in j and set(j["links"]) <= set(links)]
        cycles = circuits(links, joints)
        self.rows = 6 * len(cycles)
        always, choices = [], []
        for at, joint in enumerate(joints):
            axis, point = np.array(joint["axis"], float), np.array(joint["point"], float)

            def columns(kind, at=at, axis=axis, point=point):
                signs = [cycle.get(at, 0) for cycle in cycles]
                return [np.concatenate([sign * s for sign in signs]) for s in screws(kind, axis, point)]

            if joint.get("drive"):
                always += columns(joint["type"])
            else:
                choices.append([np.array(columns(kind)) for kind in CHOICES[joint["type"]]])
        self.always = np.array(always).reshape(-1, self.rows)
        self.choices = choices

    def variants(self):
        return itertools.product(*(range(len(options)) for options in self.choices))

    def size(self):
        return math.prod(len(options) for options in self.choices)

    def matrix(self, variant):
        return np.vstack([self.always, *(self.choices[j][o] for j, o in enumerate(variant))])

    def spans(self, variant):
        """Whether a variant has no redundant constraint: its rank is the number of equations."""
        return np.linalg.matrix_rank(self.matrix(variant)) == self.rows

    def spanned(self, rows):
        """Which choices (joint, option) lie within the span of these rows: a rank does not grow by them."""
        _, sizes, right = np.linalg.svd(rows)
        rank = int((sizes > sizes[0] * max(rows.shape) * np.finfo(float).eps).sum())
        beyond = right[rank:].T
        return {
            (j, o)
            for j, options in enumerate(self.choices)
            for o, columns in enumerate(options)
            if np.abs(columns @ beyond).max(initial=0) < 1e-9
        }


def of(ozols, name):
    shown = subprocess.run([ozols, "show", name], capture_output=True, text=True, check=True)
    return Space(shown.stdout)
