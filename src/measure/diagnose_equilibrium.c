/*
   Tests whether an equilibrium exists. Every contact row can exert a normal force, with as much friction as the law
   allows. The generalized forces of all rows on the free rigid motions of the bodies form a cone. A ray of the cone is
   the force of one row with one direction of friction. Contact can balance the loads only if the negative loads lie in
   this cone.
   The point of the cone nearest to the negative loads is found by adding rays one by one. The loads that the rays do
   not balance define a motion of the bodies. The next ray is that of the row whose force does the most negative work on
   this motion. If no row does negative work, and unbalanced loads remain, no contact resists the motion that they
   drive. There is then no equilibrium (Farkas' lemma).
*/
#include "measureimpl.h"
#include "src/state/interrupt.h"
#include "src/state/path.h"

#define EQUILIBRIUM_ROWS 3 /* number of linearizations whose rows form the cone */

/* Rays with n components each, and their factors. The sum of factor times ray is the nearest point found so far. */
typedef struct {
  PetscInt   n, nrays, nmax;
  PetscReal *ray, *normal;    /* rays; the same without friction */
  PetscReal *amount;          /* factor of each ray [force] */
  PetscInt   nfactored, ncap; /* number of rays in `Q` and `R`; number for which these have space */
  PetscReal *Q, *R;           /* QR factors of the matrix of the rays; column k of R has k + 1 numbers */
} ContactCone;

/* The row that resists a motion most, and its friction; the same on all ranks */
typedef struct {
  PetscReal rate;     /* work of the force below on the motion, negative */
  PetscInt  row;      /* global row; PETSC_DECIDE: there is none */
  PetscReal shear[2]; /* friction force */
  PetscReal normal;   /* normal force: 1; or 0 if the friction is not proportional to it, and acts alone */
} ConeRow;

static PetscErrorCode ConeAllocate(PetscInt n, ContactCone *cone)
{
  PetscFunctionBegin;
  *cone = (ContactCone){.n = n, .nmax = 20 * n + 100};
  PetscCall(PetscMalloc3(n * cone->nmax, &cone->ray, n * cone->nmax, &cone->normal, cone->nmax, &cone->amount));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConeFree(ContactCone *cone)
{
  PetscFunctionBegin;
  PetscCall(PetscFree3(cone->ray, cone->normal, cone->amount));
  PetscCall(PetscFree(cone->Q));
  PetscCall(PetscFree(cone->R));
  PetscFunctionReturn(0);
}

/*
   Finds the row whose force does the most negative work on the motion w. Pairs that stick, or have a shear limit, allow
   any friction force.
*/
static PetscErrorCode ConeFindRow(Simulation sim, PetscReal time, ContactLinearization lin, Vec w, ConeRow *found)
{
  Vec                rates, slips = NULL;
  const PetscScalar *a, *s        = NULL;
  PetscInt           first;
  struct {
    double value;
    int    rank;
  } best = {0.0, 0};
  PetscMPIInt rank;

  PetscFunctionBegin;
  *found = (ConeRow){.row = PETSC_DECIDE};
  PetscCall(VecDuplicate(lin->g, &rates));
  PetscCall(MatMult(lin->J, w, rates));
  if (lin->slip) {
    PetscCall(MatCreateVecs(lin->slip, NULL, &slips));
    PetscCall(MatMult(lin->slip, w, slips));
    PetscCall(VecGetArrayRead(slips, &s));
  }
  PetscCall(VecGetOwnershipRange(rates, &first, NULL));
  PetscCall(VecGetArrayRead(rates, &a));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const PetscReal slip[2] = {s ? PetscRealPart(s[2 * r]) : 0.0, s ? PetscRealPart(s[2 * r + 1]) : 0.0};
    const PetscReal size    = PetscSqrtReal(slip[0] * slip[0] + slip[1] * slip[1]);
    PetscReal       mu, rate = PetscRealPart(a[r]);
    PetscBool       alone = PETSC_FALSE;

    PetscCall(FrictionGetCoefficient(sim->scene, time, lin->pair[r], &mu));
    if (mu < PETSC_INFINITY) rate -= mu * size;
    else if (-size < rate) {
      rate  = -size;
      alone = PETSC_TRUE;
    } else mu = 0.0;
    if (found->row >= 0 && rate >= found->rate) continue;
    *found = (ConeRow){.rate = rate, .row = first + r, .normal = alone ? 0.0 : 1.0};
    for (PetscInt c = 0; size > 0.0 && c < 2; ++c) found->shear[c] = -(alone ? 1.0 : mu) * slip[c] / size;
  }
  PetscCall(VecRestoreArrayRead(rates, &a));
  if (slips) PetscCall(VecRestoreArrayRead(slips, &s));
  PetscCall(VecDestroy(&slips));
  PetscCall(VecDestroy(&rates));
  PetscCallMPI(MPI_Comm_rank(sim->comm, &rank));
  best.value = found->row >= 0 ? (double)found->rate : (double)PETSC_MAX_REAL;
  best.rank  = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MINLOC, sim->comm));
  PetscCallMPI(MPI_Bcast(found, (PetscMPIInt)sizeof(*found), MPI_BYTE, best.rank, sim->comm));
  PetscFunctionReturn(0);
}

