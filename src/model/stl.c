/*
   Rigid surfaces of STL files: the distance from the plane facets. Its sign is that of the facets' normals at the
   closest point, weighted by the angles of the facets there (Baerentzen and Aanaes, Signed distance computation using
   the angle weighted pseudonormal, 2005). A point whose closest point is on the border of an open surface is outside.
*/
#include "modelimpl.h"
#include <petsccompat.h>
#include <rankerror.h>
#include <stdlib.h>
#include <vector3.h>

#define STL_LEAF  4    /* largest number of facets of a leaf of the tree */
#define STL_DEPTH 128  /* size of the stack of a search */
#define STL_SAME  1e-9 /* points that are nearer than this, relative to the size of the surface, are the same */

typedef struct {
  PetscReal box[6];
  PetscInt  first, last, second; /* facets order[first] to order[last - 1]; number of the second child, 0 for a leaf */
} StlNode;

struct _n_SceneStl {
  PetscInt   n;
  PetscReal *x;   /* [9 n] corners, counterclockwise seen from outside [length] */
  PetscBool *rim; /* [3 n] whether the edge from corner k to the next one is on the border */
  PetscInt  *order, nnodes;
  StlNode   *node;
  PetscReal  size; /* largest edge of the bounding box [length] */
};

/* A corner, or an edge, of a facet with what identifies it */
typedef struct {
  PetscInt64 key[3];
  PetscInt   at; /* 3 facet + corner */
} StlRecord;

static int StlCompare(const void *a, const void *b)
{
  const StlRecord *x = (const StlRecord *)a, *y = (const StlRecord *)b;

  for (int i = 0; i < 3; ++i) {
    if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
  }
  return x->at < y->at ? -1 : x->at > y->at;
}

/* Numbers the corners such that equal ones have one number. unit: length below which corners are the same */
static PetscErrorCode StlNumberCorners(PetscInt n, const PetscReal x[], PetscReal unit, PetscInt number[])
{
  StlRecord *record;
  PetscInt   count = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(3 * n, &record));
  for (PetscInt i = 0; i < 3 * n; ++i) {
    record[i].at = i;
    for (PetscInt c = 0; c < 3; ++c) record[i].key[c] = (PetscInt64)PetscFloorReal(x[3 * i + c] / unit + 0.5);
  }
  if (n) qsort(record, (size_t)(3 * n), sizeof(*record), StlCompare);
  for (PetscInt i = 0; i < 3 * n; ++i) {
    for (PetscInt c = 0; c < 3 && i; ++c) {
      if (record[i].key[c] == record[i - 1].key[c]) continue;
      ++count;
      break;
    }
    number[record[i].at] = count;
  }
  PetscCall(PetscFree(record));
  PetscFunctionReturn(0);
}

/* Returns the facet's place in the file as text: its line, or its number in a binary file */
static const char *StlPlace(const StlFacets *f, PetscInt facet, char text[32])
{
  (void)PetscSNPrintf(text, 32, f->line[facet] ? "line %" PetscInt_FMT : "facet %" PetscInt_FMT,
    f->line[facet] ? f->line[facet] : facet + 1);
  return text;
}

/* Finds the edges on the border, which one facet has. Two facets must pass through a common edge in opposite
   directions. */
static PetscErrorCode StlFindRim(const char file[], const StlFacets *f, PetscReal unit, PetscBool rim[])
{
  StlRecord *record;
  PetscInt  *number;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(3 * f->n, &record, 3 * f->n, &number));
  PetscCall(StlNumberCorners(f->n, f->x, unit, number));
  for (PetscInt i = 0; i < 3 * f->n; ++i) {
    const PetscInt a = number[i], b = number[i - i % 3 + (i + 1) % 3];

    record[i] = (StlRecord){{PetscMin(a, b), PetscMax(a, b), 0}, i};
    rim[i]    = PETSC_FALSE;
  }
  if (f->n) qsort(record, (size_t)(3 * f->n), sizeof(*record), StlCompare);
  for (PetscInt i = 0, next; i < 3 * f->n; i = next) {
    char one[32], two[32];

    for (next = i + 1; next < 3 * f->n && record[next].key[0] == record[i].key[0]; ++next)
      if (record[next].key[1] != record[i].key[1]) break;
    rim[record[i].at] = (PetscBool)(next == i + 1);
    PetscCheck(next != i + 2 || number[record[i].at] != number[record[i + 1].at], PETSC_COMM_SELF, PETSC_ERR_USER_INPUT,
      "%s: %s: the facet has an edge in common with that of %s, and the two face opposite sides: order the corners of "
      "all facets counterclockwise seen from outside",
      file, StlPlace(f, record[i + 1].at / 3, one), StlPlace(f, record[i].at / 3, two));
  }
  PetscCall(PetscFree2(record, number));
  PetscFunctionReturn(0);
}

