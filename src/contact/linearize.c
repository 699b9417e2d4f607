/* The gap of all pairs, linearized at a displacement */
#include "contactimpl.h"

static const ContactGapOps *PairGetGapOps(const ContactPairData *pair)
{
  if (pair->formula) return &ContactGapRigidSurface;
  return pair->gap == GAP_NODE ? &ContactGapNode : &ContactGapMortar;
}

/* Collective. Deforms the surfaces and normals of pair p. local: displacement of the vertices [length] */
static PetscErrorCode ContactMovePair(Contact contact, PetscInt p, Vec local)
{
  ContactRows     *rows  = &contact->rows;
  ContactPairData *pair  = &contact->pairs[p];
  const PetscInt   first = rows->first[p], n = rows->first[p + 1] - first;

  PetscFunctionBegin;
  PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->mortar));
  PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->nonmortar));
  PetscCall(ContactSurfaceNormals(contact->dm, &pair->nonmortar, NULL, pair->normal, n, rows->vertex + first,
    rows->normal + 3 * first));
  PetscCall(ContactVerticesDeform(contact->dm, local, n, rows->vertex + first, rows->x + 3 * first));
  if (!pair->formula) PetscFunctionReturn(0);
  PetscCall(ContactSurfacePlace(contact->comm, pair));
  PetscCall(ContactSurfaceSetNormals(pair, n, rows->x + 3 * first, rows->normal + 3 * first));
  PetscCall(ContactCornersFind(contact, p));
  PetscFunctionReturn(0);
}

/* Collective. Deforms the surfaces and normals of all pairs to the global displacement u */
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

/*@
  ContactLinearize - Linearizes the gap at a displacement: c(u') = g + J (u' - u)

  Collective

  Input Parameters:
+ contact - the contact
. u       - global displacement vector, 3 components per vertex [length]
- parts   - what is computed: CONTACT_GAPS, the gap and its rows, without the derivatives that only a solve needs; J of
            smooth pairs is the derivative for their facets. CONTACT_FORCES: all

  Output Parameter:
. lin - the linearized gap; it may have no rows

  Level: beginner

  Notes:
  The gap of nonmortar vertex A is g_A = 1/m_A int phi_A (x2 - x1).n_A, integrated over the part of the nonmortar face
  that a mortar face covers. The point x1 is on the nonmortar facet, and x2 is on the mortar facet along the nonmortar
  facet's normal. n_A is the outward area-weighted mean of the normals of the facets around A, and m_A = int phi_A over
  the whole undeformed nonmortar face. The gap is positive where the faces are open. The row J_A = 1/m_A int phi_A (N2 -
  N1) n_A is the derivative for fixed overlap and fixed normals. Averaged normals vary smoothly while the faces slide.

  Pairs with gap `GAP_NODE` have the gap g_A = (y - x_A).n_A, where y is the closest point, also on edges and at
  vertices, of the mortar facets that face the vertex. J_A = (N2(y) - 1_A) n_A is the derivative for a fixed position of
  y on the facet and a fixed normal. m_A is as above, so that pressures are comparable. A vertex outside of the
  mortar face has no row if it is farther than a twentieth of a facet from it. For a vertex on the border of the
  nonmortar face this distance is a fifth of the square root of m_A, because faces with a common border bulge. At a
  common border, mortar facets are extended beyond the border by at most a fifth of a facet.

  Pairs whose mortar side is a rigid surface (`ContactSetBodies()`) have as gap the distance of each nonmortar vertex
  from that surface. J is its derivative. The row of a vertex beside a convex corner of a profile that lies between two
  vertices has the distance of the corner from the edge between them.

  Faces of order 2 are divided into facets at their nodes. The patches of smooth mortar pairs follow the bending of the
  faces between their nodes. The vertices of other pairs, and of plane faces, move with the mean displacement of the
  faces around them. J distributes forces so that a uniform pressure is the same load as on the quadratic face.

  Where the faces touch, J is the derivative of the gap except for the differences between the normals of neighbouring
  facets. It is exact on planes.

  For a smooth pair with a curved face (`SceneContactPair`), x1 and x2 are points of smooth surfaces. These are patches
  through the deformed vertices whose edges follow the mean normals of the facets around the vertices. Where a face ends
  on a plane on which it is held (`ContactSetDisplacements()`), its smooth surface is continued by the mirror image. The
  mortar gap is then measured along the normal of each nonmortar facet, and the gap of a vertex along the normal of the
  mortar surface. J is the derivative of the mean gap of a row times its present covered area, for patches that keep
  their shape and rotate with their facets. The forces of J are distributed like those of facets, and no force reduces
  a gap by reducing the covered area. The forces on both bodies, and their moments, balance up to rounding.

  If the same prescribed displacement holds both faces at a vertex, and the cells beside it do not match, it has no row.
  The integrals of its row are added to those of its free neighbours.

  The rows differ between linearizations. lin->vertex and lin->pair identify them. It is an error if the displacement is
  not finite.

  References:
. * - M. A. Puso and T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics,
      Comput. Methods Appl. Mech. Engrg. 193 (2004)

.seealso: `ContactCreate()`, `ContactLinearizationDestroy()`
@*/
PetscErrorCode ContactLinearize(Contact contact, Vec u, ContactParts parts, ContactLinearization *lin)
{
  ContactAssembly assembly;
  PetscReal       norm;

  PetscFunctionBegin;
  /* The 1-norm is used because the maximum norm of BLAS ignores NaN. */
  PetscCall(VecNorm(u, NORM_1, &norm));
  PetscCheck(!PetscIsInfOrNanReal(norm), contact->comm, PETSC_ERR_FP,
    "The displacement at which contact is linearized is not finite");
  PetscCall(PetscLogEventBegin(CONTACT_Linearize, NULL, NULL, NULL, NULL));
  PetscCall(ContactDeform(contact, u));
  PetscCall(ContactPrescribedRowsDistribute(contact));
  PetscCall(ContactAssemblyCreate(contact, parts, &assembly));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData     *pair = &contact->pairs[p];
    const ContactGapOps *ops  = PairGetGapOps(pair);
    PetscReal box[6] = {PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MAX_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL, PETSC_MIN_REAL};
    ContactCandidates candidates;

    PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
    PetscCall((*ops->box)(contact, p, box));
    PetscCall(ContactExchange(contact->comm, box, &pair->mortar, &candidates));
    PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
    PetscCall((*ops->add)(contact, p, &candidates, &assembly));
    PetscCall(ContactCornersAdd(pair, &assembly));
    PetscCall(ContactCandidatesDestroy(&candidates));
  }
  PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyFinish(contact, &assembly, lin));
  if (contact->stretches) {
    PetscCall(PetscMalloc1((*lin)->nlocal + 1, &(*lin)->area));
    PetscCall(ContactRowAreas(contact, PETSC_TRUE, *lin, (*lin)->area));
  }
  PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyDestroy(&assembly));
  PetscCall(PetscLogEventEnd(CONTACT_Linearize, NULL, NULL, NULL, NULL));
  PetscFunctionReturn(0);
}

