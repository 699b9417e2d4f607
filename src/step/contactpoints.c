/* Pressure, gap and status at the vertices of both sides of every pair. */
#include "stepimpl.h"

/*
   The rows of one pair: row A pushes its own side by z_A w_A n_A, w_A n_A = mass_A sum of J_AB over the vertices B of the mortar side.
   w_A is the area that the mortar side covers about A. Rows of other pairs have w = 0. Over vertices it is shared as the cover is, of which
   w_A is share_A times the sum, along the normal n_A that the cover has.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *share, *normal; /* w [length^2]; 3 a row */
  PetscReal *pressure, *gap, *closed;
} PairRows;

/* What the vertices of the mesh have, as far as they are in the pair: [area, force, gap x area]; [1 mortar side, -1 nonmortar, closed area, -]; force */
typedef struct {
  Vec carried, sides, force;
} PairVertices;

/* value at the rows of a face that belong to a component */
static PetscErrorCode PairVerticesMark(DM dm, const char face[], PetscInt component, PetscInt to, Vec v)
{
  IS              is;
  const PetscInt *rows;
  PetscScalar    *a;
  PetscInt        n, rstart;

  PetscFunctionBegin;
  PetscCall(MeshGetFaceDofs(dm, face, component, &is));
  PetscCall(ISGetLocalSize(is, &n));
  PetscCall(ISGetIndices(is, &rows));
  PetscCall(VecGetOwnershipRange(v, &rstart, NULL));
  PetscCall(VecGetArray(v, &a));
  for (PetscInt k = 0; k < n; ++k) a[rows[k] - rstart] = (PetscReal)to;
  PetscCall(VecRestoreArray(v, &a));
  PetscCall(ISRestoreIndices(is, &rows));
  PetscCall(ISDestroy(&is));
  PetscFunctionReturn(0);
}

/* In whose proportions areas are shared */
static Mat PairCover(ContactLinearization lin)
{
  return lin->cover ? lin->cover : lin->J;
}

/* vector: mass_A sum of a matrix's A_AB over the vertices B of the mortar side */
static PetscErrorCode PairRowsSum(Simulation sim, PetscInt pair, Mat A, PetscInt n, PetscReal vector[])
{
  ContactLinearization lin = sim->linearization;
  Vec                  mark, sum;
  const PetscScalar   *s;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path.u, &mark));
  PetscCall(VecDuplicate(lin->mass, &sum));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecZeroEntries(mark));
    PetscCall(PairVerticesMark(sim->dm, sim->scene->pairs[pair].mortar, c, 1, mark));
    PetscCall(MatMult(A, mark, sum));
    PetscCall(VecPointwiseMult(sum, sum, lin->mass));
    PetscCall(VecGetArrayRead(sum, &s));
    for (PetscInt r = 0; r < n; ++r) vector[3 * r + c] = lin->pair[r] == pair ? PetscRealPart(s[r]) : 0.0;
    PetscCall(VecRestoreArrayRead(sum, &s));
  }
  PetscCall(VecDestroy(&sum));
  PetscCall(VecDestroy(&mark));
  PetscFunctionReturn(0);
}

static PetscReal PairNorm(const PetscReal v[3])
{
  return PetscSqrtReal(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/*
   A row is in contact where the strain that its pressure is worth is more than that which its gap would be: on the central path
   their product is the same at all rows, and tends to zero
*/
static PetscErrorCode PairRowsClose(Simulation sim, PairRows *rows)
{
  PetscReal size = 0.0, young = PETSC_MAX_REAL;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) size += rows->area[r];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_REAL, MPIU_SUM, sim->comm));
  size = PetscSqrtReal(size);
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) young = PetscMin(young, sim->scene->bodies[b].material.young);
  for (PetscInt r = 0; r < rows->n; ++r) rows->closed[r] = rows->area[r] > 0.0 && rows->pressure[r] / young > rows->gap[r] / size ? 1.0 : 0.0;
  PetscFunctionReturn(0);
}

