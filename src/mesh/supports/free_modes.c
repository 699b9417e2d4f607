/* Modes of the bodies outside the span of the restraints */
#include "supportsimpl.h"

/* Makes a row of n numbers orthogonal to a unit vector */
static void SupportOrthogonalize(PetscInt n, const PetscReal unit[], PetscReal row[])
{
  PetscReal dot = 0;

  for (PetscInt i = 0; i < n; ++i) dot += unit[i] * row[i];
  for (PetscInt i = 0; i < n; ++i) row[i] -= dot * unit[i];
}

/* Adds the 6 x 6 diagonal block of a link's first (end = 0) or second body (end = 1) to `block` */
static void SupportAddBlock(const Support *support, PetscInt link, PetscInt end, PetscReal block[36])
{
  for (PetscInt k = 0; k < 36; ++k)
    block[k] += support->gram[link][(6 * end + k / 6) * SUPPORT_BLOCK + 6 * end + k % 6];
}

/* Returns whether a positive semidefinite 6 x 6 matrix has full rank. It counts the pivots of the Cholesky
   factorization. */
static PetscBool SupportIsFull(const PetscReal block[36])
{
  PetscReal A[36], largest = 0;
  PetscBool done[6] = {PETSC_FALSE};

  for (PetscInt k = 0; k < 36; ++k) A[k] = block[k];
  for (PetscInt k = 0; k < 6; ++k) largest = PetscMax(largest, A[7 * k]);
  for (PetscInt rank = 0; rank < 6; ++rank) {
    PetscInt p = -1;

    for (PetscInt k = 0; k < 6; ++k) {
      if (!done[k] && (p < 0 || A[7 * k] > A[7 * p])) p = k;
    }
    if (!(A[7 * p] > 1e-6 * largest)) return PETSC_FALSE;
    done[p] = PETSC_TRUE;
    for (PetscInt i = 0; i < 6; ++i) {
      const PetscReal factor = A[6 * i + p] / A[7 * p];

      for (PetscInt j = 0; !done[i] && j < 6; ++j) A[6 * i + j] -= factor * A[6 * p + j];
    }
  }
  return PETSC_TRUE;
}

/* Lists the links of each body: those of body b are links[start[b]] to links[start[b + 1] - 1] */
static PetscErrorCode SupportSortLinks(const Support *support, PetscInt **start, PetscInt **links)
{
  PetscFunctionBegin;
  PetscCall(PetscCalloc1(support->nbodies + 1, start));
  PetscCall(PetscMalloc1(2 * support->nlinks, links));
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    for (PetscInt end = 0; end < 2; ++end) {
      if (support->links[l].body[end] >= 0) ++(*start)[support->links[l].body[end]];
    }
  }
  for (PetscInt b = 0, sum = 0; b <= support->nbodies; ++b) {
    sum += (*start)[b];
    (*start)[b] = sum;
  }
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    for (PetscInt end = 0; end < 2; ++end) {
      if (support->links[l].body[end] >= 0) (*links)[--(*start)[support->links[l].body[end]]] = l;
    }
  }
  PetscFunctionReturn(0);
}

/* Finds the bodies that are held by the ground, then bodies that are held by held bodies, and so on. For most
   assemblies the cost is proportional to the number of links. */
static PetscErrorCode SupportFindRestrained(const Support *support, PetscBool restrained[])
{
  PetscInt *start, *links, *queue, n = 0;
  PetscReal(*ground)[36];

  PetscFunctionBegin;
  PetscCall(SupportSortLinks(support, &start, &links));
  PetscCall(PetscMalloc1(support->nbodies, &queue));
  PetscCall(PetscCalloc1(support->nbodies, &ground));
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    if (support->links[l].body[1] < 0) SupportAddBlock(support, l, 0, ground[support->links[l].body[0]]);
  }
  for (PetscInt b = 0; b < support->nbodies; ++b) {
    restrained[b] = SupportIsFull(ground[b]);
    if (restrained[b]) queue[n++] = b;
  }
  for (PetscInt k = 0; k < n; ++k) {
    for (PetscInt i = start[queue[k]]; i < start[queue[k] + 1]; ++i) {
      const SupportLink *link = &support->links[links[i]];
      const PetscInt     end = link->body[0] == queue[k] ? 1 : 0, other = link->body[end];

      if (other < 0 || restrained[other]) continue;
      SupportAddBlock(support, links[i], end, ground[other]);
      restrained[other] = SupportIsFull(ground[other]);
      if (restrained[other]) queue[n++] = other;
    }
  }
  PetscCall(PetscFree(ground));
  PetscCall(PetscFree(queue));
  PetscCall(PetscFree(links));
  PetscCall(PetscFree(start));
  PetscFunctionReturn(0);
}

