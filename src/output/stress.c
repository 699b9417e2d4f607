/* Writes stress and strain energy as datasets of the file of a load step. */
#include "outputimpl.h"
#include <mesh.h>

/*
   Writes a dataset with n rows. Component k of row i is values[stride * i + order[k]]. stride: number of values per
   record.
*/
static PetscErrorCode StressWriteValues(Output output, const char name[], PetscInt n, PetscInt components,
  const int order[], PetscInt stride, const PetscReal values[], PetscViewer viewer)
{
  Vec          field;
  PetscScalar *f;

  PetscFunctionBegin;
  PetscCall(DatasetCreate(output->comm, name, n, components, &field));
  PetscCall(VecGetArray(field, &f));
  for (PetscInt i = 0; i < n; ++i) {
    for (PetscInt k = 0; k < components; ++k) f[components * i + k] = values[stride * i + order[k]];
  }
  PetscCall(VecRestoreArray(field, &f));
  PetscCall(DatasetWrite(&field, viewer));
  PetscFunctionReturn(0);
}

static const int identity[] = {0, 1, 2, 3, 4, 5};
static const int tensor6[]  = {0, 3, 5, 1, 4, 2}; /* order of XDMF (xx xy xz yy yz zz) as indices into xx yy zz xy yz
                                                     zx */
static const int mises[]    = {6};
static const int highest[]  = {7, 8, 9};

/*
   Writes a dataset with one row per piece. values: one record per cell of this rank; all pieces of a cell get the
   values of the cell. The other arguments are those of StressWriteValues().
*/
static PetscErrorCode StressWritePieces(Output output, const char name[], PetscInt components, const int order[],
  PetscInt stride, const PetscReal values[], PetscViewer viewer)
{
  PetscReal   *pieces;
  PetscInt     cstart, cend, at = 0;
  OutputPieces of;

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(output->dm, 0, &cstart, &cend));
  PetscCall(PetscMalloc1(stride * output->ncellslocal, &pieces));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscCall(OutputGetPieces(output, c, &of));
    for (PetscInt p = 0; p < of.n; ++p, ++at)
      PetscCall(PetscArraycpy(pieces + stride * at, values + stride * (c - cstart), stride));
  }
  PetscCall(StressWriteValues(output, name, output->ncellslocal, components, order, stride, pieces, viewer));
  PetscCall(PetscFree(pieces));
  PetscFunctionReturn(0);
}

PetscErrorCode StressWriteCells(Output output, const StepState *state, PetscViewer viewer)
{
  PetscFunctionBegin;
  PetscCall(StressWritePieces(output, "stress", 6, tensor6, 7, state->stress, viewer));
  PetscCall(StressWritePieces(output, "von_mises", 1, mises, 7, state->stress, viewer));
  if (state->plastic) {
    PetscCall(StressWritePieces(output, "plastic_strain", 6, tensor6, 7, state->plastic, viewer));
    PetscCall(StressWritePieces(output, "equivalent_plastic_strain", 1, mises, 7, state->plastic, viewer));
  }
  if (state->density)
    PetscCall(StressWritePieces(output, "strain_energy_density", 1, identity, 1, state->density, viewer));
  PetscFunctionReturn(0);
}

PetscErrorCode StressWriteNodes(Output output, const StepState *state, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (!state->nodal) PetscFunctionReturn(0);
  PetscCall(StressWriteValues(output, "nodal_stress", output->nowned, 6, tensor6, STRESS_VALUES, state->nodal, viewer));
  PetscCall(
    StressWriteValues(output, "nodal_von_mises", output->nowned, 1, mises, STRESS_VALUES, state->nodal, viewer));
  PetscCall(
    StressWriteValues(output, "principal_stress", output->nowned, 3, highest, STRESS_VALUES, state->nodal, viewer));
  PetscFunctionReturn(0);
}

/* Writes n cells that consist of one point each, since ParaView shows only points that belong to a cell. */
static PetscErrorCode StressWritePointCells(Output output, PetscInt n, PetscViewer viewer)
{
  IS        is;
  PetscInt *cells, first = 0;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Exscan(&n, &first, 1, MPIU_INT, MPI_SUM, output->comm));
  PetscCall(PetscMalloc1(n, &cells));
  for (PetscInt i = 0; i < n; ++i) cells[i] = first + i;
  PetscCall(ISCreateGeneral(output->comm, n, cells, PETSC_OWN_POINTER, &is));
  PetscCall(PetscObjectSetName((PetscObject)is, "gauss_cells"));
  PetscCall(DatasetWriteIndices(is, viewer));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

PetscErrorCode StressWriteQuadrature(Output output, const StepState *state, PetscViewer viewer)
{
  PetscFunctionBegin;
  if (!state->quadrature) PetscFunctionReturn(0);
  PetscCall(StressWritePointCells(output, state->nquadrature, viewer));
  PetscCall(StressWriteValues(output, "gauss_points", state->nquadrature, 3, identity, 3, state->quadrature, viewer));
  PetscCall(
    StressWriteValues(output, "gauss_stress", state->nquadrature, 6, tensor6, 6, state->quadrature_stress, viewer));
  PetscFunctionReturn(0);
}
