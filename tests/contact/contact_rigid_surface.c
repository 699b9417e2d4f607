static char help[] = "Gaps to rigid surfaces against their definitions, and their derivatives against central "
                     "differences, with the surface moved and turned.\n";

#include <contact.h>
#include <mesh.h>
#include <vector3.h>
#include "contact_report.h"

/* Displacement of the two bodies: waves in the first, a rigid motion of the second */
typedef struct {
  PetscReal wave, turn[3], shift[3];
} Motion;

static void MotionAt(const Motion *m, PetscInt body, const PetscReal x[3], PetscReal u[3])
{
  const PetscReal angle = PetscSqrtReal(PetscSqr(m->turn[0]) + PetscSqr(m->turn[1]) + PetscSqr(m->turn[2]));
  const PetscReal s     = angle > 0.0 ? PetscSinReal(angle) / angle : 1.0,
                  h     = angle > 0.0 ? (1.0 - PetscCosReal(angle)) / PetscSqr(angle) : 0.5;
  PetscReal once[3], twice[3];

  for (PetscInt c = 0; c < 3 && !body; ++c) u[c] = m->wave * PetscSinReal(1.0 + 2.0 * x[c] + 3.0 * x[(c + 1) % 3]);
  if (!body) return;
  VectorCross(m->turn, x, once);
  VectorCross(m->turn, once, twice);
  for (PetscInt c = 0; c < 3; ++c) u[c] = m->shift[c] + s * once[c] + h * twice[c];
}

/* Sets the field on vertices; bodies are told apart by height */
static PetscErrorCode SetMotion(DM dm, const Motion *motion, Vec u)
{
  PetscSection       local, coordinates;
  Vec                x, v;
  const PetscScalar *xs;
  PetscScalar       *us;
  PetscInt           first, last;

  PetscFunctionBeginUser;
  PetscCall(DMGetLocalSection(dm, &local));
  PetscCall(DMGetCoordinateSection(dm, &coordinates));
  PetscCall(DMGetCoordinatesLocal(dm, &x));
  PetscCall(DMGetLocalVector(dm, &v));
  PetscCall(VecGetArrayRead(x, &xs));
  PetscCall(VecGetArray(v, &us));
  PetscCall(DMPlexGetDepthStratum(dm, 0, &first, &last));
  for (PetscInt p = first; p < last; ++p) {
    PetscInt  at, to;
    PetscReal place[3], d[3];

    PetscCall(PetscSectionGetOffset(coordinates, p, &at));
    PetscCall(PetscSectionGetOffset(local, p, &to));
    for (PetscInt c = 0; c < 3; ++c) place[c] = PetscRealPart(xs[at + c]);
    MotionAt(motion, place[2] > 0.05 ? 1 : 0, place, d);
    for (PetscInt c = 0; c < 3; ++c) us[to + c] = d[c];
  }
  PetscCall(VecRestoreArray(v, &us));
  PetscCall(VecRestoreArrayRead(x, &xs));
  PetscCall(DMLocalToGlobal(dm, v, INSERT_VALUES, u));
  PetscCall(DMRestoreLocalVector(dm, &v));
  PetscFunctionReturn(0);
}

