/*
   Nested dissection by coordinates. The nodes are divided in two halves, and those nodes of one half that touch the
   other one are ordered last. Six divisions are compared, two for each axis: by a plane, and by the number of layers of
   elements between a node and the nodes at the low end of the axis. The layers follow a curved or graded mesh. This
   takes a tenth of the time of METIS, and the factors are about as large.
*/
#include "choleskyimpl.h"

#define DISSECT_LEAST     8    /* sets of fewer nodes are not divided */
#define DISSECT_DIVISIONS 6    /* number of divisions that are compared */
#define DISSECT_END       0.01 /* fraction of the nodes from which layers are counted */
#define DISSECT_ROUNDING  1e-6 /* distance of nodes in one plane, in mean distances of neighbours */

typedef struct {
  const CholeskyGraph *g;
  PetscReal           *x;     /* three coordinates of each node, in units of the mean distance of neighbours */
  PetscInt            *half;  /* 2 * stamp for the nodes of the first half, 2 * stamp + 1 for those of the second */
  PetscInt             stamp; /* number of divisions so far */
  PetscInt            *layer; /* layer of each node */
  PetscInt            *list;  /* work arrays of the size of the graph */
  PetscReal           *key;
} Dissection;

/* Returns the k-th smallest of n keys, which are reordered */
static PetscReal DissectSelect(PetscInt n, PetscReal key[], PetscInt k)
{
  PetscInt first = 0, last = n - 1;

  while (first < last) {
    const PetscReal pivot = key[(first + last) / 2];
    PetscInt        i = first, j = last;

    while (i <= j) {
      while (key[i] < pivot) i++;
      while (key[j] > pivot) j--;
      if (i <= j) {
        const PetscReal swap = key[i];

        key[i++] = key[j];
        key[j--] = swap;
      }
    }
    if (k <= j) last = j;
    else if (k >= i) first = i;
    else break;
  }
  return key[k];
}

/* Returns the coordinate of the node below which the given fraction of the nodes lies */
static PetscReal DissectQuantile(Dissection *d, PetscInt n, const PetscInt node[], PetscInt axis, PetscReal fraction)
{
  for (PetscInt i = 0; i < n; i++) d->key[i] = d->x[3 * node[i] + axis];
  return DissectSelect(n, d->key, (PetscInt)(fraction * (PetscReal)n));
}

/* Divides the nodes by a plane through the median node. Nodes in the plane belong to the second half. Returns the
   number of nodes in the first half. */
static PetscInt DissectByPlane(Dissection *d, PetscInt n, const PetscInt node[], PetscInt axis)
{
  const PetscReal end   = DissectQuantile(d, n, node, axis, 0.5) - DISSECT_ROUNDING;
  PetscInt        below = 0;

  d->stamp++;
  for (PetscInt i = 0; i < n; i++) {
    const PetscBool first = (PetscBool)(d->x[3 * node[i] + axis] < end);

    d->half[node[i]] = 2 * d->stamp + !first;
    below += first;
  }
  return below;
}

/* Numbers the layers of nodes, beginning with those at the low end of the axis. Nodes that are not connected with them
   are in layer n. Returns the number of layers. */
static PetscInt DissectFindLayers(Dissection *d, PetscInt n, const PetscInt node[], PetscInt axis)
{
  const CholeskyGraph *g   = d->g;
  const PetscReal      end = DissectQuantile(d, n, node, axis, DISSECT_END) + DISSECT_ROUNDING;
  PetscInt             m = 0, *queue = d->list, fresh;

  fresh = 2 * ++d->stamp;
  for (PetscInt i = 0; i < n; i++) {
    const PetscBool start = (PetscBool)(d->x[3 * node[i] + axis] < end);

    d->half[node[i]]  = fresh + start;
    d->layer[node[i]] = start ? 0 : n;
    if (start) queue[m++] = node[i];
  }
  for (PetscInt head = 0; head < m; head++) {
    for (PetscInt k = g->start[queue[head]]; k < g->start[queue[head] + 1]; k++) {
      const PetscInt j = g->neighbour[k];

      if (d->half[j] != fresh) continue;
      d->half[j]  = fresh + 1;
      d->layer[j] = d->layer[queue[head]] + 1;
      queue[m++]  = j;
    }
  }
  return d->layer[queue[m - 1]] + 1;
}

/* Returns a measure of a separator: its size, larger if the two parts differ in size. below: nodes of the first part */
static PetscReal DissectMeasure(PetscInt size, PetscInt below, PetscInt n)
{
  const PetscReal part = (PetscReal)below / (PetscReal)n;

  return size / (4.0 * part * (1.0 - part));
}

/* Divides the nodes between the two layers where a layer is the best separator. Returns the number of nodes in the
   first half. */
static PetscInt DissectByLayer(Dissection *d, PetscInt n, const PetscInt node[], PetscInt axis)
{
  const PetscInt nlayers = DissectFindLayers(d, n, node, axis);
  PetscInt       last = 0, below = 0, best = 0, *size = d->list;
  PetscReal      least = PETSC_MAX_REAL;

  for (PetscInt l = 0; l < nlayers; l++) size[l] = 0;
  for (PetscInt i = 0; i < n; i++)
    if (d->layer[node[i]] < nlayers) size[d->layer[node[i]]]++;
  for (PetscInt l = 0; l < nlayers; l++) {
    PetscReal measure;

    below += size[l];
    if (below == n) break;
    measure = DissectMeasure(size[l], below, n);
    if (measure >= least) continue;
    least = measure;
    last  = l;
    best  = below;
  }
  d->stamp++;
  for (PetscInt i = 0; i < n; i++) d->half[node[i]] = 2 * d->stamp + (d->layer[node[i]] > last);
  return best;
}

