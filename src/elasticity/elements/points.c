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

/* Fills the n values V of each point by the function `at` of one point */
LANES_INLINE PetscBool PointsFill(PetscBool (*at)(const MaterialModuli *, const PetscReal[9], PetscReal[]), PetscInt n,
  const MaterialModuli *cell, PetscInt pack, PetscInt npoints, const Lanes H[9], Lanes V[])
{
  const MaterialModuli *moduli;
  MaterialModuli        own;
  PetscReal             h[9], v[81];

  for (int i = 0; i < n; ++i) V[i] = (Lanes){0};
  for (int l = 0; l < LANES && PointGet(cell, LANES * pack + l, npoints, H, &own, &moduli, h); ++l) {
    if (!at(moduli, h, v)) return PETSC_FALSE;
    for (int i = 0; i < n; ++i) LANE(V[i], l) = v[i];
  }
  return PETSC_TRUE;
}

PetscBool PointsStress(const MaterialLaw *law, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes P[9])
{
  return law->stresses ? law->stresses(cell, H, P) : PointsFill(law->stress, 9, cell, pack, npoints, H, P);
}

PetscBool PointsTangent(const MaterialLaw *law, const MaterialModuli *cell, PetscInt pack, PetscInt npoints,
  const Lanes H[9], Lanes A[81])
{
  return law->tangents ? law->tangents(cell, H, A) : PointsFill(law->tangent, 81, cell, pack, npoints, H, A);
}

void PointsDilatation(const MaterialLaw *law, PetscInt pack, PetscInt npoints, const Lanes H[9], Lanes C[9],
  Lanes *theta)
{
  PetscReal h[9], c[9];

  if (law->dilatations) {
    law->dilatations(H, C, theta);
    return;
  }
  *theta = (Lanes){0};
  for (int i = 0; i < 9; ++i) C[i] = (Lanes){0};
  for (int l = 0; l < LANES && LANES * pack + l < npoints; ++l) {
    for (int i = 0; i < 9; ++i) h[i] = LANE(H[i], l);
    LANE(*theta, l) = law->dilatation(h, c);
    for (int i = 0; i < 9; ++i) LANE(C[i], l) = c[i];
  }
}
