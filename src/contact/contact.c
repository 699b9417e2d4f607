/* The contact object: creation from pairs of faces, options, search distances */
#include "contactimpl.h"
#include "src/contact/self/selfimpl.h"

/* upper bound of the search depth of a pair whose search distance is given, as a fraction of the thickness of both
   bodies */
#define THROUGH_FRACTION 0.9
/* degree of the quadrature rule on the triangles of an overlap. The integrand on parallelograms, a product of two
   bilinear functions, has degree 4. The rules of degree 4 and 5 have 6 and 7 points. */
#define RULE_DEGREE 5
/* The same between smooth surfaces, where the integrand on parallelograms has degree 6. With a lower degree the
   integral would depend on how the overlap is divided into triangles. The derivative of the gap would jump where nearly
   coincident edges of the two faces cross, and contact updates would not converge there. */
#define RULE_DEGREE_SMOOTH 6

/* Returns the name of a pair for messages: the nonmortar face if the pair has no name */
static const char *ContactPairName(const SceneContactPair *pair)
{
  return pair->name ? pair->name : pair->nonmortar;
}

/* Checks that the pairs name different existing faces, and that their numbers are in range */
static PetscErrorCode ContactCheckPairs(DM dm, PetscInt npairs, const SceneContactPair pairs[])
{
  MPI_Comm comm = PetscObjectComm((PetscObject)dm);

  PetscFunctionBegin;
  for (PetscInt p = 0; p < npairs; ++p) {
    const char *name = ContactPairName(&pairs[p]);
    PetscBool   same, has;

    PetscCall(PetscStrcmp(pairs[p].mortar, pairs[p].nonmortar, &same));
    SceneCheck(same == (PetscBool)(pairs[p].self != NULL), comm, PETSC_ERR_ARG_WRONG, &pairs[p],
      "Contact pair \"%s\" names face \"%s\" as both sides, which is allowed only for a pair in contact with itself",
      name, pairs[p].mortar);
    PetscCall(DMHasLabel(dm, pairs[p].mortar, &has));
    SceneCheck(has, comm, PETSC_ERR_ARG_WRONG, &pairs[p],
      "Contact pair \"%s\" names mortar face \"%s\", but the mesh has no such face", name, pairs[p].mortar);
    SceneCheck(pairs[p].gap >= GAP_AUTO && pairs[p].gap <= GAP_DUAL, comm, PETSC_ERR_ARG_OUTOFRANGE, &pairs[p],
      "Contact pair \"%s\" has the unknown gap formulation %d", name, (int)pairs[p].gap);
    SceneCheck(pairs[p].distance >= 0.0, comm, PETSC_ERR_ARG_OUTOFRANGE, &pairs[p],
      "Contact pair \"%s\" has search distance %g, but it must not be negative", name, (double)pairs[p].distance);
    PetscCall(DMHasLabel(dm, pairs[p].nonmortar, &has));
    SceneCheck(has, comm, PETSC_ERR_ARG_WRONG, &pairs[p],
      "Contact pair \"%s\" names nonmortar face \"%s\", but the mesh has no such face", name, pairs[p].nonmortar);
    for (PetscInt q = 0; q < p; ++q) {
      PetscBool mortar, nonmortar;

      PetscCall(PetscStrcmp(pairs[p].mortar, pairs[q].mortar, &mortar));
      PetscCall(PetscStrcmp(pairs[p].nonmortar, pairs[q].nonmortar, &nonmortar));
      SceneCheck(!mortar || !nonmortar, comm, PETSC_ERR_ARG_WRONG, &pairs[p],
        "Contact pairs \"%s\" and \"%s\" are the same: mortar \"%s\", nonmortar \"%s\"", ContactPairName(&pairs[q]),
        name, pairs[p].mortar, pairs[p].nonmortar);
    }
  }
  PetscFunctionReturn(0);
}

/*
   Returns the search depth of a pair: the penetration up to which facets face each other [length]. With a larger depth
   the far sides of thin bodies would face each other through the bodies. For two touching plates this would happen at
   the sum of their thicknesses.
*/
static PetscReal ContactGetDepth(const ContactPairData *pair)
{
  const PetscReal t1 = pair->nonmortar.thickness, t2 = pair->mortar.thickness, thinner = PetscMin(t1, t2);

  if (pair->mortar.body == pair->nonmortar.body) return thinner;
  return PetscMax(thinner, PetscMin(pair->given, THROUGH_FRACTION * (t1 + t2)));
}

