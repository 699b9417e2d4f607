/* Finds pairs whose faces look away from each other */
#include "contactimpl.h"

/* A facet looks away from a normal if the cosine of the angle between its own normal and that one is larger. */
#define AWAY_COSINE (-CONTACT_NORMAL_COSINE)
#define AWAY_STEPS  8 /* normals are rounded to multiples of 1 / AWAY_STEPS */
#define AWAY_SIDE   (2 * AWAY_STEPS + 1)
#define AWAY_BINS   (AWAY_SIDE * AWAY_SIDE * AWAY_SIDE)

/* Collective. Lists the normals of all facets of a face, rounded, each once. The caller frees *list. */
static PetscErrorCode AwayNormals(MPI_Comm comm, const ContactSurface *s, PetscInt *n, PetscReal **list)
{
  PetscInt *has;

  PetscFunctionBegin;
  PetscCall(PetscCalloc1(AWAY_BINS, &has));
  for (PetscInt f = 0; f < s->nfacets; ++f) {
    PetscReal normal[3];
    PetscInt  bin = 0;

    if (!ContactFacetNormal(&s->x[12 * f], normal)) continue;
    for (PetscInt c = 0; c < 3; ++c)
      bin = AWAY_SIDE * bin + (PetscInt)PetscFloorReal(AWAY_STEPS * (normal[c] + 1.0) + 0.5);
    has[bin] = 1;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, has, AWAY_BINS, MPIU_INT, MPI_MAX, comm));
  *n = 0;
  for (PetscInt b = 0; b < AWAY_BINS; ++b) *n += has[b];
  PetscCall(PetscMalloc1(3 * *n, list));
  *n = 0;
  for (PetscInt b = 0; b < AWAY_BINS; ++b) {
    const PetscInt at[3] = {b / (AWAY_SIDE * AWAY_SIDE), b / AWAY_SIDE % AWAY_SIDE, b % AWAY_SIDE};

    if (!has[b]) continue;
    for (PetscInt c = 0; c < 3; ++c) (*list)[3 * *n + c] = (PetscReal)at[c] / AWAY_STEPS - 1.0;
    (void)VectorScaleToUnit(&(*list)[3 * (*n)++]);
  }
  PetscCall(PetscFree(has));
  PetscFunctionReturn(0);
}

/* Collective. Determines whether all normals of the mortar face look away from all normals of the nonmortar face */
static PetscErrorCode AwayFromFace(MPI_Comm comm, const ContactPairData *pair, PetscBool *away)
{
  PetscReal *mortar, *nonmortar;
  PetscInt   nmortar, nnonmortar;

  PetscFunctionBegin;
  PetscCall(AwayNormals(comm, &pair->mortar, &nmortar, &mortar));
  PetscCall(AwayNormals(comm, &pair->nonmortar, &nnonmortar, &nonmortar));
  *away = PETSC_TRUE;
  for (PetscInt i = 0; i < nmortar && *away; ++i) {
    for (PetscInt j = 0; j < nnonmortar && *away; ++j)
      *away = (PetscBool)(VectorDot(&mortar[3 * i], &nonmortar[3 * j]) > AWAY_COSINE);
  }
  PetscCall(PetscFree(mortar));
  PetscCall(PetscFree(nonmortar));
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
