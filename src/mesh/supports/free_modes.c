/* Motions of the bodies that no restraint prevents */
#include "supportsimpl.h"
#include <petscblaslapack.h>

/* resistance of a motion that counts as free; 1 is that of one restraint without a lever. Facets of a plane face in a
   mesh file with five digits resist with 1e-10. */
static const PetscReal free_resistance = 1e-9;

/*
   Replaces a symmetric matrix of restraints by its eigenvectors, one after the other. The first nfree of them are
   an orthonormal basis of the free motions.
*/
PetscErrorCode SupportFindNull(PetscInt n, PetscReal matrix[], PetscInt *nfree)
{
  PetscBLASInt size, lwork, info;
  PetscReal   *value, *work;

  PetscFunctionBegin;
  *nfree = 0;
  if (!n) PetscFunctionReturn(0);
  PetscCall(PetscBLASIntCast(n, &size));
  PetscCall(PetscBLASIntCast(34 * n, &lwork)); /* LAPACK's blocks have 32 columns */
  PetscCall(PetscMalloc2(n, &value, lwork, &work));
  PetscCallBLAS("LAPACKsyev", LAPACKsyev_("V", "L", &size, matrix, &size, value, work, &lwork, &info));
  PetscCheck(!info, PETSC_COMM_SELF, PETSC_ERR_LIB, "LAPACKsyev fails with code %" PetscBLASInt_FMT, info);
  while (*nfree < n && value[*nfree] <= free_resistance) ++*nfree;
  PetscCall(PetscFree2(value, work));
  PetscFunctionReturn(0);
}

/* Adds the 6 x 6 diagonal block of a link's first (end = 0) or second body (end = 1) to `block` */
void SupportAddBlock(const Support *support, PetscInt link, PetscInt end, PetscReal block[36])
{
  for (PetscInt k = 0; k < 36; ++k)
    block[k] += support->gram[link][(6 * end + k / 6) * SUPPORT_BLOCK + 6 * end + k % 6];
}

/* Finds the bodies that are held by the ground, then bodies that are held by held bodies, and so on. For most
   assemblies this finds all of them, in time proportional to the number of links. */
static PetscErrorCode SupportFindHeld(const Support *support, PetscBool held[])
{
  PetscBool more = PETSC_TRUE, *touched;
  PetscReal(*block)[36];

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(support->nbodies, &block, support->nbodies, &touched));
  for (PetscInt b = 0; b < support->nbodies; ++b) held[b] = PETSC_FALSE;
  while (more) {
    more = PETSC_FALSE;
    PetscCall(PetscArrayzero(block, support->nbodies));
    PetscCall(PetscArrayzero(touched, support->nbodies));
    for (PetscInt l = 0; l < support->nlinks; ++l) {
      const PetscInt *body = support->links[l].body;

      for (PetscInt end = 0; end < 2; ++end) {
        const PetscInt b = body[end], other = body[1 - end];

        if (b < 0 || held[b] || (other >= 0 && !held[other])) continue;
        SupportAddBlock(support, l, end, block[b]);
        touched[b] = PETSC_TRUE;
      }
    }
    for (PetscInt b = 0; b < support->nbodies; ++b) {
      PetscInt nfree;

      if (!touched[b]) continue;
      PetscCall(SupportFindNull(6, block[b], &nfree));
      held[b] = (PetscBool)!nfree;
      more    = (PetscBool)(more || held[b]);
    }
  }
  PetscCall(PetscFree2(block, touched));
  PetscFunctionReturn(0);
}

/* Finds the groups of bodies that are not held and that links connect. group[b]: the first body of the group of body b;
   -1 if body b is held */
static PetscErrorCode SupportGroup(const Support *support, PetscInt group[])
{
  PetscBool *held;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(support->nbodies, &held));
  PetscCall(SupportFindHeld(support, held));
  for (PetscInt b = 0; b < support->nbodies; ++b) group[b] = held[b] ? PETSC_DECIDE : b;
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    const PetscInt *body = support->links[l].body;
    const PetscInt  a = group[body[0]], b = body[1] < 0 ? PETSC_DECIDE : group[body[1]];

    for (PetscInt c = 0; a >= 0 && b >= 0 && a != b && c < support->nbodies; ++c)
      if (group[c] == PetscMax(a, b)) group[c] = PetscMin(a, b);
  }
  PetscCall(PetscFree(held));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a group, whose first body is given, to the matrix of its n modes. place[b]: position of body b
   in its group */
static void SupportGather(const Support *support, const PetscInt group[], PetscInt first, const PetscInt place[],
  PetscInt n, PetscReal matrix[])
{
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    for (PetscInt i = 0; i < SUPPORT_BLOCK; ++i) {
      const PetscInt a = support->links[l].body[i / 6];

      for (PetscInt j = 0; a >= 0 && group[a] == first && j < SUPPORT_BLOCK; ++j) {
        const PetscInt b = support->links[l].body[j / 6];

        if (b >= 0 && group[b] == first)
          matrix[(6 * place[a] + i % 6) * n + 6 * place[b] + j % 6] += support->gram[l][i * SUPPORT_BLOCK + j];
      }
    }
  }
}

/* Creates the n free motions on every rank: row 6 b + k has the coefficients of mode k of body b, one column for each
   motion, and then zeros. The motions of a group of bodies are orthonormal; those of different groups move different
   bodies. Also computes `outside`. */
PetscErrorCode SupportFindFree(Support *support, PetscInt *nmotions, Mat *motions)
{
  const PetscInt nbodies = support->nbodies;
  PetscInt      *group, *place;

  PetscFunctionBegin;
  *nmotions = 0;
  PetscCall(PetscMalloc2(nbodies, &group, nbodies, &place));
  PetscCall(SupportGroup(support, group));
  PetscCall(MatCreateSeqAIJ(PETSC_COMM_SELF, 6 * nbodies, 6 * nbodies, 6, NULL, motions));
  PetscCall(MatSetOption(*motions, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_FALSE));
  PetscCall(MatSetOption(*motions, MAT_IGNORE_ZERO_ENTRIES, PETSC_TRUE));
  for (PetscInt first = 0; first < nbodies; ++first) {
    PetscReal *matrix;
    PetscInt   n = 0, nfree;

    if (group[first] != first) continue;
    for (PetscInt b = first; b < nbodies; ++b)
      if (group[b] == first) place[b] = n++;
    n *= 6;
    PetscCall(PetscCalloc1(n * n, &matrix));
    SupportGather(support, group, first, place, n, matrix);
    PetscCall(SupportFindNull(n, matrix, &nfree));
    for (PetscInt i = 6 * first; i < 6 * nbodies; ++i) {
      for (PetscInt k = 0; k < nfree && group[i / 6] == first; ++k) {
        const PetscReal part = matrix[k * n + 6 * place[i / 6] + i % 6];

        PetscCall(MatSetValue(*motions, i, *nmotions + k, part, INSERT_VALUES));
        support->outside[i / 6][i % 6] += part * part;
      }
    }
    *nmotions += nfree;
    PetscCall(PetscFree(matrix));
  }
  PetscCall(MatAssemblyBegin(*motions, MAT_FINAL_ASSEMBLY));
  PetscCall(MatAssemblyEnd(*motions, MAT_FINAL_ASSEMBLY));
  PetscCall(PetscFree2(group, place));
  PetscFunctionReturn(0);
}
