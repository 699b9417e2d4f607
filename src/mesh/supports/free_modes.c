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
static void SupportAddBlock(const Support *support, PetscInt link, PetscInt end, PetscReal block[36])
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

/* Assembles the matrix of the bodies that are not held. place[b]: position of body b in the matrix; -1 if it is left
   out */
static void SupportGather(const Support *support, const PetscInt place[], PetscInt n, PetscReal matrix[])
{
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    for (PetscInt i = 0; i < SUPPORT_BLOCK; ++i) {
      const PetscInt a = support->links[l].body[i / 6];

      for (PetscInt j = 0; a >= 0 && place[a] >= 0 && j < SUPPORT_BLOCK; ++j) {
        const PetscInt b = support->links[l].body[j / 6];

        if (b >= 0 && place[b] >= 0)
          matrix[(6 * place[a] + i % 6) * n + 6 * place[b] + j % 6] += support->gram[l][i * SUPPORT_BLOCK + j];
      }
    }
  }
}

/* Computes outside[6 b + k], the free part of mode k of body b: the square of its projection onto the free motions */
PetscErrorCode SupportGetFree(const Support *support, PetscReal outside[])
{
  PetscBool *held;
  PetscInt  *place, n = 0, nfree;
  PetscReal *matrix;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(support->nbodies, &held, support->nbodies, &place));
  PetscCall(SupportFindHeld(support, held));
  for (PetscInt b = 0; b < support->nbodies; ++b) place[b] = held[b] ? PETSC_DECIDE : n++;
  n *= 6;
  PetscCall(PetscCalloc1(n * n, &matrix));
  SupportGather(support, place, n, matrix);
  PetscCall(SupportFindNull(n, matrix, &nfree));
  for (PetscInt k = 0; k < 6 * support->nbodies; ++k) {
    outside[k] = 0;
    for (PetscInt m = 0; m < nfree && !held[k / 6]; ++m)
      outside[k] += PetscSqr(matrix[m * n + 6 * place[k / 6] + k % 6]);
  }
  PetscCall(PetscFree(matrix));
  PetscCall(PetscFree2(held, place));
  PetscFunctionReturn(0);
}
