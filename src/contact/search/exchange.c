/* Sends mortar facets to the ranks whose part of the nonmortar face they may meet. No other part of the mesh is
   exchanged. */
#include <petscsf.h>
#include "searchimpl.h"

/* Facets to be sent, sorted by receiving rank; the arrays are those of ContactCandidates */
typedef struct {
  PetscMPIInt nranks, *rank;
  PetscInt   *range; /* [2 nranks] first facet and number of facets for each receiving rank */
  PetscInt    n, *node, *border;
  PetscReal  *x, *patch, *self;
} Outgoing;

/* Counts the facets whose box meets the box of each rank. If out->x is allocated, copies them to the arrays as well. */
static PetscErrorCode ExchangePackFacets(const ContactSurface *s, PetscMPIInt size, const PetscReal boxes[],
  Outgoing *out)
{
  PetscFunctionBegin;
  out->n      = 0;
  out->nranks = 0;
  for (PetscMPIInt r = 0; r < size; ++r) {
    const PetscInt first = out->n;

    for (PetscInt f = 0; f < s->nfacets; ++f) {
      PetscReal box[6];

      ContactFacetBox(&s->x[12 * f], box);
      if (!ContactBoxesMeet(box, &boxes[6 * r])) continue;
      if (out->x) {
        PetscCall(PetscArraycpy(&out->x[12 * out->n], &s->x[12 * f], 12));
        PetscCall(PetscArraycpy(&out->node[4 * out->n], &s->node[4 * f], 4));
        if (s->bordered) out->border[out->n] = s->border[f];
        if (s->self) {
          PetscCall(PetscArraycpy(&out->self[CONTACT_SELF_REALS * out->n], &s->reference[12 * f], 12));
          out->self[CONTACT_SELF_REALS * out->n + 12] = s->rank[f];
          out->self[CONTACT_SELF_REALS * out->n + 13] = s->below[f];
        }
        if (s->patched) PetscCall(PetscArraycpy(&out->patch[12 * out->n], &s->patch[12 * f], 12));
      }
      ++out->n;
    }
    if (out->n == first) continue;
    out->rank[out->nranks]          = r;
    out->range[2 * out->nranks]     = first;
    out->range[2 * out->nranks + 1] = out->n - first;
    ++out->nranks;
  }
  PetscFunctionReturn(0);
}

/* Collective. Creates the star forest from outgoing facets (roots) to incoming facets (leaves). Incoming facets are
   sorted by sending rank. */
static PetscErrorCode ExchangeCreateForest(MPI_Comm comm, const Outgoing *out, PetscInt *nincoming, PetscSF *sf)
{
  PetscMPIInt  nfrom, *from;
  PetscInt    *range, *order, n = 0;
  PetscSFNode *remote;

  PetscFunctionBegin;
  PetscCall(PetscCommBuildTwoSided(comm, 2, MPIU_INT, out->nranks, out->rank, out->range, &nfrom, &from, &range));
  PetscCall(PetscMalloc1(nfrom, &order));
  for (PetscMPIInt i = 0; i < nfrom; ++i) {
    order[i] = i;
    n += range[2 * i + 1];
  }
  PetscCall(PetscSortMPIIntWithIntArray(nfrom, from, order));
  PetscCall(PetscMalloc1(n, &remote));
  *nincoming = n;
  n          = 0;
  for (PetscMPIInt i = 0; i < nfrom; ++i) {
    for (PetscInt k = 0; k < range[2 * order[i] + 1]; ++k) {
      remote[n].rank    = from[i];
      remote[n++].index = range[2 * order[i]] + k;
    }
  }
  PetscCall(PetscFree(order));
  PetscCall(PetscFree(from));
  PetscCall(PetscFree(range));
  PetscCall(PetscSFCreate(comm, sf));
  PetscCall(PetscSFSetGraph(*sf, out->n, n, NULL, PETSC_OWN_POINTER, remote, PETSC_OWN_POINTER));
  PetscFunctionReturn(0);
}

/* Collective. Sends `count` values of type `unit` per facet along the star forest */
static PetscErrorCode ExchangeBroadcast(PetscSF sf, PetscMPIInt count, MPI_Datatype unit, const void *out, void *in)
{
  MPI_Datatype type;

  PetscFunctionBegin;
  PetscCallMPI(MPI_Type_contiguous(count, unit, &type));
  PetscCallMPI(MPI_Type_commit(&type));
  PetscCall(PetscSFBcastBegin(sf, type, out, in, MPI_REPLACE));
  PetscCall(PetscSFBcastEnd(sf, type, out, in, MPI_REPLACE));
  PetscCallMPI(MPI_Type_free(&type));
  PetscFunctionReturn(0);
}

/* Collective. Receives those facets of the surface s, from all ranks, whose boxes meet this rank's box */
PetscErrorCode ContactExchange(MPI_Comm comm, const PetscReal box[6], const ContactSurface *s, ContactCandidates *in)
{
  const PetscInt nborder = s->bordered ? 1 : 0, npatch = s->patched ? 1 : 0, nself = s->self ? CONTACT_SELF_REALS : 0;
  PetscMPIInt    size;
  PetscReal     *boxes;
  PetscSF        sf;
  Outgoing       out = {0};

  PetscFunctionBegin;
  PetscCallMPI(MPI_Comm_size(comm, &size));
  PetscCall(PetscMalloc3(6 * size, &boxes, size, &out.rank, 2 * size, &out.range));
  PetscCallMPI(MPI_Allgather(box, 6, MPIU_REAL, boxes, 6, MPIU_REAL, comm));
  PetscCall(ExchangePackFacets(s, size, boxes, &out));
  PetscCall(PetscMalloc5(12 * out.n, &out.x, 4 * out.n, &out.node, nborder * out.n, &out.border, 12 * npatch * out.n,
    &out.patch, nself * out.n, &out.self));
  if (out.n) PetscCall(ExchangePackFacets(s, size, boxes, &out));
  PetscCall(ExchangeCreateForest(comm, &out, &in->n, &sf));
  PetscCall(PetscMalloc5(12 * in->n, &in->x, 4 * in->n, &in->node, nborder * in->n, &in->border, 12 * npatch * in->n,
    &in->patch, nself * in->n, &in->self));
  PetscCall(ExchangeBroadcast(sf, 12, MPIU_REAL, out.x, in->x));
  PetscCall(ExchangeBroadcast(sf, 4, MPIU_INT, out.node, in->node));
  if (nself) PetscCall(ExchangeBroadcast(sf, CONTACT_SELF_REALS, MPIU_REAL, out.self, in->self));
  if (nborder) PetscCall(ExchangeBroadcast(sf, 1, MPIU_INT, out.border, in->border));
  if (npatch) PetscCall(ExchangeBroadcast(sf, 12, MPIU_REAL, out.patch, in->patch));
  PetscCall(PetscSFDestroy(&sf));
  PetscCall(PetscFree5(out.x, out.node, out.border, out.patch, out.self));
  PetscCall(PetscFree3(boxes, out.rank, out.range));
  PetscFunctionReturn(0);
}

PetscErrorCode ContactCandidatesDestroy(ContactCandidates *in)
{
  PetscFunctionBegin;
  PetscCall(PetscFree5(in->x, in->node, in->border, in->patch, in->self));
  in->n = 0;
  PetscFunctionReturn(0);
}
