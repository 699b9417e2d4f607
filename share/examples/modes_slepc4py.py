"""The lowest vibrations of a membrane with a penalty of 1e8 between two of its edges: SLEPc, shift and invert by CG
with PCAMGF.

    python3 modes_slepc4py.py -dll_append PREFIX/lib/libpetscamgf.so -st_pc_type amgf

Output:
    modes found: True
    the first one's edges move together: True
"""
import sys

import slepc4py

slepc4py.init(sys.argv)
from petsc4py import PETSc
from slepc4py import SLEPc

N, PENALTY = 32, 1e8  # nodes a side

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
edges = list(range(N)) + list(range(N * (N - 1), N * N))
A.compose("amgf_filter", PETSc.IS().createGeneral(edges, comm=PETSc.COMM_SELF))

eps = SLEPc.EPS().create()
eps.setOperators(A)
eps.setProblemType(SLEPc.EPS.ProblemType.HEP)
eps.setDimensions(nev=3)
eps.setTarget(0.0)
eps.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
st = eps.getST()
st.setType("sinvert")
st.getKSP().setType("cg")
st.getKSP().setTolerances(rtol=1e-10)
eps.setFromOptions()
eps.solve()
found = eps.getConverged()
mode = A.createVecRight()
eps.getEigenpair(0, mode)
scatter, everywhere = PETSc.Scatter.toAll(mode)
scatter.scatter(mode, everywhere)
u = everywhere.getArray()
PETSc.Sys.Print("modes found:", found >= 3)
PETSc.Sys.Print("the first one's edges move together:", abs(u[:N] - u[N * (N - 1):]).max() < 1e-5 * abs(u).max())