/* Collective. Sets the search distance and the search depth of all pairs. They are lengths that do not depend on the
   refinement of the mesh. Finds the borders of the faces. */
static PetscErrorCode ContactSetUpPairs(Contact contact)
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];
    const PetscReal  area = pair->formula ? pair->nonmortar.area : PetscMin(pair->mortar.area, pair->nonmortar.area);

    pair->distance =
      pair->given > 0.0 ? pair->given : PetscMax(contact->reach, CONTACT_SEARCH_FRACTION * PetscSqrtReal(area));
    pair->depth = PetscMax(contact->reach_depth, contact->depth > 0.0 ? contact->depth : ContactGetDepth(pair));
    if (!pair->mortar.bordered) PetscCall(ContactSurfaceFindBorder(contact->dm, &pair->mortar));
    if (!pair->nonmortar.bordered) PetscCall(ContactSurfaceFindBorder(contact->dm, &pair->nonmortar));
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates the correction for faces of order 2 (trace.c) */
static PetscErrorCode ContactCreateTrace(Contact contact)
{
  const ContactSurface **surface;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(2 * contact->npairs, &surface));
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    surface[2 * p]     = &contact->pairs[p].mortar;
    surface[2 * p + 1] = &contact->pairs[p].nonmortar;
  }
  PetscCall(ContactTraceCreate(contact->dm, 2 * contact->npairs, surface, CONTACT_TRACE_FORWARD, 3, &contact->trace));
  PetscCall(PetscFree(surface));
  PetscFunctionReturn(0);
}

static void PairSetGap(ContactPairData *pair, GapType gap)
{
  pair->may_be_dual = (PetscBool)(gap == GAP_AUTO);
  pair->gap         = gap == GAP_AUTO ? GAP_MORTAR : gap;
}

/*@C
  ContactCreate - Creates the contact of pairs of faces of a mesh

  Collective

  Input Parameters:
+ dm     - the mesh, as `MeshCreate()` gives it: 3 displacement components per vertex, face labels, "body" label
. npairs - number of contact pairs, 0 or more
- pairs  - the pairs, the same on all ranks; a face may be in several

  Output Parameter:
. contact - the contact

  Level: beginner

  Notes:
  It is an error if a pair names a face that the mesh does not have, if its two faces are one face without `self`, if
  another pair has the same two faces, or if its search distance is negative.

.seealso: `ContactSetFromOptions()`, `ContactLinearize()`, `ContactDestroy()`
@*/
PetscErrorCode ContactCreate(DM dm, PetscInt npairs, const SceneContactPair pairs[], Contact *contact)
{
  Contact         c;
  ContactBoundary boundary;
  PetscReal      *thickness;

  PetscFunctionBegin;
  PetscCall(EventsRegister());
  PetscCall(ContactCheckPairs(dm, npairs, pairs));
  PetscCall(PetscNew(&c));
  PetscCall(PetscObjectReference((PetscObject)dm));
  c->dm     = dm;
  c->comm   = PetscObjectComm((PetscObject)dm);
  c->npairs = npairs;
  PetscCall(ContactRuleCreate(RULE_DEGREE, &c->rule[0]));
  PetscCall(ContactRuleCreate(RULE_DEGREE_SMOOTH, &c->rule[1]));
  PetscCall(PetscCalloc1(npairs, &c->pairs));
  PetscCall(ContactBoundaryCreate(dm, &boundary));
  PetscCall(PetscMalloc1(boundary.nbodies, &thickness));
  PetscCall(ContactBoundaryThickness(&boundary, thickness));
  PetscCall(ContactBoundaryDestroy(&boundary));
  for (PetscInt p = 0; p < npairs; ++p) {
    PetscCall(PetscStrallocpy(ContactPairName(&pairs[p]), &c->pairs[p].name));
    c->pairs[p].place = pairs[p].place;
    PairSetGap(&c->pairs[p], pairs[p].gap);
    c->pairs[p].given      = pairs[p].distance;
    c->pairs[p].smooth     = pairs[p].smooth;
    c->pairs[p].frictional = SceneContactPairHasFriction(&pairs[p]);
    c->pairs[p].sticks     = (PetscBool)(pairs[p].friction >= PETSC_INFINITY && pairs[p].shear_limit >= PETSC_INFINITY);
    c->frictional          = (PetscBool)(c->frictional || c->pairs[p].frictional);
    PetscCall(ContactSurfaceCreate(dm, pairs[p].mortar, thickness, &c->pairs[p].mortar));
    PetscCall(ContactSurfaceCreate(dm, pairs[p].nonmortar, thickness, &c->pairs[p].nonmortar));
    if (!pairs[p].self) continue;
    PetscCall(ContactSelfCreate(dm, &c->pairs[p].mortar));
    PetscCall(ContactSelfCreate(dm, &c->pairs[p].nonmortar));
    c->self = PETSC_TRUE;
  }
  PetscCall(PetscFree(thickness));
  PetscCall(ContactCreateTrace(c));
  PetscCall(ContactRowsCreate(c));
  PetscCall(ContactHangingRowsCreate(c));
  PetscCall(ContactSetUpPairs(c));
  *contact = c;
  PetscFunctionReturn(0);
}

