/*
   The mean force f of a step from U to U'. Its work f (U' - U) is the change of a cell's energy, including plastic
   work. With lever arms that are the mean of the initial and the final positions it has no moment. References: Simo and
   Tarnow, The discrete energy-momentum method, 1992; Gonzalez, Exact energy and momentum conserving algorithms for
   general models in nonlinear elasticity, 2000.
     f = int F_m (S_m + alpha C^(-1) dE C^(-1)) : dN/dX,   S = F^(-1) P,   dE = sym F_m^T (F' - F),   C = F^T F,
   F_m and S_m are the means of the values at U and U'. F and C belong to U. alpha is one number per cell. The metric C
   makes the term with alpha a stress in the deformed cell; alpha dE alone would be very different from such a stress in
   cells that are strained by 1 or more. For laws of small strain F_m = F = I and S = P.
   The mean of the forces at U and U' would not do this work. For example, where a metal begins to yield, the stress is
   a concave function of the strain, so that the mean is too small.
*/
#include "elasticityimpl.h"

/* Data of a quadrature point for a step; the symbols are explained at the top of this file. */
typedef struct {
  PetscReal w, G[3][CELL_MAX_NODES]; /* volume of the point; gradients of the shape functions */
  PetscReal F[3][3];                 /* mean deformation gradient F_m */
  PetscReal H[2][9], P[2][9];        /* F - I and stress P at the start and at the end of the step */
  PetscReal S[3][3], dE[3][3];       /* mean stress S_m; change dE of the strain */
  PetscReal R[3][3];                 /* C^(-1) dE C^(-1) */
} MeanPoint;

/*
   Computes energy density and stress P for an element's strains H at point q. Returns false if the point is inverted.
*/
static PetscBool MeanEvaluate(const BodyMaterial *m, PetscInt q, const PetscReal H[ELEMENT_STRAINS], PetscReal P[9],
  PetscReal *energy)
{
  PetscReal             C[9];
  MaterialModuli        own;
  const MaterialModuli *moduli = CellModuli(&m->isochoric, q, &own);
  PetscReal             theta;

  *energy = m->law->energy(moduli, H) + 0.5 * m->moduli.bulk * H[9] * H[9];
  if (!m->law->stress(moduli, H, P)) return PETSC_FALSE;
  theta = m->law->dilatation(H, C);
  *energy += 0.5 * m->rest * (theta * theta - H[9] * H[9]);
  for (int i = 0; i < 9; ++i) P[i] += (m->moduli.bulk * H[9] + m->rest * (theta - H[9])) * C[i];
  return PETSC_TRUE;
}

static void MeanSetGradient(const PetscReal H[9], PetscReal F[3][3])
{
  for (int i = 0; i < 9; ++i) F[i / 3][i % 3] = H[i] + (i % 4 ? 0 : 1);
}

/* Computes R = C^(-1) dE C^(-1) for the deformation gradient F at the start of the step */
static void MeanRaise(PetscReal F[3][3], const PetscReal dE[3][3], PetscReal R[3][3])
{
  PetscReal       cofactors[3][3], inverse[3][3];
  const PetscReal det = MatrixCofactors(F, cofactors);

  for (int i = 0; i < 9; ++i) {
    inverse[i / 3][i % 3] = R[i / 3][i % 3] = 0;
    for (int k = 0; k < 3; ++k) inverse[i / 3][i % 3] += cofactors[k][i / 3] * cofactors[k][i % 3] / (det * det);
  }
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 9; ++k) R[i / 3][i % 3] += inverse[i / 3][k / 3] * dE[k / 3][k % 3] * inverse[k % 3][i % 3];
  }
}

