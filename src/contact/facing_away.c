/* Finds pairs whose faces look away from each other */
#include "contactimpl.h"

/* A facet looks away from a normal if the cosine of the angle between its own normal and that one is larger. */
#define AWAY_COSINE (-CONTACT_NORMAL_COSINE)
#define AWAY_STEPS  8 /* normals are rounded to multiples of 1 / AWAY_STEPS */
#define AWAY_SIDE   (2 * AWAY_STEPS + 1)
#define AWAY_BINS   (AWAY_SIDE * AWAY_SIDE * AWAY_SIDE)

/* Computes the unit normal that is rounded to a bin */
static void AwayNormal(PetscInt bin, PetscReal normal[3])
{
  const PetscInt at[3] = {bin / (AWAY_SIDE * AWAY_SIDE), bin / AWAY_SIDE % AWAY_SIDE, bin % AWAY_SIDE};

  for (PetscInt c = 0; c < 3; ++c) normal[c] = (PetscReal)at[c] / AWAY_STEPS - 1.0;
  (void)VectorScaleToUnit(normal);
}

/* Collective. Determines whether all normals of the mortar face look away from all normals of the nonmortar face */
static PetscErrorCode AwayFromFace(MPI_Comm comm, const ContactPairData *pair, PetscBool *away)
{
  PetscInt *has; /* whether the mortar face, and then whether the nonmortar face, has a facet with this normal */

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(2 * AWAY_BINS, &has));
  for (PetscInt side = 0; side < 2; ++side) {
    const ContactSurface *s = side ? &pair->nonmortar : &pair->mortar;

    for (PetscInt f = 0; f < s->nfacets; ++f) {
      PetscReal normal[3];
      PetscInt  bin = 0;

      if (!ContactFacetNormal(&s->x[12 * f], normal)) continue;
      for (PetscInt c = 0; c < 3; ++c)
        bin = AWAY_SIDE * bin + (PetscInt)PetscFloorReal(AWAY_STEPS * (normal[c] + 1.0) + 0.5);
      has[side * AWAY_BINS + bin] = 1;
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, has, 2 * AWAY_BINS, MPIU_INT, MPI_MAX, comm));
  *away = PETSC_TRUE;
  for (PetscInt a = 0; a < AWAY_BINS && *away; ++a) {
    for (PetscInt b = 0; has[a] && b < AWAY_BINS && *away; ++b) {
      PetscReal m[3], n[3];

      if (!has[AWAY_BINS + b]) continue;
      AwayNormal(a, m);
      AwayNormal(b, n);
      *away = (PetscBool)(VectorDot(m, n) > AWAY_COSINE);
    }
  }
  PetscCall(PetscFree(has));
  PetscFunctionReturn(0);
}

/* Collective. Determines whether all nonmortar facets look away from a rigid surface of which some vertices are within
   the search distance */
static PetscErrorCode AwayFromFormula(MPI_Comm comm, const ContactPairData *pair, PetscBool *away)
{
  const ContactSurface *s     = &pair->nonmortar;
  PetscInt              no[2] = {0, 0}; /* whether a facet faces the surface, and whether a vertex is near */

  PetscFunctionBegin;
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    const PetscReal *x = &s->x[12 * f], xi[2] = {0.0, 0.0};
    PetscReal        center[3] = {0.0, 0.0, 0.0}, phi[4], normal[3], gradient[3], weight[4];

    for (PetscInt a = 0; a < 4; ++a)
      no[1] = no[1] || ContactSurfaceDistance(pair, &x[3 * a], gradient, weight) <= pair->distance;
    ContactShape(xi, phi);
    for (PetscInt i = 0; i < 12; ++i) center[i % 3] += phi[i / 3] * x[i];
    (void)ContactSurfaceDistance(pair, center, gradient, weight);
    no[0] = no[0] || (ContactFacetNormal(x, normal) && VectorDot(gradient, normal) <= AWAY_COSINE);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, no, 2, MPIU_INT, MPI_MAX, comm));
  *away = (PetscBool)(!no[0] && no[1]);
  PetscFunctionReturn(0);
}

/*
   Collective. Determines whether the faces of pair p look away from each other everywhere, in the state of the last
   linearization.

   - turns: whether bodies may rotate by large angles, so that faces of facets may meet although they look away at the
     start. Rigid surfaces without facets act on each vertex that comes near. A face that looks away from such a surface
     and has vertices within the search distance gets wrong forces in any case.
*/
PetscErrorCode ContactLooksAway(Contact contact, PetscInt p, PetscBool turns, PetscBool *away)
{
  const ContactPairData *pair = &contact->pairs[p];

  PetscFunctionBegin;
  *away = PETSC_FALSE;
  if (pair->formula) PetscCall(AwayFromFormula(contact->comm, pair, away));
  else if (!turns && !pair->nonmortar.self) PetscCall(AwayFromFace(contact->comm, pair, away));
  PetscFunctionReturn(0);
}
