/*
   Determines the directions along which the rows of a pair with friction have no slip, and therefore no friction.

   - If both faces end on the same symmetry plane, or if the same prescribed displacement drives both at this place, no
     slip is possible along that direction. The slip rows of these vertices are linearly dependent, so that the friction
     force is not unique. It is set to zero.
   - If a vertex is held, and the other face is free or driven by another displacement, friction acts.
   - If the pair sticks, and different displacements drive both faces, no friction force can prevent the slip. The
     friction force is set to zero, and the rows are counted as frictionless for a warning.
*/
#include <string.h>
#include "assemblyimpl.h"
#include "src/mesh/query/queryimpl.h"

static const PetscReal held_normal = 0.95; /* an axis is the normal of a facet if the component of the unit normal along
                                              it is larger */

/* A vertex of a facet at which a displacement is prescribed. All fields are real, so that an array of these structs can
   be sent as an array of reals. */
typedef struct {
  PetscReal motion;          /* number of the displacement that prescribes the motion along the axis */
  PetscReal x[3], normal[3]; /* undeformed coordinates [length], unit normal of the facet */
  PetscReal size;            /* diameter of the facet [length] */
} NoSlipVertex;
#define NO_SLIP_REALS (PetscInt)(sizeof(NoSlipVertex) / sizeof(PetscReal))

/* The smallest or the largest coordinate of a mortar face along an axis */
typedef struct {
  PetscReal place;  /* [length] */
  PetscInt  motion; /* the motion that holds all vertices there; CONTACT_FREE: no one motion holds all of them */
} PrescribedEnd;

/* The prescribed displacements of a mortar face along one axis */
typedef struct {
  PetscBool     whole;  /* whether all vertices of the face are held by the same motion */
  PetscInt      motion; /* that motion, if whole is true */
  PetscInt      axis;
  PrescribedEnd end[2]; /* such as symmetry planes: a vertex that slides along them remains opposite held ones */
  PetscInt      n;      /* number of held vertices elsewhere, from all ranks */
  NoSlipVertex *vertices;
  PetscReal     rounding; /* tolerance for equal coordinates [length] */
} PrescribedFace;

/*
   Computes what prescribes the motion of a rigid body along an axis: the number of a displacement, CONTACT_AT_REST if
   its displacement is zero, or CONTACT_FREE if a rotation moves it along the axis or forces drive it. Returns false if
   the body is not rigid.
*/
static PetscBool NoSlipRigidMotion(Contact contact, const char face[], PetscInt axis, PetscInt *motion)
{
  const size_t length = strcspn(face, ".");
  PetscBool    rigid  = PETSC_FALSE;

  *motion = CONTACT_AT_REST;
  for (PetscInt k = 0; k < contact->ndisplacements; ++k) {
    const SceneDisplacement *d = &contact->displacements[k];
    PetscBool                free;

    if (!d->moves || strncmp(d->face, face, length) || strcmp(d->face + length, SCENE_WHOLE_BODY)) continue;
    rigid = PETSC_TRUE;
    free  = (PetscBool)(d->rotation[(axis + 1) % 3] != 0.0 || d->rotation[(axis + 2) % 3] != 0.0);
    for (PetscInt m = 0; m < 6; ++m)
      free = (PetscBool)(free || ((m == axis || (m >= 3 && m != 3 + axis)) && d->released[m]));
    if (free || *motion == CONTACT_FREE) *motion = CONTACT_FREE;
    else if (d->value[axis] != 0.0) *motion = k;
  }
  return rigid;
}

/* Collective. Finds the two ends of the mortar face s along the axis, and what holds them */
static PetscErrorCode PrescribedEndsFind(MPI_Comm comm, const ContactSurface *s, const PetscInt motion[],
  PrescribedFace *face)
{
  /* the negative of the smallest coordinate, and the largest; the same of the motions at each end */
  PetscReal place[2]  = {PETSC_MIN_REAL, PETSC_MIN_REAL};
  PetscInt  bounds[4] = {PETSC_MIN_INT, PETSC_MIN_INT, PETSC_MIN_INT, PETSC_MIN_INT};

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    const PetscReal x = s->reference[3 * i + face->axis];

    place[0] = PetscMax(place[0], -x);
    place[1] = PetscMax(place[1], x);
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, place, 2, MPIU_REAL, MPIU_MAX, comm));
  for (PetscInt e = 0; e < 2; ++e) {
    face->end[e].place = e ? place[1] : -place[0];
    for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
      if (PetscAbsReal(s->reference[3 * i + face->axis] - face->end[e].place) > face->rounding) continue;
      bounds[2 * e]     = PetscMax(bounds[2 * e], -motion[i]);
      bounds[2 * e + 1] = PetscMax(bounds[2 * e + 1], motion[i]);
    }
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 4, MPIU_INT, MPI_MAX, comm));
  for (PetscInt e = 0; e < 2; ++e)
    face->end[e].motion = -bounds[2 * e] == bounds[2 * e + 1] ? bounds[2 * e + 1] : CONTACT_FREE;
  PetscFunctionReturn(0);
}