/*@
  ContactSetFromOptions - Sets a contact's parameters from the options database

  Collective

  Input Parameter:
. contact - the contact

  Options Database Keys:
+ -contact_gap <auto>                - how the gap of every pair is measured: auto, mortar, node or dual; overrides the
                                       setting of the pairs
. -contact_smooth <true,false>       - whether the gap of every pair is measured between smooth surfaces through the
                                       facets; overrides the setting of the pairs
. -contact_quadrature <5>            - degree, 1 to 8, of the quadrature rule on the triangles of an overlap, for the
                                       mortar integrals. Without the option it is 5, and 6 between smooth surfaces
- -contact_search_depth <length>     - largest penetration at which facets count as facing each other. 0: the mean
                                       thickness of the thinner body or, if that is larger, the search distance that the
                                       pair sets, but at most 0.9 times the sum of both thicknesses

  Level: beginner

.seealso: `ContactCreate()`, `ContactLinearize()`
@*/
PetscErrorCode ContactSetFromOptions(Contact contact)
{
  GapType   gap    = GAP_AUTO;
  PetscInt  degree = contact->rule[0].degree;
  PetscBool smooth = contact->npairs ? contact->pairs[0].smooth : PETSC_FALSE;
  PetscBool set_gap, set_smooth, set_degree;

  PetscFunctionBegin;
  PetscOptionsBegin(contact->comm, NULL, "Contact options", "Contact");
  PetscCall(PetscOptionsEnum("-contact_gap", "How the gap of every pair is measured", "ContactSetFromOptions", GapTypes,
    (PetscEnum)gap, (PetscEnum *)&gap, &set_gap));
  PetscCall(PetscOptionsBool("-contact_smooth", "Measure the gap of every pair between smooth surfaces",
    "ContactSetFromOptions", smooth, &smooth, &set_smooth));
  PetscCall(PetscOptionsInt("-contact_quadrature",
    "Polynomial degree for which mortar integrals are exact on each triangle of an overlap", "ContactSetFromOptions",
    degree, &degree, &set_degree));
  PetscCall(PetscOptionsReal("-contact_search_depth",
    "Largest penetration that the contact search finds; 0: chosen from the thickness of the bodies",
    "ContactSetFromOptions", contact->depth, &contact->depth, NULL));
  PetscOptionsEnd();
  PetscCheck(degree >= 1 && degree <= CONTACT_RULE_DEGREE, contact->comm, PETSC_ERR_ARG_OUTOFRANGE,
    "-contact_quadrature must be in 1 to %d, but is %" PetscInt_FMT, CONTACT_RULE_DEGREE, degree);
  PetscCheck(contact->depth >= 0.0, contact->comm, PETSC_ERR_ARG_OUTOFRANGE,
    "-contact_search_depth must not be negative, but is %g", (double)contact->depth);
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    PetscCheck(!set_gap || gap != GAP_NODE || !contact->pairs[p].mortar.self, contact->comm, PETSC_ERR_SUP,
      "-contact_gap node is between two faces, but contact pair \"%s\" is the face %s in contact with itself",
      contact->pairs[p].name, contact->pairs[p].mortar.name);
    if (set_gap) PairSetGap(&contact->pairs[p], gap);
    if (set_smooth && !contact->pairs[p].formula) contact->pairs[p].smooth = smooth;
  }
  PetscCall(ContactSmoothReset(contact));
  for (PetscInt k = 0; set_degree && k < 2; ++k) PetscCall(ContactRuleCreate(degree, &contact->rule[k]));
  PetscCall(ContactSetUpPairs(contact));
  PetscFunctionReturn(0);
}

