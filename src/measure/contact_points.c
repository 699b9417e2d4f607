/* Pressure, gap and status at the vertices of both sides of every pair. */
#include "measureimpl.h"

/*
   The rows of one pair: row A pushes its own side by z_A w_A n_A, w_A n_A = mass_A sum of J_AB over the vertices B of
   the mortar side. w_A is the area that the mortar side covers about A. Rows of other pairs have w = 0. Over vertices
   it is shared as the cover is, of which w_A is share_A times the sum, along the normal n_A that the cover has.
*/
typedef struct {
  PetscInt   n;
  PetscReal *area, *share, *normal; /* w [length^2]; 3 a row */
  PetscReal *pressure, *gap, *closed;
  PetscBool  rubs;  /* the pair has friction */
  PetscReal *slips; /* 1: its friction gives way */
  PetscReal *shear,
    *way; /* of friction, on the mortar side [force/length^2], and slip [length]; n values a component */
} PairRows;

/* What the vertices of the mesh have, as far as they are in the pair: [area, force, gap x area]; [1 mortar side, -1
   nonmortar, closed area, -]; force */
typedef struct {
  Vec carried, sides, force;
  Vec shear, way; /* of friction, on the mortar side [force], and slip x area; NULL without friction */
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
   A row is in contact where the strain that its pressure is worth is more than that which its gap would be: on the
   central path their product is the same at all rows, and tends to zero
*/
static PetscErrorCode PairRowsClose(Simulation sim, PairRows *rows)
{
  PetscReal size = 0.0, young = PETSC_MAX_REAL;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) size += rows->area[r];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &size, 1, MPIU_REAL, MPIU_SUM, sim->comm));
  size = PetscSqrtReal(size);
  for (PetscInt b = 0; b < sim->scene->nbodies; ++b) young = PetscMin(young, sim->scene->bodies[b].material.young);
  for (PetscInt r = 0; r < rows->n; ++r)
    rows->closed[r] = rows->area[r] > 0.0 && rows->pressure[r] / young > rows->gap[r] / size ? 1.0 : 0.0;
  PetscFunctionReturn(0);
}

