/* The gap of all pairs, linearized at a displacement */
#include "contactimpl.h"

static const ContactGapOps *const gap_ops[] = {&ContactGapMortar, &ContactGapNode, &ContactGapMortar}; /* by GapType */

/* Deforms the surfaces and normals of a pair; local: displacement of the vertices */
static PetscErrorCode ContactMovePair(Contact contact, PetscInt p, Vec local)
{
  ContactRows     *rows  = &contact->rows;
  ContactPairData *pair  = &contact->pairs[p];
  const PetscInt   first = rows->first[p], n = rows->first[p + 1] - first;

  PetscFunctionBegin;
  PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->mortar));
  PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->nonmortar));
  PetscCall(ContactSurfaceNormals(contact->dm, &pair->nonmortar, pair->normal, n, rows->vertex + first,
    rows->normal + 3 * first));
  PetscCall(ContactVerticesDeform(contact->dm, local, n, rows->vertex + first, rows->x + 3 * first));
  if (!pair->formula) PetscFunctionReturn(0);
  PetscCall(ContactSurfacePlace(contact->comm, pair));
  PetscCall(ContactSurfaceSetNormals(pair, n, rows->x + 3 * first, rows->normal + 3 * first));
  PetscFunctionReturn(0);
}

/* Deforms the surfaces and normals of all pairs */
PetscErrorCode ContactDeform(Contact contact, Vec u)
{
  Vec local, mean = NULL;

  PetscFunctionBegin;
  PetscCall(ContactSmoothFind(contact, u));
  PetscCall(DMGetLocalVector(contact->dm, &local));
  PetscCall(DMGlobalToLocal(contact->dm, u, INSERT_VALUES, local));
  if (contact->trace) {
    PetscCall(DMGetLocalVector(contact->dm, &mean));
    PetscCall(ContactTraceApply(contact->dm, contact->trace, u, mean));
  }
  for (PetscInt p = 0; p < contact->npairs; ++p)
    PetscCall(ContactMovePair(contact, p, mean && !ContactPairFollows(&contact->pairs[p]) ? mean : local));
  if (mean) PetscCall(DMRestoreLocalVector(contact->dm, &mean));
  PetscCall(DMRestoreLocalVector(contact->dm, &local));
  PetscCall(ContactSmoothDeform(contact, u));
  PetscFunctionReturn(0);
}

