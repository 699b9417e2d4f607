/* Energy norm of the true error, from nothing of the library but mesh and law: stress of the elements against an
   exact one */
#ifndef ELASTICITY_TRUTH_H
#define ELASTICITY_TRUTH_H

#include "../lib/elasticity_problem.h"

/* A point of a trilinear cell: place, weight with the determinant, shape functions and their gradients */
typedef struct {
  PetscReal x[3], weight, N[8], G[8][3];
} CellPoint;

/* Stress xx yy zz xy yz zx at a place, or displacement gradient */
typedef void (*StressField)(const void *ctx, const PetscReal x[3], PetscReal sigma[6]);
typedef void (*GradientField)(const PetscReal x[3], PetscReal H[3][3]);

typedef struct {
  Material      material;
  ElementType   element;
  StressField   stress;   /* small strain */
  GradientField gradient; /* finite strain, element bbar */
  const void   *ctx;
} ExactSolution;

static inline PetscReal Determinant(PetscReal A[3][3])
{
  return A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) - A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
         A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
}

/* Point q of 3 x 3 x 3 Gauss points of the cell with vertices X[a][d] in tensor order. Gradients by Cramer's rule:
   J^T g = dN */
static inline void CellPointGet(PetscReal X[8][3], PetscInt q, CellPoint *p)
{
  const PetscReal gauss[3]  = {0.5 - PetscSqrtReal(0.15), 0.5, 0.5 + PetscSqrtReal(0.15)},
                  weight[3] = {5. / 18, 8. / 18, 5. / 18};
  const PetscInt index[3]   = {q % 3, q / 3 % 3, q / 9};
  PetscReal      D[8][3], J[3][3] = {{0}}, det;

  *p = (CellPoint){.weight = weight[index[0]] * weight[index[1]] * weight[index[2]]};
  for (PetscInt a = 0; a < 8; ++a) {
    PetscReal L[3], s[3];

    for (PetscInt d = 0; d < 3; ++d) {
      L[d] = (a >> d & 1) ? gauss[index[d]] : 1 - gauss[index[d]];
      s[d] = (a >> d & 1) ? 1 : -1;
    }
    p->N[a] = L[0] * L[1] * L[2];
    for (PetscInt d = 0; d < 3; ++d) D[a][d] = s[d] * L[(d + 1) % 3] * L[(d + 2) % 3];
    for (PetscInt i = 0; i < 3; ++i) {
      p->x[i] += p->N[a] * X[a][i];
      for (PetscInt k = 0; k < 3; ++k) J[k][i] += D[a][k] * X[a][i];
    }
  }
  det = Determinant(J);
  p->weight *= det;
  for (PetscInt a = 0; a < 8; ++a) {
    for (PetscInt i = 0; i < 3; ++i) {
      PetscReal A[3][3];

      for (PetscInt k = 0; k < 9; ++k) A[k / 3][k % 3] = k % 3 == i ? D[a][k / 3] : J[k / 3][k % 3];
      p->G[a][i] = Determinant(A) / det;
    }
  }
}

static inline void CellPointGradient(const CellPoint *p, PetscReal U[8][3], PetscReal H[3][3])
{
  for (PetscInt k = 0; k < 9; ++k) {
    H[k / 3][k % 3] = 0;
    for (PetscInt a = 0; a < 8; ++a) H[k / 3][k % 3] += U[a][k / 3] * p->G[a][k % 3];
  }
}

/* Of one cell: int (s - s_h) : C^(-1) : (s - s_h), s_h = 2 mu dev e + kappa (trace or mean trace) */
static inline PetscReal CellStressError(const ExactSolution *exact, PetscReal lambda, PetscReal mu, PetscReal X[8][3],
  PetscReal U[8][3])
{
  static const PetscInt row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
  const PetscReal       kappa  = lambda + 2 * mu / 3;
  PetscReal             volume = 0, mean = 0, sum = 0;

  for (PetscInt n = 0; n < 54; ++n) { /* first the mean, then the error */
    CellPoint p;
    PetscReal H[3][3], sigma[6], trace, pressure, square = 0;

    CellPointGet(X, n % 27, &p);
    CellPointGradient(&p, U, H);
    trace = H[0][0] + H[1][1] + H[2][2];
    if (n < 27) {
      volume += p.weight;
      mean += p.weight * trace;
      continue;
    }
    exact->stress(exact->ctx, p.x, sigma);
    for (PetscInt k = 0; k < 6; ++k) sigma[k] -= mu * (H[row[k]][column[k]] + H[column[k]][row[k]]);
    for (PetscInt k = 0; k < 3; ++k)
      sigma[k] -= kappa * (exact->element == ELEMENT_BBAR ? mean / volume : trace) - 2 * mu / 3 * trace;
    pressure = (sigma[0] + sigma[1] + sigma[2]) / 3;
    for (PetscInt k = 0; k < 6; ++k) square += k < 3 ? PetscSqr(sigma[k] - pressure) : 2 * PetscSqr(sigma[k]);
    sum += p.weight * (square / (2 * mu) + pressure * pressure / kappa);
  }
  return sum;
}