/* Gets vertex i of the surface's facets, which this motion holds */
static void NoSlipVertexGet(const ContactSurface *s, PetscInt i, PetscInt motion, NoSlipVertex *vertex)
{
  const PetscReal *x = &s->reference[12 * (i / 4)];

  (void)ContactFacetNormal(x, vertex->normal);
  vertex->size   = ContactFacetDiameter(x);
  vertex->motion = (PetscReal)motion;
  for (PetscInt c = 0; c < 3; ++c) vertex->x[c] = s->reference[3 * i + c];
}

/* Returns whether one motion holds the end of the face at which the vertex is. *motion: that motion */
static PetscBool PrescribedEndHolds(const PrescribedFace *face, const NoSlipVertex *vertex, PetscInt *motion)
{
  for (PetscInt e = 0; e < 2; ++e) {
    if (PetscAbsReal(vertex->x[face->axis] - face->end[e].place) > face->rounding) continue;
    *motion = face->end[e].motion;
    if (*motion != CONTACT_FREE) return PETSC_TRUE;
  }
  return PETSC_FALSE;
}

/* Collective. Determines the prescribed displacements of the mortar face s along an axis */
static PetscErrorCode PrescribedFaceCreate(Contact contact, const ContactSurface *s, PetscInt axis,
  PrescribedFace *face)
{
  PetscInt *motion, at, bounds[2] = {PETSC_MIN_INT, PETSC_MIN_INT}; /* bounds of motion: the negative of the smallest,
                                                                       and the largest */

  PetscFunctionBegin;
  *face       = (PrescribedFace){.axis = axis, .rounding = MESH_SAME_PLACE * PetscSqrtReal(s->area)};
  face->whole = NoSlipRigidMotion(contact, s->name, axis, &face->motion);
  if (face->whole) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(4 * s->nfacets, &motion));
  PetscCall(PetscMalloc1(4 * s->nfacets, &face->vertices));
  PetscCall(ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, axis, s, motion));
  PetscCall(PrescribedEndsFind(contact->comm, s, motion, face));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    bounds[0] = PetscMax(bounds[0], -motion[i]);
    bounds[1] = PetscMax(bounds[1], motion[i]);
    if (motion[i] == CONTACT_FREE) continue;
    NoSlipVertexGet(s, i, motion[i], &face->vertices[face->n]);
    if (!PrescribedEndHolds(face, &face->vertices[face->n], &at)) ++face->n;
  }
  PetscCall(PetscFree(motion));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPIU_INT, MPI_MAX, contact->comm));
  face->whole  = (PetscBool)(-bounds[0] == bounds[1]);
  face->motion = bounds[1];
  PetscCall(RecordsGather(contact->comm, NO_SLIP_REALS, &face->n, &face->vertices));
  PetscFunctionReturn(0);
}

/* Compares the mortar face with a held nonmortar vertex. *no_slip: whether the mortar face is held opposite the vertex;
   *alike: whether the same motion holds it */
static void PrescribedFaceFind(const PrescribedFace *face, const NoSlipVertex *vertex, PetscBool *no_slip,
  PetscBool *alike)
{
  const PetscInt own = (PetscInt)vertex->motion, axis = face->axis;
  PetscInt       motion;

  *no_slip = (PetscBool)(face->whole && face->motion != CONTACT_FREE);
  *alike   = (PetscBool)(*no_slip && face->motion == own);
  if (face->whole) return;
  *no_slip = PrescribedEndHolds(face, vertex, &motion);
  *alike   = (PetscBool)(*no_slip && motion == own);
  for (PetscInt i = 0; i < face->n && !*alike; ++i) {
    const NoSlipVertex *other = &face->vertices[i];

    if (PetscAbsReal(other->x[axis] - vertex->x[axis]) > face->rounding) continue;
    if (ContactDistanceAlongFacet(vertex->x, vertex->normal, other->x, other->normal) >
        PetscMax(vertex->size, other->size))
      continue;
    *no_slip = PETSC_TRUE;
    *alike   = (PetscBool)((PetscInt)other->motion == own);
  }
}

