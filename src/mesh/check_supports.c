/*
   Checks that every body is held. Each body has six rigid body modes. A prescribed displacement restrains its component
   at the vertices of its face. A contact pair, assumed closed, restrains the relative motion along the normals of its
   nonmortar facets, or along that of a plane mortar face; with friction all relative motion. A mode outside the span of
   these restraints is free, and the stiffness is singular for it.
*/
#include "meshimpl.h"
#include <vector3.h>

#define SUPPORT_BLOCK 12 /* number of modes of the two bodies of a link */

/* A link: the restraints, as rows of a matrix, of one displacement, spring, connector, contact pair or tie */
typedef struct {
  PetscInt body[2]; /* The second body is -1 if the link is between the first body and the ground. */
} SupportLink;

typedef struct {
  DM       dm;
  PetscInt nbodies, n;           /* number of bodies; number of modes, 6 per body */
  PetscReal (*center)[3], *size; /* centre, and half of the largest side, of each body's bounding box [length] */
  PetscInt     nlinks;
  SupportLink *links;
  PetscReal (*gram)[SUPPORT_BLOCK * SUPPORT_BLOCK]; /* for each link, the sum of the outer products of its rows */
  PetscReal row[SUPPORT_BLOCK];                     /* row of the last link that is being computed */
} Support;

/* Collective. Computes the centre, and half of the largest side, of every body's bounding box [length] */
static PetscErrorCode SupportMeasureBodies(Support *support)
{
  MPI_Comm   comm = PetscObjectComm((PetscObject)support->dm);
  PetscInt   cstart, cend;
  PetscReal *bounds; /* for each body, the smallest x, y, z, -x, -y, -z [length] */

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(support->n, &bounds));
  for (PetscInt i = 0; i < support->n; ++i) bounds[i] = PETSC_MAX_REAL;
  PetscCall(DMPlexGetHeightStratum(support->dm, 0, &cstart, &cend));
  for (PetscInt c = cstart; c < cend; ++c) {
    PetscInt  b, n, vertices[8];
    PetscReal x[8][3];

    PetscCall(DMGetLabelValue(support->dm, MESH_BODY_LABEL, c, &b));
    PetscCall(MeshGetCellCorners(support->dm, c, &n, vertices));
    PetscCall(MeshGetVertexCoordinates(support->dm, n, vertices, x));
    for (PetscInt i = 0; i < 3 * n; ++i) {
      bounds[6 * b + i % 3]     = PetscMin(bounds[6 * b + i % 3], x[i / 3][i % 3]);
      bounds[6 * b + 3 + i % 3] = PetscMin(bounds[6 * b + 3 + i % 3], -x[i / 3][i % 3]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, (PetscMPIInt)support->n, MPIU_REAL, MPIU_MIN, comm));
  for (PetscInt b = 0; b < support->nbodies; ++b) {
    support->size[b] = 0;
    for (PetscInt d = 0; d < 3; ++d) {
      support->center[b][d] = (bounds[6 * b + d] - bounds[6 * b + 3 + d]) / 2;
      support->size[b]      = PetscMax(support->size[b], -(bounds[6 * b + d] + bounds[6 * b + 3 + d]) / 2);
    }
  }
  PetscCall(PetscFree(bounds));
  PetscFunctionReturn(0);
}

/* Adds to the row: sign times the component along `direction` of the rigid motion t + r x (x - center)/size of body b
   at the point x, as coefficients of t and r */
static void SupportAddMotion(Support *support, PetscInt b, const PetscReal direction[3], const PetscReal x[3],
  PetscReal sign)
{
  PetscReal arm[3], moment[3], *row = support->row + (b == support->links[support->nlinks - 1].body[0] ? 0 : 6);

  for (PetscInt d = 0; d < 3; ++d) arm[d] = (x[d] - support->center[b][d]) / support->size[b];
  VectorCross(arm, direction, moment);
  for (PetscInt d = 0; d < 3; ++d) {
    row[d] += sign * direction[d];
    row[3 + d] += sign * moment[d];
  }
}

