/* Collects the figures that a reader looks for first: largest values over the load steps that converged */
#include "runimpl.h"
#include <math.h>
#include <vector3.h>

/* A kind of figure. The offsets are those of members of the owner's report. */
typedef struct {
  const char *quantity;
  const char *column; /* heading of a printed table's column; NULL: none */
  FigureOwner owner;
  const char *unit;    /* "L", "F", "F L", "L^2", "F/L^2", "%" or "" */
  PetscBool   forces;  /* the value is the length of a force with three components */
  PetscBool   size;    /* the magnitude counts */
  PetscBool   least;   /* the smallest value is reported instead of the largest one */
  PetscBool   nonzero; /* the figure is omitted if the value is 0, up to rounding, in all load steps */
  size_t      value;
  size_t      place; /* 0: none */
} FigureKind;

static const char von_mises[] = "von Mises stress";

static const FigureKind kinds[] = {
  {"displacement", "displacement", FIGURE_OF_BODY, "L", .nonzero = PETSC_TRUE,
    .value = offsetof(BodyReport, displacement), .place = offsetof(BodyReport, displacement_place)},
  {von_mises, "von Mises stress", FIGURE_OF_BODY, "F/L^2", .value = offsetof(BodyReport, von_mises),
    .place = offsetof(BodyReport, von_mises_place)},
  {"safety against yield", "safety", FIGURE_OF_BODY, "", .least = PETSC_TRUE, .value = offsetof(BodyReport, safety)},
  {"eq. plastic strain", "plastic strain", FIGURE_OF_BODY, "", .nonzero = PETSC_TRUE,
    .value = offsetof(BodyReport, plastic_strain)},
  {"contact force", "force", FIGURE_OF_PAIR, "F", .forces = PETSC_TRUE, .value = offsetof(PairReport, force)},
  {"normal force", "normal force", FIGURE_OF_PAIR, "F", .value = offsetof(PairReport, normal_force)},
  {"contact pressure", "pressure", FIGURE_OF_PAIR, "F/L^2", .value = offsetof(PairReport, pressure),
    .place = offsetof(PairReport, pressure_place)},
  {"contact area", "area", FIGURE_OF_PAIR, "L^2", .value = offsetof(PairReport, area)},
  {"reaction", "force", FIGURE_OF_FACE, "F", .forces = PETSC_TRUE, .nonzero = PETSC_TRUE,
    .value = offsetof(FaceReport, reaction)},
  {"torque", "torque", FIGURE_OF_FACE, "F L", .size = PETSC_TRUE, .value = offsetof(FaceReport, torque)},
  {"bolt force", "force", FIGURE_OF_BOLT, "F", .value = offsetof(BoltReport, force)},
  {"stress error, estimate", NULL, FIGURE_OF_STRESSED_MODEL, "%", .value = offsetof(StepReport, error_estimate)},
};

/* Writes the unit of a kind in the words of the scene's units; "" if these are unknown */
static void FigureSetUnit(const char kind[], const char units[], char unit[], size_t length)
{
  const char *size = UnitsFind(units, UNIT_LENGTH, NULL), *force = UnitsFind(units, UNIT_FORCE, NULL),
             *stress = UnitsFind(units, UNIT_STRESS, NULL), *power = kind[0] == 'L' && kind[1] ? "^2" : "";

  unit[0] = '\0';
  if (kind[0] == '%') (void)snprintf(unit, length, "%%");
  else if (kind[0] == 'L') (void)snprintf(unit, length, "%s%s", size, size[0] ? power : "");
  else if (kind[0] == 'F' && !kind[1]) (void)snprintf(unit, length, "%s", force);
  else if (kind[0] == 'F' && kind[1] == ' ')
    (void)snprintf(unit, length, "%s%s%s", force, force[0] && size[0] ? " " : "", force[0] ? size : "");
  else if (kind[0] == 'F' && (stress[0] || !force[0] || !size[0])) (void)snprintf(unit, length, "%s", stress);
  else if (kind[0] == 'F') (void)snprintf(unit, length, "%s/%s^2", force, size);
}

/* Returns the reports of a kind's owners in a load step; all of them begin with the name of the owner */
static const char *FigureGetOwners(const StepReport *step, FigureOwner owner, PetscInt *n, size_t *size)
{
  switch (owner) {
  case FIGURE_OF_BODY: *n = step->nbodies, *size = sizeof(BodyReport); return (const char *)step->bodies;
  case FIGURE_OF_PAIR: *n = step->npairs, *size = sizeof(PairReport); return (const char *)step->pairs;
  case FIGURE_OF_FACE: *n = step->nfaces, *size = sizeof(FaceReport); return (const char *)step->faces;
  case FIGURE_OF_BOLT: *n = step->nbolts, *size = sizeof(BoltReport); return (const char *)step->bolts;
  default: *n = 1, *size = 0; return (const char *)step;
  }
}

