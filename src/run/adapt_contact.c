/*
   Chooses cells at the contact in the last load step. Stress recovery includes neither the error of faceted curved
   surfaces nor that of the edge of contact.
*/
#include "runimpl.h"
#include <vector3.h>
#include "src/state/contact_state.h"
#include "src/state/run.h"

/* Values of each vertex of a face, in a vector with three values per vertex */
typedef enum {
  VERTEX_CLOSED, /* 1 if the pair has pressure at the vertex, otherwise 0 */
  VERTEX_ANGLE,  /* sum of the angles of the facets at the vertex [rad]; it is 2 pi inside a plane face */
  VERTEX_HANGS   /* 1 for hanging vertices, 0 for other vertices */
} VertexFact;

#define ADAPT_INSIDE \
  (1.9 * PETSC_PI) /* an angle around a vertex of at least this value means that the vertex is not
                                         on the border of its face [rad] */

static PetscErrorCode AdaptSetClosed(DM dm, ContactState *solved, PetscInt pair, Vec facts)
{
  PetscSection global;
  PetscInt     rstart;
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(dm, &global));
  PetscCall(VecGetOwnershipRange(facts, &rstart, NULL));
  PetscCall(VecGetArray(facts, &a));
  for (PetscInt k = 0; k < solved->npoints; ++k) {
    PetscInt offset;

    if (solved->points[k].pair != pair || !solved->points[k].presses) continue;
    PetscCall(PetscSectionGetOffset(global, solved->points[k].vertex, &offset));
    a[offset - rstart + VERTEX_CLOSED] = 1.0;
  }
  PetscCall(VecRestoreArray(facts, &a));
  PetscFunctionReturn(0);
}

static PetscErrorCode AdaptSetHanging(DM dm, Vec facts)
{
  Mat          means;
  PetscInt     start = 0, end = 0;
  PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(MeshGetHanging(dm, &means));
  if (means) PetscCall(MatGetOwnershipRange(means, &start, &end));
  PetscCall(VecGetArray(facts, &a));
  for (PetscInt i = start; i < end; ++i) {
    PetscInt n;

    PetscCall(MatGetRow(means, i, &n, NULL, NULL));
    a[3 * (i - start) + VERTEX_HANGS] = n > 0 ? 1.0 : 0.0;
    PetscCall(MatRestoreRow(means, i, &n, NULL, NULL));
  }
  PetscCall(VecRestoreArray(facts, &a));
  PetscFunctionReturn(0);
}

/* Returns the angle at corner a of an undeformed facet [rad] */
static PetscReal FacetAngle(PetscReal x[4][3], PetscInt a)
{
  PetscReal ab = 0.0, aa = 0.0, bb = 0.0;

  for (PetscInt c = 0; c < 3; ++c) {
    const PetscReal d = x[(a + 1) % 4][c] - x[a][c], e = x[(a + 3) % 4][c] - x[a][c];

    ab += d * e;
    aa += d * d;
    bb += e * e;
  }
  return aa > 0.0 && bb > 0.0 ? PetscAcosReal(PetscClipInterval(ab / PetscSqrtReal(aa * bb), -1.0, 1.0)) : 0.0;
}

/* Adds the facets' angles at a face's vertices, and finds whether the face is plane */
static PetscErrorCode AdaptMeasureFace(DM dm, const char face[], Vec facts, PetscBool *plane)
{
  PetscSection    section;
  IS              facets;
  PetscInt        n;
  const PetscInt *f;
  PetscReal       sums[4];
  Vec             angles;
  PetscScalar    *a;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMGetLocalVector(dm, &angles));
  PetscCall(VecZeroEntries(angles));
  PetscCall(VecGetArray(angles, &a));
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt  vertices[4];
    PetscReal x[4][3];

    PetscCall(MeshGetFacetVertices(dm, f[i], vertices));
    PetscCall(MeshGetVertexCoordinates(dm, 4, vertices, x));
    for (PetscInt k = 0; k < 4; ++k) {
      PetscInt offset;

      PetscCall(PetscSectionGetOffset(section, vertices[k], &offset));
      a[offset + VERTEX_ANGLE] += FacetAngle(x, k);
    }
  }
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(MeshSumFacetAreas(dm, facets, sums));
  PetscCall(ISDestroy(&facets));
  PetscCall(VecRestoreArray(angles, &a));
  PetscCall(DMLocalToGlobal(dm, angles, ADD_VALUES, facts));
  PetscCall(DMRestoreLocalVector(dm, &angles));
  *plane = MeshFacetsArePlane(sums);
  PetscFunctionReturn(0);
}