/* Collective. Sets `held` to 1 on the pair's rows without slip along an axis. Sets `frictionless` to 1 on those of
   these rows where the faces slide nevertheless. Sets nothing if the whole nonmortar face is held. */
static PetscErrorCode NoSlipMarkAxis(Contact contact, ContactPairData *pair, const PrescribedFace *mortar,
  PetscInt axis, Vec no_slip, Vec frictionless)
{
  const ContactSurface *s = &pair->nonmortar;
  PetscInt             *motion, free = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(4 * s->nfacets, &motion));
  PetscCall(ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, axis, s, motion));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) free = free || motion[i] == CONTACT_FREE;
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &free, 1, MPIU_INT, MPI_MAX, contact->comm));
  for (PetscInt i = 0; free && i < 4 * s->nfacets; ++i) {
    PetscBool    both, alike;
    NoSlipVertex vertex;

    if (motion[i] == CONTACT_FREE) continue;
    NoSlipVertexGet(s, i, motion[i], &vertex);
    /* nothing slips along the normal */
    if (PetscAbsReal(vertex.normal[axis]) > held_normal) continue;
    PrescribedFaceFind(mortar, &vertex, &both, &alike);
    if (!alike && !(both && pair->sticks)) continue;
    PetscCall(VecSetValue(no_slip, pair->row[i], 1.0, INSERT_VALUES));
    if (!alike) PetscCall(VecSetValue(frictionless, pair->row[i], 1.0, INSERT_VALUES));
  }
  PetscCall(PetscFree(motion));
  PetscFunctionReturn(0);
}

/* Returns the signed distance of vertex i of a surface from the origin, along the normal of a symmetry plane
   [length] */
static PetscReal NoSlipOffset(const ContactSurface *s, PetscInt i, const SceneDisplacement *plane)
{
  PetscReal n[3] = {plane->normal[0], plane->normal[1], plane->normal[2]};

  (void)VectorScaleToUnit(n);
  return VectorDot(n, &s->reference[3 * i]);
}

/* Returns whether the symmetry planes of two prescribed displacements are parallel */
static PetscBool NoSlipParallel(const SceneDisplacement *a, const SceneDisplacement *b)
{
  PetscReal m[3] = {a->normal[0], a->normal[1], a->normal[2]}, n[3] = {b->normal[0], b->normal[1], b->normal[2]};

  (void)VectorScaleToUnit(m);
  (void)VectorScaleToUnit(n);
  return (PetscBool)(PetscAbsReal(VectorDot(m, n)) > 1.0 - MESH_SAME_PLACE);
}

/*
   Collective. Determines whether the mortar face cannot move across the inclined symmetry plane k. This is so if the
   face ends on the same plane, or if all of it is held and its prescribed motion has no component along the plane's
   normal. planes: from ContactSurfaceFindPlanes() for the mortar face's vertices; faces: its prescribed displacements
   along each axis; offset: distance of the plane from the origin [length]
*/
static PetscErrorCode NoSlipIsAcross(Contact contact, const ContactSurface *mortar, const PrescribedFace faces[3],
  const PetscInt planes[], PetscInt k, PetscReal offset, PetscBool *across)
{
  const SceneDisplacement *plane  = &contact->displacements[k];
  PetscInt                 found  = 0;
  PetscReal                moved  = 0.0;
  PetscBool                whole  = PETSC_TRUE;
  const PetscReal          margin = MESH_SAME_PLACE * PetscSqrtReal(mortar->area);

  PetscFunctionBegin;
  for (PetscInt i = 0; i < 4 * mortar->nfacets && !found; ++i) {
    const SceneDisplacement *other = planes[i] ? &contact->displacements[planes[i] - 1] : NULL;
    const PetscReal          sign  = other && VectorDot(plane->normal, other->normal) < 0.0 ? -1.0 : 1.0;

    found =
      other && NoSlipParallel(plane, other) && PetscAbsReal(sign * NoSlipOffset(mortar, i, other) - offset) <= margin;
  }
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &found, 1, MPIU_INT, MPI_MAX, contact->comm));
  for (PetscInt axis = 0; axis < 3; ++axis) {
    const PrescribedFace *face = &faces[axis];

    whole = (PetscBool)(whole && face->whole && face->motion != CONTACT_FREE);
    if (face->whole && face->motion >= 0)
      moved += plane->normal[axis] * contact->displacements[face->motion].value[axis];
  }
  *across = (PetscBool)(found || (whole && PetscAbsReal(moved) <= margin));
  PetscFunctionReturn(0);
}

