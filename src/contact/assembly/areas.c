/* Lumped areas of nonmortar faces whose bodies have a law of finite strain */
#include "assemblyimpl.h"

/* Adds the lumped areas of the nonmortar facets of pair p to `sum`, which has an entry for each possible row.
   undeformed: those of the undeformed facets */
static PetscErrorCode AreasAddPair(const ContactPairData *pair, PetscBool undeformed, Vec sum)
{
  const PetscReal *x = undeformed ? pair->nonmortar.reference : pair->nonmortar.x;

  PetscFunctionBegin;
  for (PetscInt f = 0; f < pair->nonmortar.nfacets; ++f) {
    PetscReal   m[4];
    PetscScalar mass[4];

    (void)ContactFacetMass(&x[12 * f], m);
    for (PetscInt a = 0; a < 4; ++a) mass[a] = m[a];
    PetscCall(VecSetValues(sum, 4, &pair->row[4 * f], mass, ADD_VALUES));
  }
  PetscFunctionReturn(0);
}

/*
   Collective. Computes for each row of a linearization the lumped area of the nonmortar face around the row's vertex,
   for the surfaces as they were deformed last [length^2]. It is 1 for pairs whose nonmortar body has a law of small
   strain. weights: the areas that are the weights of the rows instead; those of gaps at vertices are undeformed.
*/
PetscErrorCode ContactRowAreas(Contact contact, PetscBool weights, ContactLinearization lin, PetscReal area[])
{
  const ContactRows *rows = &contact->rows;
  const PetscScalar *s;
  Vec                sum;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(rows->mass, &sum));
  PetscCall(VecZeroEntries(sum));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair      = &contact->pairs[p];
    const PetscBool        at_vertex = (PetscBool)(pair->formula || pair->gap == GAP_NODE);

    if (pair->stretches) PetscCall(AreasAddPair(pair, (PetscBool)(weights && at_vertex), sum));
  }
  PetscCall(VecAssemblyBegin(sum));
  PetscCall(VecAssemblyEnd(sum));
  PetscCall(VecGetArrayRead(sum, &s));
  for (PetscInt r = 0; r < lin->nlocal; ++r) {
    const PetscInt first = rows->first[lin->pair[r]];
    PetscInt       i;

    area[r] = 1.0;
    if (!contact->pairs[lin->pair[r]].stretches) continue;
    PetscCall(PetscFindInt(lin->vertex[r], rows->first[lin->pair[r] + 1] - first, rows->vertex + first, &i));
    if (i >= 0) area[r] = PetscRealPart(s[first + i]);
  }
  PetscCall(VecRestoreArrayRead(sum, &s));
  PetscCall(VecDestroy(&sum));
  PetscFunctionReturn(0);
}