/*
   Finds whether a facet needs refinement: it is in contact and, if the face is plane, at the edge of contact or of the
   face
*/
static PetscErrorCode AdaptFacetErrs(PetscSection section, const PetscScalar facts[], const PetscInt vertices[4],
  PetscBool plane, PetscBool *errs)
{
  PetscBool any = PETSC_FALSE, edge = (PetscBool)!plane;

  PetscFunctionBegin;
  for (PetscInt k = 0; k < 4; ++k) {
    PetscInt  offset;
    PetscBool closed, hangs, border;

    PetscCall(PetscSectionGetOffset(section, vertices[k], &offset));
    closed = (PetscBool)(PetscRealPart(facts[offset + VERTEX_CLOSED]) > 0.0);
    hangs  = (PetscBool)(PetscRealPart(facts[offset + VERTEX_HANGS]) > 0.0);
    border = (PetscBool)(PetscRealPart(facts[offset + VERTEX_ANGLE]) < ADAPT_INSIDE);
    any    = (PetscBool)(any || closed);
    edge   = (PetscBool)(edge || (!hangs && (!closed || border)));
  }
  *errs = (PetscBool)(any && edge);
  PetscFunctionReturn(0);
}

/* Marks the cells of deformable bodies behind facets that need refinement */
static PetscErrorCode AdaptMarkFace(Scene scene, DM dm, RunState *run, const char face[], Vec local, PetscBool plane)
{
  PetscSection       section;
  IS                 facets;
  PetscInt           n, cstart;
  const PetscInt    *f;
  const PetscScalar *a;

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(dm, &section));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &cstart, NULL));
  PetscCall(MeshGetFacets(dm, face, &facets));
  PetscCall(ISGetLocalSize(facets, &n));
  PetscCall(ISGetIndices(facets, &f));
  PetscCall(VecGetArrayRead(local, &a));
  for (PetscInt i = 0; i < n; ++i) {
    const PetscInt *cells;
    PetscInt        vertices[4], body;
    PetscBool       errs = PETSC_FALSE;

    PetscCall(MeshGetFacetVertices(dm, f[i], vertices));
    PetscCall(AdaptFacetErrs(section, a, vertices, plane, &errs));
    PetscCall(DMPlexGetSupport(dm, f[i], &cells));
    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, cells[0], &body));
    if (errs && scene->bodies[body].material.type != MATERIAL_RIGID) run->adapt.marked[cells[0] - cstart] = PETSC_TRUE;
  }
  PetscCall(VecRestoreArrayRead(local, &a));
  PetscCall(ISRestoreIndices(facets, &f));
  PetscCall(ISDestroy(&facets));
  PetscFunctionReturn(0);
}

/*
   Marks cells on both sides of each pair. Below a plane face only cells at the edge of contact are marked, since
   otherwise most refined cells would be there.
*/
PetscErrorCode AdaptMarkContact(Model model, State state, RunState *run)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < model->scene->npairs; ++p) {
    const char *const face[2] = {model->scene->pairs[p].mortar, model->scene->pairs[p].nonmortar};
    PetscBool         plane[2];
    Vec               facts, local;

    PetscCall(DMGetGlobalVector(model->dm, &facts));
    PetscCall(VecZeroEntries(facts));
    PetscCall(AdaptSetClosed(model->dm, state->solved, p, facts));
    PetscCall(AdaptSetHanging(model->dm, facts));
    for (PetscInt k = 0; k < 2; ++k) {
      const SceneBody *body = SceneFaceBody(model->scene, face[k]);

      if (SceneBodyIsSurface(body)) plane[k] = (PetscBool)(body->shape == SHAPE_RIGID_PLANE);
      else PetscCall(AdaptMeasureFace(model->dm, face[k], facts, &plane[k]));
    }
    PetscCall(DMGetLocalVector(model->dm, &local));
    PetscCall(DMGlobalToLocal(model->dm, facts, INSERT_VALUES, local));
    PetscCall(DMRestoreGlobalVector(model->dm, &facts));
    for (PetscInt k = 0; k < 2; ++k)
      PetscCall(AdaptMarkFace(model->scene, model->dm, run, face[k], local, (PetscBool)(plane[0] && plane[1])));
    PetscCall(DMRestoreLocalVector(model->dm, &local));
  }
  PetscFunctionReturn(0);
}
