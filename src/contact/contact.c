/* The contact object: pairs of faces, options, linearization of the gap */
#include "contactimpl.h"

/* Facets pair by default within this part of the size of the smaller face, the square root of its area */
#define SEARCH_FRACTION 0.25

const char *const ContactGapTypes[] = {"mortar", "ContactGapType", "CONTACT_GAP_", NULL};

PetscLogEvent CONTACT_Search, CONTACT_Integrate;

static PetscErrorCode ContactInitializePackage(void)
{
  static PetscBool initialized = PETSC_FALSE;
  PetscClassId     classid;

  PetscFunctionBegin;
  if (initialized) PetscFunctionReturn(0);
  initialized = PETSC_TRUE;
  PetscCall(PetscClassIdRegister("Contact", &classid));
  PetscCall(PetscLogEventRegister("ContactSearch", classid, &CONTACT_Search));
  PetscCall(PetscLogEventRegister("ContactIntegr", classid, &CONTACT_Integrate));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactCheckPairs(DM dm, PetscInt npairs, const ContactPair pairs[])
{
  MPI_Comm comm = PetscObjectComm((PetscObject)dm);

  PetscFunctionBegin;
  for (PetscInt p = 0; p < npairs; ++p) {
    PetscBool same, has;

    PetscCall(PetscStrcmp(pairs[p].mortar, pairs[p].nonmortar, &same));
    PetscCheck(!same, comm, PETSC_ERR_ARG_WRONG, "Contact pair %" PetscInt_FMT " names face \"%s\" twice", p, pairs[p].mortar);
    PetscCall(DMHasLabel(dm, pairs[p].mortar, &has));
    PetscCheck(has, comm, PETSC_ERR_ARG_WRONG, "Contact pair %" PetscInt_FMT " names mortar face \"%s\", but the mesh has no such face", p, pairs[p].mortar);
    PetscCall(DMHasLabel(dm, pairs[p].nonmortar, &has));
    PetscCheck(has, comm, PETSC_ERR_ARG_WRONG, "Contact pair %" PetscInt_FMT " names nonmortar face \"%s\", but the mesh has no such face", p, pairs[p].nonmortar);
    for (PetscInt q = 0; q < p; ++q) {
      PetscBool mortar, nonmortar;

      PetscCall(PetscStrcmp(pairs[p].mortar, pairs[q].mortar, &mortar));
      PetscCall(PetscStrcmp(pairs[p].nonmortar, pairs[q].nonmortar, &nonmortar));
      PetscCheck(!mortar || !nonmortar, comm, PETSC_ERR_ARG_WRONG, "Contact pairs %" PetscInt_FMT " and %" PetscInt_FMT " are the same: mortar \"%s\", nonmortar \"%s\"", q, p, pairs[p].mortar, pairs[p].nonmortar);
    }
  }
  PetscFunctionReturn(0);
}

/* How far apart, and how deep in one another, facets still pair: constant lengths, whatever the mesh */
static PetscErrorCode ContactSetSearch(Contact contact)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];

    pair->distance = contact->distance > 0.0 ? contact->distance : SEARCH_FRACTION * PetscSqrtReal(PetscMin(pair->mortar.area, pair->nonmortar.area));
    pair->depth    = contact->depth > 0.0 ? contact->depth : PetscMin(pair->mortar.thickness, pair->nonmortar.thickness);
  }
  PetscFunctionReturn(0);
}

