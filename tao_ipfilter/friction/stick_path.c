/*
   A path to the state of contacts that stick while they are closed. The load grows from the begin, which is a state of
   equilibrium, to the present one. On the way contacts open and close, one after the other. The order of these events
   decides the state at the end, which is one of several possible states. A contact whose force leaves a wide cone
   slides: its force along the face vanishes at constant load, and it sticks again where it is then. A contact that
   closes sticks where it has closed.
   Contacts that change within rounding errors of each other change together, so that symmetric bodies remain symmetric.
*/
#include "frictionimpl.h"

/* Values below `tiny`, relative to w->size, are rounding errors */
static const PetscReal tiny = 1e-10;

PetscErrorCode IPStickPathDestroy(IPStickPath *w)
{
  PetscFunctionBegin;
  PetscCall(PetscFree2(w->x, w->rate));
  PetscCall(PetscFree3(w->contact, w->slides, w->moved));
  PetscFunctionReturn(0);
}

PetscErrorCode IPStickPathCreate(const IPTermSet *set, IPTableau *p, IPStickPath *w)
{
  PetscFunctionBegin;
  *w = (IPStickPath){.set = set, .p = p};
  PetscCall(PetscCalloc2(2 * p->rows + 1, &w->x, 2 * p->rows + 1, &w->rate));
  PetscCall(PetscCalloc3(p->m, &w->contact, p->m, &w->slides, p->m, &w->moved));
  PetscFunctionReturn(0);
}

/*
   Sets the column of the load from the present forces and motions, which are those at the present load: the change of
   the motions without forces until the end, divided by the load that is left. All motions must be basic.
*/
void IPStickPathLoad(const IPStickPath *w)
{
  IPTableau      *p    = w->p;
  const PetscReal left = 1.0 - w->x[2 * p->rows];
  PetscReal      *load = IPTableauColumn(p, p->rows);

  for (PetscInt r = 0; r < p->rows; r++) load[r] = p->q[r] - w->x[r + p->rows];
  for (PetscInt j = 0; j < p->rows; j++)
    for (PetscInt r = 0; r < p->rows && w->x[j] != 0.0; r++) load[r] += IPTableauColumn(p, j)[r] * w->x[j];
  for (PetscInt r = 0; r < p->rows; r++) load[r] = left > 0.0 ? load[r] / left : 0.0;
}

/* Sets up the tableau again, since each exchange adds rounding errors, with the same basic variables */
static PetscErrorCode PathRenew(IPStickPath *w)
{
  IPTableau *p = w->p;
  PetscBool  made;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < p->m; i++) p->closed[i] = (PetscBool)(p->place[i] >= 0);
  for (PetscInt r = p->m; r < p->rows; r++) p->sticks[r - p->m] = (PetscBool)(p->place[r] >= 0);
  PetscCall(IPTableauSetUp(w->set, p->s, p, &made));
  IPStickPathLoad(w);
  PetscCall(IPTableauEnter(p));
  w->nexchanges = 0;
  PetscFunctionReturn(0);
}

static PetscInt PathTangent(const IPStickPath *w, PetscInt i, PetscInt a)
{
  return w->p->m + 2 * i + a;
}

/* Makes the force of a row basic (it is then determined by the motion, which is kept), or its motion */
static PetscErrorCode PathHold(IPStickPath *w, PetscInt row, PetscBool held)
{
  IPTableau      *p      = w->p;
  const PetscReal least  = 1e-10;
  const PetscInt  leaves = held ? row + p->rows : row, enters = held ? row : row + p->rows;

  PetscFunctionBegin;
  if (p->dropped[row] || (p->place[row] >= 0) == held) PetscFunctionReturn(0);
  if (PetscAbsReal(IPTableauColumn(p, -1 - p->place[enters])[p->place[leaves]]) <= least) p->dropped[row] = held;
  else PetscCall(IPTableauExchange(p, p->place[leaves], -1 - p->place[enters]));
  w->nexchanges++;
  PetscFunctionReturn(0);
}

static PetscErrorCode PathHoldTangents(IPStickPath *w, PetscInt i, PetscBool held)
{
  PetscFunctionBegin;
  for (PetscInt a = 0; a < 2; a++) PetscCall(PathHold(w, PathTangent(w, i, a), held));
  PetscFunctionReturn(0);
}

/* Returns whether the load is constant while forces along faces vanish */
static PetscBool PathRelaxes(const IPStickPath *w)
{
  for (PetscInt i = 0; i < w->p->m; i++)
    if (w->contact[i] == IP_STICK_SLIDES) return PETSC_TRUE;
  return PETSC_FALSE;
}

