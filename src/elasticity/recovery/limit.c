/*
   Limits recovered strains where the material has yielded. A polynomial through stresses on the yield surface leaves it
   towards the surface of the body: in a bent strip by half of the yield stress.
*/
#include "recoveryimpl.h"

static PetscReal LimitVonMises(const BodyMaterial *m, const PetscReal strain[ELEMENT_STRAINS])
{
  PetscReal stress[6];

  return m->law->cauchy(&m->isochoric, strain, stress) ? StressVonMises(stress) : 0;
}

/* Returns the largest von Mises stress at the points of a cell if it has yielded, and 0 otherwise */
static PetscReal LimitOfCell(CellState *cell)
{
  const CellBasis *basis   = cell->body->basis;
  PetscBool        yielded = PETSC_FALSE;
  PetscReal        w[CELL_MAX_POINTS], H[CELL_MAX_POINTS][ELEMENT_STRAINS], largest = 0;

  if (!cell->material->moduli.history) return 0;
  cell->body->element->strains(basis, cell->material, cell->X, cell->U, w, H);
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    if (cell->material->moduli.history[MATERIAL_HISTORY * q + MATERIAL_PLASTIC - 1] > 0) yielded = PETSC_TRUE;
    CellElastic(cell->material, q, H[q]);
    largest = PetscMax(largest, LimitVonMises(&cell->body->material, H[q]));
  }
  return yielded ? largest : 0;
}

/* Scales the deviator of the recovered strain so that its von Mises stress is at most the limit */
static void LimitApply(const BodyMaterial *m, PetscReal limit, RecoveredNode *node)
{
  PetscReal *stretch = node->value + ELEMENT_STRAINS, strain[ELEMENT_STRAINS], stress, factor;
  PetscReal  mean = (node->value[0] + node->value[4] + node->value[8]) / 3, turned = 0;

  StretchGetStrain(m, node, strain);
  stress = LimitVonMises(m, strain);
  if (stress <= limit) return;
  factor = limit / stress;
  for (int k = 0; k < 3; ++k) turned += stretch[k] / 3;
  for (int k = 0; k < 9 && !m->law->finite; ++k)
    node->value[k] = factor * node->value[k] + (k % 4 ? 0 : (1 - factor) * mean);
  for (int k = 0; k < 6; ++k) stretch[k] = factor * stretch[k] + (k < 3 ? (1 - factor) * turned : 0);
}

/* Limits the von Mises stress at nodes of cells that have yielded to the largest one at the points of these cells */
PetscErrorCode ElasticityLimitRecovered(Elasticity e, PetscSF sf, const PetscBool selected[], const PetscScalar x[],
  const PetscScalar u[], RecoveredNode recovered[])
{
  PetscReal *limit;

  PetscFunctionBegin;
  if (!e->yields) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(e->nnodes, &limit));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    CellState cell;
    PetscReal largest;

    if (!selected[e->cellbody[c]]) continue;
    ElasticityGetCell(e, c, x, u, &cell);
    largest = LimitOfCell(&cell);
    for (PetscInt a = 0; a < cell.n; ++a) limit[cell.nodes[a]] = PetscMax(limit[cell.nodes[a]], largest);
  }
  PetscCall(ValuesReduce(sf, MPIU_REAL, MPIU_MAX, limit));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt b = e->cellbody[c];

    for (PetscInt i = e->cellstart[c]; selected[b] && i < e->cellstart[c + 1]; ++i) {
      const PetscInt v = e->cellnodes[i];

      if (limit[v] > 0) LimitApply(&e->bodies[b].material, limit[v], &recovered[v]);
    }
  }
  PetscCall(PetscFree(limit));
  PetscFunctionReturn(0);
}