static PetscErrorCode PairRowsCreate(Simulation sim, PetscInt pair, PairRows *rows)
{
  const PetscInt     n = sim->linearization->nlocal;
  const PetscScalar *mass;
  PetscReal         *force;

  PetscFunctionBegin;
  rows->n = n;
  PetscCall(PetscCalloc6(n, &rows->area, n, &rows->share, 3 * n, &rows->normal, n, &rows->pressure, n, &rows->gap, n, &rows->closed));
  PetscCall(PetscMalloc1(3 * n, &force));
  PetscCall(PairRowsSum(sim, pair, PairCover(sim->linearization), n, rows->normal));
  PetscCall(PairRowsSum(sim, pair, sim->linearization->J, n, force));
  PetscCall(VecGetArrayRead(sim->linearization->mass, &mass));
  for (PetscInt r = 0; r < n; ++r) {
    PetscReal *normal = &rows->normal[3 * r], size = PairNorm(normal);

    if (!(size > 0.0)) continue;
    rows->area[r]     = PairNorm(&force[3 * r]);
    rows->share[r]    = rows->area[r] / size;
    rows->pressure[r] = sim->pressure[r];
    rows->gap[r]      = sim->gap[r] * PetscRealPart(mass[r]) / size;
    for (PetscInt c = 0; c < 3; ++c) normal[c] /= size;
  }
  PetscCall(VecRestoreArrayRead(sim->linearization->mass, &mass));
  PetscCall(PetscFree(force));
  PetscCall(PairRowsClose(sim, rows));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairRowsDestroy(PairRows *rows)
{
  PetscFunctionBegin;
  PetscCall(PetscFree6(rows->area, rows->share, rows->normal, rows->pressure, rows->gap, rows->closed));
  PetscFunctionReturn(0);
}

/*
   v[to] of the vertices B of both sides = sum of |mass_A cover_AB . n_A| share_A value_A, value NULL: 1. That is the integral of the rows' field by
   B's shape function, and sums to that of w_A value_A over a side
*/
static PetscErrorCode PairSpread(Simulation sim, const PairRows *rows, const PetscReal value[], Vec sides, PetscInt to, Vec v)
{
  ContactLinearization lin = sim->linearization;
  const PetscScalar   *t, *side, *mass;
  PetscScalar         *y, *a;
  PetscInt             n;
  Vec                  weighted, spread;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(lin->mass, &weighted));
  PetscCall(VecDuplicate(v, &spread));
  PetscCall(VecGetLocalSize(v, &n));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(VecGetArrayRead(lin->mass, &mass));
    PetscCall(VecGetArrayWrite(weighted, &y));
    for (PetscInt r = 0; r < rows->n; ++r) y[r] = mass[r] * rows->normal[3 * r + c] * rows->share[r] * (value ? value[r] : 1.0);
    PetscCall(VecRestoreArrayWrite(weighted, &y));
    PetscCall(VecRestoreArrayRead(lin->mass, &mass));
    PetscCall(MatMultTranspose(PairCover(lin), weighted, spread));
    PetscCall(VecGetArrayRead(spread, &t));
    PetscCall(VecGetArrayRead(sides, &side));
    PetscCall(VecGetArray(v, &a));
    for (PetscInt i = 0; i < n; i += 3) {
      if (PetscRealPart(side[i]) != 0.0) a[i + to] += side[i] * t[i + c];
    }
    PetscCall(VecRestoreArray(v, &a));
    PetscCall(VecRestoreArrayRead(sides, &side));
    PetscCall(VecRestoreArrayRead(spread, &t));
  }
  PetscCall(VecDestroy(&spread));
  PetscCall(VecDestroy(&weighted));
  PetscFunctionReturn(0);
}

/* J^T (mass x pressure) of the pair's rows */
static PetscErrorCode PairPlaceForces(Simulation sim, const PairRows *rows, Vec force)
{
  const PetscScalar *mass;
  PetscScalar       *y;
  Vec                weighted;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->linearization->mass, &weighted));
  PetscCall(VecGetArrayRead(sim->linearization->mass, &mass));
  PetscCall(VecGetArrayWrite(weighted, &y));
  for (PetscInt r = 0; r < rows->n; ++r) y[r] = mass[r] * rows->pressure[r];
  PetscCall(VecRestoreArrayWrite(weighted, &y));
  PetscCall(VecRestoreArrayRead(sim->linearization->mass, &mass));
  PetscCall(MatMultTranspose(sim->linearization->J, weighted, force));
  PetscCall(VecDestroy(&weighted));
  PetscFunctionReturn(0);
}

/* Both sides of a pair before anything is agglomerated */
static PetscErrorCode PairVerticesCreate(Simulation sim, PetscInt pair, const PairRows *rows, PairVertices *vertices)
{
  const SceneContactPair *faces = &sim->scene->pairs[pair];

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path.u, &vertices->carried));
  PetscCall(VecDuplicate(sim->path.u, &vertices->sides));
  PetscCall(VecDuplicate(sim->path.u, &vertices->force));
  PetscCall(VecZeroEntries(vertices->carried));
  PetscCall(VecZeroEntries(vertices->sides));
  PetscCall(PairVerticesMark(sim->dm, faces->mortar, 0, 1, vertices->sides));
  PetscCall(PairVerticesMark(sim->dm, faces->nonmortar, 0, -1, vertices->sides));
  PetscCall(PairSpread(sim, rows, NULL, vertices->sides, 0, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->pressure, vertices->sides, 1, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->gap, vertices->sides, 2, vertices->carried));
  PetscCall(PairSpread(sim, rows, rows->closed, vertices->sides, 1, vertices->sides));
  PetscCall(PairPlaceForces(sim, rows, vertices->force));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairVerticesDestroy(PairVertices *vertices)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&vertices->carried));
  PetscCall(VecDestroy(&vertices->sides));
  PetscCall(VecDestroy(&vertices->force));
  PetscFunctionReturn(0);
}

