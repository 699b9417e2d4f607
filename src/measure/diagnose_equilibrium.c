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

/*
   Linearizations of contact at the last state, from which rows are taken: with the usual search distance; and, if that
   has no suitable row, with a search distance of the size of the bodies, since a moving body may reach other faces, and
   with dual functions, whose forces may act at the edges of faces
*/
typedef enum { CONE_NEAR, CONE_FAR, CONE_KINDS } ConeKind;

/* Rates of gaps and slips in the free motions; and a number per row, which is a rate or a force */
typedef struct {
  ContactLinearization lin;
  Mat                  gap, slip; /* one, and two rows per contact row; slip is NULL without friction */
  Vec                  gaps, slips;
} ConeRows;

/* Rays in the space of the free motions. The sum of factor times ray is the nearest point found so far. */
typedef struct {
  PetscInt   nrays, nmax;
  Vec       *ray, *normal; /* [nmax] rays, which are independent; the same without friction */
  PetscReal *amount;       /* factor of each ray [force] */
  PetscInt   nfactored;    /* number of rays in `Q` and `R` */
  Vec       *Q;            /* QR factors of the matrix of the rays */
  PetscReal *R;            /* column k begins at nmax k */
  ConeRows   rows[CONE_KINDS];
} ContactCone;

static PetscErrorCode ConeCreate(PetscInt nmax, ContactCone *cone)
{
  PetscFunctionBegin;
  *cone = (ContactCone){.nmax = nmax};
  PetscCall(PetscCalloc4(nmax, &cone->ray, nmax, &cone->normal, nmax, &cone->Q, nmax, &cone->amount));
  PetscCall(PetscMalloc1(nmax * nmax, &cone->R));
  PetscFunctionReturn(0);
}

static PetscErrorCode ConeDestroy(ContactCone *cone)
{
  PetscFunctionBegin;
  for (PetscInt k = 0; k < CONE_KINDS; ++k) {
    PetscCall(ContactLinearizationDestroy(&cone->rows[k].lin));
    PetscCall(MatDestroy(&cone->rows[k].gap));
    PetscCall(MatDestroy(&cone->rows[k].slip));
    PetscCall(VecDestroy(&cone->rows[k].gaps));
    PetscCall(VecDestroy(&cone->rows[k].slips));
  }
  for (PetscInt k = 0; k < cone->nmax; ++k) {
    PetscCall(VecDestroy(&cone->ray[k]));
    PetscCall(VecDestroy(&cone->normal[k]));
    PetscCall(VecDestroy(&cone->Q[k]));
  }
  PetscCall(PetscFree4(cone->ray, cone->normal, cone->Q, cone->amount));
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
  PetscCall(MatCreateVecs(rows->gap, NULL, &rows->gaps));
  if (!rows->lin->slip) PetscFunctionReturn(0);
  PetscCall(MatMatMult(rows->lin->slip, m->Z, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &rows->slip));
  PetscCall(MatCreateVecs(rows->slip, NULL, &rows->slips));
  PetscFunctionReturn(0);
}

/*
   Computes the force of local row r that does the most negative work on a motion with given slip rates: normal and
   shear force. Pairs that stick, or have a shear limit, allow any friction force. *rate: the rate of the gap; on exit
   the work, negative
*/
static PetscErrorCode ConeGetForce(Scene scene, PetscReal time, const ConeRows *rows, PetscInt r,
  const PetscReal slip[2], PetscReal force[3], PetscReal *rate)
{
  const PetscReal size = PetscSqrtReal(slip[0] * slip[0] + slip[1] * slip[1]);
  PetscReal       mu, shear;

  PetscFunctionBegin;
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

/*
   Replaces the rates of the rows by the force of that row whose force does the most negative work, and zero for all
   others. *found: false if no force does at least the work `least`, which is negative
*/
static PetscErrorCode ConeChoose(MPI_Comm comm, Scene scene, PetscReal time, ConeRows *rows, PetscReal least,
  PetscBool *found)
{
  PetscReal    force[3] = {0.0};
  PetscScalar *gap, *slip = NULL;
  PetscInt     row = PETSC_DECIDE;
  PetscMPIInt  rank;
  struct {
    double value;
    int    rank;
  } best = {(double)least, 0};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_rank(comm, &rank));
  PetscCall(VecGetArray(rows->gaps, &gap));
  if (rows->slip) PetscCall(VecGetArray(rows->slips, &slip));
  for (PetscInt r = 0; r < rows->lin->nlocal; ++r) {
    const PetscReal slips[2] = {slip ? PetscRealPart(slip[2 * r]) : 0.0, slip ? PetscRealPart(slip[2 * r + 1]) : 0.0};
    PetscReal       own[3] = {0.0}, rate = PetscRealPart(gap[r]);

    gap[r] = 0.0;
    for (PetscInt c = 0; c < 2 && slip; ++c) slip[2 * r + c] = 0.0;
    PetscCall(ConeGetForce(scene, time, rows, r, slips, own, &rate));
    if (rate >= best.value) continue;
    best.value = (double)rate;
    row        = r;
    PetscCall(PetscArraycpy(force, own, 3));
  }
  best.rank = rank;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &best, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm));
  *found = (PetscBool)(best.value < least);
  if (*found && rank == best.rank) {
    gap[row] = force[0];
    for (PetscInt c = 0; c < 2 && slip; ++c) slip[2 * row + c] = force[1 + c];
  }
  if (rows->slip) PetscCall(VecRestoreArray(rows->slips, &slip));
  PetscCall(VecRestoreArray(rows->gaps, &gap));
  PetscFunctionReturn(0);
}

