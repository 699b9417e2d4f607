/*
   Gaps of nonmortar vertices against a rigid surface that is given by a formula. The gap of a vertex is its distance
   from the surface, and its derivative is the gradient of the distance. The closest point moves with the rigid body.
   Its displacement is a weighted sum of the displacements of four corners of the cube that represents the body in the
   mesh. The weights sum to 1.
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

/* Returns the distance of the point x from the moved surface [length]. Computes its gradient, and the weights of the
   four corners at the closest point. */
PetscReal ContactSurfaceDistance(const ContactPairData *pair, const PetscReal x[3], PetscReal gradient[3],
  PetscReal weight[4])
{
  SceneSurfaceCube cube;
  PetscReal        edge[3][3], r[3], before[3], turned[3], distance;

  SceneSurfaceGetCube(pair->formula, &cube);
  for (PetscInt c = 0; c < 3; ++c) {
    r[c]      = x[c] - pair->corner_at[0][c];
    before[c] = cube.corner[c];
    for (PetscInt i = 0; i < 3; ++i) edge[i][c] = (pair->corner_at[i + 1][c] - pair->corner_at[0][c]) / cube.size;
  }
  for (PetscInt i = 0; i < 3; ++i) {
    for (PetscInt c = 0; c < 3; ++c) before[c] += VectorDot(r, edge[i]) * cube.edge[i][c];
  }
  distance = SceneSurfaceDistance(pair->formula, before, turned);
  for (PetscInt c = 0; c < 3; ++c) {
    gradient[c] = 0.0;
    for (PetscInt i = 0; i < 3; ++i) gradient[c] += VectorDot(turned, cube.edge[i]) * edge[i][c];
  }
  for (PetscInt c = 0; c < 3; ++c) r[c] -= distance * gradient[c];
  weight[0] = 1.0;
  for (PetscInt i = 0; i < 3; ++i) {
    weight[i + 1] = VectorDot(r, edge[i]) / cube.size;
    weight[0] -= weight[i + 1];
  }
  return distance;
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

    if (distance > pair->distance) continue;
    for (PetscInt k = 0; k < 4; ++k) weight[k] *= area;
    PetscCall(ContactAssemblyAdd(assembly, row, 4, pair->corner, weight, &rows->normal[3 * i]));
    PetscCall(PetscSectionGetOffset(global, rows->vertex[i], &offset));
    offset /= 3;
    PetscCall(ContactAssemblyAdd(assembly, row, 1, &offset, &less, &rows->normal[3 * i]));
    PetscCall(VecSetValue(assembly->gap, row, area * distance, ADD_VALUES));
    ++pair->nfacing;
  }
  PetscCall(VecRestoreArrayRead(rows->mass, &mass));
  PetscFunctionReturn(0);
}

const ContactGapOps ContactGapRigidSurface = {ContactBox_RigidSurface, ContactAdd_RigidSurface};
