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
#include "src/mesh/supports/supportsimpl.h"
#include "src/state/interrupt.h"

/*
   Linearizations of contact at the last state, from which rows are taken: with the usual search distance; and, if that
   has no suitable row, with a search distance of the size of the bodies, since a moving body may reach other faces, and
   with dual functions, whose forces may act at the edges of faces
*/
typedef enum { CONE_NEAR, CONE_FAR, CONE_KINDS } ConeKind;

/* Rates of gaps and slips in the free motions */
typedef struct {
  ContactLinearization lin;
  Mat                  gap, slip; /* one, and two rows per contact row; slip is NULL without friction */
} ConeRows;

/* Rays with n components each, and their factors. The sum of factor times ray is the nearest point found so far. */
typedef struct {
  PetscInt   n, nrays, nmax;
  PetscReal *ray, *normal;    /* rays; the same without friction */
  PetscReal *amount;          /* factor of each ray [force] */
  PetscInt   nfactored, ncap; /* number of rays in `Q` and `R`; number for which these have space */
  PetscReal *Q, *R;           /* QR factors of the matrix of the rays; column k of R has k + 1 numbers */
  ConeRows   rows[CONE_KINDS];
} ContactCone;

static PetscErrorCode ConeCreate(PetscInt n, ContactCone *cone)
{
  PetscFunctionBegin;
  *cone = (ContactCone){.n = n, .nmax = 20 * n + 100};
  PetscCall(PetscMalloc3(n * cone->nmax, &cone->ray, n * cone->nmax, &cone->normal, cone->nmax, &cone->amount));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConeDestroy(ContactCone *cone)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < CONE_KINDS; ++k) {
    PetscCall(ContactLinearizationDestroy(&cone->rows[k].lin));
    PetscCall(MatDestroy(&cone->rows[k].gap));
    PetscCall(MatDestroy(&cone->rows[k].slip));
  }
  PetscCall(PetscFree3(cone->ray, cone->normal, cone->amount));
  PetscCall(PetscFree(cone->Q));
  PetscCall(PetscFree(cone->R));
  PetscFunctionReturn(0);
}

/* Linearizes contact at the last state, and computes the rates of the rows in the free motions */
static PetscErrorCode ConeLinearize(Contact contact, const VertexPlaces *places, LoadPath *path, const FreeMotions *m,
  ConeKind kind, ConeRows *rows)
{
  ContactDualPairs used;
  PetscReal        extent;
  PetscBool        changed;

  PetscFunctionBegin;
  PetscCall(ContactGetDual(contact, &used));
  if (kind == CONE_FAR) {
    PetscCall(ContactSetDual(contact, CONTACT_DUAL_ALL, &changed));
    PetscCall(VecNorm(places->x, NORM_INFINITY, &extent));
    PetscCall(ContactSetReach(contact, 2.0 * PetscSqrtReal(3.0) * extent, 0.0));
  }
  PetscCall(ContactLinearize(contact, path->u, CONTACT_FORCES, &rows->lin));
  PetscCall(ContactSetReach(contact, 0.0, 0.0));
  PetscCall(ContactSetDual(contact, used, &changed));
  PetscCall(MatMatMult(rows->lin->J, m->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &rows->gap));
  if (rows->lin->slip) PetscCall(MatMatMult(rows->lin->slip, m->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &rows->slip));
  PetscFunctionReturn(0);
}

/*
   Computes the force of local row r that does the most negative work on a motion: normal and shear force. Pairs that
   stick, or have a shear limit, allow any friction force. *rate: its work, negative
*/
static PetscErrorCode ConeGetForce(Scene scene, PetscReal time, const ConeRows *rows, PetscInt r,
  const PetscReal motion[], PetscReal force[3], PetscReal *rate)
{
  PetscReal slip[2] = {0.0, 0.0}, size, mu, shear;
  PetscInt  first;

  PetscFunctionBegin;
  PetscCall(MatGetOwnershipRange(rows->gap, &first, NULL));
  PetscCall(FreeMotionsGetRate(rows->gap, first + r, motion, rate));
  for (PetscInt c = 0; c < 2 && rows->slip; ++c)
    PetscCall(FreeMotionsGetRate(rows->slip, 2 * (first + r) + c, motion, &slip[c]));
  size     = PetscSqrtReal(slip[0] * slip[0] + slip[1] * slip[1]);
  force[0] = 1.0;
  PetscCall(FrictionGetCoefficient(scene, time, rows->lin->pair[r], &mu));
  if (mu < PETSC_INFINITY) {
    shear = mu;
    *rate -= mu * size;
  } else if (-size < *rate) {
    /* this friction is not proportional to the normal force, and acts alone */
    shear    = 1.0;
    force[0] = 0.0;
    *rate    = -size;
  } else shear = 0.0;
  for (PetscInt c = 0; c < 2; ++c) force[1 + c] = size > 0.0 ? -shear * slip[c] / size : 0.0;
  PetscFunctionReturn(0);
}

