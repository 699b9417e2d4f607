#ifndef RESULTS_H
#define RESULTS_H

#include "src/state/stateimpl.h"

/* Positions of the scene's probes */
struct _n_Probes {
  PetscInt n;
  PetscReal (*points)[3];
  MeshPlace *places;
};

/* Requested results, and their values at the end of the last load step */
struct _n_Results {
  PetscBool  nodes, points; /* requested: at nodes and cells; at quadrature points */
  PetscReal *recovered;     /* recovered stress, 6 values per local node */
  PetscReal *plastic;       /* plastic strain, 7 values a local cell; NULL: no law yields */
  PetscReal *nodal, *density, *places, *point_stress;
  PetscInt   npoints;
  PetscReal *stress; /* of the cells */
  Probes     probes;
  PetscBool  estimate; /* estimate the discretization error at the end of every load step */
  PetscBool *beyond;   /* bodies that strain.c has warned of; NULL before the first load step */
};

#endif