/* Adds the outer product of the row, multiplied by a weight, to the link's matrix, and sets the row to zero */
static PetscErrorCode SupportAddRow(Support *support, PetscReal weight)
{
  PetscReal *gram = support->gram[support->nlinks - 1];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < SUPPORT_BLOCK; ++i) {
    for (PetscInt j = 0; support->row[i] != 0 && j < SUPPORT_BLOCK; ++j)
      gram[i * SUPPORT_BLOCK + j] += weight * support->row[i] * support->row[j];
  }
  PetscCall(PetscArrayzero(support->row, SUPPORT_BLOCK));
  PetscFunctionReturn(0);
}

/* Begins a link between bodies a and b. If b is negative or equal to a, the link is between body a and the ground. */
static void SupportBeginLink(Support *support, PetscInt a, PetscInt b)
{
  support->links[support->nlinks++] = (SupportLink){{a, b == a ? PETSC_DECIDE : b}};
}

/* Collective. Gets the facets and the body of a face, and the number of its facets on all ranks. Rows are divided by
   this number, so that every face has equal weight. */
static PetscErrorCode SupportGetFace(Support *support, const char face[], IS *facets, PetscInt *body, PetscInt *total)
{
  MPI_Comm        comm = PetscObjectComm((PetscObject)support->dm);
  const PetscInt *f, *cells;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(support->dm, face, facets));
  PetscCall(ISGetLocalSize(*facets, &n));
  PetscCall(ISGetIndices(*facets, &f));
  *body = PETSC_DECIDE;
  if (n) {
    PetscCall(DMPlexGetSupport(support->dm, f[0], &cells));
    PetscCall(DMGetLabelValue(support->dm, MESH_BODY_LABEL, cells[0], body));
  }
  PetscCall(ISRestoreIndices(*facets, &f));
  PetscCallMPI(MPI_Allreduce(&n, total, 1, MPIU_INT, MPI_SUM, comm));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, body, 1, MPIU_INT, MPI_MAX, comm));
  PetscFunctionReturn(0);
}

static const PetscReal axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* Gets the vertices of a facet [length] and its unit normal */
static PetscErrorCode SupportGetFacet(DM dm, PetscInt facet, PetscReal x[4][3], PetscReal normal[3])
{
  PetscInt vertices[4];

  PetscFunctionBegin;
  PetscCall(MeshGetFacetVertices(dm, facet, vertices));
  PetscCall(MeshGetVertexCoordinates(dm, 4, vertices, x));
  MeshComputeFacetArea(x, normal);
  VectorScaleToUnit(normal);
  PetscFunctionReturn(0);
}

/*
   Adds restraints of the motion of a body at the vertices of facets. other: the body relative to which it moves;
   negative: the ground. along: the axes of the restrained components; NULL: the component along `normal`, or along the
   normal of each facet if `normal` is NULL. total: number of facets of the face on all ranks
*/
static PetscErrorCode SupportAddFacets(Support *support, IS facets, PetscInt total, PetscInt body, PetscInt other,
  const PetscBool along[3], const PetscReal normal[3])
{
  const PetscInt *f;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal x[4][3], own[3];

    PetscCall(SupportGetFacet(support->dm, f[i], x, own));
    for (PetscInt k = 0; k < 12; ++k) {
      const PetscReal *direction = along ? axes[k % 3] : normal ? normal : own;

      if (along ? !along[k % 3] : k % 3) continue;
      SupportAddMotion(support, body, direction, x[k / 3], 1);
      if (other >= 0) SupportAddMotion(support, other, direction, x[k / 3], -1);
      PetscCall(SupportAddRow(support, 1 / (PetscReal)total));
    }
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a displacement that is prescribed at a point or along an edge */
static PetscErrorCode SupportAddPoint(Support *support, const SceneDisplacement *point)
{
  IS              vertices;
  const PetscInt *v;
  PetscInt        n, total;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceVertices(support->dm, point->face, &vertices));
  PetscCall(ISGetLocalSize(vertices, &n));
  PetscCallMPI(MPI_Allreduce(&n, &total, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)support->dm)));
  PetscCall(ISGetIndices(vertices, &v));
  SupportBeginLink(support, point->body, PETSC_DECIDE);
  for (PetscInt k = 0; k < 3 * n; ++k) {
    PetscReal x[1][3];

    if (!point->fixed[k % 3]) continue;
    PetscCall(MeshGetVertexCoordinates(support->dm, 1, &v[k / 3], x));
    SupportAddMotion(support, point->body, axes[k % 3], x[0], 1);
    PetscCall(SupportAddRow(support, 1 / (PetscReal)total));
  }
  PetscCall(ISRestoreIndices(vertices, &v));
  PetscCall(ISDestroy(&vertices));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a rigid body some of whose motions are released, on the first rank only. *released: whether
   any motion is */