/* Adds factor times row `row` of a matrix to a ray */
static PetscErrorCode ConeAddRow(Mat A, PetscInt row, PetscReal factor, PetscReal ray[])
{
  const PetscInt    *columns;
  const PetscScalar *values;
  PetscInt           n;

  PetscFunctionBegin;
  PetscCall(MatGetRow(A, row, &n, &columns, &values));
  for (PetscInt k = 0; k < n; ++k) ray[columns[k]] += factor * PetscRealPart(values[k]);
  PetscCall(MatRestoreRow(A, row, &n, &columns, &values));
  PetscFunctionReturn(0);
}

/*
   Appends the ray of the row whose force does the most negative work on a motion, the same on all ranks. *found: false
   if no force does at least the work `least`, which is negative; no ray is then appended
*/
static PetscErrorCode ConeAppend(MPI_Comm comm, Scene scene, PetscReal time, ContactCone *cone, const ConeRows *rows,
  const PetscReal motion[], PetscReal least, PetscBool *found)
{
  const PetscInt n   = cone->n;
  PetscReal     *ray = &cone->ray[n * cone->nrays], *normal = &cone->normal[n * cone->nrays], force[3] = {0.0};
  PetscInt       row = PETSC_DECIDE, first;
  PetscMPIInt    rank;
  struct {
    double value;
    int    rank;
  } best = {(double)least, 0};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  for (PetscInt r = 0; r < rows->lin->nlocal; ++r) {
    PetscReal own[3], rate;

    PetscCall(ConeGetForce(scene, time, rows, r, motion, own, &rate));
    if (rate >= best.value) continue;
    best.value = (double)rate;
    row        = r;
    PetscCall(PetscArraycpy(force, own, 3));
  }
  best.rank = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm));
  *found = (PetscBool)(best.value < least);
  if (!*found) PetscFunctionReturn(0);
  PetscCall(PetscArrayzero(ray, n));
  PetscCall(PetscArrayzero(normal, n));
  if (rank == best.rank) {
    PetscCall(MatGetOwnershipRange(rows->gap, &first, NULL));
    row += first;
    PetscCall(ConeAddRow(rows->gap, row, force[0], normal));
    PetscCall(PetscArraycpy(ray, normal, n));
    for (PetscInt c = 0; c < 2 && rows->slip; ++c) PetscCall(ConeAddRow(rows->slip, 2 * row + c, force[1 + c], ray));
  }
  PetscCallMPI(MPI_Bcast(ray, (PetscMPIInt)n, MPIU_REAL, best.rank, comm));
  PetscCallMPI(MPI_Bcast(normal, (PetscMPIInt)n, MPIU_REAL, best.rank, comm));
  cone->amount[cone->nrays++] = 0.0;
  PetscFunctionReturn(0);
}

