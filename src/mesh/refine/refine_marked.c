/* Refines cells that were marked on a sequence of meshes. Equal marks reproduce equal meshes on any number of ranks. */
#include "refineimpl.h"

/* key under which the numbers that the cells have on the first rank are composed with the mesh */
#define MESH_NUMBERS "cell numbers"

/* Composes the numbers of this rank's cells with the mesh */
PetscErrorCode MeshNumberCells(DM dm, const MeshHanging *hanging)
{
  PetscInt cstart, cend, *number;
  IS       numbers;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(PetscMalloc1(cend - cstart, &number));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(hanging->section, c, &offset));
    number[c - cstart] = hanging->numbers[offset];
  }
  PetscCall(ISCreateGeneral(PETSC_COMM_SELF, cend - cstart, number, PETSC_OWN_POINTER, &numbers));
  PetscCall(PetscObjectCompose((PetscObject)dm, MESH_NUMBERS, (PetscObject)numbers));
  PetscCall(ISDestroy(&numbers));
  PetscFunctionReturn(0);
}

static PetscErrorCode MarksAppend(MeshMarks *marks, PetscInt n, PetscInt cells[])
{
  PetscFunctionBegin;
  PetscCall(PetscRealloc((marks->n + 1) * sizeof(*marks->count), &marks->count));
  PetscCall(PetscRealloc((marks->n + 1) * sizeof(*marks->cells), &marks->cells));
  marks->count[marks->n]   = n;
  marks->cells[marks->n++] = cells;
  PetscFunctionReturn(0);
}

/*
   Collective. Adds the marked cells of a mesh to the marks. The next mesh that is created with these marks has the
   marked cells refined. dm: mesh that MeshCreateScene() has created with these marks; marked: whether to mark each
   local cell; marks: initialized with zeros before the first call
*/
PetscErrorCode MeshMarksAdd(DM dm, const PetscBool marked[], MeshMarks *marks)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)dm);
  PetscMPIInt     size, *counts, *displs;
  PetscInt        cstart, cend, n = 0, total, *local, *all;
  const PetscInt *number;
  IS              numbers;

  PetscFunctionBegin;
  PetscCall(PetscObjectQuery((PetscObject)dm, MESH_NUMBERS, (PetscObject *)&numbers));
  PetscCheck(numbers, comm, PETSC_ERR_ARG_WRONGSTATE,
    "The cells of this mesh have no numbers, because it was created without refinement marks");
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, &cend));
  PetscCall(PetscMalloc3(cend - cstart, &local, size, &counts, size, &displs));
  PetscCall(ISGetIndices(numbers, &number));
  for (PetscInt c = 0; c < cend - cstart; ++c) {
    if (marked[c]) local[n++] = number[c];
  }
  PetscCall(ISRestoreIndices(numbers, &number));
  PetscCall(IntegersGather(comm, "the marked cells", n, local, counts, displs, &total, &all));
  PetscCall(MarksAppend(marks, all ? total : 0, all));
  PetscCall(PetscFree3(local, counts, displs));
  PetscFunctionReturn(0);
}

/* Frees marks and sets them to zero */
PetscErrorCode MeshMarksDestroy(MeshMarks *marks)
{
  PetscFunctionBegin;
  for (PetscInt m = 0; m < marks->n; ++m) PetscCall(PetscFree(marks->cells[m]));
  PetscCall(PetscFree(marks->count));
  PetscCall(PetscFree(marks->cells));
  marks->n = 0;
  PetscFunctionReturn(0);
}

/* Refines the marked cells, set by set. Not collective: it must be called on the rank that has the marks. */
PetscErrorCode MeshHexesRefineMarks(const MeshMarks *marks, DM dm, const SceneBody bodies[], const MeshCurves *curves,
  MeshHexes *hexes)
{
  PetscFunctionBegin;
  for (PetscInt m = 0; m < marks->n; ++m) {
    PetscBool *marked;

    PetscCall(PetscCalloc1(hexes->ncells, &marked));
    for (PetscInt i = 0; i < marks->count[m]; ++i) marked[marks->cells[m][i]] = PETSC_TRUE;
    PetscCall(MeshHexesRefine(hexes, marked));
    PetscCall(MeshHexesRefineInverted(dm, bodies, curves, hexes));
    PetscCall(PetscFree(marked));
  }
  PetscFunctionReturn(0);
}
