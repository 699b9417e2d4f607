/* Velocities, accelerations and forces at time 0, before the first time step */
#include "dynamicsimpl.h"

/* Computes the velocity v + w x (X - centre of mass) from the velocity v and the spin w of each body, as far as
   ties permit. Prescribed displacements have their own velocity. */
static PetscErrorCode StartVelocity(const Constraints *c, Dynamics *d)
{
  Scene scene = c->bodies.scene;
  PetscReal(*centres)[3];
  BodyMotion *motions;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(scene->nbodies, &centres, scene->nbodies, &motions));
  PetscCall(MassGetCentres(c, d, centres));
  for (PetscInt i = 0; i < 3 * scene->nbodies; ++i) {
    const SceneBody *body = &scene->bodies[i / 3];

    motions[i / 3].t[i % 3]      = body->velocity[i % 3];
    motions[i / 3].w[i % 3]      = body->spin[i % 3];
    motions[i / 3].center[i % 3] = centres[i / 3][i % 3];
  }
  PetscCall(VertexPlacesMove(&c->bodies.places, NULL, motions, d->velocity));
  PetscCall(PetscFree2(centres, motions));
  PetscCall(DriveStart(c, 1, d->velocity));
  if (c->ties->C) {
    PetscCall(VecCopy(d->velocity, c->ties->work));
    PetscCall(MatMult(c->ties->C, c->ties->work, d->velocity));
  }
  PetscFunctionReturn(0);
}

/* Creates the mass matrix of the free rows, with 1 on the diagonal of rows that are prescribed, dependent or without
   mass */
static PetscErrorCode StartGetMass(const Constraints *c, const Dynamics *d, Mat *A)
{
  Vec          diagonal;
  PetscScalar *m;
  PetscInt     n;

  PetscFunctionBegin;
  if (c->ties->C) PetscCall(TiesMultiply(c->ties->C, d->mass, A));
  else PetscCall(MatDuplicate(d->mass, MAT_COPY_VALUES, A));
  PetscCall(MatZeroRowsColumns(*A, c->prescribed->n, c->prescribed->rows, 1.0, NULL, NULL));
  PetscCall(MatCreateVecs(*A, &diagonal, NULL));
  PetscCall(MatGetDiagonal(*A, diagonal));
  PetscCall(VecGetLocalSize(diagonal, &n));
  PetscCall(VecGetArray(diagonal, &m));
  for (PetscInt i = 0; i < n; ++i) m[i] = PetscRealPart(m[i]) > 0.0 ? 0.0 : 1.0;
  PetscCall(VecRestoreArray(diagonal, &m));
  PetscCall(MatDiagonalSet(*A, diagonal, ADD_VALUES));
  PetscCall(VecDestroy(&diagonal));
  PetscFunctionReturn(0);
}

/* Computes the accelerations at time 0: M a = f - dE/du - damping. They are zero in rows without mass, and given in
   rows with prescribed displacements. */
static PetscErrorCode StartAcceleration(const Constraints *c, const DeadLoads *loads, Dynamics *d)
{
  PetscReal size;
  Vec       zero, force, load;
  KSP       ksp;
  PC        pc;
  Mat       A;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(d->acceleration));
  PetscCall(VecDuplicate(d->velocity, &zero));
  PetscCall(VecDuplicate(d->velocity, &force));
  PetscCall(VecZeroEntries(zero));
  PetscCall(ElasticityForce(c->bodies.elasticity, zero, force));
  PetscCall(SchemeGetDamping(&c->bodies.scene->dynamics, d, d->velocity, zero));
  PetscCall(VecAXPY(force, 1.0, zero));
  PetscCall(DriveStart(c, 2, d->acceleration));
  PetscCall(MatMultAdd(d->mass, d->acceleration, force, force));
  PetscCall(VecScale(force, -1.0));
  PetscCall(DeadLoadsGet(loads, 0.0, &load));
  if (load) PetscCall(VecAXPY(force, 1.0, load));
  PetscCall(VecDestroy(&load));
  PetscCall(VecPointwiseMult(force, force, d->inert));
  PetscCall(TiesGather(c->ties, force));
  PetscCall(PrescribedSet(c->prescribed, 0.0, force));
  PetscCall(VecNorm(force, NORM_2, &size));
  if (size > 0.0) {
    PetscCall(StartGetMass(c, d, &A));
    PetscCall(KSPCreate(c->bodies.comm, &ksp));
    PetscCall(KSPSetType(ksp, KSPCG));
    PetscCall(KSPGetPC(ksp, &pc));
    PetscCall(PCSetType(pc, PCJACOBI));
    PetscCall(KSPSetTolerances(ksp, 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, PETSC_DEFAULT));
    PetscCall(KSPSetErrorIfNotConverged(ksp, PETSC_TRUE));
    PetscCall(KSPSetOperators(ksp, A, A));
    PetscCall(KSPSolve(ksp, force, d->acceleration));
    if (c->ties->C) {
      PetscCall(VecCopy(d->acceleration, c->ties->work));
      PetscCall(MatMult(c->ties->C, c->ties->work, d->acceleration));
    }
    PetscCall(KSPDestroy(&ksp));
    PetscCall(MatDestroy(&A));
  }
  PetscCall(DriveStart(c, 2, d->acceleration));
  PetscCall(VecCopy(d->acceleration, d->auxiliary));
  PetscCall(VecDestroy(&force));
  PetscCall(VecDestroy(&zero));
  PetscFunctionReturn(0);
}