/* Appends the ray of the row that ConeChoose() finds for a motion, the same on all ranks */
static PetscErrorCode ConeAppend(const FreeMotions *m, Scene scene, PetscReal time, ContactCone *cone, ConeRows *rows,
  Vec motion, PetscReal least, PetscBool *found)
{
  const PetscInt k = cone->nrays;

  PetscFunctionBegin;
  PetscCall(FreeMotionsMultiply(m, rows->gap, motion, rows->gaps));
  if (rows->slip) PetscCall(FreeMotionsMultiply(m, rows->slip, motion, rows->slips));
  PetscCall(ConeChoose(PetscObjectComm((PetscObject)m->Z), scene, time, rows, least, found));
  if (!*found) PetscFunctionReturn(0);
  if (!cone->ray[k]) PetscCall(VecDuplicate(motion, &cone->ray[k]));
  if (!cone->normal[k]) PetscCall(VecDuplicate(motion, &cone->normal[k]));
  if (!cone->Q[k]) PetscCall(VecDuplicate(motion, &cone->Q[k]));
  PetscCall(FreeMotionsSum(m, rows->gap, rows->gaps, cone->normal[k]));
  PetscCall(VecZeroEntries(cone->ray[k]));
  if (rows->slip) PetscCall(FreeMotionsSum(m, rows->slip, rows->slips, cone->ray[k]));
  PetscCall(VecAXPY(cone->ray[k], 1.0, cone->normal[k]));
  cone->amount[cone->nrays++] = 0.0;
  PetscFunctionReturn(0);
}

/* Updates the QR factors for the vectors that were added since the last call. dependent: a vector whose square has a
   smaller part across all others counts as dependent */
static PetscErrorCode ConeOrthogonalize(ContactCone *cone, Vec vectors[], PetscReal dependent)
{
  PetscReal *along;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(cone->nmax, &along));
  for (; cone->nfactored < cone->nrays; ++cone->nfactored) {
    const PetscInt k = cone->nfactored;
    PetscReal     *R = &cone->R[cone->nmax * k], whole;

    PetscCall(VecCopy(vectors[k], cone->Q[k]));
    PetscCall(VecNorm(cone->Q[k], NORM_2, &whole));
    PetscCall(PetscArrayzero(R, k));
    for (PetscInt pass = 0; pass < 2; ++pass) { /* the second pass removes the rounding errors of a small remainder */
      PetscCall(VecMDot(cone->Q[k], k, cone->Q, along));
      for (PetscInt j = 0; j < k; ++j) {
        R[j] += along[j];
        along[j] = -along[j];
      }
      PetscCall(VecMAXPY(cone->Q[k], k, along, cone->Q));
    }
    PetscCall(VecNormalize(cone->Q[k], &R[k]));
    if (PetscSqr(R[k]) > dependent * PetscSqr(whole)) continue;
    PetscCall(VecZeroEntries(cone->Q[k]));
    R[k] = 0.0;
  }
  PetscCall(PetscFree(along));
  PetscFunctionReturn(0);
}

/* Computes the factors, of any sign, for which the unbalanced load is smallest */
static PetscErrorCode ConeSolve(ContactCone *cone, Vec load, PetscReal amount[])
{
  PetscFunctionBegin;
  PetscCall(ConeOrthogonalize(cone, cone->ray, 1e-12));
  PetscCall(VecMDot(load, cone->nrays, cone->Q, amount));
  for (PetscInt k = cone->nrays - 1; k >= 0; --k) {
    const PetscReal *R = &cone->R[cone->nmax * k];

    amount[k] = R[k] > 0.0 ? amount[k] / R[k] : 0.0;
    for (PetscInt j = 0; j < k; ++j) amount[j] -= R[j] * amount[k];
  }
  for (PetscInt k = 0; k < cone->nrays; ++k) amount[k] = -amount[k];
  PetscFunctionReturn(0);
}