/* Takes the value of a load step if it is the largest so far, or the smallest; differences by rounding do not count */
static PetscErrorCode FigureTake(const FigureKind *kind, const char *owner, PetscInt step, RunFigure *figure)
{
  const PetscReal *numbers = (const PetscReal *)(owner + kind->value),
                  *place   = kind->place ? (const PetscReal *)(owner + kind->place) : NULL;
  PetscReal value          = kind->forces ? VectorNorm(numbers) : numbers[0];

  PetscFunctionBegin;
  if (kind->size) value = PetscAbsReal(value);
  if (kind->unit[0] == '%') value *= 100.0;
  if (PetscIsNanReal(value)) PetscFunctionReturn(0);
  if (!PetscIsNanReal(figure->value) &&
      (kind->least ? figure->value - value : value - figure->value) <= REPORT_TIE * value)
    PetscFunctionReturn(0);
  figure->value = value;
  figure->step  = step;
  for (PetscInt d = 0; d < 3; ++d) {
    if (place) figure->place[d] = place[d];
    if (kind->forces) figure->components[d] = numbers[d];
  }
  PetscFunctionReturn(0);
}

/* Returns the load step of the largest von Mises stress */
static PetscInt FiguresFindStressed(const RunReport *run)
{
  PetscReal largest = -1.0;
  PetscInt  step    = 0;

  for (PetscInt f = 0; f < run->nfigures; ++f) {
    if (strcmp(run->figures[f].quantity, von_mises) || run->figures[f].value <= largest) continue;
    largest = run->figures[f].value;
    step    = run->figures[f].step;
  }
  return step;
}

static PetscErrorCode FiguresAdd(const FigureKind *kind, RunReport *run, PetscInt i)
{
  RunFigure *figure = &run->figures[run->nfigures];

  PetscFunctionBegin;
  *figure = (RunFigure){.owner = kind->owner,
    .quantity                  = kind->quantity,
    .column                    = kind->column,
    .name                      = "",
    .value                     = NAN,
    .place                     = {NAN, NAN, NAN},
    .components                = {NAN, NAN, NAN}};
  FigureSetUnit(kind->unit, run->units, figure->unit, sizeof(figure->unit));
  for (PetscInt s = 0; s < run->nsteps; ++s) {
    PetscInt    n;
    size_t      size;
    const char *owners = FigureGetOwners(&run->steps[s], kind->owner, &n, &size);

    if (!run->steps[s].converged || i >= n) continue;
    if (kind->owner == FIGURE_OF_STRESSED_MODEL && run->steps[s].step != FiguresFindStressed(run)) continue;
    if (kind->owner != FIGURE_OF_STRESSED_MODEL) figure->name = *(const char *const *)(owners + (size_t)i * size);
    if (kind->owner == FIGURE_OF_FACE && !run->steps[s].faces[i].driven) {
      figure->owner    = FIGURE_OF_PLANE;
      figure->quantity = "symmetry reaction";
    }
    PetscCall(FigureTake(kind, owners + (size_t)i * size, run->steps[s].step, figure));
  }
  if (!PetscIsNanReal(figure->value)) ++run->nfigures;
  PetscFunctionReturn(0);
}

/* Returns the resultant force of a face or pair below which it is rounding error of the forces at the nodes */
static PetscReal FiguresForceRounding(const RunReport *run)
{
  PetscReal size = 0.0;

  for (PetscInt s = 0; s < run->nsteps; ++s) {
    const StepReport *step = &run->steps[s];

    for (PetscInt f = 0; f < step->nfaces; ++f) size = PetscMax(size, step->faces[f].size);
    for (PetscInt p = 0; p < step->npairs; ++p) size = PetscMax(size, step->pairs[p].size);
  }
  return PETSC_SQRT_MACHINE_EPSILON * size;
}

/* Removes the figures of a kind, from number `first` on, that are 0 in comparison with others, or sets them to 0 */
static PetscErrorCode FiguresFindZeros(const FigureKind *kind, RunReport *run, PetscInt first)
{
  PetscReal largest = 0.0, rounding;
  PetscInt  n       = first;

  PetscFunctionBegin;
  for (PetscInt f = first; f < run->nfigures; ++f) largest = PetscMax(largest, run->figures[f].value);
  rounding = PetscMax(REPORT_ZERO * largest, kind->forces ? FiguresForceRounding(run) : 0.0);
  for (PetscInt f = first; f < run->nfigures; ++f) {
    const PetscBool zero = (PetscBool)(run->figures[f].value <= rounding);

    if (zero && kind->nonzero) continue;
    run->figures[n] = run->figures[f];
    if (zero) run->figures[n].value = 0.0;
    ++n;
  }
  run->nfigures = n;
  PetscFunctionReturn(0);
}

/* Sets run->figures from the reports of the load steps */
PetscErrorCode FiguresCollect(RunReport *run)
{
  const size_t nkinds = PETSC_STATIC_ARRAY_LENGTH(kinds);
  PetscInt     most   = 1, n;
  size_t       size;

  PetscFunctionBegin;
  PetscCall(PetscFree(run->figures));
  run->nfigures = 0;
  for (PetscInt s = 0; s < run->nsteps; ++s) {
    for (size_t k = 0; k < nkinds; ++k) {
      (void)FigureGetOwners(&run->steps[s], kinds[k].owner, &n, &size);
      most = PetscMax(most, n);
    }
  }
  PetscCall(PetscMalloc1((PetscInt)nkinds * most, &run->figures));
  for (size_t k = 0; k < nkinds; ++k) {
    const PetscInt first = run->nfigures;

    for (PetscInt i = 0; i < (kinds[k].owner == FIGURE_OF_STRESSED_MODEL ? 1 : most); ++i)
      PetscCall(FiguresAdd(&kinds[k], run, i));
    if (!kinds[k].least) PetscCall(FiguresFindZeros(&kinds[k], run, first));
  }
  PetscFunctionReturn(0);
}
