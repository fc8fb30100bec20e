"""What Pinocchio makes of a URDF whose loops stand in a `robot.yaml` beside it: rank of the loops' Jacobian, W, and poses."""

import statistics
import sys
import time

import numpy as np
import pinocchio as pin
import yaml

ZERO = 1e-6


class Model:
    def __init__(self, path, side):
        self.model = pin.buildModelFromUrdf(str(path))
        self.data = self.model.createData()
        with open(side) as f:
            loops = yaml.safe_load(f)
        self.ends = [[self.frame(n) for n in pair] for pair in loops["closed_loop"]]
        self.rows = [6 if t.lower() == "6d" else 3 for t in loops["type"]]

    def frame(self, name):
        """A frame of a link, or of the child's side of a joint."""
        for f, frame in enumerate(self.model.frames):
            if frame.name == name:
                return f
        raise KeyError(name)

    def jacobian(self, q):
        """Rows of the loops, and how far they are open."""
        m, d = self.model, self.data
        pin.computeJointJacobians(m, d, q)
        pin.updateFramePlacements(m, d)
        rows, gaps = [], []
        for (a, b), n in zip(self.ends, self.rows):
            relative = d.oMf[a].actInv(d.oMf[b])
            j = pin.getFrameJacobian(m, d, b, pin.LOCAL)
            i = pin.getFrameJacobian(m, d, a, pin.LOCAL)
            if n == 6:
                rows.append(pin.Jlog6(relative) @ (j - relative.toActionMatrixInverse() @ i))
                gaps.append(pin.log6(relative).vector)
            else:
                turn_a, turn_b = d.oMf[a].rotation, d.oMf[b].rotation
                rows.append(turn_b @ j[:3] - turn_a @ i[:3])
                gaps.append(d.oMf[b].translation - d.oMf[a].translation)
        return np.vstack(rows), np.concatenate(gaps)

    def close(self, q, hold=(), steps=300):
        free = [v for v in range(self.model.nv) if v not in set(hold)]
        for _ in range(steps):
            j, gap = self.jacobian(q)
            if np.abs(gap).max() < 1e-13:
                break
            dv = np.zeros(self.model.nv)
            dv[free] = -np.linalg.lstsq(j[:, free], gap, rcond=1e-8)[0]
            dv *= min(1.0, 0.2 / max(np.abs(dv).max(), 1e-12))
            q = pin.integrate(self.model, q, dv)
        return q, float(np.abs(self.jacobian(q)[1]).max())

    def start(self):
        """A closed pose: from the neutral one, or from beside it."""
        random = np.random.default_rng(3)
        q = pin.neutral(self.model)
        for _ in range(40):
            found, gap = self.close(q)
            if gap < 1e-10:
                return found, gap
            q = pin.integrate(self.model, pin.neutral(self.model), random.normal(size=self.model.nv) * 0.7)
        return found, gap

    def of(self, q):
        j, _ = self.jacobian(q)
        norms = np.linalg.norm(j, axis=0)
        s = np.linalg.svd(j / np.where(norms > 1e-5, norms, 1), compute_uv=False)
        rank = int((s > ZERO * s[0]).sum())
        nv = self.model.nv
        return {"nv": nv, "rows": len(j), "rank": rank, "w": nv - rank, "redundant": len(j) - rank}

    def figures(self):
        q, gap = self.start()
        return self.of(q), gap

    def along(self, other, steps, poses):
        """The way of this model in another that has its joints and more: W, redundant and the gap at each small step, and then in
        poses farther apart, inside the limits."""
        q, _ = self.start()
        random = np.random.default_rng(5)
        v = random.normal(size=self.model.nv)
        inside = self.within(q)
        for step in [0.003] * steps + [0.05] * poses:
            j, _ = self.jacobian(q)
            v = v - np.linalg.pinv(j, rcond=1e-8) @ (j @ v)
            v = v / np.abs(v).max()
            beside, gap = self.close(pin.integrate(self.model, q, step * v))
            if gap > 1e-9 or step > 0.01 and inside and not self.within(beside):
                v = random.normal(size=self.model.nv)
                continue
            q = beside
            there = pin.neutral(other.model)
            for name in self.model.names[1:]:
                i, k = self.model.getJointId(name), other.model.getJointId(name)
                a, b = self.model.joints[i], other.model.joints[k]
                there[b.idx_q : b.idx_q + b.nq] = q[a.idx_q : a.idx_q + a.nq]
            figures = other.of(there)
            yield figures["w"], figures["redundant"], float(np.abs(other.jacobian(there)[1]).max())

    def within(self, q):
        m = self.model
        return bool(((m.lowerPositionLimit <= q) & (q <= m.upperPositionLimit)).all())


def of_mjcf(file):
    """Velocities, rows and rank of the connects and welds of an MJCF file in the pose that it is drawn in, the rank as NumPy has
    it; joint equalities are not read."""
    model, *constraints = pin.buildModelAndConstraintsFromMJCF(file)
    data = model.createData()
    pin.computeJointJacobians(model, data, model.referenceConfigurations["qpos0"])
    rows = [np.zeros((0, model.nv))]
    for c in [c for kind in constraints for c in kind]:
        at = c.createData()
        c.calc(model, data, at)
        rows.append(c.jacobian(model, data, at))
    j = np.vstack(rows)
    return model.nv, len(j), int(np.linalg.matrix_rank(j)) if len(j) else 0


if __name__ == "__main__":
    took = []
    for _ in range(int(sys.argv[2])):
        began = time.perf_counter()
        found = of_mjcf(sys.argv[1])
        took.append(1000 * (time.perf_counter() - began))
    print(*found, statistics.median(took))