/*
   Sets the rates of nonbasic variables: of what vanishes at constant load, or of the load. Forces of the begin that are
   linearly dependent on others vanish until the end of the load.
*/
static void PathDrive(IPStickPath *w, PetscBool relaxes)
{
  const IPTableau *p    = w->p;
  const PetscInt   load = 2 * p->rows;

  for (PetscInt v = 0; v <= load; v++) w->rate[v] = 0.0;
  if (!relaxes) w->rate[load] = 1.0;
  for (PetscInt r = 0; r < p->rows && !relaxes; r++)
    if (p->place[r] < 0 && w->x[load] < 1.0) w->rate[r] = -w->x[r] / (1.0 - w->x[load]);
  for (PetscInt i = 0; i < p->m && relaxes; i++) {
    for (PetscInt a = 0; a < 2; a++) {
      const PetscInt v = PathTangent(w, i, a);

      if (w->contact[i] == IP_STICK_SLIDES && p->place[v] < 0) w->rate[v] = -w->x[v];
    }
  }
}

/* Computes the rates of all variables */
static void PathRates(IPStickPath *w, PetscBool relaxes)
{
  const IPTableau *p = w->p;

  PathDrive(w, relaxes);
  for (PetscInt j = 0; j <= p->rows; j++) {
    const PetscReal *c = IPTableauColumn(p, j), rate = w->rate[p->others[j]];

    for (PetscInt r = 0; r < p->rows && rate != 0.0; r++) w->rate[p->basic[r]] += rate * c[r];
  }
}

/* Returns how far the force of a contact that sticks remains in the cone |tau| <= IP_TERM_STICKS lambda */
static PetscReal PathCone(const IPStickPath *w, PetscInt i, PetscReal *speed)
{
  const PetscReal wide = PetscSqr(IP_TERM_STICKS), x = w->x[i], rate = w->rate[i];
  PetscReal       a = wide * x * x, b = wide * x * rate, c = wide * rate * rate, root;

  *speed = PetscAbsReal(rate);
  for (PetscInt k = 0; k < 2; k++) {
    const PetscInt v = PathTangent(w, i, k);

    if (w->p->place[v] < 0) continue;
    a -= PetscSqr(w->x[v]);
    b -= w->x[v] * w->rate[v];
    c -= PetscSqr(w->rate[v]);
    *speed = PetscMax(*speed, PetscAbsReal(w->rate[v]) / IP_TERM_STICKS);
  }
  if (*speed <= tiny * w->size[0]) return PETSC_INFINITY;
  if (x <= 0.0) return rate > 0.0 && c >= 0.0 ? PETSC_INFINITY : 0.0;
  if (a <= 0.0) return b > 0.0 ? PETSC_INFINITY : 0.0;
  if (b * b < c * a || (b >= 0.0 && c >= 0.0)) return PETSC_INFINITY;
  root = PetscSqrtReal(b * b - c * a);
  return b < 0.0 ? a / (root - b) : (b + root) / -c;
}

/* Returns how far it is until a contact changes. *speed: at which it approaches this change */
static PetscReal PathReach(const IPStickPath *w, PetscInt i, PetscReal *speed)
{
  const PetscBool closed = (PetscBool)(w->p->place[i] >= 0);
  const PetscInt  v      = closed ? i : i + w->p->rows;

  *speed = -w->rate[v];
  if (w->p->dropped[i]) return PETSC_INFINITY;
  if (closed && w->contact[i] == IP_STICK_HELD) return PathCone(w, i, speed);
  if (*speed <= tiny * w->size[!closed]) return PETSC_INFINITY;
  return PetscMax(w->x[v], 0.0) / *speed;
}

/* Returns the state of a contact without a force along the face: it is free if it has slid too often */
static IPStickState PathRests(const IPStickPath *w, PetscInt i)
{
  const PetscInt most = 30;

  if (w->slides[i] > most) return IP_STICK_FREE;
  return w->p->place[i] >= 0 ? IP_STICK_HELD : IP_STICK_OPEN;
}

/* Opens a contact, or lets it slide if a force along the face remains */
static PetscErrorCode PathRelease(IPStickPath *w, PetscInt i)
{
  const IPTableau *p   = w->p;
  PetscReal        tau = 0.0;

  PetscFunctionBegin;

  for (PetscInt a = 0; a < 2; a++) {
    const PetscInt v = PathTangent(w, i, a);

    if (p->place[v] >= 0) tau = PetscMax(tau, PetscAbsReal(w->x[v]));
    else w->x[v] = 0.0;
  }
  PetscCall(PathHoldTangents(w, i, PETSC_FALSE));
  w->moved[i] = PETSC_TRUE;
  w->slides[i]++;
  w->contact[i] = IP_STICK_SLIDES;
  if (tau <= tiny * w->size[0]) {
    w->x[i] = 0.0;
    PetscCall(PathHold(w, i, PETSC_FALSE));
    w->contact[i] = PathRests(w, i);
  }
  PetscFunctionReturn(0);
}

