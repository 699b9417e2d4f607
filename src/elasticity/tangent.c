/* The tangent stiffness: matrix, near null space, assembly */
#include "elasticity_private.h"

/* 1 on free rows, 0 on prescribed ones */
static PetscErrorCode ElasticityFreeRows(Elasticity e, Vec rows)
{
  Vec          local;
  PetscScalar *l;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecGetArray(local, &l));
  for (PetscInt i = 0; i < 3 * e->nnodes; ++i) l[i] = (e->prescribed[i / 3] >> i % 3 & 1) ? 0 : 1;
  PetscCall(VecRestoreArray(local, &l));
  PetscCall(DMLocalToGlobal(e->dm, local, INSERT_VALUES, rows));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/* The modes with zeros on prescribed rows, orthonormal again; a mode that the others span there is left out.
   An AMG built on the zeroed modes needs fewer iterations the closer Poisson's ratio is to 1/2. */
static PetscErrorCode ElasticityRestrictModes(Elasticity e, MatNullSpace all, MatNullSpace *restricted)
{
  const PetscReal dependent = 1e-6;
  PetscInt        nall, n = 0;
  const Vec      *modes;
  Vec             kept[6], rows;
  PetscScalar     dots[6];

  PetscFunctionBegin;
  PetscCall(MatNullSpaceGetVecs(all, NULL, &nall, &modes));
  PetscCall(VecDuplicate(modes[0], &rows));
  PetscCall(ElasticityFreeRows(e, rows));
  for (PetscInt i = 0; i < nall; ++i) {
    PetscReal before, after;

    PetscCall(VecDuplicate(rows, &kept[n]));
    PetscCall(VecPointwiseMult(kept[n], modes[i], rows));
    PetscCall(VecNorm(kept[n], NORM_2, &before));
    for (PetscInt pass = 0; pass < 2; ++pass) { /* twice is enough for orthogonality to rounding */
      PetscCall(VecMDot(kept[n], n, kept, dots));
      for (PetscInt j = 0; j < n; ++j) dots[j] = -dots[j];
      PetscCall(VecMAXPY(kept[n], n, dots, kept));
    }
    PetscCall(VecNormalize(kept[n], &after));
    if (after > dependent * before) ++n;
    else PetscCall(VecDestroy(&kept[n]));
  }
  PetscCall(MatNullSpaceCreate(PetscObjectComm((PetscObject)rows), PETSC_FALSE, n, kept, restricted));
  for (PetscInt i = 0; i < n; ++i) PetscCall(VecDestroy(&kept[i]));
  PetscCall(VecDestroy(&rows));
  PetscFunctionReturn(0);
}

/* Rigid body modes of the reference geometry, zero on prescribed rows */
static PetscErrorCode ElasticitySetNearNullSpace(Elasticity e, Mat A)
{
  Vec          local, coordinates;
  MatNullSpace modes, restricted;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinatesLocal(e->dm, &local));
  PetscCall(DMCreateGlobalVector(e->dm, &coordinates));
  PetscCall(DMLocalToGlobal(e->dm, local, INSERT_VALUES, coordinates));
  PetscCall(MatNullSpaceCreateRigidBody(coordinates, &modes));
  PetscCall(VecDestroy(&coordinates));
  if (e->prescribed) {
    PetscCall(ElasticityRestrictModes(e, modes, &restricted));
    PetscCall(MatNullSpaceDestroy(&modes));
    modes = restricted;
  }
  PetscCall(MatSetNearNullSpace(A, modes));
  PetscCall(MatNullSpaceDestroy(&modes));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCreateTangent - Creates the tangent matrix, all its entries allocated and zero

  Collective

  Input Parameter:
. elasticity - the context

  Output Parameter:
. tangent - n x n matrix of block size 3, laid out as the mesh's global vectors

  Options Database Key:
. -elasticity_mat_type <baij> - baij, aij or sbaij

  Level: beginner

  Notes:
  The matrix is marked symmetric, and carries the rigid body modes, zero on the rows prescribed when it is created, as its near null space.

