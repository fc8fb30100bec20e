"""Whether a fixed model falls as it did: both in MuJoCo, from one pose, under gravity, for a second."""

import mujoco
import numpy as np

STEP = 5e-4
# Loops are stiff springs to MuJoCo, which redundant rows make stiffer; the share that this may be of a model's size, or of its way
# where that is longer.
APART = 5e-3
# What holds nothing but itself weighs this little beside a link.
LIGHT = 1e-3


def alike(before, after, marks):
    """Links weigh the same at the same place in both, and what stands in between next to nothing: the format between the two,
    which knows no masses, may have hung them up elsewhere."""
    for model, own in zip((before, after), marks):
        m = model.model
        m.body_mass[1:], m.body_inertia[1:] = LIGHT, LIGHT
        for b, points in (own[n] for n in marks[0] if n in marks[1]):
            if b > 0:
                m.body_mass[b], m.body_inertia[b], m.body_ipos[b] = 1, 1, points[0]
        mujoco.mj_setConst(m, model.data)


def fallen(model, q, damped):
    """The pose after a second. Joints are damped so that nothing whirls: what is chaos is no comparison."""
    m, d = model.model, model.data
    # Beyond the limits some reach places where they may go on in more ways than one.
    m.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    m.opt.timestep = STEP
    m.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    m.eq_solref[:] = [2 * STEP, 1]
    m.eq_solimp[:] = [0.999, 0.9999, 0.001, 0.5, 2]
    m.opt.tolerance = 1e-12
    m.opt.iterations = 100
    mujoco.mj_resetData(m, d)
    d.qpos[:] = q
    mujoco.mj_forward(m, d)
    for v, by in damped.items():
        m.dof_damping[v] = by
    opened = 0.0
    for _ in range(round(1 / STEP)):
        mujoco.mj_step(m, d)
        opened = max(opened, float(np.abs(d.efc_pos[: d.ne]).max(initial=0)))
    m.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    # MuJoCo begins anew where its numbers ran away.
    ran_away = any(w.number for w in d.warning)
    return d.qpos.copy(), np.inf if ran_away else opened


def damping(model, q):
    """Of each velocity as much as stops it in half a second."""
    m, d = model.model, model.data
    model.jacobian(q)
    full = np.zeros((m.nv, m.nv))
    mujoco.mj_fullM(m, d, full)
    return 2 * np.diag(full)


def apart(before, after, q, there, marks, size, own=True):
    """How far the links are apart after a second, and how far they went, as shares of the model's size: with their `own` masses
    where MuJoCo keeps the loops closed with these, which it does not where something weighs next to nothing, else all alike.
    Nothing where it does not keep them closed in the owner's model either way."""
    if not own:
        alike(before, after, marks)
    ours, theirs = marks
    names = [n for n in ours if n in theirs]
    slow = damping(before, q)
    velocities = after.same_velocities(before)
    (one, opened), (two, _) = fallen(before, q, dict(enumerate(slow))), fallen(after, there, {b: slow[a] for a, b in velocities})
    if opened > APART * size:
        return apart(before, after, q, there, marks, size, own=False) if own else None
    start, end = before.seen(q, ours), before.seen(one, ours)
    found = after.seen(two, theirs)
    gap = lambda a, b: max((float(np.abs(x - y).max()) for n in names for x, y in zip(a[n], b[n])), default=0.0)
    return gap(end, found) / size, gap(start, end) / size