/* Computes the normal of a facet, as long as twice its area */
static void StlNormal(const PetscReal x[9], PetscReal normal[3])
{
  PetscReal a[3], b[3];

  for (PetscInt c = 0; c < 3; ++c) {
    a[c] = x[3 + c] - x[c];
    b[c] = x[6 + c] - x[c];
  }
  VectorCross(a, b, normal);
}

/* Multiplies the coordinates by `scale`, and removes facets without area. Returns the size of the bounding box. */
static PetscReal StlScale(PetscReal scale, StlFacets *f)
{
  PetscReal low[3], high[3], size = 0.0, normal[3];
  PetscInt  kept = 0;

  for (PetscInt i = 0; i < 9 * f->n; ++i) {
    f->x[i] *= scale;
    low[i % 3]  = i < 3 ? f->x[i] : PetscMin(low[i % 3], f->x[i]);
    high[i % 3] = i < 3 ? f->x[i] : PetscMax(high[i % 3], f->x[i]);
  }
  for (PetscInt c = 0; c < 3; ++c) size = PetscMax(size, high[c] - low[c]);
  for (PetscInt i = 0; i < f->n; ++i) {
    StlNormal(&f->x[9 * i], normal);
    if (VectorNorm(normal) <= PetscSqr(STL_SAME * size)) continue;
    for (PetscInt c = 0; c < 9; ++c) f->x[9 * kept + c] = f->x[9 * i + c];
    f->line[kept++] = f->line[i];
  }
  f->n = kept;
  return size;
}

/* Reads and checks the file on one rank */
static PetscErrorCode StlLoad(const char file[], PetscReal scale, SceneStl stl)
{
  StlFacets f = {0};

  PetscFunctionBegin;
  PetscCall(StlRead(file, &f));
  stl->size = StlScale(scale, &f);
  PetscCheck(f.n, PETSC_COMM_SELF, PETSC_ERR_USER_INPUT, "%s: no facet has an area", file);
  stl->n = f.n;
  stl->x = f.x;
  PetscCall(PetscMalloc1(3 * f.n, &stl->rim));
  PetscCall(StlFindRim(file, &f, STL_SAME * stl->size, stl->rim));
  PetscCall(PetscFree(f.line));
  PetscFunctionReturn(0);
}

/* A facet while the facets are sorted, and three times the coordinate of its centre along an axis [length] */
typedef struct {
  PetscReal at;
  PetscInt  facet;
} StlSorted;

static int StlCompareCentres(const void *a, const void *b)
{
  const StlSorted *x = (const StlSorted *)a, *y = (const StlSorted *)b;

  if (x->at != y->at) return x->at < y->at ? -1 : 1;
  return x->facet < y->facet ? -1 : x->facet > y->facet;
}

/* Sorts the facets order[first] to order[last - 1] by their centres along an axis. work: as long as order */
static void StlSort(SceneStl s, PetscInt first, PetscInt last, PetscInt axis, StlSorted work[])
{
  for (PetscInt i = first; i < last; ++i) {
    const PetscReal *x = &s->x[9 * s->order[i] + axis];

    work[i] = (StlSorted){x[0] + x[3] + x[6], s->order[i]};
  }
  qsort(&work[first], (size_t)(last - first), sizeof(*work), StlCompareCentres);
  for (PetscInt i = first; i < last; ++i) s->order[i] = work[i].facet;
}