/*@C
  ContactCreate - Creates the contact of pairs of faces of a mesh

  Collective

  Input Parameters:
+ dm     - the mesh, as `MeshCreate()` gives it: 3 displacement components a vertex, face labels, "body" label
. npairs - number of contact pairs, 0 or more
- pairs  - the pairs, the same on all ranks; a face may be in several

  Output Parameter:
. contact - the contact

  Level: beginner

  Notes:
  A pair that names a face the mesh does not have, the same face twice, or the same faces as another pair is an error.

.seealso: `ContactSetFromOptions()`, `ContactLinearize()`, `ContactDestroy()`
@*/
PetscErrorCode ContactCreate(DM dm, PetscInt npairs, const ContactPair pairs[], Contact *contact)
{
  Contact    c;
  PetscInt   nbodies;
  PetscReal *thickness;

  PetscFunctionBegin;
  PetscCall(ContactInitializePackage());
  PetscCall(ContactCheckPairs(dm, npairs, pairs));
  PetscCall(PetscNew(&c));
  PetscCall(PetscObjectReference((PetscObject)dm));
  c->dm           = dm;
  c->comm         = PetscObjectComm((PetscObject)dm);
  c->npairs       = npairs;
  c->type         = CONTACT_GAP_MORTAR;
  c->gap          = ContactGap_Mortar;
  c->cosine       = -0.174;
  c->overlap_drop = 1e-8;
  c->row_drop     = 1e-5;
  PetscCall(PetscCalloc1(npairs, &c->pairs));
  PetscCall(ContactBodyThickness(dm, &nbodies, &thickness));
  for (PetscInt p = 0; p < npairs; ++p) {
    PetscCall(ContactSurfaceCreate(dm, pairs[p].mortar, thickness, &c->pairs[p].mortar));
    PetscCall(ContactSurfaceCreate(dm, pairs[p].nonmortar, thickness, &c->pairs[p].nonmortar));
  }
  PetscCall(PetscFree(thickness));
  PetscCall(ContactRowsCreate(c));
  PetscCall(ContactSetSearch(c));
  *contact = c;
  PetscFunctionReturn(0);
}