/*
   Computes the ray of a row: the generalized force on the free motions of a unit of its force. shear: whether friction
   is included.
*/
static PetscErrorCode ConeGetRay(const FreeMotions *m, ContactLinearization lin, const ConeRow *row, PetscBool shear,
  PetscReal ray[])
{
  Vec      unit, force;
  PetscInt first, end;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(m->x, &force));
  PetscCall(VecDuplicate(lin->g, &unit));
  PetscCall(VecZeroEntries(unit));
  PetscCall(VecGetOwnershipRange(unit, &first, &end));
  if (row->row >= first && row->row < end) PetscCall(VecSetValue(unit, row->row, row->normal, INSERT_VALUES));
  PetscCall(VecAssemblyBegin(unit));
  PetscCall(VecAssemblyEnd(unit));
  PetscCall(MatMultTranspose(lin->J, unit, force));
  PetscCall(VecDestroy(&unit));
  if (lin->slip && shear) {
    PetscCall(MatCreateVecs(lin->slip, NULL, &unit));
    PetscCall(VecZeroEntries(unit));
    for (PetscInt c = 0; c < 2; ++c) {
      if (row->row >= first && row->row < end)
        PetscCall(VecSetValue(unit, 2 * row->row + c, row->shear[c], INSERT_VALUES));
    }
    PetscCall(VecAssemblyBegin(unit));
    PetscCall(VecAssemblyEnd(unit));
    PetscCall(MatMultTransposeAdd(lin->slip, unit, force, force));
    PetscCall(VecDestroy(&unit));
  }
  PetscCall(FreeMotionsSum(m, force, ray));
  PetscCall(VecDestroy(&force));
  PetscFunctionReturn(0);
}