static PetscErrorCode SupportAddRigid(Support *support, const SceneDisplacement *displacement, PetscInt b,
  PetscBool *released)
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  *released = SceneFreesMotion(displacement);
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)support->dm), &rank));
  for (PetscInt m = 0; *released && !rank && m < 6; ++m) {
    if (displacement->released[m]) continue;
    if (m < 3) SupportAddMotion(support, b, axes[m], displacement->center, 1);
    else support->row[m] = 1;
    PetscCall(SupportAddRow(support, 1));
  }
  PetscFunctionReturn(0);
}

/* Adds the restraints of a prescribed displacement */
static PetscErrorCode SupportAddDisplacement(Support *support, const SceneDisplacement *displacement)
{
  IS        facets;
  PetscInt  b, total;
  PetscReal normal[3] = {displacement->normal[0], displacement->normal[1], displacement->normal[2]};
  PetscBool released;

  PetscFunctionBegin;
  if (displacement->at != DISPLACEMENT_FACE) {
    PetscCall(SupportAddPoint(support, displacement));
    PetscFunctionReturn(0);
  }
  PetscCall(SupportGetFace(support, displacement->face, &facets, &b, &total));
  SupportBeginLink(support, b, PETSC_DECIDE);
  PetscCall(SupportAddRigid(support, displacement, b, &released));
  if (displacement->inclined) VectorScaleToUnit(normal);
  if (!released)
    PetscCall(SupportAddFacets(support, facets, total, b, PETSC_DECIDE,
      displacement->inclined ? NULL : displacement->fixed, normal));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Finds whether a face is plane, and its unit normal. A rigid surface without facets knows its normal. Collective. */
static PetscErrorCode SupportFindPlane(Support *support, const SceneBody *body, IS facets, PetscReal normal[3],
  PetscBool *plane)
{
  const PetscReal rounding = 1e-10;
  PetscReal       sums[4];

  PetscFunctionBegin;
  *plane = PETSC_FALSE;
  if (SceneBodyIsSurface(body)) {
    *plane = (PetscBool)(body->shape == SHAPE_RIGID_PLANE);
    PetscCall(PetscArraycpy(normal, &body->own[SURFACE_AXIS], 3));
  } else {
    PetscCall(MeshSumFacetAreas(support->dm, facets, sums));
    *plane = (PetscBool)(VectorNorm(sums) > (1.0 - rounding) * sums[3]);
    PetscCall(PetscArraycpy(normal, sums, 3));
  }
  VectorScaleToUnit(normal);
  PetscFunctionReturn(0);
}

/*
   Adds restraints of the relative motion of two bodies along the normals of the facets of a curved face, at their
   centres. A round body can then rotate about its axis, since the normals at the centres meet the axis.
*/
static PetscErrorCode SupportAddCentres(Support *support, IS facets, PetscInt total, PetscInt body, PetscInt other)
{
  const PetscInt *f;
  PetscInt        n;

  PetscFunctionBegin;
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscReal x[4][3], normal[3], centre[3];

    PetscCall(SupportGetFacet(support->dm, f[i], x, normal));
    for (PetscInt d = 0; d < 3; ++d) centre[d] = 0.25 * (x[0][d] + x[1][d] + x[2][d] + x[3][d]);
    SupportAddMotion(support, body, normal, centre, 1);
    SupportAddMotion(support, other, normal, centre, -1);
    PetscCall(SupportAddRow(support, 1 / (PetscReal)total));
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscFunctionReturn(0);
}

/* Adds the restraint of a contact pair without friction: the relative motion along the normals of its nonmortar facets,
   or along that of a plane mortar face */
static PetscErrorCode SupportAddPair(Support *support, Scene scene, const SceneContactPair *pair)
{
  IS        facets;
  PetscInt  mortar, nonmortar, total;
  PetscReal flat[3];
  PetscBool plane;

  PetscFunctionBegin;
  PetscCall(SupportGetFace(support, pair->mortar, &facets, &mortar, &total));
  PetscCall(SupportFindPlane(support, &scene->bodies[mortar], facets, flat, &plane));
  PetscCall(ISDestroy(&facets));
  PetscCall(SupportGetFace(support, pair->nonmortar, &facets, &nonmortar, &total));
  SupportBeginLink(support, nonmortar, mortar);
  if (scene->weak_springs && !plane) PetscCall(SupportAddCentres(support, facets, total, nonmortar, mortar));
  else PetscCall(SupportAddFacets(support, facets, total, nonmortar, mortar, NULL, plane ? flat : NULL));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Adds the restraint of the relative motion along the given axes at the vertices of the nonmortar face. It represents a
   tie, springs between faces, or a contact pair with friction. */
static PetscErrorCode SupportAddJoint(Support *support, const char mortar_face[], const char nonmortar_face[],
  const PetscBool along[3])
{
  IS       facets;
  PetscInt mortar, nonmortar, total;

  PetscFunctionBegin;
  PetscCall(SupportGetFace(support, mortar_face, &facets, &mortar, &total));
  PetscCall(ISDestroy(&facets));
  PetscCall(SupportGetFace(support, nonmortar_face, &facets, &nonmortar, &total));
  SupportBeginLink(support, nonmortar, mortar);
  PetscCall(SupportAddFacets(support, facets, total, nonmortar, mortar, along, NULL));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a cyclic symmetry, on the first rank: the only free motions of the body are the translation
   along the axis and the rotation about it */
static PetscErrorCode SupportAddCyclic(Support *support, const SceneCyclic *cut)
{
  IS          facets;
  PetscInt    body, total, least = 0;
  PetscMPIInt rank;
  PetscReal   axis[3] = {cut->axis[0], cut->axis[1], cut->axis[2]}, across[2][3];

  PetscFunctionBegin;
  PetscCall(SupportGetFace(support, cut->from, &facets, &body, &total));
  PetscCall(ISDestroy(&facets));
  SupportBeginLink(support, body, PETSC_DECIDE);
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)support->dm), &rank));
  if (rank) PetscFunctionReturn(0);
  (void)VectorScaleToUnit(axis);
  for (PetscInt d = 1; d < 3; ++d) least = PetscAbsReal(axis[d]) < PetscAbsReal(axis[least]) ? d : least;
  for (PetscInt d = 0; d < 3; ++d) across[0][d] = (d == least ? 1 : 0) - axis[least] * axis[d];
  (void)VectorScaleToUnit(across[0]);
  VectorCross(axis, across[0], across[1]);
  for (PetscInt k = 0; k < 2; ++k) {
    SupportAddMotion(support, body, across[k], cut->center, 1);
    PetscCall(SupportAddRow(support, 1));
    PetscCall(PetscArraycpy(support->row + 3, across[k], 3));
    PetscCall(SupportAddRow(support, 1));
  }
  PetscFunctionReturn(0);
}

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