/* Computes F_m, S_m, dE and R of a point. finite: the law is one of finite strain; change: F' - F. */
static void MeanSetPoint(PetscBool finite, const PetscReal change[9], MeanPoint *p)
{
  PetscReal identity[9] = {0}, F[3][3], C[3][3];

  for (int i = 0; i < 9; ++i) p->S[i / 3][i % 3] = p->dE[i / 3][i % 3] = 0;
  MeanSetGradient(identity, p->F);
  for (int end = 0; end < 2; ++end) {
    PetscReal det;

    MeanSetGradient(finite ? p->H[end] : identity, F);
    det = MatrixCofactors(F, C);
    for (int i = 0; i < 9; ++i) {
      if (finite) p->F[i / 3][i % 3] += 0.5 * p->H[end][i];
      for (int k = 0; k < 3; ++k) {
        const PetscReal S = 0.25 * C[k][i / 3] * p->P[end][3 * k + i % 3] / det;

        p->S[i / 3][i % 3] += S;
        p->S[i % 3][i / 3] += S;
      }
    }
  }
  for (int i = 0; i < 9; ++i) {
    for (int k = 0; k < 3; ++k) {
      p->dE[i / 3][i % 3] += 0.5 * p->F[k][i / 3] * change[3 * k + i % 3];
      p->dE[i % 3][i / 3] += 0.5 * p->F[k][i / 3] * change[3 * k + i % 3];
    }
  }
  MeanSetGradient(finite ? p->H[0] : identity, F);
  MeanRaise(F, p->dE, p->R);
}

/*
   Returns alpha such that the force does the work `gained`; 0 if the difference is rounding error. size: sum of the
   energies at both ends.
*/
static PetscReal MeanGetFactor(PetscInt npoints, const MeanPoint points[], PetscReal gained, PetscReal size)
{
  const PetscReal rounding = 1e3 * PETSC_MACHINE_EPSILON;
  PetscReal       work = 0, square = 0;

  for (PetscInt q = 0; q < npoints; ++q) {
    for (int i = 0; i < 9; ++i) {
      work += points[q].w * points[q].S[i / 3][i % 3] * points[q].dE[i / 3][i % 3];
      square += points[q].w * points[q].R[i / 3][i % 3] * points[q].dE[i / 3][i % 3];
    }
  }
  return PetscAbsReal(gained - work) > rounding * size ? (gained - work) / square : 0;
}

/* Adds to F the mean force over the time step minus the mean of the forces at its two ends, at one quadrature point */
static void MeanAddForce(PetscInt n, const MeanPoint *p, PetscReal alpha, PetscReal F[3][CELL_MAX_NODES])
{
  PetscReal P[9];

  for (int i = 0; i < 9; ++i) {
    P[i] = -0.5 * (p->P[0][i] + p->P[1][i]);
    for (int k = 0; k < 3; ++k) P[i] += p->F[i / 3][k] * (p->S[k][i % 3] + alpha * p->R[k][i % 3]);
  }
  CellForceAdd((int)n, p->w, (PetscReal(*)[CELL_MAX_NODES])p->G, P, F);
}

/*
   Computes, for a cell, the mean force minus the mean of the forces at its displacements U[0] and U[1]. Returns false
   if a point is inverted.
*/
static PetscBool CellExcess(CellState cell[2], PetscReal F[3][CELL_MAX_NODES])
{
  const CellBasis *basis = cell->body->basis;
  PetscReal        w[CELL_MAX_POINTS], H[2][CELL_MAX_POINTS][ELEMENT_STRAINS], way[3][CELL_MAX_NODES];
  PetscReal        gained = 0, size = 0, alpha;
  MeanPoint        points[CELL_MAX_POINTS];

  for (int end = 0; end < 2; ++end)
    cell->body->element->strains(basis, cell->material, cell->X, cell[end].U, w, H[end]);
  for (int i = 0; i < 3; ++i) {
    for (PetscInt a = 0; a < cell->n; ++a) {
      way[i][a] = cell[1].U[i][a] - cell[0].U[i][a];
      F[i][a]   = 0;
    }
  }
  for (PetscInt q = 0; q < basis->npoints; ++q) {
    MeanPoint *p = &points[q];
    PetscReal  change[9];

    p->w = CellGradients((int)cell->n, basis, q, cell->X, p->G);
    CellDisplacementGradient((int)cell->n, way, p->G, change);
    for (int end = 0; end < 2; ++end) {
      PetscReal energy;

      if (!MeanEvaluate(cell->material, q, H[end][q], p->P[end], &energy)) return PETSC_FALSE;
      for (int i = 0; i < 9; ++i) p->H[end][i] = H[end][q][i];
      gained += (end ? 1 : -1) * p->w * energy;
      size += p->w * energy;
    }
    MeanSetPoint(cell->material->law->finite, change, p);
  }
  alpha = MeanGetFactor(basis->npoints, points, gained, size);
  for (PetscInt q = 0; q < basis->npoints; ++q) MeanAddForce(cell->n, &points[q], alpha, F);
  return PETSC_TRUE;
}

