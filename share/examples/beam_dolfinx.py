"""An elastic beam whose two end faces are tied by a penalty of 1e8: DOLFINx, with PCAMGF in two lines.

    python3 beam_dolfinx.py -dll_append PREFIX/lib/libpetscamgf.so -pc_type amgf

Here BoomerAMG by itself takes 161 iterations in place of 22 (-pc_type hypre), and GAMG is not even definite (-pc_type
gamg).

Output:
    converged: True
    at most 60 iterations: True
"""
import sys

import petsc4py

petsc4py.init(sys.argv)
import numpy
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from petsc4py import PETSc

PENALTY = 1e8
LENGTH, SIDE, CELLS = 4.0, 1.0, 8  # cells across
beam = mesh.create_box(MPI.COMM_WORLD, [[0, 0, 0], [LENGTH, SIDE, SIDE]], [4 * CELLS, CELLS, CELLS],
                       mesh.CellType.hexahedron)
V = fem.VectorFunctionSpace(beam, ("Lagrange", 1))
u, v = ufl.TrialFunction(V), ufl.TestFunction(V)


def strain(w):
    return ufl.sym(ufl.grad(w))


stress = 2 * 400.0 * strain(u) + 600.0 * ufl.tr(strain(u)) * ufl.Identity(3)
stiffness = fem.form(ufl.inner(stress, strain(v)) * ufl.dx)
load = fem.form(ufl.dot(fem.Constant(beam, PETSc.ScalarType((0, 0, -1))), v) * ufl.dx)
held = fem.locate_dofs_geometrical(V, lambda x: numpy.isclose(x[2], 0) & (abs(x[0] - LENGTH / 2) < 0.6))
clamp = fem.dirichletbc(numpy.zeros(3, dtype=PETSc.ScalarType), held, V)
A = fem.petsc.assemble_matrix(stiffness, [clamp])
A.assemble()
b = fem.petsc.assemble_vector(load)
fem.petsc.apply_lifting(b, [stiffness], [[clamp]])
b.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
fem.petsc.set_bc(b, [clamp])


def face(x0):
    """y, z and global number of the vertices of an end face, from all ranks, in the order of y and z"""
    dofs = fem.locate_dofs_geometrical(V, lambda x: numpy.isclose(x[0], x0))
    dofs = dofs[dofs < V.dofmap.index_map.size_local]
    number = V.dofmap.index_map.local_to_global(dofs.astype(numpy.int32))
    places = V.tabulate_dof_coordinates()[dofs]
    rows = sum(beam.comm.allgather([(round(y, 9), round(z, 9), int(n)) for (_, y, z), n in zip(places, number)]), [])
    return numpy.array([n for _, _, n in sorted(rows)], dtype=PETSc.IntType)


left, right = face(0.0), face(LENGTH)
ties = PETSc.Mat().createAIJ(A.getSizes(), nnz=32)
ties.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
# as where meshes do not match: a vertex, and the middle of a facet
weights = numpy.array([1, -0.25, -0.25, -0.25, -0.25])
if beam.comm.rank == 0:
    for y, z in numpy.ndindex(CELLS, CELLS):
        k = y * (CELLS + 1) + z
        for d in range(3):
            rows = [3 * n + d for n in (left[k], right[k], right[k + 1], right[k + CELLS + 1], right[k + CELLS + 2])]
            ties.setValues(rows, rows, PENALTY * numpy.outer(weights, weights), addv=True)
ties.assemble()
A = A + ties
A.setBlockSize(3)

tied = [3 * n + d for n in (*left, *right) for d in range(3)]
# the first line; -pc_type amgf is the second
A.compose("amgf_filter", PETSc.IS().createGeneral(tied, comm=PETSc.COMM_SELF))
ksp = PETSc.KSP().create(beam.comm)
ksp.setType("cg")
ksp.setTolerances(rtol=1e-8, max_it=5000)
ksp.setOperators(A)
ksp.setFromOptions()
x = b.duplicate()
ksp.solve(b, x)
PETSc.Sys.Print("converged:", ksp.getConvergedReason() > 0)
PETSc.Sys.Print("at most 60 iterations:", ksp.getIterationNumber() <= 60)