/* J times the way between two near states, against the difference of their gaps */
static PetscErrorCode TestSurface(SceneBody bodies[2], const char what[])
{
  const SceneContactPair pair = {.name = "pair", .mortar = "tool.surface", .nonmortar = "block.zmax", .distance = 100};
  const PetscReal        step = 1e-6;
  const Motion           at   = {0.02, {0.1, -0.2, 0.3}, {0.02, 0.03, -0.01}};
  DM                     dm;
  Contact                contact;
  ContactLinearization   lin[3];
  Vec                    u[3], Jv;
  PetscReal              error;
  PetscInt               m;

  PetscFunctionBeginUser;
  PetscCall(MeshCreate(PETSC_COMM_WORLD, 2, bodies, 0, &dm));
  PetscCall(ContactCreate(dm, 1, &pair, &contact));
  PetscCall(ContactSetBodies(contact, bodies));
  for (PetscInt k = 0; k < 3; ++k) {
    Motion moved = at;

    moved.wave += (PetscReal)(k - 1) * step;
    for (PetscInt c = 0; c < 3; ++c) {
      moved.turn[c] += (PetscReal)((k - 1) * (c + 1)) * step;
      moved.shift[c] -= (PetscReal)((k - 1) * (c + 2)) * step;
    }
    PetscCall(DMCreateGlobalVector(dm, &u[k]));
    PetscCall(SetMotion(dm, &moved, u[k]));
    PetscCall(ContactLinearize(contact, u[k], CONTACT_FORCES, &lin[k]));
  }
  PetscCall(MatGetSize(lin[1]->J, &m, NULL));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: %" PetscInt_FMT " rows\n", what, m));
  PetscCall(VecDuplicate(lin[1]->g, &Jv));
  PetscCall(VecAXPY(u[2], -1.0, u[0]));
  PetscCall(MatMult(lin[1]->J, u[2], Jv));
  PetscCall(VecAXPY(Jv, -1.0, lin[2]->g));
  PetscCall(VecAXPY(Jv, 1.0, lin[0]->g));
  PetscCall(VecNorm(Jv, NORM_INFINITY, &error));
  PetscCall(Report("  derivative", error / (2.0 * step), 1e-7));
  PetscCall(VecDestroy(&Jv));
  for (PetscInt k = 0; k < 3; ++k) {
    PetscCall(ContactLinearizationDestroy(&lin[k]));
    PetscCall(VecDestroy(&u[k]));
  }
  PetscCall(ContactDestroy(&contact));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

/* Points at known distances: across the surface's axis and along it */
static PetscErrorCode TestDistance(const SceneBody *body, PetscReal across, PetscReal along, PetscReal known,
  const char what[])
{
  const PetscReal x[3] = {body->own[0] + 0.6 * across, body->own[1] + 0.8 * across, body->own[2] - along};
  PetscReal       gradient[3], distance;

  PetscFunctionBeginUser;
  distance = SceneSurfaceDistance(body, x, gradient);
  PetscCall(Report(what, PetscMax(PetscAbsReal(distance - known), PetscAbsReal(VectorNorm(gradient) - 1.0)), 1e-12));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  static const BodyShape shape[]   = {SHAPE_RIGID_PLANE, SHAPE_RIGID_SPHERE, SHAPE_RIGID_CYLINDER, SHAPE_RIGID_CONE,
      SHAPE_RIGID_TORUS, SHAPE_RIGID_EXTRUDED, SHAPE_RIGID_REVOLVED};
  static const PetscReal own[]     = {0.1, 0.2, 0.9, 0, 0, -1, 0.5, 0.2, 45, 0.3, 1, 0, 0, 0.05, 0, 0, 6, 0, -0.2, 0.4,
        -0.2, 0.4, 1};
  static const PetscReal known[]   = {0.7, PETSC_SQRT2 * 0.7 - 0.5, 0.2, 0.0, 0.05, 0.31055512754639893, 0.25};
  SceneBody              bodies[2] = {
                 {.name = (char *)"block", .lower = {-0.6, -0.5, -1}, .upper = {0.5, 0.6, 0}, .cells = {3, 3, 2}},
                 {.name = (char *)"tool", .material = {.type = MATERIAL_RIGID}}};

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscArraycpy(bodies[1].own, own, PETSC_STATIC_ARRAY_LENGTH(own)));
  for (PetscInt i = 0; i < 7; ++i) {
    bodies[1].shape = shape[i];
    PetscCall(TestSurface(bodies, BodyShapes[shape[i]]));
    if (i == 4) PetscCall(TestDistance(&bodies[1], 0.7, 0.15, known[i], "  distance"));
    else PetscCall(TestDistance(&bodies[1], 0.7, 0.7, known[i], "  distance"));
  }
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      nsize: {{1 3}}

TEST*/