/* Assembles the matrix of the bodies that are not yet known to be held. place[b]: position of body b in the matrix; -1
   if it is left out */
static void SupportGather(const Support *support, const PetscInt place[], PetscInt n, PetscReal gram[])
{
  for (PetscInt l = 0; l < support->nlinks; ++l) {
    for (PetscInt i = 0; i < SUPPORT_BLOCK; ++i) {
      const PetscInt a = support->links[l].body[i / 6];

      for (PetscInt j = 0; a >= 0 && place[a] >= 0 && j < SUPPORT_BLOCK; ++j) {
        const PetscInt b = support->links[l].body[j / 6];

        if (b >= 0 && place[b] >= 0)
          gram[(6 * place[a] + i % 6) * n + 6 * place[b] + j % 6] += support->gram[l][i * SUPPORT_BLOCK + j];
      }
    }
  }
}

/* Computes outside[k], the free part of each mode: 1 minus the squared length of its projection onto the span of the
   matrix's rows. Uses Gram-Schmidt orthogonalization with pivoting. The basis replaces the first rows of `gram`. */
static void SupportProject(PetscInt n, PetscReal gram[], PetscReal outside[])
{
  PetscReal first = 0;

  for (PetscInt k = 0; k < n; ++k) outside[k] = 1;
  for (PetscInt rank = 0; rank < n; ++rank) {
    PetscReal *pivot = gram + rank * n, largest = -1;
    PetscInt   best = rank;

    for (PetscInt r = rank; r < n; ++r) {
      PetscReal norm = 0;

      for (PetscInt i = 0; i < n; ++i) norm += PetscSqr(gram[r * n + i]);
      if (norm > largest) {
        best    = r;
        largest = norm;
      }
    }
    for (PetscInt i = 0; best != rank && i < n; ++i) {
      const PetscReal swap = pivot[i];

      pivot[i]           = gram[best * n + i];
      gram[best * n + i] = swap;
    }
    if (!rank) first = PetscSqrtReal(largest);
    /* The row is orthogonalized once more, so that it is orthogonal up to rounding. */
    for (PetscInt q = 0; q < rank; ++q) SupportOrthogonalize(n, gram + q * n, pivot);
    largest = 0;
    for (PetscInt i = 0; i < n; ++i) largest += PetscSqr(pivot[i]);
    if (PetscSqrtReal(largest) <= 1e-9 * first) break;
    for (PetscInt i = 0; i < n; ++i) {
      pivot[i] /= PetscSqrtReal(largest);
      outside[i] -= PetscSqr(pivot[i]);
    }
    for (PetscInt r = rank + 1; r < n; ++r) SupportOrthogonalize(n, pivot, gram + r * n);
  }
}

/* Sums the matrices of the links over the ranks */
PetscErrorCode SupportSum(Support *support)
{
  MPI_Comm comm = PetscObjectComm((PetscObject)support->dm);

  PetscFunctionBegin;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, support->gram,
    (PetscMPIInt)(support->nlinks * SUPPORT_BLOCK * SUPPORT_BLOCK), MPIU_REAL, MPIU_SUM, comm));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, support->motion, (PetscMPIInt)(support->nlinks * 36), MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/* The free part is 0 for bodies that are known to be held. */
PetscErrorCode SupportGetFree(const Support *support, PetscReal outside[])
{
  PetscBool *restrained;
  PetscInt  *place, m = 0;
  PetscReal *gram, *free_part;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(support->nbodies, &restrained, support->nbodies, &place));
  PetscCall(SupportFindRestrained(support, restrained));
  for (PetscInt b = 0; b < support->nbodies; ++b) place[b] = restrained[b] ? PETSC_DECIDE : m++;
  PetscCall(PetscCalloc2(36 * m * m, &gram, 6 * m, &free_part));
  SupportGather(support, place, 6 * m, gram);
  SupportProject(6 * m, gram, free_part);
  for (PetscInt k = 0; k < support->n; ++k) outside[k] = restrained[k / 6] ? 0 : free_part[6 * place[k / 6] + k % 6];
  PetscCall(PetscFree2(gram, free_part));
  PetscCall(PetscFree2(restrained, place));
  PetscFunctionReturn(0);
}