/* Creates the node of the facets order[first] to order[last - 1], and its children */
static void StlBuild(SceneStl s, PetscInt first, PetscInt last, StlSorted work[])
{
  const PetscInt self   = s->nnodes++;
  StlNode       *node   = &s->node[self];
  const PetscInt middle = first + (last - first) / 2;
  PetscInt       axis   = 0;

  *node = (StlNode){{0}, first, last, 0};
  for (PetscInt i = 3 * first; i < 3 * last; ++i) {
    const PetscReal *x = &s->x[9 * s->order[i / 3] + 3 * (i % 3)];

    for (PetscInt c = 0; c < 3; ++c) {
      node->box[c]     = i == 3 * first ? x[c] : PetscMin(node->box[c], x[c]);
      node->box[3 + c] = i == 3 * first ? x[c] : PetscMax(node->box[3 + c], x[c]);
    }
  }
  if (last - first <= STL_LEAF) return;
  for (PetscInt c = 1; c < 3; ++c) {
    if (node->box[3 + c] - node->box[c] > node->box[3 + axis] - node->box[axis]) axis = c;
  }
  StlSort(s, first, last, axis, work);
  StlBuild(s, first, middle, work);
  s->node[self].second = s->nnodes;
  StlBuild(s, middle, last, work);
}

PetscErrorCode SceneStlDestroy(SceneStl *stl)
{
  PetscFunctionBegin;
  if (!*stl) PetscFunctionReturn(0);
  PetscCall(PetscFree((*stl)->x));
  PetscCall(PetscFree((*stl)->rim));
  PetscCall(PetscFree2((*stl)->order, (*stl)->node));
  PetscCall(PetscFree(*stl));
  PetscFunctionReturn(0);
}

/*
   Computes the volume and the first and second moments of the solid inside, from the tetrahedra of the facets with the
   middle of the bounding box. *closed: whether the surface has no border. centre: of mass, or the middle of the box.
   edge: of a cube that has the same sum of moments of inertia, or fits into the box
*/
static void StlMeasure(const struct _n_SceneStl *s, PetscReal centre[3], PetscReal *edge)
{
  const PetscReal *box = s->node[0].box;
  PetscReal        origin[3], volume = 0.0, first[3] = {0, 0, 0}, second = 0.0, normal[3];
  PetscBool        closed = PETSC_TRUE;

  for (PetscInt c = 0; c < 3; ++c) origin[c] = centre[c] = 0.5 * (box[c] + box[3 + c]);
  *edge = s->size / PetscSqrtReal(3.0);
  for (PetscInt f = 0; f < s->n; ++f) {
    PetscReal r[3][3], part, square = 0.0, sum[3] = {0, 0, 0};

    StlNormal(&s->x[9 * f], normal);
    for (PetscInt i = 0; i < 9; ++i) {
      r[i / 3][i % 3] = s->x[9 * f + i] - origin[i % 3];
      sum[i % 3] += r[i / 3][i % 3];
      closed = (PetscBool)(closed && !s->rim[3 * f + i / 3]);
    }
    for (PetscInt i = 0; i < 3; ++i) square += VectorDot(r[i], r[i]);
    part = VectorDot(normal, r[0]) / 6.0;
    volume += part;
    for (PetscInt c = 0; c < 3; ++c) first[c] += part * sum[c] / 4.0;
    second += part * (VectorDot(sum, sum) + square) / 20.0;
  }
  if (!closed || volume <= 0.0) return;
  for (PetscInt c = 0; c < 3; ++c) centre[c] += first[c] / volume;
  second = second / volume - VectorDot(first, first) / PetscSqr(volume); /* mean square distance from the centre */
  *edge  = 2.0 * PetscSqrtReal(PetscMax(second, 0.0));
}

