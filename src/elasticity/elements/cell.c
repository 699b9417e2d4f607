/* A cell with the coordinates and displacements of its nodes */
#include "elementsimpl.h"

/* Adds the shortening of a section to the displacements of a cell's nodes beyond the section */
static void SectionAdd(Elasticity e, PetscInt c, CellState *cell)
{
  const BodySection *section = &e->sections[e->cellsection[c]];

  for (PetscInt a = 0; a < cell->n; ++a) {
    for (int d = 0; d < 3; ++d)
      cell->U[d][a] += section->shortening * section->axis[d] * e->beyond[e->cellbeyond[c] + a];
  }
}

void ElasticityGetCell(Elasticity e, PetscInt c, const PetscScalar x[], const PetscScalar u[], CellState *cell)
{
  cell->n        = e->cellstart[c + 1] - e->cellstart[c];
  cell->nodes    = e->cellnodes + e->cellstart[c];
  cell->body     = &e->bodies[e->cellbody[c]];
  cell->material = &cell->body->material;
  if (e->history && e->firstpoint[c] >= 0) {
    cell->own                = cell->body->material;
    cell->own.moduli.history = cell->own.isochoric.history = e->history + MATERIAL_HISTORY * e->firstpoint[c];
    cell->material                                         = &cell->own;
  }
  CellGather(cell->n, cell->nodes, x, cell->X);
  CellGather(cell->n, cell->nodes, u, cell->U);
  if (e->temperature && cell->body->expands) ThermalSubtract(e->temperature + 4 * c, cell);
  if (e->cellsection && e->cellsection[c] >= 0) SectionAdd(e, c, cell);
}