/* Collective. Sets `plane` to 1 + the number of the inclined symmetry plane on the rows whose vertices lie on it, if
   the mortar face cannot move across it. Sets nothing if all nonmortar vertices lie on such planes. */
static PetscErrorCode NoSlipMarkPlanes(Contact contact, ContactPairData *pair, const PrescribedFace mortar[3],
  Vec plane)
{
  const ContactSurface *s = &pair->nonmortar;
  PetscInt             *planes, *others, off = 0;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(4 * s->nfacets, &planes, 4 * pair->mortar.nfacets, &others));
  PetscCall(ContactSurfaceFindPlanes(contact->dm, contact->ndisplacements, contact->displacements, s, planes));
  PetscCall(
    ContactSurfaceFindPlanes(contact->dm, contact->ndisplacements, contact->displacements, &pair->mortar, others));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) off = off || !planes[i];
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &off, 1, MPIU_INT, MPI_MAX, contact->comm));
  for (PetscInt k = 0; off && k < contact->ndisplacements; ++k) {
    PetscReal offset = PETSC_MIN_REAL;
    PetscBool across = PETSC_FALSE;

    if (!contact->displacements[k].inclined) continue;
    for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
      if (planes[i] == k + 1) offset = NoSlipOffset(s, i, &contact->displacements[k]);
    }
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &offset, 1, MPIU_REAL, MPIU_MAX, contact->comm));
    PetscCall(NoSlipIsAcross(contact, &pair->mortar, mortar, others, k, offset, &across));
    for (PetscInt i = 0; across && i < 4 * s->nfacets; ++i) {
      if (planes[i] == k + 1) PetscCall(VecSetValue(plane, pair->row[i], planes[i], INSERT_VALUES));
    }
  }
  PetscCall(PetscFree2(planes, others));
  PetscFunctionReturn(0);
}

/*
   Collective. Computes contact->rows.no_slip, the directions along which rows have no slip, and the number of
   frictionless rows of each pair
*/
PetscErrorCode ContactFindNoSlip(Contact contact)
{
  ContactRows *rows = &contact->rows;
  Vec          no_slip[4], frictionless;

  PetscFunctionBegin;
  if (rows->no_slip) PetscFunctionReturn(0);
  PetscCall(PetscCalloc1(rows->nlocal + 1, &rows->no_slip));
  PetscCall(VecDuplicate(rows->mass, &frictionless));
  for (PetscInt c = 0; c < 4; ++c) {
    PetscCall(VecDuplicate(rows->mass, &no_slip[c]));
    PetscCall(VecZeroEntries(no_slip[c]));
  }
  for (PetscInt p = 0; p < contact->npairs; ++p) {
    ContactPairData *pair = &contact->pairs[p];
    PrescribedFace   mortar[3];
    PetscScalar      sum;

    if (!pair->frictional) continue;
    PetscCall(VecZeroEntries(frictionless));
    for (PetscInt c = 0; c < 3; ++c) {
      PetscCall(PrescribedFaceCreate(contact, &pair->mortar, c, &mortar[c]));
      PetscCall(NoSlipMarkAxis(contact, pair, &mortar[c], c, no_slip[c], frictionless));
    }
    PetscCall(NoSlipMarkPlanes(contact, pair, mortar, no_slip[3]));
    for (PetscInt c = 0; c < 3; ++c) PetscCall(PetscFree(mortar[c].vertices));
    PetscCall(VecAssemblyBegin(frictionless));
    PetscCall(VecAssemblyEnd(frictionless));
    PetscCall(VecSum(frictionless, &sum));
    pair->nfrictionless = (PetscInt)PetscRealPart(sum);
  }
  for (PetscInt c = 0; c < 4; ++c) {
    const PetscScalar *a;

    PetscCall(VecAssemblyBegin(no_slip[c]));
    PetscCall(VecAssemblyEnd(no_slip[c]));
    PetscCall(VecGetArrayRead(no_slip[c], &a));
    for (PetscInt i = 0; i < rows->nlocal; ++i)
      rows->no_slip[i] |= (c == 3 ? (PetscInt)PetscRealPart(a[i]) : PetscRealPart(a[i]) > 0.0) << c;
    PetscCall(VecRestoreArrayRead(no_slip[c], &a));
    PetscCall(VecDestroy(&no_slip[c]));
  }
  PetscCall(VecDestroy(&frictionless));
  PetscFunctionReturn(0);
}