/*@
  ContactSetFromOptions - Sets a contact's parameters from the options database

  Collective

  Input Parameter:
. contact - the contact

  Options Database Keys:
+ -contact_gap <mortar>              - how the gap is measured
. -contact_search_distance <length>  - facets farther apart do not pair; 0: a quarter of the square root of the smaller face's area
. -contact_search_depth <length>     - facets deeper in one another do not pair; 0: the smallest mean thickness of the bodies in contact
. -contact_normal_cosine <-0.174>    - facets pair when the cosine between their normals is at most this
. -contact_overlap_drop <1e-8>       - overlaps below this part of the smaller facet's area are left out
. -contact_row_drop <1e-5>           - rows whose 1-norm is below this part of the largest row's are left out
- -contact_view                      - prints the contact after every linearization

  Level: beginner

.seealso: `ContactCreate()`, `ContactLinearize()`
@*/
PetscErrorCode ContactSetFromOptions(Contact contact)
{
  PetscFunctionBegin;
  PetscOptionsBegin(contact->comm, NULL, "Contact options", "Contact");
  PetscCall(PetscOptionsEnum("-contact_gap", "How the gap is measured", "ContactSetFromOptions", ContactGapTypes, (PetscEnum)contact->type, (PetscEnum *)&contact->type, NULL));
  PetscCall(PetscOptionsReal("-contact_search_distance", "Facets farther apart than this length do not pair (0: from the size of the faces)", "ContactSetFromOptions", contact->distance, &contact->distance, NULL));
  PetscCall(PetscOptionsReal("-contact_search_depth", "Facets deeper in one another than this length do not pair (0: from the thickness of the bodies)", "ContactSetFromOptions", contact->depth, &contact->depth, NULL));
  PetscCall(PetscOptionsReal("-contact_normal_cosine", "Facets pair when the cosine between their normals is at most this", "ContactSetFromOptions", contact->cosine, &contact->cosine, NULL));
  PetscCall(PetscOptionsReal("-contact_overlap_drop", "Overlaps below this part of the smaller facet's area are left out", "ContactSetFromOptions", contact->overlap_drop, &contact->overlap_drop, NULL));
  PetscCall(PetscOptionsReal("-contact_row_drop", "Rows whose 1-norm is below this part of the largest are left out", "ContactSetFromOptions", contact->row_drop, &contact->row_drop, NULL));
  PetscCall(PetscOptionsViewer("-contact_view", "View the contact after every linearization", "ContactView", NULL, NULL, NULL));
  PetscOptionsEnd();
  PetscCheck(contact->distance >= 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_search_distance must not be negative, but is %g", (double)contact->distance);
  PetscCheck(contact->depth >= 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_search_depth must not be negative, but is %g", (double)contact->depth);
  PetscCheck(contact->cosine >= -1.0 && contact->cosine < 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_normal_cosine must be in [-1, 0), but is %g", (double)contact->cosine);
  PetscCheck(contact->overlap_drop >= 0.0 && contact->overlap_drop < 1.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_overlap_drop must be in [0, 1), but is %g", (double)contact->overlap_drop);
  PetscCheck(contact->row_drop >= 0.0 && contact->row_drop < 1.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE, "-contact_row_drop must be in [0, 1), but is %g", (double)contact->row_drop);
  PetscCall(ContactSetSearch(contact));
  PetscFunctionReturn(0);
}

/* The surfaces and normals at displacement u */
static PetscErrorCode ContactDeform(Contact contact, Vec u)
{
  ContactRows *rows = &contact->rows;
  Vec          local;

  PetscFunctionBegin;
  PetscCall(DMGetLocalVector(contact->dm, &local));
  PetscCall(DMGlobalToLocal(contact->dm, u, INSERT_VALUES, local));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair  = &contact->pairs[p];
    const PetscInt   first = rows->first[p];

    PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->mortar));
    PetscCall(ContactSurfaceDeform(contact->dm, local, &pair->nonmortar));
    PetscCall(ContactSurfaceNormals(contact->dm, &pair->nonmortar, pair->normal, rows->first[p + 1] - first, rows->vertex + first, rows->normal + 3 * first));
  }
  PetscCall(DMRestoreLocalVector(contact->dm, &local));
  PetscFunctionReturn(0);
}

static PetscErrorCode ContactViewFromOptions(Contact contact)
{
  PetscViewer       viewer;
  PetscViewerFormat format;
  PetscBool         flag;

  PetscFunctionBegin;
  PetscCall(PetscOptionsGetViewer(contact->comm, NULL, NULL, "-contact_view", &viewer, &format, &flag));
  if (!flag) PetscFunctionReturn(0);
  PetscCall(PetscViewerPushFormat(viewer, format));
  PetscCall(ContactView(contact, viewer));
  PetscCall(PetscViewerPopFormat(viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscFunctionReturn(0);
}

/*@
  ContactLinearize - Linearizes the gap at a displacement: c(u') = g + J (u' - u)

  Collective

  Input Parameters:
+ contact - the contact
- u       - global displacement vector, 3 components a vertex [length]

  Output Parameter:
. lin - the linearized gap; may have no rows at all

  Options Database Key:
. -contact_view - prints the pairs, the search distances and the number of rows

  Level: beginner

  Notes:
  The gap of nonmortar vertex A is g_A = 1/m_A int phi_A (x2 - x1).n_A over the part of the nonmortar face that a mortar
  face covers: x1 on the nonmortar facet, x2 on the mortar facet along the nonmortar facet's normal, n_A the outward
  area-weighted mean of the normals of the facets about A, m_A = int phi_A over the whole undeformed nonmortar face. It is
  positive where the faces are open. The row J_A = 1/m_A int phi_A (N2 - N1) n_A keeps the overlap and the normals fixed.

  Rows differ between linearizations; lin->vertex and lin->pair tell which they are. A displacement that is not finite is an
  error.

  References:
. * - M. A. Puso and T. A. Laursen, A mortar segment-to-segment contact method for large deformation solid mechanics, Comput. Methods Appl. Mech. Engrg. 193 (2004)

.seealso: `ContactCreate()`, `ContactLinearizationDestroy()`
@*/
PetscErrorCode ContactLinearize(Contact contact, Vec u, ContactLinearization *lin)
{
  ContactAssembly assembly;
  PetscReal       norm;

  PetscFunctionBegin;
  PetscCall(VecNorm(u, NORM_1, &norm)); /* the maximum norm of BLAS passes over NaN */
  PetscCheck(!PetscIsInfOrNanReal(norm), contact->comm, PETSC_ERR_FP, "The displacement at which contact is linearized is not finite");
  contact->noverlaps = 0;
  PetscCall(ContactDeform(contact, u));
  PetscCall(ContactAssemblyCreate(contact, &assembly));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];
    ContactCandidates      candidates;
    ContactNear            near;

    PetscCall(PetscLogEventBegin(CONTACT_Search, NULL, NULL, NULL, NULL));
    PetscCall(ContactExchange(contact->comm, pair, &candidates));
    PetscCall(ContactSearch(pair, &candidates, &near));
    PetscCall(PetscLogEventEnd(CONTACT_Search, NULL, NULL, NULL, NULL));
    PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
    PetscCall((*contact->gap)(contact, pair, &candidates, &near, &assembly));
    PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
    PetscCall(ContactNearDestroy(&near));
    PetscCall(ContactCandidatesDestroy(&candidates));
  }
  PetscCall(PetscLogEventBegin(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyFinish(contact, &assembly, lin));
  PetscCall(PetscLogEventEnd(CONTACT_Integrate, NULL, NULL, NULL, NULL));
  PetscCall(ContactAssemblyDestroy(&assembly));
  PetscCall(ContactViewFromOptions(contact));
  PetscFunctionReturn(0);
}

/*@
  ContactView - Prints a contact: its pairs, what is searched, and the rows of the last linearization

  Collective

  Input Parameters:
+ contact - the contact
- viewer  - an ASCII viewer; others are ignored

  Options Database Key:
. -contact_view - calls this after every linearization

  Level: intermediate

.seealso: `ContactLinearize()`
@*/
PetscErrorCode ContactView(Contact contact, PetscViewer viewer)
{
  PetscBool ascii;
  PetscInt  noverlaps;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  PetscCallMPI(MPI_Allreduce(&contact->noverlaps, &noverlaps, 1, MPIU_INT, MPI_SUM, contact->comm));
  PetscCall(PetscViewerASCIIPrintf(viewer, "Contact: %" PetscInt_FMT " pairs, gap %s, %" PetscInt_FMT " overlapping facet pairs, %" PetscInt_FMT " rows\n", contact->npairs, ContactGapTypes[contact->type], noverlaps, contact->nrows));
  PetscCall(PetscViewerASCIIPushTab(viewer));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    const ContactPairData *pair = &contact->pairs[p];

    PetscCall(PetscViewerASCIIPrintf(viewer, "pair %" PetscInt_FMT ": mortar %s, nonmortar %s, search distance %g, depth %g\n", p, pair->mortar.name, pair->nonmortar.name, (double)pair->distance, (double)pair->depth));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "facets pair where the cosine of their normals is at most %g and they overlap by more than %g of the smaller; rows below %g of the largest are left out\n", (double)contact->cosine, (double)contact->overlap_drop,
                                   (double)contact->row_drop));
  PetscCall(PetscViewerASCIIPopTab(viewer));
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
  PetscCall(PetscFree((*lin)->vertex));
  PetscCall(PetscFree((*lin)->pair));
  PetscCall(PetscFree(*lin));
  PetscFunctionReturn(0);
}

/*@
  ContactDestroy - Destroys a contact

  Collective

  Input Parameter:
. contact - the contact, may be NULL

  Level: beginner

.seealso: `ContactCreate()`
@*/
PetscErrorCode ContactDestroy(Contact *contact)
{
  PetscFunctionBegin;
  if (!*contact) PetscFunctionReturn(0);
  PetscCall(ContactRowsDestroy(*contact));
  for (PetscInt p = 0; p < (*contact)->npairs; ++p) {
    PetscCall(ContactSurfaceDestroy(&(*contact)->pairs[p].mortar));
    PetscCall(ContactSurfaceDestroy(&(*contact)->pairs[p].nonmortar));
  }
  PetscCall(PetscFree((*contact)->pairs));
  PetscCall(DMDestroy(&(*contact)->dm));
  PetscCall(PetscFree(*contact));
  PetscFunctionReturn(0);
}
