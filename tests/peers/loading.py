"""Whether MuJoCo, Pinocchio and sdformat take the files that ozols writes, and all that is in them."""

import os
import re
import subprocess

import mujoco
import pinocchio as pin
import urdf_in_mujoco

# Where sdformat is installed, the program that `run` builds with it.
SDFORMAT = os.environ.get("OZOLS_SDFORMAT", "")


def names(path):
    """Links and joints that a file has, and the joints among them that move. Owners' files need not be well-formed."""
    with open(path, encoding="utf-8") as f:
        text = re.sub(r"<!--.*?-->", "", f.read(), flags=re.DOTALL)

    def tags(tag):
        for words in re.findall(rf"<{tag}\s([^>]*)", text):
            found = dict(re.findall(r"""([\w:]+)\s*=\s*["']([^"']*)["']""", words))
            if "name" in found:
                yield found["name"], found.get("type")

    joints = [(name, kind) for name, kind in tags("joint") if kind]
    moving = {name for name, kind in joints if kind != "fixed"}
    return {name for name, _ in tags("link")}, {name for name, _ in joints}, moving


def by_sdformat(path):
    """Links, joints and complaints of sdformat."""
    out = subprocess.run([SDFORMAT, path], capture_output=True, text=True, check=False).stdout
    found = {"link": set(), "joint": set(), "error": set()}
    for line in out.splitlines():
        word, _, rest = line.partition(" ")
        if word in found:
            # Numbers of vertices are not the same where there are more.
            found[word].add(re.sub(r"\[\d+\]", "[]", rest))
    return found["link"], found["joint"], found["error"]


def pinocchio_refuses(path, ending):
    build = {".urdf": pin.buildModelFromUrdf, ".xml": pin.buildModelFromMJCF}[ending]
    try:
        build(str(path))
    except Exception as e:
        return " ".join(str(e).split())
    return None


def mujoco_refuses(path, ending):
    if ending == ".urdf":
        return urdf_in_mujoco.refused(path)
    try:
        mujoco.MjModel.from_xml_path(str(path))
    except ValueError as e:
        return " ".join(str(e).split())
    return None


def refused(path, ending, of=None):
    """What the engines have against a written file: a line each. What they refuse of the owner's file, `of`, is the owner's."""
    path, of = str(path), of and str(of)
    peers = [] if ending == ".sdf" else [("MuJoCo", mujoco_refuses), ("Pinocchio", pinocchio_refuses)]
    for peer, refuses in peers:
        why = refuses(path, ending)
        if why and not (of and refuses(of, ending)):
            yield f"{peer} refuses it: {why[:200]}"
    if not SDFORMAT or ending == ".xml":
        return
    links, joints, errors = by_sdformat(path)
    all_links, all_joints, moving = names(path)
    # A floating joint of URDF is none to sdformat, which then misses it.
    with open(path, encoding="utf-8") as f:
        if re.search(r"""type=["']floating""", f.read()) and ending == ".urdf":
            return
    if of is None:
        # Links that are fixed to one another become one.
        lost = moving - joints
        old_errors = set()
    else:
        old_links, old_joints, old_errors = by_sdformat(of)
        known_links, known_joints, known_moving = names(of)
        lost = (old_links - links) | (old_joints - joints)
        # Where all that moves was kept, all that is new is to be.
        if known_moving <= old_joints:
            lost |= ((all_links - known_links) - links) | ((all_joints - known_joints) - joints)
    if lost:
        yield f"sdformat loses {', '.join(sorted(lost)[:4])}"
    for e in sorted(errors - old_errors)[:2]:
        yield f"sdformat complains: {e[:200]}"
