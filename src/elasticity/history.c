/* Plastic strains at the quadrature points. They change only when a state of equilibrium is committed. */
#include "elasticityimpl.h"

PetscErrorCode ElasticitySetUpHistory(Elasticity e)
{
  PetscFunctionBegin;
  for (PetscInt b = 0; b < e->nbodies; ++b) e->yields = (PetscBool)(e->yields || e->bodies[b].material.law->advance);
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(e->ncells, &e->firstpoint));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const Body *body = &e->bodies[e->cellbody[c]];

    e->firstpoint[c] = body->material.law->advance ? e->npoints : PETSC_DECIDE;
    if (body->material.law->advance) e->npoints += body->basis->npoints;
  }
  PetscCall(PetscCalloc1(MATERIAL_HISTORY * e->npoints, &e->history));
  PetscFunctionReturn(0);
}

/*
   Collective. Stores the plastic strains at a displacement, from which the next load step starts. u: displacement in a
   state of equilibrium, global, 3 components per node [length]. Energy, force and stress at u do not change. If no law
   has a history, nothing is done.
*/
PetscErrorCode ElasticityCommit(Elasticity e, Vec u)
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal      w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS];
    CellState      cell;
    MaterialModuli own;

    if (e->firstpoint[c] < 0) continue;
    ElasticityGetCell(e, c, x, ul, &cell);
    cell.body->element->strains(cell.body->basis, cell.material, cell.X, cell.U, w, H);
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q)
      (void)cell.material->law->advance(CellModuli(&cell.material->moduli, q, &own), H[q],
        e->history + MATERIAL_HISTORY * (e->firstpoint[c] + q));
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}

/* Collective. Finds whether any quadrature point has a plastic strain. yielded: the same on every rank. */
PetscErrorCode ElasticityHasYielded(Elasticity e, PetscBool *yielded)
{
  PetscFunctionBegin;
  *yielded = PETSC_FALSE;
  if (!e->yields) PetscFunctionReturn(0);
  for (PetscInt i = 0; i < e->npoints && !*yielded; ++i)
    *yielded = (PetscBool)(e->history[MATERIAL_HISTORY * i + MATERIAL_PLASTIC - 1] > 0);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, yielded, 1, MPI_PETSCBOOL, MPI_LOR, PetscObjectComm((PetscObject)e->dm)));
  PetscFunctionReturn(0);
}

/* Returns whether the law of cell c has a history. If so, gets the cell and the volumes w of its points. */
static PetscBool HistoryGetCell(Elasticity e, PetscInt c, const PetscScalar x[], CellState *cell, PetscReal w[])
{
  PetscReal G[3][CELL_MAX_NODES];

  if (e->firstpoint[c] < 0) return PETSC_FALSE;
  ElasticityGetCell(e, c, x, x, cell);
  for (PetscInt q = 0; q < cell->body->basis->npoints; ++q)
    w[q] = CELL_CALL(CellGradients, cell->body->basis, q, cell->X, G);
  return PETSC_TRUE;
}

/*@
  ElasticityPlasticWork - Computes the plastic work up to the last state of equilibrium, a part of the energy

  Collective

  Input Parameter:
. e - the context

  Output Parameters:
+ work    - integral of the stress over the plastic strain, of all bodies [force length]
- largest - equivalent plastic strain of each body, nbodies values; 0 without plasticity

  Level: intermediate

.seealso: `ElasticityEnergy()`
@*/
PetscErrorCode ElasticityPlasticWork(Elasticity e, PetscReal *work, PetscReal largest[])
{
  Vec                local;
  const PetscScalar *zero, *x;

  PetscFunctionBegin;
  *work = 0;
  PetscCall(PetscArrayzero(largest, e->nbodies));
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(ElasticityGetLocals(e, NULL, &local, &zero, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal w[CELL_MAX_POINTS];
    CellState cell;

    if (!HistoryGetCell(e, c, x, &cell, w)) continue;
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q) {
      const PetscReal *history = cell.material->moduli.history + MATERIAL_HISTORY * q;

      *work += w[q] * cell.material->law->work(&cell.material->moduli, history);
      largest[e->cellbody[c]] = PetscMax(largest[e->cellbody[c]], history[MATERIAL_PLASTIC - 1]);
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &zero, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, work, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)e->dm)));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, largest, (PetscMPIInt)e->nbodies, MPIU_REAL, MPIU_MAX,
    PetscObjectComm((PetscObject)e->dm)));
  PetscFunctionReturn(0);
}

/* Computes the elastic energy of a cell, and the plastic work in it since the last state of equilibrium */
static void HistoryMeasureStep(CellState *cell, PetscReal *stored, PetscReal *work)
{
  const BodyMaterial *m = cell->material;
  PetscReal           w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], history[MATERIAL_HISTORY];
  MaterialModuli      own;

  *stored = cell->body->element->energy(cell->body->basis, m, cell->X, cell->U);
  *work   = 0;
  if (!m->law->advance) return;
  cell->body->element->strains(cell->body->basis, m, cell->X, cell->U, w, H);
  for (PetscInt q = 0; q < cell->body->basis->npoints; ++q) {
    const MaterialModuli *moduli = CellModuli(&m->moduli, q, &own);

    (void)m->law->advance(moduli, H[q], history);
    *stored -= w[q] * m->law->work(moduli, history);
    *work += w[q] * (m->law->work(moduli, history) - m->law->work(moduli, moduli->history));
  }
}

