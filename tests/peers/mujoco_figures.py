"""What MuJoCo makes of an MJCF file: velocities, rows and rank of the equality Jacobian, W, and poses."""

import mujoco
import numpy as np

# Relative singular values below this count as zero; rounded models have left-overs up to 3e-8.
ZERO = 1e-6


# Else these go to a file in the folder of whoever runs this.
mujoco.set_mju_user_warning(lambda message: None)


def integrate(model, q, v):
    mujoco.mj_integratePos(model, q, v, 1.0)


class Model:
    def __init__(self, path, zero=ZERO):
        """What is relatively less than `zero` counts as nothing where the model is closed and moved."""
        self.zero = zero
        self.model = path if isinstance(path, mujoco.MjModel) else mujoco.MjModel.from_xml_path(str(path))
        flags = mujoco.mjtDisableBit
        for name in ("mjDSBL_CONTACT", "mjDSBL_LIMIT", "mjDSBL_FRICTIONLOSS"):
            self.model.opt.disableflags |= int(getattr(flags, name))
        self.model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        self.data = mujoco.MjData(self.model)

    def jacobian(self, q):
        """Rows of the active equalities, and how far each is open."""
        d = self.data
        d.qpos[:] = q
        d.qvel[:] = 0
        mujoco.mj_fwdPosition(self.model, d)
        return d.efc_J.reshape(-1, self.model.nv)[: d.ne].copy(), d.efc_pos[: d.ne].copy()

    def close(self, q, hold=(), steps=80):
        """The closed pose near by, by Newton's method of least norm; the velocities `hold` stay."""
        q = np.array(q, dtype=float)
        free = [v for v in range(self.model.nv) if v not in set(hold)]
        for _ in range(steps):
            j, gap = self.jacobian(q)
            if len(gap) == 0 or np.abs(gap).max() < 1e-13:
                break
            dv = np.zeros(self.model.nv)
            dv[free] = -np.linalg.lstsq(j[:, free], gap, rcond=self.zero)[0]
            dv *= min(1.0, 0.3 / max(np.abs(dv).max(), 1e-12))
            integrate(self.model, q, dv)
        _, gap = self.jacobian(q)
        return q, (float(np.abs(gap).max()) if len(gap) else 0.0)

    def figures(self, q):
        j, _ = self.jacobian(q)
        nv = self.model.nv
        # Columns of unit length, so that metres and radians do not matter; what is all rounding stays as small as it is.
        norms = np.linalg.norm(j, axis=0) if len(j) else np.zeros(nv)
        s = np.linalg.svd(j / np.where(norms > 1e-5, norms, 1), compute_uv=False) if len(j) else []
        rank = int((s > ZERO * s[0]).sum()) if len(s) and s[0] > 0 else 0
        return {"nv": nv, "rows": len(j), "rank": rank, "w": nv - rank, "redundant": len(j) - rank}

    def independent(self, q, w):
        """As many velocities as there are motions, that decide them all."""
        j, _ = self.jacobian(q)
        kernel = np.linalg.svd(j)[2][self.model.nv - w :] if len(j) else np.eye(self.model.nv)
        held = []
        left = kernel.T.copy()
        for _ in range(w):
            norms = np.linalg.norm(left, axis=1)
            best = int(norms.argmax())
            held.append(best)
            along = left[best] / norms[best]
            left = left - np.outer(left @ along, along)
        return held

    def places(self, q):
        """Places of the bodies with names."""
        self.jacobian(q)
        m = self.model
        names = [mujoco.mj_id2name(m, mujoco.mjtObj.mjOBJ_BODY, b) for b in range(m.nbody)]
        return {n: self.data.xpos[b].copy() for b, n in enumerate(names) if n}

    def reach(self, q):
        """How far each body with a name reaches from its origin: to joints, sites, shapes and the bodies on it."""
        self.jacobian(q)
        m, d = self.model, self.data
        out = np.zeros(m.nbody)

        def take(bodies, at, more=0.0):
            for b, p, r in zip(bodies, at, np.broadcast_to(more, len(bodies))):
                out[b] = max(out[b], np.linalg.norm(p - d.xpos[b]) + r)

        take(m.body_parentid[1:], d.xpos[1:])
        take(m.jnt_bodyid, d.xanchor)
        take(m.site_bodyid, d.site_xpos)
        take(m.geom_bodyid, d.geom_xpos, m.geom_rbound)
        return {n: float(out[mujoco.mj_name2id(m, mujoco.mjtObj.mjOBJ_BODY, n)]) for n in self.places(q)}

    def marks(self, q, points):
        """Points that bodies carry, given in the world at a pose: by body, in its own frame."""
        self.jacobian(q)
        out = {}
        for n, ps in points.items():
            b = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, n)
            r = self.data.xmat[b].reshape(3, 3)
            out[n] = (b, [r.T @ (p - self.data.xpos[b]) for p in ps])
        return out

    def seen(self, q, marks):
        """Where the marks are at a pose."""
        self.jacobian(q)
        d = self.data
        at = lambda b, p: d.xpos[b] + d.xmat[b].reshape(3, 3) @ p
        return {n: [at(b, p) for p in ps] for n, (b, ps) in marks.items()}

    def match(self, marks, wanted, q, steps=60):
        """The closed pose near by with marks where they are wanted."""
        m, q = self.model, np.array(q, dtype=float)
        for _ in range(steps):
            found = self.seen(q, marks)
            rows, gap = self.jacobian(q)
            rows, gap = [rows], [gap]
            for n, (b, _) in marks.items():
                for now, want in zip(found[n], wanted[n]):
                    j = np.zeros((3, m.nv))
                    mujoco.mj_jac(m, self.data, j, None, now, b)
                    rows.append(j)
                    gap.append(now - want)
            gap = np.concatenate(gap)
            if np.abs(gap).max() < 1e-13:
                break
            dv = -np.linalg.lstsq(np.vstack(rows), gap, rcond=1e-8)[0]
            dv *= min(1.0, 0.3 / max(np.abs(dv).max(), 1e-12))
            integrate(m, q, dv)
        return q

    def embed(self, other, q):
        """The pose of another model, of the joints that both have; what is new stands at zero."""
        m, o = self.model, other.model
        out = m.qpos0.copy()
        sizes = {0: 7, 1: 4, 2: 1, 3: 1}
        # Joints without names are told by their bodies, or by their order: what is new has a name.
        waiting = {}
        for j in range(m.njnt):
            waiting.setdefault(self.key(j), []).append(j)
        for i in range(o.njnt):
            j = waiting[other.key(i)].pop(0)
            n = sizes[int(m.jnt_type[j])]
            a, b = m.jnt_qposadr[j], o.jnt_qposadr[i]
            out[a : a + n] = q[b : b + n]
        return out

    def same_velocities(self, other):
        """Pairs of velocities, of the other model and of this one, of the joints that both have."""
        m, o = self.model, other.model
        waiting, out = {}, []
        for j in range(m.njnt):
            waiting.setdefault(self.key(j), []).append(j)
        for i in range(o.njnt):
            a, b = o.jnt_dofadr[i], m.jnt_dofadr[waiting[other.key(i)].pop(0)]
            out += [(a + k, b + k) for k in range({0: 6, 1: 3, 2: 1, 3: 1}[int(o.jnt_type[i])])]
        return out

    def within(self, q):
        """Whether hinges and slides are within their limits, where they have some."""
        m = self.model
        one = [j for j in range(m.njnt) if m.jnt_limited[j] and m.jnt_type[j] > 1]
        return all(m.jnt_range[j, 0] <= q[m.jnt_qposadr[j]] <= m.jnt_range[j, 1] for j in one)

    def wander(self, q, poses, random, step=0.05):
        """Closed poses on the motion through one, inside the limits: as many as asked, fewer where there is no way on."""
        q, v = np.array(q, dtype=float), random.normal(size=self.model.nv)
        inside, found = self.within(q), 0
        for _ in range(10 * poses):
            if found == poses:
                return
            j, _ = self.jacobian(q)
            along = v - np.linalg.pinv(j, rcond=self.zero) @ (j @ v) if len(j) else v
            if np.abs(along).max() < 1e-9:
                return
            there = q.copy()
            integrate(self.model, there, step * along / np.abs(along).max())
            there, gap = self.close(there)
            # A file whose pose is outside the limits has none to keep.
            if gap > max(1e-7, self.zero * (self.zero > ZERO)) or inside and not self.within(there):
                v = random.normal(size=self.model.nv)
                continue
            q, v, found = there, along, found + 1
            yield q.copy()

    def key(self, j):
        m = self.model
        name = mujoco.mj_id2name(m, mujoco.mjtObj.mjOBJ_JOINT, j)
        body = mujoco.mj_id2name(m, mujoco.mjtObj.mjOBJ_BODY, m.jnt_bodyid[j])
        return name or (body, int(m.jnt_type[j]))