/* Friction gives way where the slip is more than rounding makes of the displacements */
static PetscErrorCode PairRowsRub(Simulation sim, PetscInt pair, const PetscScalar mass[], PairRows *rows)
{
  const PetscReal      rounding = 1e-9;
  ContactLinearization lin      = sim->linearization;
  PetscReal            size;

  PetscFunctionBegin;
  PetscCall(VecNorm(sim->path.u, NORM_INFINITY, &size));
  PetscCall(PetscCalloc3(rows->n, &rows->slips, 3 * rows->n, &rows->shear, 3 * rows->n, &rows->way));
  for (PetscInt r = 0; r < rows->n; ++r) {
    const PetscReal *s = &sim->slip[2 * r], *f = &sim->shear[2 * r], *t = &lin->tangent[6 * r];

    if (lin->pair[r] != pair || !(rows->area[r] > 0.0)) continue;
    rows->slips[r] = rows->closed[r] > 0.0 && PetscSqr(s[0]) + PetscSqr(s[1]) > PetscSqr(rounding * size) ? 1.0 : 0.0;
    for (PetscInt c = 0; c < 3; ++c) {
      rows->shear[c * rows->n + r] = (f[0] * t[c] + f[1] * t[3 + c]) / PetscRealPart(mass[r]);
      rows->way[c * rows->n + r] =
        (s[0] * t[c] + s[1] * t[3 + c]) * PetscRealPart(mass[r]) * rows->share[r] / rows->area[r];
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode PairRowsCreate(Simulation sim, PetscInt pair, PairRows *rows)
{
  const PetscInt     n = sim->linearization->nlocal;
  const PetscScalar *mass;
  PetscReal         *force;

  PetscFunctionBegin;
  *rows =
    (PairRows){.n = n, .rubs = (PetscBool)(sim->linearization->slip && SceneContactPairRubs(&sim->scene->pairs[pair]))};
  PetscCall(PetscCalloc6(n, &rows->area, n, &rows->share, 3 * n, &rows->normal, n, &rows->pressure, n, &rows->gap, n,
    &rows->closed));
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
  PetscCall(PetscFree(force));
  PetscCall(PairRowsClose(sim, rows));
  if (rows->rubs) PetscCall(PairRowsRub(sim, pair, mass, rows));
  PetscCall(VecRestoreArrayRead(sim->linearization->mass, &mass));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairRowsDestroy(PairRows *rows)
{
  PetscFunctionBegin;
  if (rows->rubs) PetscCall(PetscFree3(rows->slips, rows->shear, rows->way));
  PetscCall(PetscFree6(rows->area, rows->share, rows->normal, rows->pressure, rows->gap, rows->closed));
  PetscFunctionReturn(0);
}

/*
   v[to] of the vertices B of both sides = sum of |mass_A cover_AB . n_A| share_A value_A, value NULL: 1. That is the
   integral of the rows' field by B's shape function, and sums to that of w_A value_A over a side
*/
static PetscErrorCode PairSpread(Simulation sim, const PairRows *rows, const PetscReal value[], Vec sides, PetscInt to,
  Vec v)
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
    for (PetscInt r = 0; r < rows->n; ++r)
      y[r] = mass[r] * rows->normal[3 * r + c] * rows->share[r] * (value ? value[r] : 1.0);
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

/* What friction has at the vertices, its forces among all, and in sides[2] the area that slips */
static PetscErrorCode PairVerticesRub(Simulation sim, PetscInt pair, const PairRows *rows, PairVertices *vertices)
{
  PetscScalar *f;
  Vec          force;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(sim->path.u, &vertices->shear));
  PetscCall(VecDuplicate(sim->path.u, &vertices->way));
  PetscCall(VecZeroEntries(vertices->shear));
  PetscCall(VecZeroEntries(vertices->way));
  PetscCall(PairSpread(sim, rows, rows->slips, vertices->sides, 2, vertices->sides));
  for (PetscInt c = 0; c < 3; ++c) {
    PetscCall(PairSpread(sim, rows, rows->shear + c * rows->n, vertices->sides, c, vertices->shear));
    PetscCall(PairSpread(sim, rows, rows->way + c * rows->n, vertices->sides, c, vertices->way));
  }
  PetscCall(MatCreateVecs(sim->linearization->slip, NULL, &force));
  PetscCall(VecGetArrayWrite(force, &f));
  for (PetscInt k = 0; k < 2 * rows->n; ++k) f[k] = sim->shear[k];
  PetscCall(VecRestoreArrayWrite(force, &f));
  PetscCall(FrictionAddForces(sim->linearization, force, pair, vertices->force));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

/* Both sides of a pair before anything is agglomerated */
static PetscErrorCode PairVerticesCreate(Simulation sim, PetscInt pair, const PairRows *rows, PairVertices *vertices)
{
  const SceneContactPair *faces = &sim->scene->pairs[pair];

  PetscFunctionBegin;
  vertices->shear = vertices->way = NULL;
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
  if (rows->rubs) PetscCall(PairVerticesRub(sim, pair, rows, vertices));
  PetscFunctionReturn(0);
}

static PetscErrorCode PairVerticesDestroy(PairVertices *vertices)
{
  PetscFunctionBegin;
  PetscCall(VecDestroy(&vertices->carried));
  PetscCall(VecDestroy(&vertices->sides));
  PetscCall(VecDestroy(&vertices->force));
  PetscCall(VecDestroy(&vertices->shear));
  PetscCall(VecDestroy(&vertices->way));
  PetscFunctionReturn(0);
}

/* A component of the shear in place of the pressure, handed on and evened out as that is, so that one stays within
   the other's law */
static PetscErrorCode PairShearPoints(Simulation sim, PetscInt pair, PetscInt first, const PairVertices *vertices,
  Vec alone, PetscInt component)
{
  PetscSection       global;
  const PetscScalar *shear, *a;
  PetscScalar       *carry;
  PetscInt           rstart, n;
  Vec                carried;

  PetscFunctionBegin;
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetLocalSize(alone, &n));
  PetscCall(VecDuplicate(alone, &carried));
  PetscCall(VecCopy(alone, carried));
  PetscCall(VecGetArrayRead(vertices->shear, &shear));
  PetscCall(VecGetArray(carried, &carry));
  for (PetscInt i = 0; i < n; i += 3) carry[i + 1] = shear[i + component];
  PetscCall(VecRestoreArray(carried, &carry));
  PetscCall(NodalPressureEvenOut(sim, &sim->scene->pairs[pair], carried));
  PetscCall(VecGetArrayRead(carried, &a));
  for (PetscInt k = first; k < sim->npoints; ++k) {
    ContactPoint *point = &sim->points[k];
    PetscInt      i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    if (point->area > 0.0) point->shear[component] = PetscRealPart(a[i + 1] / a[i]);
  }
  PetscCall(VecRestoreArrayRead(carried, &a));
  PetscCall(VecRestoreArrayRead(vertices->shear, &shear));
  PetscCall(VecDestroy(&carried));
  PetscFunctionReturn(0);
}

/* Shear and slip of the points from number `first` on, slip in the means of what the vertices have of the other
   side's cover, alone */
static PetscErrorCode PairRubPoints(Simulation sim, PetscInt pair, PetscInt first, const PairVertices *vertices,
  Vec alone)
{
  PetscSection          global;
  const ContactHistory *m = &sim->history;
  const PetscScalar    *area, *side, *way;
  PetscInt              rstart;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < 3; ++c) PetscCall(PairShearPoints(sim, pair, first, vertices, alone, c));
  PetscCall(DMGetGlobalSection(sim->dm, &global));
  PetscCall(VecGetOwnershipRange(alone, &rstart, NULL));
  PetscCall(VecGetArrayRead(alone, &area));
  PetscCall(VecGetArrayRead(vertices->sides, &side));
  PetscCall(VecGetArrayRead(vertices->way, &way));
  for (PetscInt k = first; k < sim->npoints; ++k) {
    ContactPoint *point = &sim->points[k];
    PetscInt      i;

    PetscCall(PetscSectionGetOffset(global, point->vertex, &i));
    i -= rstart;
    for (PetscInt c = 0; c < 3; ++c) {
      point->shear[c] *= PetscRealPart(side[i]);
      point->slip[c] = -PetscRealPart(side[i] * way[i + c] / area[i]);
    }
    point->slips     = (PetscBool)(point->closed && PetscRealPart(side[i + 2]) > 0.5 * PetscRealPart(side[i + 1]));
    point->slip_path = m->slip_path[point->pair * m->nowned + i / 3];
  }
  PetscCall(VecRestoreArrayRead(vertices->way, &way));
  PetscCall(VecRestoreArrayRead(vertices->sides, &side));
  PetscCall(VecRestoreArrayRead(alone, &area));
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
    point = &sim->points[sim->npoints++];
    *point =
      (ContactPoint){.pair = pair, .vertex = v, .area = PetscRealPart(a[i]), .gap = PetscRealPart(b[i + 2] / b[i])};
    if (point->area > 0.0) {
      point->pressure = PetscRealPart(a[i + 1] / a[i]);
      point->gap      = PetscRealPart(a[i + 2] / a[i]);
    }
    for (PetscInt c = 0; c < 3; ++c) point->force[c] = PetscRealPart(f[i + c]);
    point->closed = (PetscBool)(2.0 * PetscRealPart(s[i + 1]) >
                                (1.0 + PETSC_SQRT_MACHINE_EPSILON) *
                                  PetscRealPart(b[i])); /* half of it, but for rounding, is not enough */
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
  PetscReal sums[3] = {0.0, 0.0, 0.0}, largest = 0.0;

  PetscFunctionBegin;
  for (PetscInt r = 0; r < rows->n; ++r) {
    sums[0] += rows->area[r] * rows->pressure[r];
    sums[1] += rows->area[r] * rows->closed[r];
    if (rows->rubs) sums[2] += rows->area[r] * rows->slips[r];
  }
  for (PetscInt k = first; k < sim->npoints; ++k) largest = PetscMax(largest, sim->points[k].pressure);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPIU_REAL, MPIU_SUM, sim->comm));
  PetscCallMPI(MPI_Allreduce(&largest, &report->pressure, 1, MPIU_REAL, MPIU_MAX, sim->comm));
  report->normal_force = sums[0];
  report->area         = sums[1];
  report->slip_area    = sums[2];
  report->stick_area   = rows->rubs ? sums[1] - sums[2] : 0.0;
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
    PetscCall(NodalPressureEvenOut(sim, &sim->scene->pairs[p], vertices.carried));
    PetscCall(PairAppendPoints(sim, p, &vertices, alone));
    if (rows.rubs) PetscCall(PairRubPoints(sim, p, first, &vertices, alone));
    PetscCall(PairReportPoints(sim, &rows, first, &report->pairs[p]));
    PetscCall(VecDestroy(&alone));
    PetscCall(PairVerticesDestroy(&vertices));
    PetscCall(PairRowsDestroy(&rows));
  }
  PetscCall(PetscLogEventEnd(SIM_Forces, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}