/* The same of mean dilatation at finite strain: int (H - H_h) : d2W_iso(H_h) : (H - H_h) + kappa (theta - Theta_h)^2 */
static inline PetscReal CellGradientError(const ExactSolution *exact, const MaterialLaw *law,
  const MaterialModuli *moduli, const MaterialModuli *isochoric, PetscReal X[8][3], PetscReal U[8][3])
{
  PetscReal volume = 0, mean = 0, sum = 0;

  for (PetscInt n = 0; n < 54; ++n) {
    CellPoint p;
    PetscReal H[3][3], truth[3][3], e[9], A[81], C[9], square = 0;

    CellPointGet(X, n % 27, &p);
    CellPointGradient(&p, U, H);
    if (n < 27) {
      volume += p.weight;
      mean += p.weight * law->dilatation(&H[0][0], C);
      continue;
    }
    exact->gradient(p.x, truth);
    law->tangent(isochoric, &H[0][0], A);
    for (PetscInt i = 0; i < 9; ++i) e[i] = truth[i / 3][i % 3] - H[i / 3][i % 3];
    for (PetscInt i = 0; i < 81; ++i) square += e[i / 9] * A[i] * e[i % 9];
    sum += p.weight * (square + moduli->bulk * PetscSqr(law->dilatation(&truth[0][0], C) - mean / volume));
  }
  return sum;
}

/* Vertices X[a][d] of a cell and their displacements, and the offsets of both */
static inline PetscErrorCode CellGather(DM dm, PetscInt cell, const PetscScalar x[], const PetscScalar u[],
  PetscReal X[8][3], PetscReal U[8][3], PetscInt offsets[8])
{
  PetscSection section;
  PetscInt     vertices[8];

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(MeshGetCellVertices(dm, cell, vertices));
  for (PetscInt a = 0; a < 8; ++a) {
    PetscCall(PetscSectionGetOffset(section, vertices[a], &offsets[a]));
    for (PetscInt d = 0; d < 3; ++d) {
      X[a][d] = PetscRealPart(x[offsets[a] + d]);
      U[a][d] = PetscRealPart(u[offsets[a] + d]);
    }
  }
  PetscFunctionReturn(0);
}

/* Squared energy norm of the error */
static inline PetscErrorCode TrueError(DM dm, const ExactSolution *exact, Vec u, PetscReal *error)
{
  const MaterialLaw *law;
  Vec                coordinates, local;
  const PetscScalar *x, *l;
  PetscInt           start, end;
  MaterialModuli     m, isochoric;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(&exact->material, &law));
  PetscCall(MaterialGetModuli(&exact->material, &m, &isochoric));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetLocalVector(dm, &local));
  PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArrayRead(local, &l));
  *error = 0;
  for (PetscInt c = start; c < end; ++c) {
    PetscReal X[8][3], U[8][3];
    PetscInt  offsets[8];

    PetscCall(CellGather(dm, c, x, l, X, U, offsets));
    *error += law->constant ? CellStressError(exact, m.lambda, m.mu, X, U)
                            : CellGradientError(exact, law, &m, &isochoric, X, U);
  }
  PetscCall(VecRestoreArrayRead(local, &l));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMRestoreLocalVector(dm, &local));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* Prints whether the effectivity sqrt(estimate/truth) is within a factor of 1, and its digits only if asked for or if
   it is not */
static inline PetscErrorCode ReportEffectivity(PetscInt level, PetscReal estimate, PetscReal truth, PetscReal factor)
{
  const PetscReal effectivity = PetscSqrtReal(estimate / truth);
  PetscBool       view        = PETSC_FALSE;

  PetscFunctionBeginUser;
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-effectivity_view", &view, NULL));
  if (view)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "level %" PetscInt_FMT ": true error %g, effectivity %.4f\n", level,
      (double)PetscSqrtReal(truth), (double)effectivity));
  else if (effectivity > 1 / factor && effectivity < factor)
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "level %" PetscInt_FMT ": effectivity within a factor %.1f of 1\n", level,
      (double)factor));
  else
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "level %" PetscInt_FMT ": effectivity %g\n", level, (double)effectivity));
  PetscFunctionReturn(0);
}

#endif