static PetscReal ConeDot(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

#define CONE_BLOCK 4 /* number of columns that are multiplied together, which is faster than one by one */

/* Computes A^T x. A: columns of n numbers each */
static void ConeDots(PetscInt n, PetscInt columns, const PetscReal A[], const PetscReal x[], PetscReal product[])
{
  PetscInt k = 0;

  for (; k + CONE_BLOCK <= columns; k += CONE_BLOCK) {
    const PetscReal *a  = &A[n * k];
    PetscReal        s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;

    for (PetscInt i = 0; i < n; ++i) {
      s0 += a[i] * x[i];
      s1 += a[n + i] * x[i];
      s2 += a[2 * n + i] * x[i];
      s3 += a[3 * n + i] * x[i];
    }
    product[k]     = s0;
    product[k + 1] = s1;
    product[k + 2] = s2;
    product[k + 3] = s3;
  }
  for (; k < columns; ++k) product[k] = ConeDot(n, &A[n * k], x);
}

/* Computes y += alpha A factor. A: columns of n numbers each */
static void ConeAdd(PetscInt n, PetscInt columns, const PetscReal A[], PetscReal alpha, const PetscReal factor[],
  PetscReal y[])
{
  PetscInt k = 0;

  for (; k + CONE_BLOCK <= columns; k += CONE_BLOCK) {
    const PetscReal *a = &A[n * k], f0 = alpha * factor[k], f1 = alpha * factor[k + 1], f2 = alpha * factor[k + 2],
                    f3 = alpha * factor[k + 3];

    for (PetscInt i = 0; i < n; ++i) y[i] += f0 * a[i] + f1 * a[n + i] + f2 * a[2 * n + i] + f3 * a[3 * n + i];
  }
  for (; k < columns; ++k)
    for (PetscInt i = 0; i < n; ++i) y[i] += alpha * factor[k] * A[n * k + i];
}

/* Computes the unbalanced load: left = load + the sum of factor times ray */
static PetscErrorCode ConeSubtract(const ContactCone *cone, const PetscReal load[], PetscReal left[])
{
  PetscFunctionBegin;
  PetscCall(PetscArraycpy(left, load, cone->n));
  ConeAdd(cone->n, cone->nrays, cone->ray, 1.0, cone->amount, left);
  PetscFunctionReturn(0);
}

static PetscReal *ConeColumn(const ContactCone *cone, PetscInt ray)
{
  return cone->R + ray * (ray + 1) / 2;
}

/* Updates the QR factors for the rays that were added since the last call */
static PetscErrorCode ConeOrthogonalize(ContactCone *cone)
{
  const PetscInt  n         = cone->n;
  const PetscReal dependent = 1e-12, again = 0.01;
  PetscReal      *along;

  PetscFunctionBegin;
  if (cone->ncap < cone->nrays) {
    cone->ncap = 2 * cone->nrays;
    PetscCall(PetscRealloc(sizeof(PetscReal) * (size_t)(n * cone->ncap), &cone->Q));
    PetscCall(PetscRealloc(sizeof(PetscReal) * (size_t)(cone->ncap * (cone->ncap + 1) / 2), &cone->R));
  }
  PetscCall(PetscMalloc1(cone->nrays, &along));
  for (; cone->nfactored < cone->nrays; ++cone->nfactored) {
    const PetscInt k = cone->nfactored;
    PetscReal     *q = &cone->Q[n * k], *R = ConeColumn(cone, k), whole, remainder;

    PetscCall(PetscArraycpy(q, &cone->ray[n * k], n));
    whole = ConeDot(n, q, q);
    PetscCall(PetscArrayzero(R, k));
    remainder = whole;
    for (PetscInt pass = 0; pass < 2; ++pass) { /* the second pass removes the rounding errors of a small remainder */
      if (pass && remainder > again * whole) break;
      ConeDots(n, k, cone->Q, q, along);
      ConeAdd(n, k, cone->Q, -1.0, along, q);
      for (PetscInt j = 0; j < k; ++j) R[j] += along[j];
      remainder = ConeDot(n, q, q);
    }
    R[k] = remainder > dependent * whole ? PetscSqrtReal(remainder) : 0.0;
    for (PetscInt i = 0; i < n; ++i) q[i] = R[k] > 0.0 ? q[i] / R[k] : 0.0;
  }
  PetscCall(PetscFree(along));
  PetscFunctionReturn(0);
}

/* Computes the factors, of any sign, for which the unbalanced load is smallest */
static PetscErrorCode ConeSolve(ContactCone *cone, const PetscReal load[], PetscReal amount[])
{
  PetscFunctionBegin;
  PetscCall(ConeOrthogonalize(cone));
  ConeDots(cone->n, cone->nrays, cone->Q, load, amount);
  for (PetscInt k = 0; k < cone->nrays; ++k) amount[k] = -amount[k];
  for (PetscInt k = cone->nrays - 1; k >= 0; --k) {
    const PetscReal *R = ConeColumn(cone, k);

    amount[k] = R[k] > 0.0 ? amount[k] / R[k] : 0.0;
    for (PetscInt j = 0; j < k; ++j) amount[j] -= R[j] * amount[k];
  }
  PetscFunctionReturn(0);
}

/* Removes rays whose factor is zero */
static void ConeDrop(ContactCone *cone)
{
  PetscReal largest = 0.0;
  PetscInt  kept    = 0;

  for (PetscInt k = 0; k < cone->nrays; ++k) largest = PetscMax(largest, cone->amount[k]);
  for (PetscInt k = 0; k < cone->nrays; ++k) {
    if (cone->amount[k] <= 1e-14 * largest) {
      cone->nfactored = PetscMin(cone->nfactored, kept);
      continue;
    }
    cone->amount[kept] = cone->amount[k];
    for (PetscInt i = 0; i < cone->n; ++i) {
      cone->ray[cone->n * kept + i]    = cone->ray[cone->n * k + i];
      cone->normal[cone->n * kept + i] = cone->normal[cone->n * k + i];
    }
    ++kept;
  }
  cone->nrays = kept;
}

/*
   Computes the non-negative factors for which the unbalanced load is smallest (Lawson and Hanson's algorithm)
*/
static PetscErrorCode ConeBalance(ContactCone *cone, const PetscReal load[])
{
  PetscReal *wanted, part = 0.0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(cone->nmax, &wanted));
  while (part < 1.0 && cone->nrays) {
    PetscCall(ConeSolve(cone, load, wanted));
    part = 1.0;
    for (PetscInt k = 0; k < cone->nrays; ++k) {
      if (wanted[k] < 0.0) part = PetscMin(part, cone->amount[k] / (cone->amount[k] - wanted[k]));
    }
    for (PetscInt k = 0; k < cone->nrays; ++k) {
      cone->amount[k] += part * (wanted[k] - cone->amount[k]);
      if (part < 1.0 && wanted[k] < 0.0 && cone->amount[k] <= 1e-14 * -wanted[k]) cone->amount[k] = 0.0;
    }
    if (part < 1.0) ConeDrop(cone);
  }
  PetscCall(PetscFree(wanted));
  PetscFunctionReturn(0);
}