/* Gaps of all pairs, and their derivatives unless gaps_only */
static PetscErrorCode ContactMeasure(Contact contact, Vec u, PetscBool gaps_only, ContactLinearization *lin)
{
  ContactAssembly assembly;
  PetscReal       norm;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_1, &norm)); /* BLAS's maximum norm ignores NaN, the 1-norm does not */
  PetscCheck(!PetscIsInfOrNanReal(norm), contact->comm, PETSC_ERR_FP,
    "The displacement at which contact is linearized is not finite");
  PetscCall(PetscLogEventBegin(CONTACT_Linearize, NULL, NULL, NULL, NULL));
  PetscCall(ContactDeform(contact, u));
  PetscCall(ContactAssemblyCreate(contact, &assembly));
  assembly.gaps_only = gaps_only;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData     *pair = &contact->pairs[p];
    const ContactGapOps *ops  = pair->formula ? &ContactGapRigidSurface : gap_ops[pair->gap];
    PetscReal box[6] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL};
    ContactCandidates candidates;

    PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
    PetscCall((*ops->box)(contact, p, box));
    PetscCall(ContactExchange(contact->comm, box, &pair->mortar, &candidates));
    PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
    pair->nfacing = 0;
    PetscCall((*ops->add)(contact, p, &candidates, &assembly));
    PetscCall(ContactCandidatesDestroy(&candidates));
  }
  PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyFinish(contact, &assembly, lin));
  PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyDestroy(&assembly));
  PetscCall(PetscLogEventEnd(CONTACT_Linearize, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*@
  ContactLinearize - Linearizes the gap at a displacement: c(u') = g + J (u' - u)

  Collective

  Input Parameters:
+ contact - the contact
- u       - global displacement vector, 3 components per vertex [length]

  Output Parameter:
. lin - the linearized gap; it may have no rows

  Level: beginner

  Notes:
  The gap of nonmortar vertex A is g_A = 1/m_A int phi_A (x2 - x1).n_A over the part of the nonmortar face that a mortar
  face covers: x1 on the nonmortar facet, x2 on the mortar facet along the nonmortar facet's normal, n_A the outward
  area-weighted mean of the normals of the facets about A, m_A = int phi_A over the whole undeformed nonmortar face. It
  is positive where the faces are open. The row J_A = 1/m_A int phi_A (N2 - N1) n_A keeps the overlap and the normals
  fixed. With -contact_normals facet the facet's normal takes the place of n_A: averaged normals vary smoothly as faces
  slide, but facets' own ones transmit a uniform pressure exactly over curved faces whose meshes match.

  Pairs with gap `GAP_NODE` measure g_A = (y - x_A).n_A from the vertex to the closest point y of the mortar facets that
  face it, edges and vertices included; J_A = (N2(y) - 1_A) n_A keeps y's place on the facet and the normal fixed, and
  m_A is the same mass, so that pressures compare. A vertex beside the mortar face, by more than a twentieth of a facet,
  has no row. A vertex on the border of the nonmortar face has one up to half the size of the area about it: faces that
  end together bulge. Mortar facets at a border that both faces share reach up to a tenth of a facet beyond it.

  Pairs whose mortar side is a rigid surface (`ContactSetBodies()`) measure the distance of each nonmortar vertex from
  it; J is its derivative.

  Faces of order 2 are cut into facets at their nodes. The patches of smooth mortar pairs follow what the faces bend;
  the vertices of others, and of plane faces, move with the mean displacement of the faces about them. J spreads forces
  so that a uniform pressure is the same load as on the quadratic face.

  Where the faces touch, J is the derivative of the gap up to what the normals of neighbouring facets differ: exact on
  planes, and on curved faces with -contact_normals facet.

  Of a smooth pair with a curved face (`SceneContactPair`), x1 and x2 are on the smooth surfaces that the facets stand
  for: patches through the deformed vertices, bent to follow the mean normals of the facets about them, and going on as
  in a mirror where a face ends on a plane that it is held on (`ContactSetDisplacements()`). The mortar gap is then
  measured along the normal of each nonmortar facet, that of a vertex along the normal of the mortar surface.
  lin->derivative is the gap's derivative to rounding, the normals' turning with u included; it reaches two facets far.
  J is the derivative with patches that keep their shape and turn with their facets, of the mean gap of a row times the
  area that is covered now: its forces are spread as those of facets are, none closes a gap by uncovering it, and they
  balance on both bodies, their moments too, to rounding. lin->derivative serves to foresee the gap.

  Rows differ between linearizations; lin->vertex and lin->pair tell which they are. A displacement that is not finite
  is an error.

  References:
. * - M. A. Puso and T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
      Comput. Methods Appl. Mech. Engrg. 193 (2004)

.seealso: `ContactCreate()`, `ContactLinearizationDestroy()`
@*/
PetscErrorCode ContactLinearize(Contact contact, Vec u, ContactLinearization *lin)
{
  PetscFunctionBegin;
  PetscCall(ContactMeasure(contact, u, PETSC_FALSE, lin));
  PetscFunctionReturn(0);
}

/*@
  ContactGetGaps - Measures the gap at a displacement

  Collective

  Input Parameters:
+ contact - the contact
- u       - global displacement vector, 3 components per vertex [length]

  Output Parameter:
. lin - the gap and its rows as of `ContactLinearize()`, without what only a solve needs: J of smooth pairs is that of
        their facets, and lin->derivative is NULL

  Level: developer

.seealso: `ContactLinearize()`, `ContactLinearizationDestroy()`
@*/
PetscErrorCode ContactGetGaps(Contact contact, Vec u, ContactLinearization *lin)
{
  PetscFunctionBegin;
  PetscCall(ContactMeasure(contact, u, PETSC_TRUE, lin));
  PetscFunctionReturn(0);
}

/*@
  ContactLinearizationDestroy - Destroys a linearized gap

  Collective

  Input Parameter:
. lin - the linearized gap, may be NULL

  Level: beginner

.seealso: `ContactLinearize()`
@*/
PetscErrorCode ContactLinearizationDestroy(ContactLinearization *lin)
{
  PetscFunctionBegin;
  if (!*lin) PetscFunctionReturn(0);
  PetscCall(VecDestroy(&(*lin)->g));
  PetscCall(VecDestroy(&(*lin)->mass));
  PetscCall(MatDestroy(&(*lin)->J));
  PetscCall(MatDestroy(&(*lin)->derivative));
  PetscCall(MatDestroy(&(*lin)->cover));
  PetscCall(MatDestroy(&(*lin)->slip));
  PetscCall(PetscFree((*lin)->normal));
  PetscCall(PetscFree((*lin)->tangent));
  PetscCall(PetscFree((*lin)->covered));
  PetscCall(PetscFree((*lin)->vertex));
  PetscCall(PetscFree((*lin)->pair));
  PetscCall(PetscFree(*lin));
  PetscFunctionReturn(0);
}
