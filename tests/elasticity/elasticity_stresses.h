/* Energy norm of the true error by the elements' own stresses at their own points, for elements whose stress is not
   that of their displacements */
#ifndef ELASTICITY_STRESSES_H
#define ELASTICITY_STRESSES_H

#include <elasticity.h>
#include "elasticity_point.h"

/* What a point of n in a cell counts of the whole: of tetrahedra those of degree 2 and 5, of hexahedra Gauss's */
static inline PetscErrorCode StressesWeight(PetscBool tetrahedron, PetscInt n, PetscInt q, PetscReal *weight)
{
  const PetscInt width = n == 8 ? 2 : 3, index[3] = {q % width, q / width % width, q / (width * width)};
  PetscReal      gauss[3], line[3];

  PetscFunctionBeginUser;
  PetscCall(PetscDTGaussQuadrature(width, 0, 1, gauss, line));
  if (!tetrahedron) *weight = line[index[0]] * line[index[1]] * line[index[2]];
  else if (n == 4) *weight = 0.25;
  else *weight = q < 4 ? 0.11268792571801585080 : q < 8 ? 0.073493043116361949544 : 0.042546020777081466438;
  PetscFunctionReturn(0);
}

static inline PetscErrorCode StressesVolume(const PointCell *cell, PetscReal *volume)
{
  PetscFunctionBeginUser;
  *volume = 0;
  for (PetscInt q = 0; q < POINTS * POINTS * POINTS; ++q) {
    Point p;

    PetscCall(PointGet(cell, q, &p));
    *volume += p.weight;
  }
  PetscFunctionReturn(0);
}

/* s : C^(-1) : s of an isotropic material, s as xx yy zz xy yz zx */
static inline PetscReal StressesSquared(const MaterialModuli *moduli, const PetscReal s[6])
{
  const PetscReal mean   = (s[0] + s[1] + s[2]) / 3;
  PetscReal       square = 0;

  for (PetscInt k = 0; k < 6; ++k) square += k < 3 ? PetscSqr(s[k] - mean) : 2 * PetscSqr(s[k]);
  return square / (2 * moduli->mu) + PetscSqr(mean) / (moduli->lambda + 2 * moduli->mu / 3);
}

/* Squared: over cells that are parallelepipeds or straight tetrahedra, of a linear material with the exact
   displacement gradient */
static inline PetscErrorCode StressesError(DM dm, Elasticity e, const Material *material,
  void (*gradient)(const PetscReal x[3], PetscReal H[3][3]), Vec u, PetscReal *error)
{
  const MaterialLaw *law;
  MaterialModuli     moduli;
  Vec                coordinates;
  const PetscScalar *x;
  PetscInt           start, end, npoints, n;
  PetscReal         *places, *stress;

  PetscFunctionBeginUser;
  PetscCall(MaterialGetLaw(material, &law));
  PetscCall(MaterialGetModuli(material, &moduli, NULL));
  PetscCall(MeshGetNodeCoordinates(dm, &coordinates));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(ElasticityPointStress(e, u, &npoints, &places, &stress));
  PetscCall(VecGetArrayRead(coordinates, &x));
  n      = npoints / PetscMax(end - start, 1);
  *error = 0;
  for (PetscInt k = 0; k < npoints; ++k) {
    PointCell cell;
    PetscReal volume = 0, weight = 0, H[3][3], exact[6];

    PetscCall(PointCellGet(dm, start + k / n, x, &cell));
    PetscCall(StressesVolume(&cell, &volume));
    PetscCall(StressesWeight((PetscBool)MeshIsTetrahedron(cell.n), n, k % n, &weight));
    gradient(&places[3 * k], H);
    law->cauchy(&moduli, &H[0][0], exact);
    for (PetscInt i = 0; i < 6; ++i) exact[i] -= stress[6 * k + i];
    *error += weight * volume * StressesSquared(&moduli, exact);
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(PetscFree(stress));
  PetscCall(PetscFree(places));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, error, 1, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

#endif
