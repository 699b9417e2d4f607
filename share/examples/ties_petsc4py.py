"""A membrane whose lower edge is tied to its upper one by a penalty of 1e8: PCAMGF from petsc4py, with nothing of ours
imported.

    python3 ties_petsc4py.py -dll_append PREFIX/lib/libpetscamgf.so -pc_type amgf

Output:
    converged: True
    at most 25 iterations: True
"""
import sys

import petsc4py

petsc4py.init(sys.argv)
from petsc4py import PETSc

N, PENALTY = 64, 1e8  # nodes a side


def create_matrix():
    """The Laplacian on a square; where its upper edge is tied to the lower one, the penalty"""
    A = PETSc.Mat().createAIJ([N * N, N * N], nnz=8)
    A.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
    for row in range(*A.getOwnershipRange()):
        i, j = divmod(row, N)
        A.setValue(row, row, 4.0, addv=True)
        for near, inside in ((row - 1, j > 0), (row + 1, j < N - 1), (row - N, i > 0), (row + N, i < N - 1)):
            if inside:
                A.setValue(row, near, -1.0, addv=True)
        if i == 0:
            opposite = N * (N - 1) + j
            A.setValues([row, opposite], [row, opposite], [PENALTY, -PENALTY, -PENALTY, PENALTY], addv=True)
    A.assemble()
    return A


A = create_matrix()
edges = list(range(N)) + list(range(N * (N - 1), N * N))
# this line and -pc_type amgf: no more is needed
A.compose("amgf_filter", PETSc.IS().createGeneral(edges, comm=PETSc.COMM_SELF))
x, b = A.createVecs()
b.set(1e-3)
ksp = PETSc.KSP().create()
ksp.setType("cg")
ksp.setTolerances(rtol=1e-10)
ksp.setOperators(A)
ksp.setFromOptions()
ksp.solve(b, x)
PETSc.Sys.Print("converged:", ksp.getConvergedReason() > 0)
PETSc.Sys.Print("at most 25 iterations:", ksp.getIterationNumber() <= 25)