/*
   Computes `left`, the loads that contact forces cannot balance. size: sum of the magnitudes of the nodal loads.
   *none: no equilibrium exists, or only one with contact forces of more than a thousand times the loads.
*/
static PetscErrorCode ConeProject(PetscReal time, const FreeMotions *m, PetscInt nlins, ContactLinearization lins[],
  const PetscReal load[], PetscReal size, ContactCone *cone, PetscReal left[], PetscBool *none)
{
  const PetscReal beyond = 1e3, negligible = 1e-7;
  const PetscInt  n = m->n;
  PetscBool       stop;
  Vec             w;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  PetscCall(VecDuplicate(m->x, &w));
  for (PetscInt it = 0; it < cone->nmax && cone->nrays < cone->nmax; ++it) {
    ConeRow  row, best = {.row = PETSC_DECIDE};
    PetscInt of = 0;

    PetscCall(InterruptTest(m->sim, &stop));
    if (stop) break;
    PetscCall(ConeSubtract(cone, load, left));
    if (PetscSqrtReal(ConeDot(n, left, left)) <= negligible * size) break;
    PetscCall(FreeMotionsDisplace(m, left, w));
    for (PetscInt l = 0; l < nlins; ++l) {
      PetscCall(ConeFindRow(m->sim, time, lins[l], w, &row));
      if (row.row >= 0 && (best.row < 0 || row.rate < best.rate)) {
        best = row;
        of   = l;
      }
    }
    *none = (PetscBool)(best.row < 0 || best.rate >= -ConeDot(n, load, left) / (beyond * size));
    if (*none) break;
    PetscCall(ConeGetRay(m, lins[of], &best, PETSC_TRUE, &cone->ray[n * cone->nrays]));
    PetscCall(ConeGetRay(m, lins[of], &best, PETSC_FALSE, &cone->normal[n * cone->nrays]));
    cone->amount[cone->nrays++] = 0.0;
    PetscCall(ConeBalance(cone, load));
  }
  PetscCall(VecDestroy(&w));
  PetscFunctionReturn(0);
}

/* Removes from a motion the part that changes the gaps of the rows that carry a force. What remains is sliding. */
static void ConeSlide(const ContactCone *cone, PetscReal motion[])
{
  const PetscInt n   = cone->n;
  PetscReal     *own = cone->normal;

  for (PetscInt k = 0; k < cone->nrays; ++k) {
    PetscReal *v = &own[n * k], whole = ConeDot(n, v, v), remainder;

    for (PetscInt pass = 0; pass < 2; ++pass) {
      for (PetscInt j = 0; j < k; ++j) {
        const PetscReal along = ConeDot(n, v, &own[n * j]);

        for (PetscInt i = 0; i < n; ++i) v[i] -= along * own[n * j + i];
      }
    }
    remainder = ConeDot(n, v, v);
    for (PetscInt i = 0; i < n; ++i) v[i] = remainder > 1e-12 * whole ? v[i] / PetscSqrtReal(remainder) : 0.0;
  }
  for (PetscInt k = 0; k < cone->nrays; ++k) {
    const PetscReal along = ConeDot(n, motion, &own[n * k]);

    for (PetscInt i = 0; i < n; ++i) motion[i] -= along * own[n * k + i];
  }
}

