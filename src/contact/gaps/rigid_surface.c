/*
   Gaps of nonmortar vertices against a rigid surface that is given by a formula. The gap of a vertex is its distance
   from the surface, and its derivative is the gradient of the distance. The closest point moves with the rigid body.
   Its displacement is a weighted sum of the displacements of four corners of the cube that represents the body in the
   mesh. The weights sum to 1. Rows of vertices beside a corner of a profile: rigid_corner.c.
*/
#include "gapsimpl.h"

/* Collective. Finds the global numbers and the current coordinates of the four corners of the cube, which may be on any
   ranks */
PetscErrorCode ContactSurfacePlace(MPI_Comm comm, ContactPairData *pair)
{
  const ContactSurface *s = &pair->mortar;
  SceneSurfaceCube      cube;
  PetscReal             found[16];

  PetscFunctionBegin;
  SceneSurfaceGetCube(pair->formula, &cube);
  for (PetscInt i = 0; i < 16; ++i) found[i] = PETSC_MIN_REAL;
  for (PetscInt v = 0; v < 4 * s->nfacets; ++v) {
    for (PetscInt k = 0; k < 4; ++k) {
      PetscReal off = 0.0;

      for (PetscInt c = 0; c < 3; ++c)
        off += PetscAbsReal(s->reference[3 * v + c] - cube.corner[c] - (k ? cube.size * cube.edge[k - 1][c] : 0.0));
      if (off > 1e-6 * cube.size) continue;
      found[4 * k] = (PetscReal)s->node[v];
      PetscCall(PetscArraycpy(&found[4 * k + 1], &s->x[3 * v], 3));
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, found, 16, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt k = 0; k < 4; ++k) {
    pair->corner[k] = (PetscInt)found[4 * k];
    PetscCall(PetscArraycpy(pair->corner_at[k], &found[4 * k + 1], 3));
  }
  PetscFunctionReturn(0);
}

/* The undeformed cube of the surface, and the edges that it has now, divided by its size */
typedef struct {
  SceneSurfaceCube cube;
  PetscReal        edge[3][3];
} ContactSurfaceMotion;

static void SurfaceGetMotion(const ContactPairData *pair, ContactSurfaceMotion *motion)
{
  SceneSurfaceGetCube(pair->formula, &motion->cube);
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt c = 0; c < 3; ++c)
      motion->edge[i][c] = (pair->corner_at[i + 1][c] - pair->corner_at[0][c]) / motion->cube.size;
  }
}

/* Computes the vector v with the components along the edges `to` that r has along the edges `from` */
static void SurfaceTurn(const PetscReal r[3], const PetscReal from[3][3], const PetscReal to[3][3], PetscReal v[3])
{
  for (PetscInt c = 0; c < 3; ++c) {
    v[c] = 0.0;
    for (PetscInt i = 0; i < 3; ++i) v[c] += VectorDot(r, from[i]) * to[i][c];
  }
}

/* Computes where the point x of the moved body was before its motion [length] */
static void SurfacePlaceBefore(const ContactPairData *pair, const ContactSurfaceMotion *motion, const PetscReal x[3],
  PetscReal before[3])
{
  const PetscReal r[3] = {x[0] - pair->corner_at[0][0], x[1] - pair->corner_at[0][1], x[2] - pair->corner_at[0][2]};

  for (PetscInt c = 0; c < 3; ++c) {
    before[c] = motion->cube.corner[c];
    for (PetscInt i = 0; i < 3; ++i) before[c] += VectorDot(r, motion->edge[i]) * motion->cube.edge[i][c];
  }
}

/* Computes the weights of the four corners of the cube at the point x - distance normal */
static void SurfaceWeigh(const ContactPairData *pair, const ContactSurfaceMotion *motion, const PetscReal x[3],
  PetscReal distance, const PetscReal normal[3], PetscReal weight[4])
{
  PetscReal r[3];

  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - pair->corner_at[0][c] - distance * normal[c];
  weight[0] = 1.0;
  for (PetscInt i = 0; i < 3; ++i) {
    weight[i + 1] = VectorDot(r, motion->edge[i]) / motion->cube.size;
    weight[0] -= weight[i + 1];
  }
}

/* Returns the distance of the point x from the moved surface [length]. Computes its gradient, and the weights of the
   four corners at the closest point. */
