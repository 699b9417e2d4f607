"""A petsc4py program that knows nothing of PCAMGF but the name under which it composes the stiff unknowns.

    python3 amgf_foreign.py -dll_append /path/to/libpetscamgf.so -pc_type amgf [-filter composed] [-write PREFIX]
    [-stiff MATRIX]

A = K + J^T D J: a Laplacian on a square grid, and J ties its lower to its upper edge with a stiffness D of many orders.
-filter composed    composes an IS of the tied unknowns on A; otherwise name them by -pc_amgf_filter_file or
-pc_amgf_detect
-write PREFIX       writes A and b to PREFIX.dat and the IS to PREFIX.is (PETSc binary), for other programs
-stiff MATRIX       reads MATRIX instead (PETSc binary) and writes the rows whose diagonal exceeds 50 medians to
                    MATRIX.is
"""
import sys

import petsc4py

petsc4py.init(sys.argv)
import numpy
from petsc4py import PETSc

N = 40  # nodes a side


def constraint(k):
    """Unknowns and coefficients of row k of J, as a mortar method has them: a lower node against three upper ones; and
    its stiffness."""
    upper = N * (N - 1) + k
    return (k, upper - 1, upper, upper + 1), (1.0, -0.25, -0.5, -0.25), 10.0**(2 + 6 * (7 * k % N) / N)


def create_operator(comm):
    """Laplacian + J^T D J"""
    A = PETSc.Mat().createAIJ([N * N, N * N], nnz=16, comm=comm)
    A.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
    start, end = A.getOwnershipRange()
    for row in range(start, end):
        i, j = divmod(row, N)
        A.setValue(row, row, 4.0, addv=True)
        for near, inside in ((row - 1, j > 0), (row + 1, j < N - 1), (row - N, i > 0), (row + N, i < N - 1)):
            if inside:
                A.setValue(row, near, -1.0, addv=True)
    for k in range(1, N - 1):
        cols, coefficients, stiffness = constraint(k)
        if start <= cols[0] < end:
            A.setValues(cols, cols, stiffness * numpy.outer(coefficients, coefficients), addv=True)
    A.assemble()
    return A


def create_filter(A):
    start, end = A.getOwnershipRange()
    rows = sorted({row for k in range(1, N - 1) for row in constraint(k)[0] if start <= row < end})
    return PETSc.IS().createGeneral(rows, comm=A.comm)


def write_stiff_rows(name):
    A = PETSc.Mat().load(PETSc.Viewer().createBinary(name, "r"))
    diagonal = A.getDiagonal().getArray()
    rows = numpy.nonzero(diagonal > 50 * numpy.median(diagonal))[0]
    PETSc.IS().createGeneral(rows.astype(PETSc.IntType)).view(PETSc.Viewer().createBinary(name + ".is", "w"))


def main():
    options = PETSc.Options()
    if options.hasName("stiff"):
        write_stiff_rows(options.getString("stiff"))
        return
    A = create_operator(PETSc.COMM_WORLD)
    rows = create_filter(A)
    x, b = A.createVecs()
    b.set(1.0)
    if options.hasName("write"):
        prefix = options.getString("write")
        viewer = PETSc.Viewer().createBinary(prefix + ".dat", "w")
        A.view(viewer)
        b.view(viewer)
        rows.view(PETSc.Viewer().createBinary(prefix + ".is", "w"))
    if options.getString("filter", "") == "composed":
        A.compose("amgf_filter", rows)
    ksp = PETSc.KSP().create(A.comm)
    ksp.setType("cg")
    ksp.setTolerances(rtol=1e-10)
    ksp.setOperators(A)
    ksp.setFromOptions()
    ksp.solve(b, x)


main()