/* Sets d->residual to the internal, damping and dead forces at the displacement u. time: in load steps */
PetscErrorCode DynamicsSetRest(const Constraints *c, const DeadLoads *loads, PetscReal time, Vec u, Dynamics *d)
{
  Vec add;

  PetscFunctionBegin;
  if (!d->residual) PetscFunctionReturn(0);
  PetscCall(ElasticityForce(c->bodies.elasticity, u, d->residual));
  PetscCall(DeadLoadsGet(loads, time, &add));
  if (add) PetscCall(VecAXPY(d->residual, -1.0, add));
  PetscCall(VecDestroy(&add));
  PetscCall(VecDuplicate(u, &add));
  PetscCall(SchemeGetDamping(&c->bodies.scene->dynamics, d, d->velocity, add));
  PetscCall(VecAXPY(d->residual, 1.0, add));
  PetscCall(VecDestroy(&add));
  PetscFunctionReturn(0);
}

/* Creates the data of a dynamic analysis. Must be called after the ties, and before the stiffness, which contains the
   mass term of the first time step. */
PetscErrorCode DynamicsCreate(const Constraints *c, const DeadLoads *loads, Springs *springs, Dynamics *d)
{
  const SceneDynamics *scene = &c->bodies.scene->dynamics;
  PetscReal            momentum[3], spin[3];
  PetscBool            changed;
  Vec                  u;

  PetscFunctionBegin;
  if (!SceneIsDynamic(c->bodies.scene)) PetscFunctionReturn(0);
  PetscCall(MassCreate(c, d));
  PetscCall(VecDuplicate(c->bodies.mass, &d->velocity));
  PetscCall(VecDuplicate(c->bodies.mass, &d->acceleration));
  PetscCall(VecDuplicate(c->bodies.mass, &d->auxiliary));
  PetscCall(VecDuplicate(c->bodies.mass, &d->centre));
  d->elasticity = c->bodies.elasticity;
  d->prescribed = c->prescribed;
  d->springs    = springs;
  if (scene->damping_stiffness > 0.0 || springs->dampers) PetscCall(VecDuplicate(c->bodies.mass, &d->viscous));
  if (scene->scheme == SCHEME_IMPACT) PetscCall(VecDuplicate(c->bodies.mass, &d->residual));
  PetscCall(StartVelocity(c, d));
  PetscCall(StartAcceleration(c, loads, d));
  if (d->residual) PetscCall(VecZeroEntries(d->auxiliary));
  PetscCall(VecDuplicate(c->bodies.mass, &u));
  PetscCall(VecZeroEntries(u));
  PetscCall(MassMeasure(c, d, u, &d->kinetic, momentum, spin));
  PetscCall(SchemeBegin(scene, scene->time_step, u, d));
  PetscCall(ElasticitySetInertia(c->bodies.elasticity, d->inertia, d->viscosity, &changed));
  PetscCall(DynamicsSetRest(c, loads, 0.0, u, d));
  PetscCall(VecDestroy(&u));
  PetscFunctionReturn(0);
}

PetscErrorCode DynamicsDestroy(Dynamics *d)
{
  PetscFunctionBegin;
  PetscCall(MatDestroy(&d->mass));
  PetscCall(VecDestroy(&d->velocity));
  PetscCall(VecDestroy(&d->acceleration));
  PetscCall(VecDestroy(&d->auxiliary));
  PetscCall(VecDestroy(&d->inert));
  PetscCall(VecDestroy(&d->centre));
  PetscCall(VecDestroy(&d->driven));
  PetscCall(VecDestroy(&d->viscous));
  PetscCall(VecDestroy(&d->residual));
  PetscCall(VecDestroy(&d->turn));
  PetscCall(VecDestroy(&d->excess));
  PetscCall(VecDestroy(&d->turned));
  PetscFunctionReturn(0);
}