/*@C
  ContactSetDisplacements - Sets the prescribed displacements of the bodies' faces, which determine the symmetry planes
  of smooth surfaces, the directions without friction, and the vertices without a row

  Collective

  Input Parameters:
+ contact       - the contact
. n             - number of prescribed displacements
- displacements - the prescribed displacements; not copied, they must exist until the contact is destroyed

  Level: intermediate

  Note:
  If a face ends at right angles on a plane perpendicular to an axis, and its vertices there are held along that axis,
  its smooth surface is continued by its mirror image. Elsewhere the smooth surface ends at the border of the face, and
  the normals on the border are extrapolated.

.seealso: `ContactCreate()`, `ContactLinearize()`
@*/
PetscErrorCode ContactSetDisplacements(Contact contact, PetscInt n, const SceneDisplacement displacements[])
{
  PetscFunctionBegin;
  contact->ndisplacements = n;
  contact->displacements  = displacements;
  PetscCall(PetscFree(contact->rows.no_slip));
  PetscCall(ContactPrescribedRowsReset(contact));
  PetscCall(ContactSmoothReset(contact));
  PetscFunctionReturn(0);
}

/*@C
  ContactSetBodies - Sets the bodies of a contact, some of which may be rigid surfaces

  Logically Collective

  Input Parameters:
+ contact - the contact
- bodies  - the bodies of the mesh; not copied, they must exist until the contact is destroyed

  Level: intermediate

  Note:
  A pair whose mortar side is a rigid surface measures its gap from the formula of the surface. A rigid surface as the
  nonmortar side is an error.

.seealso: `ContactCreate()`, `ContactLinearize()`
@*/
PetscErrorCode ContactSetBodies(Contact contact, const SceneBody bodies[])
{
  PetscFunctionBegin;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];

    SceneCheck(!SceneBodyIsSurface(&bodies[pair->nonmortar.body]), contact->comm, PETSC_ERR_ARG_WRONG, pair,
      "Contact pair \"%s\": the nonmortar side %s is a rigid surface, which has no nodes for the contact constraints: "
      "make it the mortar side",
      pair->name, pair->nonmortar.name);
    pair->stretches    = MaterialIsFinite(&bodies[pair->nonmortar.body].material);
    contact->stretches = (PetscBool)(contact->stretches || pair->stretches);
    if (!SceneBodyIsSurface(&bodies[pair->mortar.body])) continue;
    pair->formula = &bodies[pair->mortar.body];
    pair->smooth  = PETSC_FALSE;
  }
  PetscCall(ContactSmoothReset(contact));
  PetscCall(ContactSetUpPairs(contact));
  PetscFunctionReturn(0);
}

/* Determines whether a face of a pair is curved before it deforms, and its gap is measured from a smooth surface. pair:
   number of the pair. The answer is known after the first linearization. */
PetscErrorCode ContactIsCurved(Contact contact, PetscInt pair, PetscBool *curved)
{
  const ContactPairData *data = &contact->pairs[pair];

  PetscFunctionBegin;
  *curved = data->formula ? (PetscBool)(data->formula->shape != SHAPE_RIGID_PLANE) : data->mortar.patched;
  PetscFunctionReturn(0);
}

/*@
  ContactIsAtEdge - Finds whether a node is on the edge of a pair's nonmortar face

  Collective

  Input Parameters:
+ contact - the contact
. pair    - number of the pair
- node    - number of the node in global vectors; equal on all ranks

  Output Parameter:
. edge - whether the node is on the edge; equal on all ranks

  Level: developer

.seealso: `ContactCreate()`
@*/
PetscErrorCode ContactIsAtEdge(Contact contact, PetscInt pair, PetscInt node, PetscBool *edge)
{
  const ContactSurface *s = &contact->pairs[pair].nonmortar;

  PetscFunctionBegin;
  *edge = PETSC_FALSE;
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i)
    *edge = (PetscBool)(*edge || (s->node[i] == node && s->border[i / 4] & 16 << i % 4));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, edge, 1, MPI_PETSCBOOL, MPI_LOR, contact->comm));
  PetscFunctionReturn(0);
}