/* Collective. Reads an STL file, with its coordinates multiplied by `scale` */
PetscErrorCode SceneStlCreate(MPI_Comm comm, const char place[], const char file[], PetscReal scale, SceneStl *stl,
  PetscReal centre[3], PetscReal *edge)
{
  PetscMPIInt rank, count;
  SceneStl    s;
  StlSorted  *work;

  PetscFunctionBegin;
  PetscCall(PetscNew(&s));
  *stl = s;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  RankCallFor(comm, !rank, StlLoad(file, scale, s), "%s", place);
  PetscCallMPI(MPI_Bcast(&s->n, 1, MPIU_INT, 0, comm));
  PetscCallMPI(MPI_Bcast(&s->size, 1, MPIU_REAL, 0, comm));
  PetscCall(PetscMPIIntCast(9 * s->n, &count));
  if (rank) {
    PetscCall(PetscMalloc1(9 * s->n, &s->x));
    PetscCall(PetscMalloc1(3 * s->n, &s->rim));
  }
  PetscCallMPI(MPI_Bcast(s->x, count, MPIU_REAL, 0, comm));
  PetscCallMPI(MPI_Bcast(s->rim, count / 3, MPI_PETSCBOOL, 0, comm));
  PetscCall(PetscMalloc2(s->n, &s->order, 2 * s->n, &s->node));
  for (PetscInt f = 0; f < s->n; ++f) s->order[f] = f;
  PetscCall(PetscMalloc1(s->n, &work));
  StlBuild(s, 0, s->n, work);
  PetscCall(PetscFree(work));
  StlMeasure(s, centre, edge);
  PetscFunctionReturn(0);
}

/*
   Computes the point of a triangle that is closest to x (Ericson, Real-time collision detection, 2005, section 5.1.5).
   Returns where it is: 0: inside, 1 + k: on the edge from corner k to the next, 4 + k: at corner k.
*/
static PetscInt StlClosest(const PetscReal t[9], const PetscReal x[3], PetscReal p[3])
{
  PetscReal ab[3], ac[3], d[6], a = 0.0, b = 0.0, va, vb, vc; /* p = t[0] + a ab + b ac */
  PetscInt  where = 0;

  for (PetscInt c = 0; c < 3; ++c) {
    ab[c] = t[3 + c] - t[c];
    ac[c] = t[6 + c] - t[c];
  }
  for (PetscInt k = 0; k < 3; ++k) {
    const PetscReal r[3] = {x[0] - t[3 * k], x[1] - t[3 * k + 1], x[2] - t[3 * k + 2]};

    d[2 * k]     = VectorDot(ab, r);
    d[2 * k + 1] = VectorDot(ac, r);
  }
  va = d[2] * d[5] - d[4] * d[3];
  vb = d[4] * d[1] - d[0] * d[5];
  vc = d[0] * d[3] - d[2] * d[1];
  if (d[0] <= 0.0 && d[1] <= 0.0) where = 4;
  else if (d[2] >= 0.0 && d[3] <= d[2]) where = 5;
  else if (vc <= 0.0 && d[0] >= 0.0 && d[2] <= 0.0) where = 1;
  else if (d[5] >= 0.0 && d[4] <= d[5]) where = 6;
  else if (vb <= 0.0 && d[1] >= 0.0 && d[5] <= 0.0) where = 3;
  else if (va <= 0.0 && d[3] - d[2] >= 0.0 && d[4] - d[5] >= 0.0) where = 2;
  if (where == 5) a = 1.0;
  if (where == 6) b = 1.0;
  if (where == 1) a = d[0] / (d[0] - d[2]);
  if (where == 3) b = d[1] / (d[1] - d[5]);
  if (where == 2) {
    b = (d[3] - d[2]) / ((d[3] - d[2]) + (d[4] - d[5]));
    a = 1.0 - b;
  }
  if (!where) {
    a = vb / (va + vb + vc);
    b = vc / (va + vb + vc);
  }
  for (PetscInt c = 0; c < 3; ++c) p[c] = t[c] + a * ab[c] + b * ac[c];
  return where;
}

/* Returns the angle of a facet at a point of it, which is where StlClosest() says */
static PetscReal StlAngle(const PetscReal t[9], PetscInt where)
{
  const PetscReal *at = &t[3 * (where % 4)];
  PetscReal        a[3], b[3], cross[3];

  if (where < 4) return where ? PETSC_PI : 2.0 * PETSC_PI;
  for (PetscInt c = 0; c < 3; ++c) {
    a[c] = t[3 * ((where - 3) % 3) + c] - at[c];
    b[c] = t[3 * ((where - 2) % 3) + c] - at[c];
  }
  VectorCross(a, b, cross);
  return PetscAtan2Real(VectorNorm(cross), VectorDot(a, b));
}