PetscReal ContactSurfaceDistance(const ContactPairData *pair, const PetscReal x[3], PetscReal gradient[3],
  PetscReal weight[4])
{
  ContactSurfaceMotion motion;
  PetscReal            before[3], turned[3], distance;

  SurfaceGetMotion(pair, &motion);
  SurfacePlaceBefore(pair, &motion, x, before);
  distance = SceneSurfaceDistance(pair->formula, before, turned);
  SurfaceTurn(turned, motion.cube.edge, motion.edge, gradient);
  SurfaceWeigh(pair, &motion, x, distance, gradient, weight);
  return distance;
}

/* Finds the deepest corners of the moved surface below an edge of the nonmortar face, SceneSurfaceFindCorners(), and
   the weights of the cube's corners there. Returns their number. */
PetscInt ContactSurfaceFindCorners(const ContactPairData *pair, const PetscReal ends[6], const PetscReal normals[6],
  SceneSurfaceCorner corner[2], PetscReal weight[2][4])
{
  ContactSurfaceMotion motion;
  PetscReal            before[6], turned[6], y[3];
  PetscInt             n;

  SurfaceGetMotion(pair, &motion);
  for (PetscInt k = 0; k < 6; k += 3) {
    SurfacePlaceBefore(pair, &motion, &ends[k], &before[k]);
    SurfaceTurn(&normals[k], motion.edge, motion.cube.edge, &turned[k]);
  }
  n = SceneSurfaceFindCorners(pair->formula, before, turned, corner);
  for (PetscInt i = 0; i < n; ++i) {
    const PetscReal share     = corner[i].share,
                    normal[3] = {corner[i].normal[0], corner[i].normal[1], corner[i].normal[2]};

    SurfaceTurn(normal, motion.cube.edge, motion.edge, corner[i].normal);
    for (PetscInt c = 0; c < 3; ++c) y[c] = (1.0 - share) * ends[c] + share * ends[3 + c];
    SurfaceWeigh(pair, &motion, y, -corner[i].gap, corner[i].normal, weight[i]);
  }
  return n;
}

/* Sets the normals at n points x opposite to the normals of the pair's rigid surface */
PetscErrorCode ContactSurfaceSetNormals(const ContactPairData *pair, PetscInt n, const PetscReal x[],
  PetscReal normal[])
{
  PetscReal gradient[3], weight[4];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < n; ++i) {
    (void)ContactSurfaceDistance(pair, &x[3 * i], gradient, weight);
    for (PetscInt c = 0; c < 3; ++c) normal[3 * i + c] = -gradient[c];
  }
  PetscFunctionReturn(0);
}

/* Leaves the box as it is, because no facets are exchanged */
static PetscErrorCode ContactBox_RigidSurface(PETSC_UNUSED Contact contact, PETSC_UNUSED PetscInt p,
  PETSC_UNUSED PetscReal box[6])
{
  PetscFunctionBegin;
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactAdd_RigidSurface(Contact contact, PetscInt p, PETSC_UNUSED const ContactCandidates *mortar,
  ContactAssembly *assembly)
{
  ContactPairData   *pair = &contact->pairs[p];
  const ContactRows *rows = &contact->rows;
  const PetscScalar *mass;
  PetscInt           rstart;
  PetscSection       global;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(contact->dm, &global));
  PetscCall(VecGetOwnershipRange(rows->mass, &rstart, NULL));
  PetscCall(VecGetArrayRead(rows->mass, &mass));
  for (PetscInt i = rows->first[p]; i < rows->first[p + 1]; ++i) {
    const PetscInt  row  = rstart + i;
    const PetscReal area = PetscRealPart(mass[i]), less = -area;
    PetscReal       gradient[3], weight[4];
    const PetscReal distance = ContactSurfaceDistance(pair, &rows->x[3 * i], gradient, weight);
    PetscInt        offset;

    if (distance > pair->distance || rows->at_corner[i]) continue;
    for (PetscInt k = 0; k < 4; ++k) weight[k] *= area;
    PetscCall(ContactEntriesAdd(&assembly->coupling, row, 4, pair->corner, weight));
    PetscCall(PetscSectionGetOffset(global, rows->vertex[i], &offset));
    offset /= 3;
    PetscCall(ContactEntriesAdd(&assembly->coupling, row, 1, &offset, &less));
    PetscCall(VecSetValue(assembly->gap, row, area * distance, ADD_VALUES));
  }
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapRigidSurface = {ContactBox_RigidSurface, ContactAdd_RigidSurface};