/* Changes the state of a contact that has reached the limit of its state */
static PetscErrorCode PathChange(IPStickPath *w, PetscInt i)
{
  IPTableau      *p      = w->p;
  const PetscBool closed = (PetscBool)(p->place[i] >= 0);

  PetscFunctionBegin;
  if (closed && w->contact[i] == IP_STICK_HELD) {
    PetscCall(PathRelease(w, i));
    PetscFunctionReturn(0);
  }
  w->x[closed ? i : i + p->rows] = 0.0;
  PetscCall(PathHold(w, i, (PetscBool)!closed));
  if (w->contact[i] == IP_STICK_OPEN && p->place[i] >= 0) {
    PetscCall(PathHoldTangents(w, i, PETSC_TRUE));
    w->contact[i] = IP_STICK_HELD;
    w->moved[i]   = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

/* Ends the relaxation: what vanishes has vanished, and closed contacts stick where they are */
static PetscErrorCode PathSettle(IPStickPath *w)
{
  IPTableau *p = w->p;

  PetscFunctionBegin;
  for (PetscInt i = 0; i < p->m; i++) {
    if (w->contact[i] != IP_STICK_SLIDES) continue;
    for (PetscInt a = 0; a < 2; a++) {
      const PetscInt v = PathTangent(w, i, a);

      if (p->place[v] < 0) w->x[v] = 0.0;
    }
    w->contact[i] = PathRests(w, i);
    if (w->contact[i] == IP_STICK_HELD) PetscCall(PathHoldTangents(w, i, PETSC_TRUE));
  }
  PetscFunctionReturn(0);
}

/* Changes all contacts that are at their limit, or one of them only. reach: how far it is to the next change */
static PetscErrorCode PathChangeAll(IPStickPath *w, PetscReal reach, PetscBool one)
{
  PetscInt *list, n = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(w->p->m, &list));
  for (PetscInt i = 0; i < w->p->m; i++) {
    PetscReal speed, at = PathReach(w, i, &speed);

    if (at < PETSC_INFINITY && (at - reach) * speed <= tiny * w->size[w->p->place[i] < 0]) list[n++] = i;
  }
  for (PetscInt v = 0; v <= 2 * w->p->rows; v++) w->x[v] += reach * w->rate[v];
  for (PetscInt k = 0; k < (one ? PetscMin(n, 1) : n); k++) PetscCall(PathChange(w, list[k]));
  PetscCall(PetscFree(list));
  PetscFunctionReturn(0);
}

/* Sets the sizes of forces and of motions on the path, for tolerances */
static void PathMeasure(IPStickPath *w)
{
  const IPTableau *p = w->p;
  const PetscReal *c = IPTableauColumn(p, p->rows);

  for (PetscInt i = 0; i < p->m; i++) {
    const PetscBool closed = (PetscBool)(p->place[i] >= 0);
    const PetscInt  v      = closed ? i : i + p->rows;
    const PetscReal size   = PetscAbsReal(w->x[v]) + PetscAbsReal(c[p->place[v]]);

    if (!p->dropped[i]) w->size[!closed] = PetscMax(w->size[!closed], size);
  }
  for (PetscInt k = 0; k < 2; k++)
    if (w->size[k] == 0.0) w->size[k] = w->size[!k];
}

/*
   Adds a small force to closed contacts without one. It vanishes until the end of the load. Contacts that touch thus
   open one after the other when the load begins to grow.
*/
static void PathPress(IPStickPath *w)
{
  const PetscReal small = 1e-6;
  IPTableau      *p     = w->p;

  for (PetscInt i = 0; i < p->m; i++) {
    const PetscReal add = small * w->size[0] - w->x[i];

    if (p->place[i] < 0 || add <= 0.0) continue;
    w->x[i] += add;
    IPTableauColumn(p, p->rows)[p->place[i]] -= add;
  }
}

/*
   Follows the path from its begin, where the variables w->x have values. *events: increased by the number of changes.
   *reached: whether the load reaches its end
*/
PetscErrorCode IPStickPathFollow(IPStickPath *w, PetscInt *events, PetscBool *reached)
{
  IPTableau     *p    = w->p;
  const PetscInt load = 2 * p->rows, most = 100 * p->m + 100, few = 300;

  PetscFunctionBegin;
  *reached = PETSC_FALSE;
  PathMeasure(w);
  PathPress(w);
  for (PetscInt k = 0; k < most; k++) {
    const PetscBool relaxes = PathRelaxes(w);
    const PetscReal left    = relaxes ? 1.0 : 1.0 - w->x[load];
    PetscReal       reach   = left;
    PetscBool       stop;

    PetscCall(IPReducedInterrupted(p->s, &stop));
    if (stop) break;
    PathRates(w, relaxes);
    for (PetscInt i = 0; i < p->m; i++) {
      PetscReal speed;

      reach = PetscMin(reach, PathReach(w, i, &speed));
    }
    if (reach < left) {
      PetscCall(PathChangeAll(w, reach, (PetscBool)(2 * k > most)));
      if (w->nexchanges > PetscMax(few, p->rows)) PetscCall(PathRenew(w));
      ++*events;
      continue;
    }
    for (PetscInt v = 0; v <= load; v++) w->x[v] += left * w->rate[v];
    *reached = (PetscBool)!relaxes;
    if (*reached) break;
    PetscCall(PathSettle(w));
  }
  PetscFunctionReturn(0);
}
