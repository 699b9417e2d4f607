#ifndef RESULTS_H
#define RESULTS_H

#include "src/state/stateimpl.h"

/* Positions of the scene's probes. */
struct _n_Probes {
  PetscInt n;
  PetscReal (*points)[3];
  MeshPlace *places;
};

/* Requested results, and their values at the end of the last load step. */
struct _n_Results {
  PetscBool  nodes, points; /* `nodes`: true if stress at nodes and cells is requested; `points`: true if stress at
                               quadrature points is requested */
  PetscReal *recovered;     /* recovered stress, 6 values per local node */
  PetscReal *plastic;       /* plastic strain, 7 values per cell of this rank; NULL if no material yields */
  PetscReal *nodal, *density, *places, *point_stress;
  Vec        reaction; /* forces of supports on the nodes, if `nodes` is true [force] */
  PetscInt   npoints;
  PetscReal *stress; /* stress of the cells of this rank, 7 values per cell */
  Probes     probes;
  PetscBool  estimate; /* true if the discretization error is estimated at the end of every load step */
  PetscBool *beyond; /* [nbodies] true for bodies about whose strain strain_warnings.c has warned; NULL before the first
                          load step */
};

#endif
