/*
   Evaluates a law at the points of a pack: at all at once, or one by one if the law has functions of one point only.
   Values in lanes beyond the last point are then zero.
*/
#include "elementsimpl.h"

/* Gets the moduli and the displacement gradient in lane l. Returns false if there is no such point. */
static PetscBool PointGet(const MaterialModuli *cell, PetscInt q, PetscInt npoints, const Lanes H[9],
  MaterialModuli *own, const MaterialModuli **moduli, PetscReal h[9])
{
  if (q >= npoints) return PETSC_FALSE;
  *moduli = CellModuli(cell, q, own);
  for (int i = 0; i < 9; ++i) h[i] = LANE(H[i], q % LANES);
  return PETSC_TRUE;
}

PetscBool PointsEnergy(const MaterialLaw *law, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes *W)
{
  const MaterialModuli *moduli;
  MaterialModuli        own;
  PetscReal             h[9];

  if (law->energies) return law->energies(cell, H, W);
  *W = (Lanes){0};
  for (int l = 0; l < LANES && PointGet(cell, LANES * pack + l, npoints, H, &own, &moduli, h); ++l) {
    LANE(*W, l) = law->energy(moduli, h);
    if (LANE(*W, l) >= PETSC_INFINITY) return PETSC_FALSE;
  }
  return PETSC_TRUE;
}

PetscBool PointsStress(const MaterialLaw *law, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes P[9])
{
  const MaterialModuli *moduli;
  MaterialModuli        own;
  PetscReal             h[9], p[9];

  if (law->stresses) return law->stresses(cell, H, P);
  for (int i = 0; i < 9; ++i) P[i] = (Lanes){0};
  for (int l = 0; l < LANES && PointGet(cell, LANES * pack + l, npoints, H, &own, &moduli, h); ++l) {
    if (!law->stress(moduli, h, p)) return PETSC_FALSE;
    for (int i = 0; i < 9; ++i) LANE(P[i], l) = p[i];
  }
  return PETSC_TRUE;
}

PetscBool PointsTangent(const MaterialLaw *law, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes A[81])
{
  const MaterialModuli *moduli;
  MaterialModuli        own;
  PetscReal             h[9], a[81];

  if (law->tangents) return law->tangents(cell, H, A);
  for (int i = 0; i < 81; ++i) A[i] = (Lanes){0};
  for (int l = 0; l < LANES && PointGet(cell, LANES * pack + l, npoints, H, &own, &moduli, h); ++l) {
    if (!law->tangent(moduli, h, a)) return PETSC_FALSE;
    for (int i = 0; i < 81; ++i) LANE(A[i], l) = a[i];
  }
  return PETSC_TRUE;
}
