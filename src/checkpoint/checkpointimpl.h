/* Private header of checkpoints: declarations that reading and writing share */
#ifndef CHECKPOINTIMPL_H
#define CHECKPOINTIMPL_H

#include <checkpoint.h>
#include <scene.h>
#include <elasticity.h>
#include "src/output/outputimpl.h"

/* checkpoint_fields.c: gets a field with its size; a missing field is an error */
PETSC_INTERN PetscErrorCode CheckpointFindField(Checkpoint, const char name[], const CheckpointField **);

/*
   plastic.c: names of three fields: coordinates of the quadrature points, plastic strains at these points, and plastic
   deformations at these points. Each rank may read any part of a field.
*/
#define CHECKPOINT_PLASTIC_PLACES      "plastic_places"
#define CHECKPOINT_PLASTIC             "plastic_history"
#define CHECKPOINT_PLASTIC_DEFORMATION "plastic_deformation"
/* 0: no law is plastic; 1: plastic strains are stored; 2: plastic deformations as well */
PETSC_INTERN int            CheckpointPlasticParts(Scene);
PETSC_INTERN PetscErrorCode CheckpointAddPlastic(Scene, Elasticity, Checkpoint);
PETSC_INTERN PetscErrorCode CheckpointGetPlastic(Scene, MPI_Comm, Elasticity, Checkpoint);

/* plastic_nearest.c: finds the nearest of many points */
typedef struct {
  const PetscReal *places;          /* coordinates and body of the points */
  PetscReal        lower[3], size;  /* lower corner of the grid and edge length of its boxes [length] */
  PetscInt         n[3];            /* number of boxes along x, y, z */
  PetscInt        *first, *records; /* records[first[b]] to records[first[b + 1] - 1] are the points in box b */
} PlasticGrid;

PETSC_INTERN PetscErrorCode PlasticGridCreate(PetscInt n, const PetscReal places[], PlasticGrid *);
PETSC_INTERN PetscErrorCode PlasticGridDestroy(PlasticGrid *);
PETSC_INTERN PetscInt       PlasticGridFind(const PlasticGrid *, const PetscReal place[4], PetscReal *square);

/*
   read.c, write.c: numbers of a checkpoint, which are stored as attributes of its file; the list ends with a NULL name
*/
typedef struct {
  const char *name;
  size_t      offset;
} CheckpointNumberField;

PETSC_INTERN const CheckpointNumberField CheckpointNumbers[];
PETSC_INTERN PetscReal                  *CheckpointNumber(Checkpoint, size_t i);

#endif
