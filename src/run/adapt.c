/*
   Chooses the cells to refine for the next mesh: those with the largest errors over all load steps, and those at the
   contact in the last load step
*/
#include "runimpl.h"
#include "src/state/run.h"

#define ADAPT_SHARE \
  0.8 /* fraction of the squared error that the refined cells have; after refinement about 0.4 of the squared error
         remains */

/*
   Collective. Makes a simulation record the error of every cell, and refine the cells marked before. sim: the
   simulation, before SimulationSetUp(); marks: the marks, initially empty, which must exist until the simulation is set
   up.
*/
PetscErrorCode SimulationSetMarks(Simulation sim, const MeshMarks *marks)
{
  Scene scene = sim->model->scene;

  PetscFunctionBegin;
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    const SceneBody *body = &scene->bodies[b];

    PetscCheck(body->order < 2, sim->model->comm, PETSC_ERR_SUP,
      "-accuracy_adaptive: body \"%s\" has order %" PetscInt_FMT ", but only hexahedra of order 1 are refined locally",
      body->name, body->order);
    PetscCheck(body->material.type != MATERIAL_RIGID || body->shape == SHAPE_BOX || SceneBodyIsSurface(body),
      sim->model->comm, PETSC_ERR_SUP,
      "-accuracy_adaptive: the rigid body \"%s\" has curved faces made of facets, which the error of stresses cannot "
      "refine: use a rigid surface without facets, or omit the option",
      body->name);
  }
  PetscCheck(!scene->nties, sim->model->comm, PETSC_ERR_SUP,
    "-accuracy_adaptive: the faces of tie \"%s\" must be refined as a whole: omit the option", scene->ties[0].name);
  PetscCheck(!scene->ncyclic, sim->model->comm, PETSC_ERR_SUP,
    "-accuracy_adaptive: the faces of cyclic symmetry \"%s\" must be refined as a whole: omit the option",
    scene->cyclic[0].name);
  sim->run->marks = marks;
  PetscFunctionReturn(0);
}

/* Sums the errors of cells whose error is at least `threshold`, over all ranks */
static PetscErrorCode AdaptSum(MPI_Comm comm, RunState *run, PetscInt n, PetscReal threshold, PetscReal *sum)
{
  PetscFunctionBegin;
  *sum = 0.0;
  for (PetscInt c = 0; c < n; ++c) *sum += run->adapt.errors[c] >= threshold ? run->adapt.errors[c] : 0.0;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, sum, 1, MPIU_REAL, MPIU_SUM, comm));
  PetscFunctionReturn(0);
}

/*
   Marks the cells with the largest errors (Doerfler 1996). Thresholds are fixed fractions of the largest error instead
   of errors of cells, so that cells which are equal by symmetry are treated equally on any number of ranks.
*/
static PetscErrorCode AdaptMarkErrors(MPI_Comm comm, RunState *run, PetscInt n)
{
  const PetscReal step    = PetscPowReal(2.0, -0.125);
  PetscReal       largest = 0.0, threshold, all, sum = 0.0;

  PetscFunctionBegin;
  for (PetscInt c = 0; c < n; ++c) largest = PetscMax(largest, run->adapt.errors[c]);
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPIU_REAL, MPIU_MAX, comm));
  PetscCall(AdaptSum(comm, run, n, 0.0, &all));
  threshold = 1.03 * largest;
  while (sum < ADAPT_SHARE * all) {
    threshold *= step;
    PetscCall(AdaptSum(comm, run, n, threshold, &sum));
  }
  for (PetscInt c = 0; c < n; ++c)
    run->adapt.marked[c] = (PetscBool)(run->adapt.errors[c] >= threshold && run->adapt.errors[c] > 0.0);
  PetscFunctionReturn(0);
}

/*
   Collective. Chooses the cells to be refined in the next mesh. sim: the simulation, with marks and after its load
   steps; growth: approximate ratio of the next mesh's unknowns to the present ones. The cells with the largest errors
   are chosen, which together have 0.8 of the squared recovered error over all load steps. Since recovery does not
   include the errors of contact, cells on both sides of the contact area of the last load step are added: on curved
   faces all of them, on plane faces those at the edge of contact.
*/
PetscErrorCode SimulationPropose(Simulation sim, PetscReal *growth)
{
  PetscInt cstart, cend, counts[2] = {0, 0};

  PetscFunctionBegin;
  PetscCall(DMPlexGetHeightStratum(sim->model->dm, 0, &cstart, &cend));
  PetscCall(AdaptMarkErrors(sim->model->comm, sim->run, cend - cstart));
  PetscCall(AdaptMarkContact(sim->model, sim->state, sim->run));
  for (PetscInt c = 0; c < cend - cstart; ++c) counts[0] += sim->run->adapt.marked[c];
  counts[1] = cend - cstart;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPIU_INT, MPI_SUM, sim->model->comm));
  *growth = 1.0 + 7.0 * (PetscReal)counts[0] / (PetscReal)counts[1];
  PetscFunctionReturn(0);
}

/*
   Collective. Marks the cells chosen by SimulationPropose(). sim: the simulation, after SimulationPropose(); marks: the
   marks of the present mesh, to which the marks for the next mesh are added.
*/
PetscErrorCode SimulationMark(Simulation sim, MeshMarks *marks)
{
  PetscFunctionBegin;
  PetscCall(MeshMarksAdd(sim->model->dm, sim->run->adapt.marked, marks));
  PetscFunctionReturn(0);
}