/* Collective. Computes outside[6 b + k], the free part of mode k of body b. It is 0 for bodies that are known to be
   held. */
static PetscErrorCode SupportGetFree(Support *support, PetscReal outside[])
{
  PetscBool *restrained;
  PetscInt  *place, m = 0;
  PetscReal *gram, *free_part;

  PetscFunctionBegin;
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, support->gram, (PetscMPIInt)(support->nlinks * SUPPORT_BLOCK * SUPPORT_BLOCK),
      MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)support->dm)));
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

/* Adds the restraints of a spring between two points, on the first rank only */
static PetscErrorCode SupportAddConnector(Support *support, const SceneConnector *connector)
{
  PetscMPIInt rank;

  PetscFunctionBegin;
  SupportBeginLink(support, connector->body, connector->to);
  PetscCallMPI(MPI_Comm_rank(PetscObjectComm((PetscObject)support->dm), &rank));
  for (int m = 0; !rank && m < (connector->axial ? 1 : 3); ++m) {
    PetscReal along[3] = {m == 0, m == 1, m == 2};

    if (!connector->axial && connector->value[m] == 0.0) continue;
    for (int d = 0; d < 3 && connector->axial; ++d) along[d] = connector->point[1][d] - connector->point[0][d];
    (void)VectorScaleToUnit(along);
    SupportAddMotion(support, connector->body, along, connector->point[0], 1);
    if (connector->to >= 0) SupportAddMotion(support, connector->to, along, connector->point[1], -1);
    PetscCall(SupportAddRow(support, 1));
  }
  PetscFunctionReturn(0);
}