/*
   Linearizes contact at the last state three times: with the usual search distance; with dual functions, whose forces
   may act at the edges of faces; and with a search distance of the size of the bodies, since a moving body may reach
   other faces
*/
static PetscErrorCode EquilibriumLinearize(const FreeMotions *m, ContactLinearization lins[EQUILIBRIUM_ROWS])
{
  Simulation       sim = m->sim;
  ContactDualPairs used;
  PetscReal        extent;
  PetscBool        changed;

  PetscFunctionBegin;
  PetscCall(ContactGetDual(sim->contact, &used));
  PetscCall(VecNorm(m->x, NORM_INFINITY, &extent));
  PetscCall(ContactLinearizeForces(sim->contact, sim->path->u, &lins[0]));
  PetscCall(ContactSetDual(sim->contact, CONTACT_DUAL_ALL, &changed));
  PetscCall(ContactLinearizeForces(sim->contact, sim->path->u, &lins[1]));
  PetscCall(ContactSetReach(sim->contact, 2.0 * PetscSqrtReal(3.0) * extent, 0.0));
  PetscCall(ContactLinearizeForces(sim->contact, sim->path->u, &lins[2]));
  PetscCall(ContactSetReach(sim->contact, 0.0, 0.0));
  PetscCall(ContactSetDual(sim->contact, used, &changed));
  PetscFunctionReturn(0);
}

/* Reports the motion of the bodies that contact does not hold. left: unbalanced load on the free motions. */
static PetscErrorCode EquilibriumReport(const FreeMotions *m, const ContactCone *cone, const PetscReal left[],
  PetscBool frictional, StepReport *report)
{
  PetscReal *motion, whole = ConeDot(m->n, left, left);
  Vec        w;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(m->n, &motion));
  PetscCall(PetscArraycpy(motion, left, m->n));
  ConeSlide(cone, motion);
  PetscCall(VecDuplicate(m->x, &w));
  PetscCall(FreeMotionsDisplace(m, ConeDot(m->n, motion, motion) > 1e-6 * whole ? motion : left, w));
  if (frictional) PetscCall(ReportReason(report, PETSC_FALSE, "friction does not hold the bodies"));
  PetscCall(RigidMotionReport(m->sim, w, "nothing stops it", NULL, report));
  PetscCall(VecDestroy(&w));
  PetscCall(PetscFree(motion));
  PetscFunctionReturn(0);
}

/* Rotates free rigid bodies, and the load on these bodies, back to the last state */
static PetscErrorCode EquilibriumTurnBack(Simulation sim, PetscReal time, Vec load)
{
  const Constraints constraints = SimulationConstraints(sim);
  PetscBool         anew;

  PetscFunctionBegin;
  PetscCall(RigidTurnLoads(&constraints, -1.0, time, load));
  PetscCall(TiesTurn(&constraints, time, sim->path->u, sim->path->u, &anew));
  PetscCall(RigidTurnLoads(&constraints, 1.0, time, load));
  PetscFunctionReturn(0);
}

/*
   Tests, after a solve failed, whether an equilibrium exists for the loads at `time` and the positions of the last
   state. *none: no equilibrium exists; the report then names the moving body and its motion. A signal ends the test,
   and *none is false.
*/
PetscErrorCode EquilibriumDiagnose(Simulation sim, PetscReal time, Vec force, StepReport *report, PetscBool *none)
{
  ContactLinearization lins[EQUILIBRIUM_ROWS];
  ContactCone          cone;
  FreeMotions          motions;
  PetscReal           *load, *left, size;
  PetscBool            stop;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  if (!sim->contact || !force) PetscFunctionReturn(0);
  PetscCall(InterruptTest(sim, &stop));
  if (stop) PetscFunctionReturn(0);
  PetscCall(EquilibriumTurnBack(sim, time, force));
  PetscCall(NodalMagnitudesMeasure(force, &size, NULL));
  PetscCall(FreeMotionsCreate(sim, &motions));
  if (motions.n && size > 0.0) {
    PetscCall(PetscMalloc2(motions.n, &load, motions.n, &left));
    PetscCall(ConeAllocate(motions.n, &cone));
    PetscCall(EquilibriumLinearize(&motions, lins));
    PetscCall(FreeMotionsSum(&motions, force, load));
    PetscCall(ConeProject(time, &motions, EQUILIBRIUM_ROWS, lins, load, size, &cone, left, none));
    if (*none) PetscCall(EquilibriumReport(&motions, &cone, left, (PetscBool)(lins[0]->slip != NULL), report));
    for (PetscInt l = 0; l < EQUILIBRIUM_ROWS; ++l) PetscCall(ContactLinearizationDestroy(&lins[l]));
    PetscCall(ConeFree(&cone));
    PetscCall(PetscFree2(load, left));
  }
  PetscCall(FreeMotionsDestroy(&motions));
  PetscFunctionReturn(0);
}