static PetscReal ConeDot(PetscInt n, const PetscReal a[], const PetscReal b[])
{
  PetscReal sum = 0.0;

  for (PetscInt i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/* Computes product = A^T x. A: columns of n numbers each */
static void ConeDots(PetscInt n, PetscInt columns, const PetscReal A[], const PetscReal x[], PetscReal product[])
{
  for (PetscInt k = 0; k < columns; ++k) product[k] = ConeDot(n, &A[n * k], x);
}

/* Computes y += alpha A factor. A: columns of n numbers each */
static void ConeAdd(PetscInt n, PetscInt columns, const PetscReal A[], PetscReal alpha, const PetscReal factor[],
  PetscReal y[])
{
  for (PetscInt k = 0; k < columns; ++k) {
    for (PetscInt i = 0; i < n; ++i) y[i] += alpha * factor[k] * A[n * k + i];
  }
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
static PetscErrorCode ConeProject(Model model, State state, PetscReal time, const FreeMotions *m,
  const PetscReal load[], PetscReal size, ContactCone *cone, PetscReal left[], PetscBool *none)
{
  const PetscReal beyond = 1e3, negligible = model->springs.weak ? WEAK_SPRINGS_SHARE : 1e-7;
  const PetscInt  n = m->n;
  PetscBool       stop;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  for (PetscInt it = 0; it < cone->nmax && cone->nrays < cone->nmax && !*none; ++it) {
    PetscBool found = PETSC_FALSE;

    PetscCall(InterruptTest(model, state, &stop));
    if (stop) break;
    PetscCall(PetscArraycpy(left, load, n));
    ConeAdd(n, cone->nrays, cone->ray, 1.0, cone->amount, left);
    if (PetscSqrtReal(ConeDot(n, left, left)) <= negligible * size) break;
    for (ConeKind kind = CONE_NEAR; kind < CONE_KINDS && model->contact && !found; ++kind) {
      if (!cone->rows[kind].lin)
        PetscCall(ConeLinearize(model->contact, &model->places, state->path, m, kind, &cone->rows[kind]));
      PetscCall(ConeAppend(model->comm, model->scene, time, cone, &cone->rows[kind], left,
        -ConeDot(n, load, left) / (beyond * size), &found));
    }
    *none = (PetscBool)!found;
    if (found) PetscCall(ConeBalance(cone, load));
  }
  PetscFunctionReturn(0);
}

/*
   Removes from a motion the part that changes the gaps of the rows that carry a force. What remains is sliding. The
   motion is unchanged if nothing remains.
*/
static PetscErrorCode ConeSlide(const ContactCone *cone, PetscReal motion[])
{
  const PetscInt n = cone->n;
  PetscInt       nfree;
  PetscReal     *matrix, *slide, *along;

  PetscFunctionBegin;
  PetscCall(PetscCalloc3(n * n, &matrix, n, &slide, n, &along));
  for (PetscInt k = 0; k < cone->nrays; ++k) {
    const PetscReal *v = &cone->normal[n * k], square = ConeDot(n, v, v);

    for (PetscInt i = 0; i < n * n && square > 0.0; ++i) matrix[i] += v[i / n] * v[i % n] / square;
  }
  PetscCall(SupportFindNull(n, matrix, &nfree));
  ConeDots(n, nfree, matrix, motion, along);
  ConeAdd(n, nfree, matrix, 1.0, along, slide);
  if (ConeDot(n, slide, slide) > 1e-6 * ConeDot(n, motion, motion)) PetscCall(PetscArraycpy(motion, slide, n));
  PetscCall(PetscFree3(matrix, slide, along));
  PetscFunctionReturn(0);
}

/* Reports the motion of the bodies that contact does not hold. left: unbalanced load on the free motions. */
static PetscErrorCode EquilibriumReport(Model model, const FreeMotions *m, const ContactCone *cone, PetscReal left[],
  StepReport *report)
{
  Vec w;

  PetscFunctionBegin;
  PetscCall(ConeSlide(cone, left));
  PetscCall(VecDuplicate(model->places.x, &w));
  PetscCall(FreeMotionsDisplace(m, left, w));
  PetscCall(ReportReason(report, PETSC_FALSE,
    cone->rows[CONE_NEAR].slip ? "friction does not hold the bodies"
    : model->contact           ? "contact does not hold the bodies"
                               : "nothing holds the bodies"));
  PetscCall(RigidMotionReport(model, w, "nothing stops it", NULL, report));
  PetscCall(VecDestroy(&w));
  PetscFunctionReturn(0);
}

/* Rotates free rigid bodies, and the load on these bodies, back to the last state */
static PetscErrorCode EquilibriumTurnBack(Model model, State state, PetscReal time, Vec load)
{
  const Constraints constraints = ModelConstraints(model);
  PetscBool         anew;

  PetscFunctionBegin;
  PetscCall(RigidTurnLoads(&constraints, -1.0, time, load));
  PetscCall(TiesTurn(&constraints, time, state->path->u, state->path->u, &anew));
  PetscCall(RigidTurnLoads(&constraints, 1.0, time, load));
  PetscFunctionReturn(0);
}

/*
   Tests whether an equilibrium exists for the loads at `time` and the positions of the last state. *none: no
   equilibrium exists; the report then names the moving body and its motion. A signal ends the test, and *none is false.
*/
PetscErrorCode EquilibriumDiagnose(Model model, State state, PetscReal time, Vec force, StepReport *report,
  PetscBool *none)
{
  ContactCone cone;
  FreeMotions motions;
  PetscReal  *load, *left, size;
  PetscBool   stop;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  if (!force) PetscFunctionReturn(0);
  PetscCall(InterruptTest(model, state, &stop));
  if (stop) PetscFunctionReturn(0);
  PetscCall(EquilibriumTurnBack(model, state, time, force));
  PetscCall(NodalMagnitudesMeasure(force, &size, NULL));
  PetscCall(FreeMotionsCreate(model, state, &motions));
  if (motions.n && size > 0.0) {
    PetscCall(PetscMalloc2(motions.n, &load, motions.n, &left));
    PetscCall(ConeCreate(motions.n, &cone));
    PetscCall(FreeMotionsSum(&motions, force, load));
    PetscCall(ConeProject(model, state, time, &motions, load, size, &cone, left, none));
    if (*none) PetscCall(EquilibriumReport(model, &motions, &cone, left, report));
    PetscCall(ConeDestroy(&cone));
    PetscCall(PetscFree2(load, left));
  }
  PetscCall(FreeMotionsDestroy(&motions));
  PetscFunctionReturn(0);
}