/* Selects a free mode of a body for the message: a mode that is entirely free; otherwise a rotation, about an axis that
   is then not known; otherwise a translation. Returns PETSC_DECIDE if no mode is free. */
static PetscInt SupportFindFreest(const PetscReal outside[6])
{
  PetscReal freest = 0;
  PetscInt  mode   = PETSC_DECIDE;

  for (PetscInt k = 0; k < 6; ++k) {
    const PetscReal rank = outside[k] > 1 - 1e-6 ? 2 : outside[k] + (k < 3 ? 0 : 1);

    if (outside[k] <= 2e-6 || rank <= freest + 1e-6) continue;
    freest = rank;
    mode   = k;
  }
  return mode;
}

/* Collective. Reports the first body that has a free mode */
static PetscErrorCode SupportRaise(const Support *support, Scene scene, const PetscReal outside[])
{
  static const char *const modes[] = {"a translation along x", "a translation along y", "a translation along z",
    "a rotation about x", "a rotation about y", "a rotation about z"};
  MPI_Comm                 comm    = PetscObjectComm((PetscObject)support->dm);

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const PetscInt mode  = SupportFindFreest(outside + 6 * b);
    PetscInt       nfree = 0;

    for (PetscInt k = 0; k < 6; ++k) nfree += outside[6 * b + k] > 1 - 1e-6;
    PetscCheck(nfree < 6, comm, PETSC_ERR_USER_INPUT,
      "nothing holds body \"%s\": prescribe a displacement on one of its faces", scene->bodies[b].name);
    PetscCheck(mode < 0, comm, PETSC_ERR_USER_INPUT,
      "body \"%s\" is not held against %s: prescribe a displacement, or add springs, a tie or a contact pair",
      scene->bodies[b].name, modes[mode]);
  }
  PetscFunctionReturn(0);
}

/* Collective. Checks that a face has facets. A surface of a Gmsh file has none if it is not on the boundary of the
   body. */
static PetscErrorCode SupportCheckFacets(DM dm, const char what[], const char owner[], const char face[])
{
  IS       facets;
  PetscInt n, total;

  PetscFunctionBegin;
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISDestroy(&facets));
  PetscCallMPI(MPI_Allreduce(&n, &total, 1, MPIU_INT, MPI_SUM, PetscObjectComm((PetscObject)dm)));
  PetscCheck(total, PetscObjectComm((PetscObject)dm), PETSC_ERR_USER_INPUT,
    "%s \"%s\": the face \"%s\" has no facets, because that surface of the mesh file is not on the boundary of the "
    "body",
    what, owner, face);
  PetscFunctionReturn(0);
}

/* Collective. Finds the bodies with free modes. The first of them is reported as an error, unless the scene has weak
   springs. unsupported: whether each body has a free mode; NULL if not needed */
static PetscErrorCode SupportFindUnsupported(DM dm, Scene scene, PetscBool unsupported[])
{
  static const PetscBool all[3] = {PETSC_TRUE, PETSC_TRUE, PETSC_TRUE};
  const PetscInt         nlinks =
    scene->ndisplacements + scene->nsprings + scene->nconnectors + scene->npairs + scene->nties + scene->ncyclic;
  Support    support = {.dm = dm, .nbodies = scene->nbodies, .n = 6 * scene->nbodies};
  PetscReal *outside;

  PetscFunctionBegin;
  PetscCall(PetscCalloc5(scene->nbodies, &support.center, scene->nbodies, &support.size, nlinks, &support.links, nlinks,
    &support.gram, support.n, &outside));
  PetscCall(SupportMeasureBodies(&support));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    PetscCall(SupportAddDisplacement(&support, &scene->displacements[d]));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    const SceneSpring *spring = &scene->springs[s];

    if (spring->to)
      PetscCall(SupportAddJoint(&support, spring->to, spring->face,
        (PetscBool[3]){spring->value[0] > 0, spring->value[1] > 0, spring->value[2] > 0}));
    else
      PetscCall(SupportAddDisplacement(&support,
        &(SceneDisplacement){.face = spring->face,
          .fixed                   = {spring->value[0] > 0, spring->value[1] > 0, spring->value[2] > 0}}));
  }
  for (PetscInt c = 0; c < scene->nconnectors; ++c) PetscCall(SupportAddConnector(&support, &scene->connectors[c]));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *pair = &scene->pairs[p];

    if (pair->self) continue;
    if (SceneContactPairHasFriction(pair)) PetscCall(SupportAddJoint(&support, pair->mortar, pair->nonmortar, all));
    else PetscCall(SupportAddPair(&support, scene, pair));
  }
  for (PetscInt t = 0; t < scene->nties; ++t)
    PetscCall(SupportAddJoint(&support, scene->ties[t].mortar, scene->ties[t].nonmortar, all));
  for (PetscInt k = 0; k < scene->ncyclic; ++k) PetscCall(SupportAddCyclic(&support, &scene->cyclic[k]));
  PetscCall(SupportGetFree(&support, outside));
  for (PetscInt k = 0; unsupported && k < support.n; ++k)
    unsupported[k / 6] = (PetscBool)(unsupported[k / 6] || outside[k] > 2e-6);
  if (!scene->weak_springs) PetscCall(SupportRaise(&support, scene, outside));
  PetscCall(PetscFree5(support.center, support.size, support.links, support.gram, outside));
  PetscFunctionReturn(0);
}

