"""A URDF as MuJoCo reads it, with the loops that it does not read: those of a `robot.yaml` beside it, and `<loop_joint>`."""

import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import yaml


def bare(path):
    """The file without shapes, whose meshes may not be there."""
    root = ET.parse(path).getroot()
    for link in root.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    return root


def refused(path):
    """What MuJoCo has against the file as it is; nothing where it takes it."""
    try:
        mujoco.MjSpec.from_string(ET.tostring(bare(path), encoding="unicode")).compile()
    except ValueError as e:
        return " ".join(str(e).split())
    return None


def model(path, side=None):
    """With its loops; what moves without mass, which MuJoCo refuses of owners, too, has a little."""
    root = bare(path)
    spec = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
    spec.compiler.fusestatic = False
    spec.compiler.boundmass, spec.compiler.boundinertia = 1e-9, 1e-12
    spec.compiler.balanceinertia = True
    child = {j.get("name"): j.find("child").get("link") for j in root.findall("joint")}
    sites = [0]

    def site(body, at=None):
        sites[0] += 1
        name = f"loop-{sites[0]}"
        body.add_site(name=name, **place(at))
        return name

    def equality(kind, one, two):
        found = spec.add_equality()
        found.type = kind
        found.objtype = mujoco.mjtObj.mjOBJ_SITE
        found.name1, found.name2 = one, two

    if side:
        with open(side) as f:
            loops = yaml.safe_load(f)
        for pair, word in zip(loops["closed_loop"], loops["type"]):
            ends = [site(spec.body(child.get(n, n))) for n in pair]
            weld = word.lower() == "6d"
            equality(mujoco.mjtEq.mjEQ_WELD if weld else mujoco.mjtEq.mjEQ_CONNECT, *ends)
    for j in root.findall("loop_joint"):
        one, two = j.find("link1"), j.find("link2")
        body, word = spec.body(one.get("link")), j.get("type")
        far = site(spec.body(two.get("link")), two)
        if word in ("spherical", "fixed"):
            weld = word == "fixed"
            equality(mujoco.mjtEq.mjEQ_WELD if weld else mujoco.mjtEq.mjEQ_CONNECT, site(body, one), far)
            continue
        small = body.add_body(name=f"{j.get('name')}~body", **place(one))
        small.mass, small.inertia, small.explicitinertial = 1e-6, [1e-9] * 3, True
        kinds = {"prismatic": mujoco.mjtJoint.mjJNT_SLIDE}
        small.add_joint(
            name=j.get("name"), type=kinds.get(word, mujoco.mjtJoint.mjJNT_HINGE),
            axis=numbers(j.find("axis"), "xyz") if j.find("axis") is not None else [1, 0, 0],
        )
        equality(mujoco.mjtEq.mjEQ_WELD, site(small), far)
    return spec.compile()


def numbers(e, key):
    return [float(x) for x in e.get(key, "0 0 0").split()]


def place(e):
    """Position and turn that `xyz` and `rpy` of an element stand for."""
    if e is None:
        return {}
    quat = np.zeros(4)
    mujoco.mju_euler2Quat(quat, np.array(numbers(e, "rpy")), "XYZ")
    return {"pos": numbers(e, "xyz"), "quat": quat}