/* Appends the pair's points; alone: what they carried before it was agglomerated */
static PetscErrorCode PairAppendPoints(Simulation sim, PetscInt pair, const PairVertices *vertices, Vec alone)
{
  PetscSection       global;
  const PetscScalar *a, *b, *s, *f;
  PetscInt           pstart, pend, rstart, n, npoints = 0;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(PetscSectionGetChart(global, &pstart, &pend));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetLocalSize(alone, &n));
  PetscCall(VecGetArrayRead(vertices->carried, &a));
  PetscCall(VecGetArrayRead(alone, &b));
  PetscCall(VecGetArrayRead(vertices->sides, &s));
  PetscCall(VecGetArrayRead(vertices->force, &f));
  for (PetscInt i = 0; i < n; i += 3) npoints += PetscRealPart(b[i]) > 0.0;
  PetscCall(PetscRealloc((sim->npoints + npoints) * sizeof(ContactPoint), &sim->points));
  for (PetscInt v = pstart; v < pend; ++v) {
    ContactPoint *point;
    PetscInt      i, ndofs;

    PetscCall(PetscSectionGetDof(global, v, &ndofs));
    PetscCall(PetscSectionGetOffset(global, v, &i));
    i -= rstart;
    if (ndofs <= 0 || i < 0 || !(PetscRealPart(b[i]) > 0.0)) continue;
    point  = &sim->points[sim->npoints++];
    *point = (ContactPoint){.pair = pair, .vertex = v, .area = PetscRealPart(a[i]), .gap = PetscRealPart(b[i + 2] / b[i])};
    if (point->area > 0.0) {
      point->pressure = PetscRealPart(a[i + 1] / a[i]);
      point->gap      = PetscRealPart(a[i + 2] / a[i]);
    }
    for (PetscInt c = 0; c < 3; ++c) point->force[c] = PetscRealPart(f[i + c]);
    point->closed = (PetscBool)(2.0 * PetscRealPart(s[i + 1]) > PetscRealPart(b[i]));
  }
  PetscCall(VecRestoreArrayRead(vertices->force, &f));
  PetscCall(VecRestoreArrayRead(vertices->sides, &s));
  PetscCall(VecRestoreArrayRead(alone, &b));
  PetscCall(VecRestoreArrayRead(vertices->carried, &a));
  PetscFunctionReturn(0);
}

/* first: of the pair's points */
static PetscErrorCode PairReportPoints(Simulation sim, const PairRows *rows, PetscInt first, PairReport *report)
{
  PetscReal sums[2] = {0.0, 0.0}, largest = 0.0;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) {
    sums[0] += rows->area[r] * rows->pressure[r];
    sums[1] += rows->area[r] * rows->closed[r];
  }
  for (PetscInt k = first; k < sim->npoints; ++k) largest = PetscMax(largest, sim->points[k].pressure);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPIU_REAL, MPIU_SUM, sim->comm));
  PetscCallMPI(MPI_Allreduce(&largest, &report->pressure, 1, MPIU_REAL, MPIU_MAX, sim->comm));
  report->normal_force = sums[0];
  report->area         = sums[1];
  PetscFunctionReturn(0);
}

/* Collective */
PetscErrorCode ContactPointsMeasure(Simulation sim, StepReport *report)
{
  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(SIM_Forces, NULL, NULL, NULL, NULL));
  sim->npoints = 0;
  PetscCall(PetscFree(sim->points));
  for (PetscInt p = 0; sim->linearization && p < report->npairs; ++p) {
    const PetscInt first = sim->npoints;
    PairRows       rows;
    PairVertices   vertices;
    Vec            alone;

    PetscCall(PairRowsCreate(sim, p, &rows));
    PetscCall(PairVerticesCreate(sim, p, &rows, &vertices));
    PetscCall(VecDuplicate(vertices.carried, &alone));
    PetscCall(VecCopy(vertices.carried, alone));
    PetscCall(CoverEvenOut(sim, &sim->scene->pairs[p], vertices.carried));
    PetscCall(PairAppendPoints(sim, p, &vertices, alone));
    PetscCall(PairReportPoints(sim, &rows, first, &report->pairs[p]));
    PetscCall(VecDestroy(&alone));
    PetscCall(PairVerticesDestroy(&vertices));
    PetscCall(PairRowsDestroy(&rows));
  }
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