/*
   Collective. Computes the plastic work of a step in those bodies that have a collapse load, that is, whose hardening
   is limited. u: trial displacement, global, 3 components per node [length]; stored: elastic energy of all bodies at u,
   0 if there is no such body [force length]; work: plastic work of such bodies since the last state of equilibrium
   [force length]; body: the body with the largest plastic work.
*/
PetscErrorCode ElasticityPlasticFlow(Elasticity e, Vec u, PetscReal *stored, PetscReal *work, PetscInt *body)
{
  Vec                local;
  const PetscScalar *ul, *x;
  PetscReal         *sums; /* plastic work of each body, followed by the elastic energy of all bodies */
  PetscBool          flows = PETSC_FALSE;

  PetscFunctionBegin;
  *stored = *work = 0;
  *body           = 0;
  for (PetscInt b = 0; b < e->nbodies; ++b) flows = (PetscBool)(flows || MaterialCollapses(&e->bodies[b].given));
  if (!flows) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(e->nbodies + 1, &sums));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal elastic, plastic;
    CellState cell;

    ElasticityGetCell(e, c, x, ul, &cell);
    HistoryMeasureStep(&cell, &elastic, &plastic);
    sums[e->nbodies] += elastic;
    if (MaterialCollapses(&cell.body->given)) sums[e->cellbody[c]] += plastic;
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, (PetscMPIInt)(e->nbodies + 1), MPIU_REAL, MPIU_SUM,
    PetscObjectComm((PetscObject)e->dm)));
  *stored = sums[e->nbodies];
  for (PetscInt b = 0; b < e->nbodies; ++b) {
    *work += sums[b];
    if (sums[b] > sums[*body]) *body = b;
  }
  PetscCall(PetscFree(sums));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCellPlastic - Gets the plastic strain of the cells at the last state of equilibrium

  Collective

  Input Parameter:
. e - the context

  Output Parameter:
. strain - mean over each local cell, in the order of the mesh's cells: plastic strain xx yy zz xy yz zx and its
           equivalent, MATERIAL_PLASTIC values per cell; free with `PetscFree()`. `NULL` on all ranks if no body is
           plastic

  Level: intermediate

.seealso: `ElasticityPlasticWork()`
@*/
PetscErrorCode ElasticityCellPlastic(Elasticity e, PetscReal *strain[])
{
  Vec                local;
  const PetscScalar *zero, *x;

  PetscFunctionBegin;
  *strain = NULL;
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(ElasticityGetLocals(e, NULL, &local, &zero, &x));
  PetscCall(PetscCalloc1(MATERIAL_PLASTIC * e->ncells + 1, strain));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal w[CELL_MAX_POINTS], volume = 0;
    CellState cell;

    if (!HistoryGetCell(e, c, x, &cell, w)) continue;
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q) volume += w[q];
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q) {
      for (int k = 0; k < MATERIAL_PLASTIC; ++k)
        (*strain)[MATERIAL_PLASTIC * c + k] += w[q] / volume * cell.material->moduli.history[MATERIAL_HISTORY * q + k];
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &zero, &x));
  PetscFunctionReturn(0);
}

/*
   Collective. Gets the quadrature points of laws with a history, for checkpoints. npoints: their number on this rank;
   places: per point its 3 undeformed coordinates [length] and its body, cell by cell, to be freed with PetscFree(),
   NULL on all ranks if no law has a history; history: MATERIAL_HISTORY values per point, borrowed, writable.
*/
PetscErrorCode ElasticityGetHistory(Elasticity e, PetscInt *npoints, PetscReal *places[], PetscReal *history[])
{
  Vec                local;
  const PetscScalar *zero, *x;

  PetscFunctionBegin;
  *npoints = e->npoints;
  *history = e->history;
  *places  = NULL;
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(4 * e->npoints + 1, places));
  PetscCall(ElasticityGetLocals(e, NULL, &local, &zero, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    PetscReal w[CELL_MAX_POINTS];
    CellState cell;

    if (!HistoryGetCell(e, c, x, &cell, w)) continue;
    for (PetscInt q = 0; q < cell.body->basis->npoints; ++q) {
      PetscReal *place = *places + 4 * (e->firstpoint[c] + q);

      place[3] = (PetscReal)e->cellbody[c];
      for (int a = 0; a < cell.n; ++a) {
        for (int d = 0; d < 3; ++d) place[d] += cell.body->basis->N[q][a] * cell.X[d][a];
      }
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &zero, &x));
  PetscFunctionReturn(0);
}