/* Divides the nodes in one of six ways. Returns the number of nodes in the first half. */
static PetscInt DissectHalve(Dissection *d, PetscInt n, const PetscInt node[], PetscInt way)
{
  return way % 2 ? DissectByLayer(d, n, node, way / 2) : DissectByPlane(d, n, node, way / 2);
}

/* Counts the nodes of each half that have neighbours in the other half */
static void DissectCountTouching(const Dissection *d, PetscInt n, const PetscInt node[], PetscInt touching[2])
{
  touching[0] = touching[1] = 0;
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt mine = d->half[node[i]], other = mine ^ 1;

    for (PetscInt k = d->g->start[node[i]]; k < d->g->start[node[i] + 1]; k++) {
      if (d->half[d->g->neighbour[k]] != other) continue;
      touching[mine & 1]++;
      break;
    }
  }
}

/* Orders the nodes: those of both halves, then the separator, which is taken from half `from`. parts: numbers of nodes
   of the three parts */
static void DissectPart(Dissection *d, PetscInt n, PetscInt node[], PetscInt from, PetscInt parts[3])
{
  PetscInt place[3];

  parts[0] = parts[1] = parts[2] = 0;
  for (PetscInt i = 0; i < n; i++) {
    const PetscInt mine = d->half[node[i]];
    PetscInt       part = mine & 1;

    for (PetscInt k = d->g->start[node[i]]; part == from && k < d->g->start[node[i] + 1]; k++)
      if (d->half[d->g->neighbour[k]] == (mine ^ 1)) part = 2;
    d->list[i] = 3 * node[i] + part;
    parts[part]++;
  }
  place[0] = 0;
  place[1] = parts[0];
  place[2] = parts[0] + parts[1];
  for (PetscInt i = 0; i < n; i++) node[place[d->list[i] % 3]++] = d->list[i] / 3;
}

/* Finds the way of division with the smallest separator; -1: the nodes cannot be divided */
static PetscInt DissectChoose(Dissection *d, PetscInt n, const PetscInt node[])
{
  PetscReal least = PETSC_MAX_REAL;
  PetscInt  best  = -1;

  for (PetscInt way = 0; way < DISSECT_DIVISIONS; way++) {
    const PetscInt below = DissectHalve(d, n, node, way);
    PetscInt       touching[2];
    PetscReal      measure;

    if (!below || below == n) continue;
    DissectCountTouching(d, n, node, touching);
    measure = DissectMeasure(PetscMin(touching[0], touching[1]), below, n);
    if (measure >= least) continue;
    least = measure;
    best  = way;
  }
  return best;
}

/* Orders n nodes */
static void DissectNodes(Dissection *d, PetscInt n, PetscInt node[])
{
  const PetscInt way = n < DISSECT_LEAST ? -1 : DissectChoose(d, n, node);
  PetscInt       touching[2], parts[3];

  if (way < 0) return;
  (void)DissectHalve(d, n, node, way);
  DissectCountTouching(d, n, node, touching);
  DissectPart(d, n, node, touching[1] <= touching[0], parts);
  if (parts[2] == n) return;
  DissectNodes(d, parts[0], node);
  DissectNodes(d, parts[1], node + parts[0]);
}

/* Computes the coordinates in units of the mean distance of neighbours along each axis */
static void DissectScale(const CholeskyGraph *g, const PetscScalar coordinates[], PetscReal x[])
{
  for (PetscInt c = 0; c < 3; c++) {
    PetscReal sum = 0.0;

    for (PetscInt i = 0; i < g->n; i++) {
      x[3 * i + c] = PetscRealPart(coordinates[3 * i + c]);
      for (PetscInt k = g->start[i]; k < g->start[i + 1]; k++)
        sum += PetscAbsScalar(coordinates[3 * i + c] - coordinates[3 * g->neighbour[k] + c]);
    }
    for (PetscInt i = 0; i < g->n; i++) x[3 * i + c] *= sum > 0.0 ? (PetscReal)g->start[g->n] / sum : 0.0;
  }
}

/* Orders the nodes by nested dissection. coordinates: three for each node; perm[i]: the i-th node */
PetscErrorCode CholeskyDissect(const CholeskyGraph *g, const PetscScalar coordinates[], PetscInt perm[])
{
  Dissection d = {.g = g};

  PetscFunctionBegin;
  PetscCall(PetscMalloc5(3 * g->n, &d.x, g->n, &d.half, g->n, &d.layer, g->n, &d.list, g->n, &d.key));
  DissectScale(g, coordinates, d.x);
  for (PetscInt i = 0; i < g->n; i++) d.half[i] = -1;
  for (PetscInt i = 0; i < g->n; i++) perm[i] = i;
  DissectNodes(&d, g->n, perm);
  PetscCall(PetscFree5(d.x, d.half, d.layer, d.list, d.key));
  PetscFunctionReturn(0);
}
