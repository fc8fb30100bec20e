"""Asks MuJoCo what the well-known grippers of a catalogue do: each has one motion as drawn, and by it a jaw pulls with a force
that lies between the least and the greatest that the catalogue tells.

    grippers.py OZOLS
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import mujoco
import numpy as np

ROW = """SELECT s.id, s.name, s.input, s.jaw_c, l.force_min, l.force_max, c.id AS scheme FROM structures s
JOIN layouts l ON l.structure = s.id JOIN classics c ON c.structure = s.id ORDER BY s.id"""


def motion(model, data):
    """What the constraints leave: directions of all speeds, one a column."""
    mujoco.mj_forward(model, data)
    rows = np.zeros((data.nefc, model.nv))
    if mujoco.mj_isSparse(model):
        mujoco.mju_sparse2dense(rows, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
    else:
        rows = data.efc_J.reshape(data.nefc, model.nv).copy()
    if not len(rows):
        return np.eye(model.nv)
    _, sizes, directions = np.linalg.svd(rows)
    rank = int((sizes > 1e-9 * sizes[0]).sum())
    return directions[rank:].T


def tip(model, data, jaw, at):
    """The Jacobian of a point of a jaw."""
    jacobian = np.zeros((3, model.nv))
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, jaw)
    mujoco.mj_jac(model, data, jacobian, None, np.array(at), body)
    return jacobian


def check(row, model):
    data = mujoco.MjData(model)
    left = motion(model, data)
    if left.shape[1] != 1:
        return f"{left.shape[1]} motions"
    speeds = left[:, 0]
    joint = model.actuator_trnid[0, 0]
    drive = speeds[model.jnt_dofadr[joint]]
    three, turns = row["jaw_c"] is not None, row["input"] == "turn"
    ahead = 0.0 if "half-turn" in row["name"] or three and turns else 0.12
    closes = []
    for n, jaw in enumerate(("jaw-a", "jaw-b", "jaw-c") if three else ("jaw-a", "jaw-b")):
        turn = 2 * np.pi * n / (3 if three else 2)
        # Jaws of a drive that slides ahead stand round its axis, others round the normal of their plane.
        away = np.array([0, np.cos(turn), np.sin(turn)] if three and not turns else [-np.sin(turn), np.cos(turn), 0])
        closes.append(-(tip(model, data, jaw, np.array([ahead, 0, 0]) + 0.015 * away) @ speeds) @ away)
    # Work in is work out; a newton metre of a turning drive is one a radian.
    force = abs(drive / sum(closes))
    least, most = row["force_min"], row["force_max"]
    return None if 0.999 * least <= force <= 1.001 * most else f"a force of {force} outside {least} to {most}"


def main(ozols):
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        known = []
        for jaws in ("2", "3"):
            file = str(Path(folder, f"known-{jaws}.db"))
            subprocess.run([ozols, "catalog", "build", "--classics", "--jaws", jaws, "--ideas", "1", "--quiet", "-o", file], check=True, stdout=subprocess.DEVNULL)
            rows = json.loads(subprocess.run([ozols, "catalog", "query", file, ROW, "--format", "json"], check=True, capture_output=True).stdout)
            known += [(file, row) for row in rows]
        for file, row in known:
            toml, xml = Path(folder, "gripper.toml"), Path(folder, "gripper.xml")
            subprocess.run([ozols, "catalog", "export", file, row["id"], "-o", toml], check=True, stdout=subprocess.DEVNULL)
            subprocess.run([ozols, "export", toml, "--to", "mjcf", "-o", xml, "--quiet"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            why = check(row, mujoco.MjModel.from_xml_path(str(xml)))
            if why:
                wrong.append(f"{row['scheme']} ({row['id']}): {why}")
    print(f"{len(known)} well-known grippers in MuJoCo: {len(known) - len(wrong)} as the catalogue says")
    for line in wrong:
        print("  ", line)
    return bool(wrong) or len(known) < 50


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