/* The closest point so far: its distance [length], the sum of the weighted normals of the facets there */
typedef struct {
  PetscReal least, point[3], normal[3];
  PetscBool rim, inside; /* whether it is on the border; whether it is inside a facet */
} StlNearest;

/* Tries one facet. same: length below which distances and points are the same */
static void StlTry(const struct _n_SceneStl *s, PetscInt f, const PetscReal x[3], PetscReal same, StlNearest *nearest)
{
  const PetscReal *t = &s->x[9 * f];
  PetscReal        p[3], r[3], off[3], normal[3], distance, weight;
  const PetscInt   where = StlClosest(t, x, p);

  for (PetscInt c = 0; c < 3; ++c) {
    r[c]   = x[c] - p[c];
    off[c] = p[c] - nearest->point[c];
  }
  distance = VectorNorm(r);
  if (distance > nearest->least + same) return;
  if (distance < nearest->least - same) {
    nearest->least = distance;
    nearest->rim   = PETSC_FALSE;
    for (PetscInt c = 0; c < 3; ++c) {
      nearest->point[c]  = p[c];
      nearest->normal[c] = 0.0;
    }
  } else if (VectorNorm(off) > same) return;
  nearest->inside = (PetscBool)!where;
  if (where && where < 4) nearest->rim = (PetscBool)(nearest->rim || s->rim[3 * f + where - 1]);
  if (where > 3)
    nearest->rim = (PetscBool)(nearest->rim || s->rim[3 * f + where - 4] || s->rim[3 * f + (where - 2) % 3]);
  weight = StlAngle(t, where);
  StlNormal(t, normal);
  (void)VectorScaleToUnit(normal);
  for (PetscInt c = 0; c < 3; ++c) nearest->normal[c] += weight * normal[c];
}

static PetscReal StlBoxDistance(const PetscReal box[6], const PetscReal x[3])
{
  PetscReal r[3];

  for (PetscInt c = 0; c < 3; ++c) r[c] = PetscMax(0.0, PetscMax(box[c] - x[c], x[c] - box[3 + c]));
  return VectorNorm(r);
}

/* Returns the distance of the point x, negative inside [length], and computes its gradient */
PetscReal StlDistance(const struct _n_SceneStl *s, const PetscReal x[3], PetscReal gradient[3])
{
  const PetscReal same    = STL_SAME * s->size;
  StlNearest      nearest = {.least = PETSC_MAX_REAL};
  PetscInt        stack[STL_DEPTH], depth = 0;
  PetscReal       r[3], along;

  stack[depth++] = 0;
  while (depth) {
    const PetscInt self = stack[--depth];
    const StlNode *node = &s->node[self];

    if (StlBoxDistance(node->box, x) > nearest.least + same) continue;
    if (node->second) {
      const PetscBool swap =
        (PetscBool)(StlBoxDistance(s->node[self + 1].box, x) > StlBoxDistance(s->node[node->second].box, x));

      stack[depth++] = swap ? self + 1 : node->second;
      stack[depth++] = swap ? node->second : self + 1;
      continue;
    }
    for (PetscInt i = node->first; i < node->last; ++i) StlTry(s, s->order[i], x, same, &nearest);
  }
  (void)VectorScaleToUnit(nearest.normal);
  for (PetscInt c = 0; c < 3; ++c) r[c] = x[c] - nearest.point[c];
  along = VectorDot(r, nearest.normal);
  for (PetscInt c = 0; c < 3; ++c) gradient[c] = nearest.normal[c];
  if (nearest.inside) return along;
  if (nearest.rim || along >= 0.0) along = nearest.least;
  else along = -nearest.least;
  for (PetscInt c = 0; c < 3 && nearest.least > same; ++c) gradient[c] = r[c] / along;
  return along;
}