/*@
  ContactGetStretch - Computes by how much the nonmortar faces grow around the vertices of the rows

  Collective

  Input Parameters:
+ contact - the contact
. u       - global displacement vector, 3 components per vertex [length]
- lin     - a linearized gap

  Output Parameter:
. stretch - for each row of lin, the lumped area of the nonmortar face at u, divided by that with which the row was
            computed. It is 1 if the nonmortar body has a law of small strain.

  Level: developer

  Note:
  The force of a row divided by the area at u is the pressure (Cauchy stress). Gaps at vertices are computed with
  undeformed areas, other gaps with those at the displacement of the linearization, which may be that of the last load
  step.

.seealso: `ContactLinearize()`
@*/
PetscErrorCode ContactGetStretch(Contact contact, Vec u, ContactLinearization lin, PetscReal stretch[])
{
  PetscFunctionBegin;
  PetscCall(ContactDeform(contact, u));
  PetscCall(ContactRowAreas(contact, PETSC_FALSE, lin, stretch));
  for (PetscInt r = 0; r < lin->nlocal; ++r) stretch[r] = lin->area[r] > 0.0 ? stretch[r] / lin->area[r] : 1.0;
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
  PetscCall(VecDestroy(&(*lin)->doubt));
  PetscCall(VecDestroy(&(*lin)->mass));
  PetscCall(MatDestroy(&(*lin)->J));
  PetscCall(MatDestroy(&(*lin)->cover));
  PetscCall(MatDestroy(&(*lin)->slip));
  PetscCall(MatDestroy(&(*lin)->mortar));
  PetscCall(MatDestroy(&(*lin)->mortar_cover));
  PetscCall(MatDestroy(&(*lin)->mortar_slip));
  PetscCall(PetscFree((*lin)->normal));
  PetscCall(PetscFree((*lin)->tangent));
  PetscCall(PetscFree((*lin)->covered));
  PetscCall(PetscFree((*lin)->area));
  PetscCall(PetscFree((*lin)->mortar_sum));
  PetscCall(PetscFree((*lin)->vertex));
  PetscCall(PetscFree((*lin)->pair));
  PetscCall(PetscFree(*lin));
  PetscFunctionReturn(0);
}