.seealso: `ElasticityTangent()`, `MatSetNearNullSpace()`
@*/
PetscErrorCode ElasticityCreateTangent(Elasticity e, Mat *tangent)
{
  Vec      global;
  Mat      A;
  PetscInt n, N;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalVector(e->dm, &global));
  PetscCall(VecGetLocalSize(global, &n));
  PetscCall(VecGetSize(global, &N));
  PetscCall(DMRestoreGlobalVector(e->dm, &global));
  PetscCall(MatCreate(PetscObjectComm((PetscObject)e->dm), &A));
  PetscCall(MatSetSizes(A, n, n, N, N));
  PetscCall(MatSetBlockSize(A, 3));
  PetscCall(MatSetType(A, e->mattype));
  PetscCall(ElasticityPreallocate(e, A));
  PetscCall(MatSetOption(A, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  PetscCall(MatSetOption(A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(MatSetOption(A, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  PetscCall(ElasticitySetNearNullSpace(e, A));
  *tangent = A;
  PetscFunctionReturn(0);
}

/*
   A constant isotropic tangent: K_ab = int lambda grad N_a (x) grad N_b + mu grad N_b (x) grad N_a + mu (grad N_a . grad N_b) I,
   from the six integrals S_ij[a][b] = int dN_a/dX_i dN_b/dX_j, i <= j, as S_ji is the transpose of S_ij.
*/
static void HexStiffnessIsotropic(const HexBasis *basis, PetscReal X[3][8], PetscReal lambda, PetscReal mu, PetscScalar K[24][24])
{
  PetscReal S[3][3][8][8] = {{{{0}}}}, G[3][8];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        for (int a = 0; a < 8; ++a) {
          const PetscReal g = w * G[i][a];

          for (int b = 0; b < 8; ++b) S[i][j][a][b] += g * G[j][b];
        }
      }
    }
  }
  for (int a = 0; a < 8; ++a) {
    for (int b = 0; b < 8; ++b) {
      const PetscReal laplacian = mu * (S[0][0][a][b] + S[1][1][a][b] + S[2][2][a][b]);

      for (int i = 0; i < 3; ++i) {
        K[3 * a + i][3 * b + i] = laplacian + (lambda + mu) * S[i][i][a][b];
        for (int j = i + 1; j < 3; ++j) {
          K[3 * a + i][3 * b + j] = lambda * S[i][j][a][b] + mu * S[i][j][b][a];
          K[3 * a + j][3 * b + i] = lambda * S[i][j][b][a] + mu * S[i][j][a][b];
        }
      }
    }
  }
}

/* Any law: K_ia,kb = int dN_a/dX_j dP_ij/dH_kl dN_b/dX_l */
static void HexStiffness(const HexBasis *basis, PetscReal X[3][8], PetscReal U[3][8], const BodyMaterial *m, PetscScalar K[24][24])
{
  PetscReal S[3][3][8][8] = {{{{0}}}}, G[3][8], H[9], A[81];

  for (PetscInt q = 0; q < basis->npoints; ++q) {
    const PetscReal w = HexGradients(basis, q, X, G);

    HexDisplacementGradient(U, G, H);
    m->law->tangent(m->lambda, m->mu, H, A);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        for (int j = 0; j < 3; ++j) {
          const PetscReal *c = A + 9 * (3 * i + j) + 3 * k;
          PetscReal        T[8];

          for (int b = 0; b < 8; ++b) T[b] = w * (c[0] * G[0][b] + c[1] * G[1][b] + c[2] * G[2][b]);
          for (int a = 0; a < 8; ++a) {
            for (int b = 0; b < 8; ++b) S[i][k][a][b] += G[j][a] * T[b];
          }
        }
      }
    }
  }
  for (int a = 0; a < 8; ++a) {
    for (int i = 0; i < 3; ++i) {
      for (int b = 0; b < 8; ++b) {
        for (int k = 0; k < 3; ++k) K[3 * a + i][3 * b + k] = S[i][k][a][b];
      }
    }
  }
}

/* Zeroes rows and columns of prescribed displacements; their diagonal keeps the stiffness's scale */
static void HexMaskPrescribed(const unsigned char prescribed[], const PetscInt nodes[8], PetscScalar K[24][24])
{
  for (int a = 0; a < 8; ++a) {
    if (!prescribed[nodes[a]]) continue;
    for (int i = 0; i < 3; ++i) {
      const int         r        = 3 * a + i;
      const PetscScalar diagonal = K[r][r];

      if (!(prescribed[nodes[a]] >> i & 1)) continue;
      for (int s = 0; s < 24; ++s) K[r][s] = K[s][r] = 0;
      K[r][r] = diagonal;
    }
  }
}

/*@
  ElasticityTangent - Assembles the second derivative of the energy

  Collective

  Input Parameters:
+ elasticity - the context
. u          - displacement, global, 3 components a vertex [length]; may be `NULL` (no displacement)
- tangent    - matrix from `ElasticityCreateTangent()`

  Output Parameter:
. tangent - the tangent [force/length]; rows and columns of prescribed unknowns are zero apart from the diagonal

  Level: beginner

.seealso: `ElasticityCreateTangent()`, `ElasticitySetPrescribed()`, `ElasticityForce()`
@*/
PetscErrorCode ElasticityTangent(Elasticity e, Vec u, Mat tangent)
{
  ISLocalToGlobalMapping map;
  Vec                    coordinates, local;
  const PetscInt        *global;
  const PetscScalar     *x, *ul;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Tangent, tangent, 0, 0, 0));
  PetscCall(DMGetLocalToGlobalMapping(e->dm, &map));
  PetscCall(ISLocalToGlobalMappingGetBlockIndices(map, &global));
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  if (u) PetscCall(DMGlobalToLocal(e->dm, u, INSERT_VALUES, local));
  else PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArrayRead(local, &ul));
  PetscCall(MatZeroEntries(tangent));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt     *nodes = e->cellnodes + 8 * c;
    const BodyMaterial *m     = &e->bodies[e->cellbody[c]];
    PetscInt            rows[8];
    PetscReal           X[3][8], U[3][8];
    PetscScalar         K[24][24];

    ElasticityGatherCell(nodes, x, X);
    if (m->law->constant) HexStiffnessIsotropic(&e->basis, X, m->lambda, m->mu, K);
    else {
      ElasticityGatherCell(nodes, ul, U);
      HexStiffness(&e->basis, X, U, m, K);
    }
    if (e->prescribed) HexMaskPrescribed(e->prescribed, nodes, K);
    for (PetscInt a = 0; a < 8; ++a) rows[a] = global[nodes[a]];
    PetscCall(MatSetValuesBlocked(tangent, 8, rows, 8, rows, &K[0][0], ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(local, &ul));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscCall(ISLocalToGlobalMappingRestoreBlockIndices(map, &global));
  PetscCall(MatAssemblyBegin(tangent, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(tangent, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscLogEventEnd(ELASTICITY_Tangent, tangent, 0, 0, 0));
  PetscFunctionReturn(0);
}