/*@
  MeshGetUnsupported - Finds the bodies that have free rigid body motions

  Collective

  Input Parameters:
+ dm    - the mesh, created by `MeshCreate()`
- scene - the scene

  Output Parameter:
. unsupported - one value per body: whether any of its rigid body motions is free

  Level: intermediate

.seealso: `MeshCheckScene()`
@*/
PetscErrorCode MeshGetUnsupported(DM dm, Scene scene, PetscBool unsupported[])
{
  PetscFunctionBegin;
  PetscCall(PetscArrayzero(unsupported, scene->nbodies));
  PetscCall(SupportFindUnsupported(dm, scene, unsupported));
  PetscFunctionReturn(0);
}

/*@
  MeshCheckScene - Checks that the faces that a scene names have facets, and that every body is supported

  Collective

  Input Parameters:
+ dm    - the mesh, created by `MeshCreate()`
- scene - the scene

  Level: intermediate

  Notes:
  A body is supported if none of its rigid body motions is free. Contact pairs are assumed closed.

.seealso: `MeshCreate()`, `SceneLoad()`
@*/
PetscErrorCode MeshCheckScene(DM dm, Scene scene)
{
  PetscFunctionBegin;
  PetscCall(MeshLabelPoints(dm, scene));
  for (PetscInt d = 0; d < scene->ndisplacements; ++d) {
    if (scene->displacements[d].at == DISPLACEMENT_FACE)
      PetscCall(SupportCheckFacets(dm, "Displacement", scene->displacements[d].name, scene->displacements[d].face));
  }
  for (PetscInt p = 0; p < scene->npressures; ++p)
    PetscCall(SupportCheckFacets(dm, "Pressure", scene->pressures[p].name, scene->pressures[p].face));
  for (PetscInt t = 0; t < scene->ntractions; ++t)
    PetscCall(SupportCheckFacets(dm, "Load", scene->tractions[t].name, scene->tractions[t].face));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    PetscCall(SupportCheckFacets(dm, "Spring", scene->springs[s].name, scene->springs[s].face));
    if (scene->springs[s].to) PetscCall(SupportCheckFacets(dm, "Spring", scene->springs[s].name, scene->springs[s].to));
  }
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    PetscCall(SupportCheckFacets(dm, "Contact pair", scene->pairs[p].name, scene->pairs[p].mortar));
    PetscCall(SupportCheckFacets(dm, "Contact pair", scene->pairs[p].name, scene->pairs[p].nonmortar));
  }
  for (PetscInt t = 0; t < scene->nties; ++t) {
    PetscCall(SupportCheckFacets(dm, "Tie", scene->ties[t].name, scene->ties[t].mortar));
    PetscCall(SupportCheckFacets(dm, "Tie", scene->ties[t].name, scene->ties[t].nonmortar));
  }
  for (PetscInt k = 0; k < scene->ncyclic; ++k) {
    PetscCall(SupportCheckFacets(dm, "Cyclic symmetry", scene->cyclic[k].name, scene->cyclic[k].from));
    PetscCall(SupportCheckFacets(dm, "Cyclic symmetry", scene->cyclic[k].name, scene->cyclic[k].to));
  }
  if (!SceneIsDynamic(scene)) PetscCall(SupportFindUnsupported(dm, scene, NULL));
  PetscFunctionReturn(0);
}
