/*
   Estimates how far a curved surface is from its plane facets. At a corner of a facet the normal of the surface is the
   mean of the normals of all facets there. The surface above an edge from x_i to x_j is taken as an arc with the
   normals n_i and n_j at its ends. Its height is a parabola along the edge, with (n_j - n_i).(x_j - x_i) / 8 in the
   middle.
*/
#include "detectimpl.h"
#include <stdlib.h>
#include <vector3.h>

typedef struct {
  PetscInt64 key[4]; /* surface, and rounded coordinates */
  PetscInt   at;     /* 4 facet + corner */
} BulgeCorner;

static int BulgeCompare(const void *a, const void *b)
{
  const BulgeCorner *x = (const BulgeCorner *)a, *y = (const BulgeCorner *)b;

  for (int i = 0; i < 4; ++i) {
    if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
  }
  return x->at < y->at ? -1 : x->at > y->at;
}

/* Lists the corners of all facets such that equal corners of one surface follow each other */
static void BulgeSort(const MeshSurfaces *s, BulgeCorner corner[])
{
  PetscReal size = 0.0;

  for (PetscInt i = 0; i < 12 * s->n; ++i) size = PetscMax(size, PetscAbsReal(s->x[i] - s->x[i % 3]));
  for (PetscInt i = 0; i < 4 * s->n; ++i) {
    corner[i] = (BulgeCorner){{s->surface[i / 4], 0, 0, 0}, i};
    for (PetscInt c = 0; c < 3; ++c)
      corner[i].key[1 + c] = (PetscInt64)PetscFloorReal((s->x[3 * i + c] - s->x[c]) / (MESH_SAME_PLACE * size) + 0.5);
  }
  if (s->n) qsort(corner, (size_t)(4 * s->n), sizeof(*corner), BulgeCompare);
}

/* Computes the normals of the surface at the corners of all facets. normal: 12 numbers for each facet */
PetscErrorCode DetectNormals(const MeshSurfaces *s, PetscReal normal[])
{
  BulgeCorner *corner;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * s->n, &corner));
  BulgeSort(s, corner);
  for (PetscInt i = 0, next; i < 4 * s->n; i = next) {
    PetscReal sum[3] = {0.0, 0.0, 0.0};

    for (next = i; next < 4 * s->n; ++next) {
      PetscReal of[3];
      PetscBool same = PETSC_TRUE;

      for (PetscInt k = 0; k < 4; ++k) same = (PetscBool)(same && corner[next].key[k] == corner[i].key[k]);
      if (!same) break;
      if (!ContactFacetNormal(&s->x[12 * (corner[next].at / 4)], of)) continue;
      for (PetscInt c = 0; c < 3; ++c) sum[c] += of[c];
    }
    (void)VectorScaleToUnit(sum);
    for (PetscInt k = i; k < next; ++k) PetscCall(PetscArraycpy(&normal[3 * corner[k].at], sum, 3));
  }
  PetscCall(PetscFree(corner));
  PetscFunctionReturn(0);
}

/* Returns the height of the surface above a facet at the parameters xi [length]. normal: of the surface at its
   corners */
PetscReal DetectBulge(const PetscReal x[12], const PetscReal normal[12], const PetscReal xi[2])
{
  PetscReal phi[4], height = 0.0;

  ContactShape(xi, phi);
  for (PetscInt k = 0; k < 16; ++k) {
    const PetscInt i = k / 4, j = k % 4;

    for (PetscInt c = 0; c < 3; ++c)
      height += 0.25 * phi[i] * phi[j] * (normal[3 * j + c] - normal[3 * i + c]) * (x[3 * j + c] - x[3 * i + c]);
  }
  return height;
}