/*@
  ElasticityExcess - Computes the mean force of a step, which conserves energy and momentum, minus the mean of the
  forces at both ends

  Collective

  Input Parameters:
+ e    - the context
. from - displacement at the start, a state of equilibrium, global, 3 components per node [length]
- to   - displacement at the end [length]

  Output Parameters:
+ excess - the difference, on all rows; zero if a cell is inverted [force]
- valid  - whether no cell is inverted

  Level: intermediate

  Notes:
  The work of the mean force is the change of `ElasticityEnergy()`, including plastic work. The mean force has neither a
  resultant nor a moment about the mean positions. For bodies with a constant tangent the difference is zero.

  References:
. * - Gonzalez, Exact energy and momentum conserving algorithms for general models in nonlinear elasticity, 2000.

.seealso: `ElasticityForce()`, `ElasticityCommit()`
@*/
PetscErrorCode ElasticityExcess(Elasticity e, Vec from, Vec to, Vec excess, PetscBool *valid)
{
  Vec                locals[2], flocal;
  const PetscScalar *ul[2], *x;
  PetscScalar       *fl;

  PetscFunctionBegin;
  *valid = PETSC_TRUE;
  PetscCall(PetscLogEventBegin(ELASTICITY_Force, to, excess, 0, 0));
  PetscCall(ElasticityGetLocals(e, from, &locals[0], &ul[0], &x));
  PetscCall(DMGetLocalVector(e->dm, &locals[1]));
  PetscCall(DMGlobalToLocal(e->dm, to, INSERT_VALUES, locals[1]));
  PetscCall(VecGetArrayRead(locals[1], &ul[1]));
  PetscCall(DMGetLocalVector(e->dm, &flocal));
  PetscCall(VecZeroEntries(flocal));
  PetscCall(VecGetArray(flocal, &fl));
  for (PetscInt c = 0; c < e->ncells && *valid; ++c) {
    CellState cells[2];
    PetscReal F[3][CELL_MAX_NODES];

    if (e->bodies[e->cellbody[c]].material.law->constant) continue;
    for (int end = 0; end < 2; ++end) ElasticityGetCell(e, c, x, ul[end], &cells[end]);
    *valid = CellExcess(cells, F);
    for (int a = 0; a < cells->n && *valid; ++a) {
      for (int i = 0; i < 3; ++i) fl[3 * cells->nodes[a] + i] += F[i][a];
    }
  }
  PetscCall(VecRestoreArray(flocal, &fl));
  PetscCall(VecRestoreArrayRead(locals[1], &ul[1]));
  PetscCall(DMRestoreLocalVector(e->dm, &locals[1]));
  PetscCall(ElasticityRestoreLocals(e, &locals[0], &ul[0], &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, valid, 1, MPI_PETSCBOOL, MPI_LAND, PetscObjectComm((PetscObject)e->dm)));
  PetscCall(VecZeroEntries(excess));
  if (*valid) PetscCall(DMLocalToGlobal(e->dm, flocal, ADD_VALUES, excess));
  PetscCall(DMRestoreLocalVector(e->dm, &flocal));
  PetscCall(PetscLogEventEnd(ELASTICITY_Force, to, excess, 0, 0));
  PetscFunctionReturn(0);
}
