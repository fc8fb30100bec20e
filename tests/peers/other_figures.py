"""What Exudyn and pylinkage make of a mechanism: W and redundant constraints, where they say so."""

import mujoco
import numpy as np

# Freedoms that each kind of MuJoCo joint leaves, about and along the axes of a frame whose z is the joint's.
HELD = {
    mujoco.mjtJoint.mjJNT_HINGE: [1, 1, 1, 1, 1, 0],
    mujoco.mjtJoint.mjJNT_SLIDE: [1, 1, 0, 1, 1, 1],
    mujoco.mjtJoint.mjJNT_BALL: [1, 1, 1, 0, 0, 0],
}


def square(z):
    """A rotation matrix whose third column is along z."""
    z = z / np.linalg.norm(z)
    x = np.cross(z, np.eye(3)[np.abs(z).argmin()])
    x = x / np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def exudyn(model, q):
    """W and redundant constraints of the bodies, joints, connects and welds of a MuJoCo model at a pose, built anew in Exudyn."""
    import exudyn as exu
    from exudyn.rigidBodyUtilities import RigidBodyInertia

    m, d = model.model, model.data
    model.jacobian(q)
    mbs = exu.SystemContainer().AddSystem()
    ground = mbs.CreateGround()
    bodies = [ground]

    def body(b):
        return mbs.CreateRigidBody(
            referencePosition=d.xpos[b].tolist(),
            referenceRotationMatrix=d.xmat[b].reshape(3, 3),
            inertia=RigidBodyInertia(mass=1, inertiaTensor=np.eye(3)),
        )

    def joint(ends, at, axes, held):
        mbs.CreateGenericJoint(itemNumbers=ends, position=list(at), rotationMatrixAxes=axes, constrainedAxes=held, show=False)

    for b in range(1, m.nbody):
        first, n = m.body_jntadr[b], m.body_jntnum[b]
        on = bodies[m.body_parentid[b]]
        if n == 0:
            bodies.append(body(b))
            joint([on, bodies[b]], d.xpos[b], np.eye(3), [1] * 6)
            continue
        # Several joints of a body are a chain of bodies in one place.
        for j in range(first, first + n):
            now = body(b)
            kind = m.jnt_type[j]
            if kind != mujoco.mjtJoint.mjJNT_FREE:
                joint([on, now], d.xanchor[j], square(d.xaxis[j]), HELD[mujoco.mjtJoint(kind)])
            on = now
        bodies.append(on)
    for e in range(m.neq):
        if not d.eq_active[e]:
            continue
        kind = m.eq_type[e]
        ends = [m.eq_obj1id[e], m.eq_obj2id[e]]
        sites = m.eq_objtype[e] == mujoco.mjtObj.mjOBJ_SITE
        of = [m.site_bodyid[s] for s in ends] if sites else ends
        at = d.site_xpos[ends[0]] if sites else d.xpos[of[0]] + d.xmat[of[0]].reshape(3, 3) @ m.eq_data[e][:3]
        if kind == mujoco.mjtEq.mjEQ_CONNECT:
            joint([bodies[b] for b in of], at, np.eye(3), [1, 1, 1, 0, 0, 0])
        elif kind == mujoco.mjtEq.mjEQ_WELD:
            joint([bodies[b] for b in of], d.xpos[of[0]], np.eye(3), [1] * 6)
    mbs.Assemble()
    found = mbs.ComputeSystemDegreeOfFreedom()
    return int(found["degreeOfFreedom"]), int(found["redundantConstraints"])


def pylinkage(bars):
    """W of a planar linkage by its topology, of bars as pairs of pins; those whose name begins with a capital are the ground's."""
    from pylinkage.hypergraph import Edge, HypergraphLinkage, Node, NodeRole
    from pylinkage.topology import compute_mobility

    graph = HypergraphLinkage()
    for pin in sorted({p for bar in bars for p in bar}):
        graph.add_node(Node(pin, role=NodeRole.GROUND if pin[0].isupper() else NodeRole.DRIVEN))
    for a, b in bars:
        graph.add_edge(Edge(a + b, a, b))
    return compute_mobility(graph).dof
