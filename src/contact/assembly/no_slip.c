/*
   Determines the directions along which the rows of a pair with friction have no slip, and therefore no friction.

   - If both faces end on the same symmetry plane, or if the same prescribed displacement drives both, no slip is
     possible along that direction. The slip rows of these vertices are linearly dependent, so that the friction force
     is not unique. It is set to zero.
   - If a vertex is held, and the other face is free or driven by another displacement, friction acts.
   - If the pair sticks, and different displacements drive both faces, no friction force can prevent the slip. The
     friction force is set to zero, and the rows are counted as frictionless for a warning.
*/
#include <stdlib.h>
#include <string.h>
#include "assemblyimpl.h"
#include "src/mesh/query/queryimpl.h"

static const PetscReal plane_rounding = 1e-6; /* tolerance for coordinates on one plane, relative to the size of the
                                                face */
static const PetscReal held_normal = 0.95; /* an axis is the normal of a facet if the component of the unit normal along
                                              it is larger */

/* The coordinate, along an axis, of vertices of a mortar face at which a displacement is prescribed. All fields are
   real, so that an array of these structs can be sent as an array of reals. */
typedef struct {
  PetscReal motion, place; /* number of the displacement that prescribes the motion, and coordinate along the axis
                              [length] */
} PrescribedPlace;

/* The prescribed displacements of a mortar face along one axis */
typedef struct {
  PetscBool        whole;  /* whether all vertices of the face are held by the same motion */
  PetscInt         motion; /* that motion, if whole is true */
  PetscInt         n;      /* number of entries of `places` from all ranks, without repetition */
  PrescribedPlace *places;
  PetscReal        rounding; /* tolerance for equal coordinates [length] */
} PrescribedFace;

static int PrescribedPlaceCompare(const void *a, const void *b)
{
  const PrescribedPlace *p = (const PrescribedPlace *)a, *q = (const PrescribedPlace *)b;

  if (p->motion != q->motion) return p->motion < q->motion ? -1 : 1;
  return (p->place > q->place) - (p->place < q->place);
}

/* Sorts the entries and removes those with equal motion and, up to rounding, equal coordinate */
static void PrescribedPlacesUnite(PetscReal rounding, PetscInt *n, PrescribedPlace places[])
{
  PetscInt kept = 0;

  if (*n) qsort(places, (size_t)*n, sizeof(*places), PrescribedPlaceCompare);
  for (PetscInt i = 0; i < *n; ++i) {
    if (!kept || places[kept - 1].motion != places[i].motion || places[i].place > places[kept - 1].place + rounding)
      places[kept++] = places[i];
  }
  *n = kept;
}

/* Collective. Collects the entries of all ranks on every rank */
static PetscErrorCode PrescribedPlacesGather(MPI_Comm comm, PrescribedFace *face)
{
  PetscFunctionBegin;
  PetscCall(RecordsGather(comm, 2, &face->n, &face->places));
  PrescribedPlacesUnite(face->rounding, &face->n, face->places);
  PetscFunctionReturn(0);
}

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

/* Collective. Determines the prescribed displacements of the mortar face s along an axis */
static PetscErrorCode PrescribedFaceCreate(Contact contact, const ContactSurface *s, PetscInt axis,
  PrescribedFace *face)
{
  PetscInt *motion, bounds[2] = {PETSC_MIN_INT, PETSC_MIN_INT}; /* bounds of motion: the negative of the smallest,
                                                                   and the largest */

  PetscFunctionBegin;
  *face       = (PrescribedFace){.rounding = plane_rounding * PetscSqrtReal(s->area)};
  face->whole = NoSlipRigidMotion(contact, s->name, axis, &face->motion);
  if (face->whole) PetscFunctionReturn(0);
  PetscCall(PetscMalloc1(4 * s->nfacets, &motion));
  PetscCall(PetscMalloc1(4 * s->nfacets, &face->places));
  PetscCall(ContactSurfaceFindMotions(contact->dm, contact->ndisplacements, contact->displacements, axis, s, motion));
  for (PetscInt i = 0; i < 4 * s->nfacets; ++i) {
    bounds[0] = PetscMax(bounds[0], -motion[i]);
    bounds[1] = PetscMax(bounds[1], motion[i]);
    if (motion[i] != CONTACT_FREE)
      face->places[face->n++] = (PrescribedPlace){(PetscReal)motion[i], s->reference[3 * i + axis]};
  }
  PetscCall(PetscFree(motion));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, bounds, 2, MPIU_INT, MPI_MAX, contact->comm));
  face->whole  = (PetscBool)(-bounds[0] == bounds[1]);
  face->motion = bounds[1];
  PrescribedPlacesUnite(face->rounding, &face->n, face->places);
  PetscCall(PrescribedPlacesGather(contact->comm, face));
  PetscFunctionReturn(0);
}

/* Compares the mortar face with a nonmortar vertex that has this prescribed motion, and this coordinate (place) along
   the axis. *held: whether the mortar face is held at that coordinate; *alike: whether the same motion holds it */
static void PrescribedFaceFind(const PrescribedFace *face, PetscInt motion, PetscReal place, PetscBool *no_slip,
  PetscBool *alike)
{
  *no_slip = (PetscBool)(face->whole && face->motion != CONTACT_FREE);
  *alike   = (PetscBool)(*no_slip && face->motion == motion);
  for (PetscInt i = 0; !face->whole && i < face->n; ++i) {
    if (PetscAbsReal(face->places[i].place - place) > face->rounding) continue;
    *no_slip = PETSC_TRUE;
    if ((PetscInt)face->places[i].motion == motion) *alike = PETSC_TRUE;
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
    PetscBool both, alike;
    PetscReal normal[3];

    if (motion[i] == CONTACT_FREE) continue;
    /* nothing slips along the normal */
    if (ContactFacetNormal(&s->reference[12 * (i / 4)], normal) && PetscAbsReal(normal[axis]) > held_normal) continue;
    PrescribedFaceFind(mortar, motion[i], s->reference[3 * i + axis], &both, &alike);
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
  return (PetscBool)(PetscAbsReal(VectorDot(m, n)) > 1.0 - plane_rounding);
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
  const PetscReal          margin = plane_rounding * PetscSqrtReal(mortar->area);

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
    for (PetscInt c = 0; c < 3; ++c) PetscCall(PetscFree(mortar[c].places));
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