/*@
  ContactGetFrictionless - Counts the nodes of a pair on which no friction acts although the faces slide

  Collective

  Input Parameters:
+ contact - the contact, whose gap has been linearized
- pair    - number of the pair

  Output Parameters:
+ nfrictionless - number of nodes, on all ranks, at which different displacements of both faces are prescribed although
                  the pair sticks
- nnodes        - number of nodes of the nonmortar face, on all ranks

  Level: intermediate

.seealso: `ContactSetDisplacements()`, `ContactLinearize()`
@*/
PetscErrorCode ContactGetFrictionless(Contact contact, PetscInt pair, PetscInt *nfrictionless, PetscInt *nnodes)
{
  PetscInt n = contact->rows.first[pair + 1] - contact->rows.first[pair];

  PetscFunctionBegin;
  *nfrictionless = contact->pairs[pair].nfrictionless;
  PetscCallMPI(MPI_Allreduce(&n, nnodes, 1, MPIU_INT, MPI_SUM, contact->comm));
  PetscFunctionReturn(0);
}

/*@
  ContactGetReach - Gets the distance and the penetration up to which facets count as facing each other

  Not Collective

  Input Parameter:
. contact - the contact

  Output Parameters:
+ distance - the smallest search distance of those pairs whose distance the scene does not set [length];
             `PETSC_MAX_REAL` if the scene sets all of them
- depth    - the largest search depth of all pairs [length]

  Level: intermediate

.seealso: `ContactSetReach()`, `ContactLinearize()`
@*/
PetscErrorCode ContactGetReach(Contact contact, PetscReal *distance, PetscReal *depth)
{
  PetscFunctionBegin;
  *distance = PETSC_MAX_REAL;
  *depth    = 0.0;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    if (contact->pairs[p].given <= 0.0) *distance = PetscMin(*distance, contact->pairs[p].distance);
    *depth = PetscMax(*depth, contact->pairs[p].depth);
  }
  PetscFunctionReturn(0);
}

/*@
  ContactSetReach - Increases the distance and the penetration up to which facets count as facing each other, for load
  steps with large motions

  Logically Collective

  Input Parameters:
+ contact  - the contact
. distance - lower limit of the search distance of pairs whose distance the scene does not set [length]; 0: the default
- depth    - lower limit of the search depth of all pairs [length]; 0: the default

  Level: intermediate

  Note:
  If depth is positive, any two facets whose normals make an angle of more than 90 degrees count as facing each other.
  Such a linearization is suitable for measuring gaps, not for a solve.

.seealso: `ContactGetReach()`, `ContactLinearize()`
@*/
PetscErrorCode ContactSetReach(Contact contact, PetscReal distance, PetscReal depth)
{
  PetscFunctionBegin;
  contact->reach       = distance;
  contact->reach_depth = depth;
  PetscCall(ContactSetUpPairs(contact));
  PetscFunctionReturn(0);
}

/*
   Logically Collective. Sets which pairs with GAP_MORTAR use dual shape functions. With these the resultant of the
   contact forces can act at the edges of faces. *changed: whether this changes a pair
*/
PetscErrorCode ContactSetDual(Contact contact, ContactDualPairs which, PetscBool *changed)
{
  PetscFunctionBegin;
  *changed      = PETSC_FALSE;
  contact->dual = which;
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];
    const PetscBool  dual = (PetscBool)(which == CONTACT_DUAL_ALL || (which == CONTACT_DUAL_AUTO && pair->may_be_dual));

    if (pair->gap != GAP_MORTAR || pair->formula || pair->dual == dual) continue;
    pair->dual = dual;
    *changed   = PETSC_TRUE;
  }
  PetscFunctionReturn(0);
}

/* Not collective. Gets what ContactSetDual() has set */
PetscErrorCode ContactGetDual(Contact contact, ContactDualPairs *which)
{
  PetscFunctionBegin;
  *which = contact->dual;
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
  PetscCall(ContactCyclicDestroy(*contact));
  PetscCall(ContactSmoothReset(*contact));
  for (PetscInt p = 0; p < (*contact)->npairs; ++p) {
    PetscCall(PetscFree((*contact)->pairs[p].name));
    PetscCall(PetscFree((*contact)->pairs[p].corners));
    PetscCall(ContactSurfaceDestroy(&(*contact)->pairs[p].mortar));
    PetscCall(ContactSurfaceDestroy(&(*contact)->pairs[p].nonmortar));
  }
  PetscCall(MatDestroy(&(*contact)->trace));
  PetscCall(PetscFree((*contact)->pairs));
  PetscCall(DMDestroy(&(*contact)->dm));
  PetscCall(PetscFree(*contact));
  PetscFunctionReturn(0);
}