static void ConeSwap(Vec v[], PetscInt i, PetscInt j)
{
  const Vec other = v[i];

  v[i] = v[j];
  v[j] = other;
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
    ConeSwap(cone->ray, kept, k);
    ConeSwap(cone->normal, kept++, k);
  }
  cone->nrays = kept;
}

/*
   Computes the non-negative factors for which the unbalanced load is smallest (Lawson and Hanson's algorithm)
*/
static PetscErrorCode ConeBalance(ContactCone *cone, Vec load)
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
static PetscErrorCode ConeProject(Model model, State state, PetscReal time, const FreeMotions *m, Vec load,
  PetscReal size, ContactCone *cone, Vec left, PetscBool *none)
{
  const PetscReal beyond = 1e3, negligible = model->springs.weak ? WEAK_SPRINGS_SHARE : 1e-7;
  PetscReal       norm, along;
  PetscBool       stop;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  for (PetscInt it = 0; it < 20 * m->n + 100 && cone->nrays < cone->nmax && !*none; ++it) {
    PetscBool found = PETSC_FALSE;

    PetscCall(InterruptTest(model, state, &stop));
    if (stop) break;
    PetscCall(VecCopy(load, left));
    PetscCall(VecMAXPY(left, cone->nrays, cone->amount, cone->ray));
    PetscCall(VecNorm(left, NORM_2, &norm));
    if (norm <= negligible * size) break;
    PetscCall(VecDot(load, left, &along));
    for (ConeKind kind = CONE_NEAR; kind < CONE_KINDS && model->contact && !found; ++kind) {
      if (!cone->rows[kind].lin)
        PetscCall(ConeLinearize(model->contact, &model->places, state->path, m, kind, &cone->rows[kind]));
      PetscCall(ConeAppend(m, model->scene, time, cone, &cone->rows[kind], left, -along / (beyond * size), &found));
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
static PetscErrorCode ConeSlide(ContactCone *cone, Vec motion)
{
  PetscReal *along, before, after;
  Vec        slide;

  PetscFunctionBegin;
  cone->nfactored = 0;
  PetscCall(ConeOrthogonalize(cone, cone->normal, 1e-9));
  PetscCall(PetscMalloc1(cone->nmax, &along));
  PetscCall(VecDuplicate(motion, &slide));
  PetscCall(VecCopy(motion, slide));
  PetscCall(VecMDot(motion, cone->nrays, cone->Q, along));
  for (PetscInt k = 0; k < cone->nrays; ++k) along[k] = -along[k];
  PetscCall(VecMAXPY(slide, cone->nrays, along, cone->Q));
  PetscCall(VecNorm(motion, NORM_2, &before));
  PetscCall(VecNorm(slide, NORM_2, &after));
  if (after > 1e-3 * before) PetscCall(VecCopy(slide, motion));
  PetscCall(VecDestroy(&slide));
  PetscCall(PetscFree(along));
  PetscFunctionReturn(0);
}

/* Reports the motion of the bodies that contact does not hold. left: unbalanced load on the free motions. */
static PetscErrorCode EquilibriumReport(Model model, const FreeMotions *m, ContactCone *cone, Vec left,
  StepReport *report)
{
  Vec w;

  PetscFunctionBegin;
  PetscCall(ConeSlide(cone, left));
  PetscCall(VecDuplicate(model->places.x, &w));
  PetscCall(FreeMotionsMultiply(m, m->Z, left, w));
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
  PetscReal   size;
  PetscBool   stop;
  Vec         load, left;

  PetscFunctionBegin;
  *none = PETSC_FALSE;
  if (!force) PetscFunctionReturn(0);
  PetscCall(InterruptTest(model, state, &stop));
  if (stop) PetscFunctionReturn(0);
  PetscCall(EquilibriumTurnBack(model, state, time, force));
  PetscCall(NodalMagnitudesMeasure(force, &size, NULL));
  PetscCall(FreeMotionsCreate(model, state, &motions));
  if (motions.n && size > 0.0) {
    PetscCall(ConeCreate(motions.n + 1, &cone));
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, motions.n, &load));
    PetscCall(VecDuplicate(load, &left));
    PetscCall(FreeMotionsSum(&motions, motions.Z, force, load));
    PetscCall(ConeProject(model, state, time, &motions, load, size, &cone, left, none));
    if (*none) PetscCall(EquilibriumReport(model, &motions, &cone, left, report));
    PetscCall(ConeDestroy(&cone));
    PetscCall(VecDestroy(&left));
    PetscCall(VecDestroy(&load));
  }
  PetscCall(FreeMotionsDestroy(&motions));
  PetscFunctionReturn(0);
}
