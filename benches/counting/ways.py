"""Ways to count the variants without redundant constraints, as one would go about it without ozols."""

import itertools

import numpy as np


def each(space):
    """numpy, one matrix after another."""
    return sum(bool(space.spans(variant)) for variant in space.variants())


def batches(space, size=4096):
    """numpy, thousands of matrices at once; rows of nothing make them equally long."""
    longest = max(len(columns) for options in space.choices for columns in options)
    sizes = [len(options) for options in space.choices]
    padded = np.zeros((len(sizes), max(sizes), longest, space.rows))
    for j, options in enumerate(space.choices):
        for o, columns in enumerate(options):
            padded[j, o, : len(columns)] = columns
    joints = np.arange(len(sizes))
    every = np.stack(np.unravel_index(np.arange(space.size()), sizes), 1)
    found = 0
    for start in range(0, len(every), size):
        some = padded[joints, every[start : start + size]].reshape(-1, len(joints) * longest, space.rows)
        always = np.broadcast_to(space.always, (len(some), *space.always.shape))
        found += int((np.linalg.matrix_rank(np.concatenate([always, some], 1)) == space.rows).sum())
    return found


class Numbered:
    """A number for each choice (joint, option), and the clauses that each joint takes one."""

    def __init__(self, space):
        self.space = space
        numbers = itertools.count(1)
        self.rows = [[next(numbers) for _ in options] for options in space.choices]
        self.size = next(numbers) - 1
        self.one_each = self.rows + [[-a, -b] for row in self.rows for a, b in itertools.combinations(row, 2)]

    def of(self, joint, option):
        return self.rows[joint][option]

    def variant(self, model):
        chosen = {v for v in model if v > 0}
        return tuple(next(o for o, v in enumerate(row) if v in chosen) for row in self.rows)

    def cut(self, variant):
        """What every variant without redundant constraints holds and this one does not: a choice beyond a subspace that this one
        spans, the subspace taken as large as it can be."""
        space = self.space
        rows = [space.matrix(variant)]
        inside = space.spanned(rows[0])
        for j, options in enumerate(space.choices):
            for o, columns in enumerate(options):
                if (j, o) not in inside and np.linalg.matrix_rank(np.vstack([*rows, columns])) < space.rows:
                    rows.append(columns)
                    inside = space.spanned(np.vstack(rows))
        return [v for j, row in enumerate(self.rows) for o, v in enumerate(row) if (j, o) not in inside]


def model_by_model(space):
    """A SAT solver proposes variants, the rank refuses some, and says what they lack."""
    from pysat.solvers import Cadical195

    numbered = Numbered(space)
    found = 0
    with Cadical195(bootstrap_with=numbered.one_each) as solver:
        while solver.solve():
            variant = numbered.variant(solver.get_model())
            if space.spans(variant):
                found += 1
                solver.add_clause([-numbered.of(j, o) for j, o in enumerate(variant)])
            else:
                solver.add_clause(numbered.cut(variant))
    return found


def clauses(space):
    """All that a variant without redundant constraints must hold: least such variants and largest others turn by turn, until a SAT
    solver finds nothing between them."""
    from pysat.solvers import Cadical195

    numbered = Numbered(space)
    cuts = []
    with Cadical195(bootstrap_with=numbered.one_each) as solver:
        while solver.solve():
            variant = list(numbered.variant(solver.get_model()))
            if space.spans(variant):
                for j, option in enumerate(variant):
                    variant[j] = 0
                    if not space.spans(variant):
                        variant[j] = option
                solver.add_clause([-numbered.of(j, o) for j, o in enumerate(variant) if o])
            else:
                cuts.append(numbered.cut(variant))
                solver.add_clause(cuts[-1])
    return numbered, numbered.one_each + cuts


def constraint_programming(space):
    """CP-SAT lists every solution of the clauses."""
    from ortools.sat.python import cp_model

    numbered, all_clauses = clauses(space)
    model = cp_model.CpModel()
    names = [None, *(model.new_bool_var(str(v)) for v in range(1, numbered.size + 1))]
    for clause in all_clauses:
        model.add_bool_or([names[v] if v > 0 else names[-v].Not() for v in clause])

    class Counter(cp_model.CpSolverSolutionCallback):
        found = 0

        def on_solution_callback(self):
            self.found += 1

    solver, counter = cp_model.CpSolver(), Counter()
    solver.parameters.enumerate_all_solutions = True
    solver.parameters.num_workers = 1
    if solver.solve(model, counter) not in (cp_model.OPTIMAL, cp_model.INFEASIBLE):
        raise SystemExit("not all solutions were listed")
    return counter.found


def sentential_diagram(space):
    """A #SAT counter: the clauses compiled into a sentential decision diagram."""
    from pysdd.sdd import SddManager, Vtree

    numbered, all_clauses = clauses(space)
    manager = SddManager.from_vtree(Vtree(var_count=numbered.size, vtree_type="balanced"))
    manager.auto_gc_and_minimize_on()
    whole = manager.true()
    for clause in sorted(all_clauses, key=len):
        some = manager.false()
        for v in clause:
            some = some | manager.literal(v)
        whole = whole & some
    return whole.global_model_count()


def zero_suppressed(space):
    """A zero-suppressed decision diagram: one choice of each joint, and of these the supersets of a choice of each clause."""
    from graphillion import setset

    numbered, all_clauses = clauses(space)
    setset.set_universe(list(range(1, numbered.size + 1)))
    whole = setset([[]])
    for row in numbered.rows:
        whole = whole.join(setset([[v] for v in row]))
    for clause in sorted((c for c in all_clauses if c[0] > 0), key=len):
        whole = whole.supersets(setset([[v] for v in clause]))
    return len(whole)


WAYS = {
    "numpy, one by one": each,
    "numpy, 4,096 at once": batches,
    "SAT, model by model (CaDiCaL)": model_by_model,
    "CP-SAT, all solutions (OR-Tools)": constraint_programming,
    "#SAT (PySDD)": sentential_diagram,
    "ZDD (Graphillion)": zero_suppressed,
}
