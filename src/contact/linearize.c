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
  PetscFunctionReturn(0);
}

/* Deforms the surfaces and normals of all pairs */
PetscErrorCode ContactDeform(Contact contact, Vec u)
{
  Vec local, mean = NULL;

  PetscFunctionBegin;
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
  is positive where the faces are open. The row J_A = 1/m_A int phi_A (N2 - N1) n_A is the derivative at fixed overlap
  and fixed normals. With -contact_normals facet the facet's normal is used instead of n_A. Averaged normals vary
  smoothly when faces slide; facet normals transmit a uniform pressure exactly over curved faces with matching meshes.

  Pairs with gap `GAP_NODE` measure g_A = (y - x_A).n_A from the vertex to the closest point y of the mortar facets that
  face it, edges and vertices included; J_A = (N2(y) - 1_A) n_A is the derivative with y's position on the facet and the
  normal fixed. m_A is the same mass, so that multipliers are pressures here too. A vertex that lies outside the mortar
  face by more than a twentieth of a facet has no row.

  Faces of order 2 are divided into facets at their nodes. Smooth mortar pairs then have curved patches, also on planes,
  that follow the deformed face; vertices of other pairs move with the mean displacement of the faces around them. J
  distributes forces so that a uniform pressure gives the same nodal loads as on the quadratic face.

  Where the faces touch, J is the exact derivative of the gap on planes, and on curved faces with -contact_normals
  facet. Otherwise its error is of the order of the angle between neighbouring facets.

  Of a smooth pair with a curved face (`SceneContactPair`), x1 and x2 are on smooth surfaces: patches through the
  deformed vertices whose normals there are the mean normals of the surrounding facets. The surface is continued by
  reflection where a face ends on a symmetry plane (`ContactSetDisplacements()`). The mortar gap is then measured along
  the normal of each nonmortar facet, that of a vertex along the normal of the mortar surface. lin->derivative is the
  exact derivative of the gap, including the rotation of the normals; a row depends on vertices up to two facets away. J
  is the derivative of the mean gap of a row times its currently covered area, with patches that keep their shape and
  rotate with their facets. So its forces are distributed as for plane facets, no force reduces a gap by reducing the
  covered area, and forces and moments on both bodies are in equilibrium to rounding. lin->derivative is used only to
  predict the gap.

  Rows differ between linearizations; lin->vertex and lin->pair identify them. A displacement that is not finite is an
  error.

  References:
. * - M. A. Puso and T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
      Comput. Methods Appl. Mech. Engrg. 193 (2004)

.seealso: `ContactCreate()`, `ContactLinearizationDestroy()`
@*/
PetscErrorCode ContactLinearize(Contact contact, Vec u, ContactLinearization *lin)
{
  ContactAssembly assembly;
  PetscReal       norm;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_1, &norm)); /* BLAS's maximum norm ignores NaN, the 1-norm does not */
  PetscCheck(!PetscIsInfOrNanReal(norm), contact->comm, PETSC_ERR_FP,
    "The displacement at which contact is linearized is not finite");
  PetscCall(ContactDeform(contact, u));
  PetscCall(ContactAssemblyCreate(contact, &assembly));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData     *pair = &contact->pairs[p];
    const ContactGapOps *ops  = gap_ops[pair->gap];
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
