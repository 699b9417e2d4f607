/*
   The links that hold the bodies of a scene. A prescribed displacement restrains its component at the vertices of its
   face. A contact pair, assumed closed, restrains the relative motion along the normals of its nonmortar facets, or
   along that of a plane mortar face; with friction all relative motion.
*/
#include "supportsimpl.h"
#include <vector3.h>

static const PetscReal axes[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

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
  SupportBeginLink(support, point->body, PETSC_DECIDE, SUPPORT_FIXED);
  for (PetscInt k = 0; k < 3 * n; ++k) {
    PetscReal x[1][3];

    if (!point->fixed[k % 3]) continue;
    PetscCall(SupportGetPlaces(support, 1, &v[k / 3], x));
    SupportAddMotion(support, point->body, axes[k % 3], x[0], 1);
    PetscCall(SupportAddRow(support, 1 / (PetscReal)total));
  }
  PetscCall(ISRestoreIndices(vertices, &v));
  PetscCall(ISDestroy(&vertices));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a rigid body some of whose motions are released. *released: whether any motion is */
static PetscErrorCode SupportAddRigid(Support *support, const SceneDisplacement *displacement, PetscInt b,
  PetscBool *released)
{
  PetscFunctionBegin;
  *released = SceneFreesMotion(displacement);
  for (PetscInt m = 0; *released && m < 6; ++m) {
    if (displacement->released[m]) continue;
    if (m < 3) SupportAddMotion(support, b, axes[m], displacement->center, 1);
    else support->row[m] = 1;
    PetscCall(SupportAddRow(support, support->once));
  }
  PetscFunctionReturn(0);
}

/* Adds the restraints of a prescribed displacement */
static PetscErrorCode SupportAddDisplacement(Support *support, const SceneDisplacement *displacement)
{
  SupportFace face;
  PetscReal   normal[3] = {displacement->normal[0], displacement->normal[1], displacement->normal[2]};
  PetscBool   released;

  PetscFunctionBegin;
  if (displacement->at != DISPLACEMENT_FACE) {
    PetscCall(SupportAddPoint(support, displacement));
    PetscFunctionReturn(0);
  }
  PetscCall(SupportGetFace(support, displacement->face, &face));
  SupportBeginLink(support, face.body, PETSC_DECIDE, SUPPORT_FIXED);
  PetscCall(SupportAddRigid(support, displacement, face.body, &released));
  if (displacement->inclined) VectorScaleToUnit(normal);
  if (!released)
    PetscCall(
      SupportAddFacets(support, &face, PETSC_DECIDE, displacement->inclined ? NULL : displacement->fixed, normal));
  PetscCall(SupportDestroyFace(&face));
  PetscFunctionReturn(0);
}

/* Finds whether a face is plane, and its unit normal. A rigid surface without facets knows its normal. Collective. */
static PetscErrorCode SupportFindPlane(Support *support, const SceneBody *body, IS facets, PetscReal normal[3],
  PetscBool *plane)
{
  PetscReal sums[4];

  PetscFunctionBegin;
  *plane = PETSC_FALSE;
  if (SceneBodyIsSurface(body)) {
    *plane = (PetscBool)(body->shape == SHAPE_RIGID_PLANE);
    PetscCall(PetscArraycpy(normal, &body->own[SURFACE_AXIS], 3));
  } else {
    PetscCall(MeshSumFacetAreas(support->dm, facets, sums));
    *plane = MeshFacetsArePlane(sums);
    PetscCall(PetscArraycpy(normal, sums, 3));
  }
  VectorScaleToUnit(normal);
  PetscFunctionReturn(0);
}

/* Adds the restraint of the motion of the nonmortar face relative to the mortar face, or to the ground if `mortar` is
   NULL. along: its components; those of a sliding pair are along the normals of the nonmortar facets, or along that of
   a plane mortar face */
static PetscErrorCode SupportAddFaces(Support *support, Scene scene, SupportKind kind, const char mortar[],
  const char nonmortar[], const PetscBool along[3])
{
  SupportFace face, other = {.body = PETSC_DECIDE};
  PetscReal   flat[3];
  PetscBool   plane = PETSC_FALSE;

  PetscFunctionBegin;
  if (mortar) PetscCall(SupportGetFace(support, mortar, &other));
  PetscCall(SupportGetFace(support, nonmortar, &face));
  SupportBeginLink(support, face.body, other.body, kind);
  if (kind == SUPPORT_SLIDING) {
    PetscCall(SupportFindPlane(support, &scene->bodies[other.body], other.facets, flat, &plane));
    PetscCall(SupportMeasureFace(support, &other));
    PetscCall(SupportMeasureFace(support, &face));
    along = NULL;
  }
  PetscCall(SupportAddFacets(support, &face, other.body, along, plane ? flat : NULL));
  if (mortar) PetscCall(SupportDestroyFace(&other));
  PetscCall(SupportDestroyFace(&face));
  PetscFunctionReturn(0);
}

/* Adds the restraints of a cyclic symmetry: the only free motions of the body are the translation
   along the axis and the rotation about it */
static PetscErrorCode SupportAddCyclic(Support *support, const SceneCyclic *cut)
{
  SupportFace face;
  PetscInt    least   = 0;
  PetscReal   axis[3] = {cut->axis[0], cut->axis[1], cut->axis[2]}, across[2][3];

  PetscFunctionBegin;
  PetscCall(SupportGetFace(support, cut->from, &face));
  PetscCall(SupportDestroyFace(&face));
  SupportBeginLink(support, face.body, PETSC_DECIDE, SUPPORT_FIXED);
  (void)VectorScaleToUnit(axis);
  for (PetscInt d = 1; d < 3; ++d) least = PetscAbsReal(axis[d]) < PetscAbsReal(axis[least]) ? d : least;
  for (PetscInt d = 0; d < 3; ++d) across[0][d] = (d == least ? 1 : 0) - axis[least] * axis[d];
  (void)VectorScaleToUnit(across[0]);
  VectorCross(axis, across[0], across[1]);
  for (PetscInt k = 0; k < 2; ++k) {
    SupportAddMotion(support, face.body, across[k], cut->center, 1);
    PetscCall(SupportAddRow(support, support->once));
    PetscCall(PetscArraycpy(support->row + 3, across[k], 3));
    PetscCall(SupportAddRow(support, support->once));
  }
  PetscFunctionReturn(0);
}

/* Adds the restraints of a spring between two points */
static PetscErrorCode SupportAddConnector(Support *support, const SceneConnector *connector)
{
  PetscFunctionBegin;
  SupportBeginLink(support, connector->body, connector->to, SUPPORT_FIXED);
  for (int m = 0; m < (connector->axial ? 1 : 3); ++m) {
    PetscReal along[3] = {m == 0, m == 1, m == 2};

    if (!connector->axial && connector->value[m] == 0.0) continue;
    for (int d = 0; d < 3 && connector->axial; ++d) along[d] = connector->point[1][d] - connector->point[0][d];
    (void)VectorScaleToUnit(along);
    SupportAddMotion(support, connector->body, along, connector->point[0], 1);
    if (connector->to >= 0) SupportAddMotion(support, connector->to, along, connector->point[1], -1);
    PetscCall(SupportAddRow(support, support->once));
  }
  PetscFunctionReturn(0);
}

/* Adds the restraint of an equation between displacements of points */
static PetscErrorCode SupportAddEquation(Support *support, const SceneEquation *equation)
{
  PetscFunctionBegin;
  SupportBeginLink(support, equation->body, equation->to, SUPPORT_FIXED);
  SupportAddMotion(support, equation->body, equation->direction[0], equation->point[0], 1);
  if (equation->to >= 0) SupportAddMotion(support, equation->to, equation->direction[1], equation->point[1], 1);
  PetscCall(SupportAddRow(support, support->once));
  PetscFunctionReturn(0);
}

/* Adds the links of everything in the scene that holds bodies, up to the kind `most` */
static PetscErrorCode SupportAddScene(Support *support, Scene scene, SupportKind most)
{
  static const PetscBool all[3] = {PETSC_TRUE, PETSC_TRUE, PETSC_TRUE};

  PetscFunctionBegin;
  for (PetscInt d = 0; d < scene->ndisplacements; ++d)
    PetscCall(SupportAddDisplacement(support, &scene->displacements[d]));
  for (PetscInt s = 0; s < scene->nsprings; ++s) {
    const SceneSpring *spring   = &scene->springs[s];
    const PetscBool    along[3] = {spring->value[0] > 0, spring->value[1] > 0, spring->value[2] > 0};

    PetscCall(SupportAddFaces(support, scene, SUPPORT_FIXED, spring->to, spring->face, along));
  }
  for (PetscInt c = 0; c < scene->nconnectors; ++c) PetscCall(SupportAddConnector(support, &scene->connectors[c]));
  for (PetscInt k = 0; k < scene->nequations; ++k) PetscCall(SupportAddEquation(support, &scene->equations[k]));
  for (PetscInt p = 0; p < scene->npairs; ++p) {
    const SceneContactPair *pair = &scene->pairs[p];
    const SupportKind       kind = SceneContactPairHasFriction(pair) ? SUPPORT_FRICTION : SUPPORT_SLIDING;

    if (!pair->self && kind <= most)
      PetscCall(SupportAddFaces(support, scene, kind, pair->mortar, pair->nonmortar, all));
  }
  for (PetscInt t = 0; t < scene->nties; ++t)
    PetscCall(SupportAddFaces(support, scene, SUPPORT_FIXED, scene->ties[t].mortar, scene->ties[t].nonmortar, all));
  for (PetscInt k = 0; k < scene->ncyclic; ++k) PetscCall(SupportAddCyclic(support, &scene->cyclic[k]));
  PetscFunctionReturn(0);
}

PetscErrorCode SupportCreate(DM dm, Scene scene, Vec u, SupportKind most, Support *support)
{
  const MPI_Comm comm   = PetscObjectComm((PetscObject)dm);
  const PetscInt nlinks = scene->ndisplacements + scene->nsprings + scene->nconnectors + scene->nequations +
                          scene->npairs + scene->nties + scene->ncyclic;
  PetscMPIInt rank;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  *support = (Support){.dm = dm, .nbodies = scene->nbodies, .once = rank ? 0 : 1};
  if (u) {
    PetscCall(DMCreateLocalVector(dm, &support->u));
    PetscCall(DMGlobalToLocal(dm, u, INSERT_VALUES, support->u));
  }
  PetscCall(PetscCalloc6(scene->nbodies, &support->center, scene->nbodies, &support->size, nlinks, &support->links,
    nlinks, &support->gram, scene->nbodies, &support->contact, scene->nbodies, &support->outside));
  PetscCall(SupportMeasureBodies(support, u));
  PetscCall(SupportAddScene(support, scene, most));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, support->gram,
    (PetscMPIInt)(support->nlinks * SUPPORT_BLOCK * SUPPORT_BLOCK), MPIU_REAL, MPIU_SUM, comm));
  PetscCallMPI(
    MPI_Allreduce(MPI_IN_PLACE, support->contact, (PetscMPIInt)(support->nbodies * 72), MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

PetscErrorCode SupportDestroy(Support *support)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&support->u));
  PetscCall(
    PetscFree6(support->center, support->size, support->links, support->gram, support->contact, support->outside));
  PetscFunctionReturn(0);
}
