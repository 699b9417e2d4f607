/* Output of -ksp_view for PCBLOCKAMG */
#include "blockamgimpl.h"

static PetscErrorCode ViewLevel(const BlockHierarchy *h, int i, PetscViewer viewer)
{
  const PetscBool   dense = (PetscBool)(i == h->nlevels);
  const BlockLevel *l     = dense ? &h->bottom : &h->levels[i];

  PetscFunctionBegin;
  PetscCall(PetscViewerASCIIPrintf(viewer, "  level %d: unknowns=%.0f, entries per row=%.1f, ", i, l->unknowns,
    l->entries / PetscMax(l->unknowns, 1.0)));
  if (dense) PetscCall(PetscViewerASCIIPrintf(viewer, "dense inverse\n"));
  else
    PetscCall(
      PetscViewerASCIIPrintf(viewer, "blocks of %d x %d, fraction of their values that are matrix entries %.2f\n", l->B,
        l->B, l->entries / PetscMax(l->blocks, 1.0)));
  PetscFunctionReturn(0);
}

PetscErrorCode PCView_BlockAMG(PC pc, PetscViewer viewer)
{
  PC_BlockAMG          *amg   = (PC_BlockAMG *)pc->data;
  const BlockHierarchy *h     = amg->h;
  PetscLogDouble        bytes = 0.0, unknowns = 0.0;
  PetscBool             ascii;
  int                   n;

  PetscFunctionBegin;
  PetscCall(PetscObjectTypeCompare((PetscObject)viewer, PETSCVIEWERASCII, &ascii));
  if (!ascii) PetscFunctionReturn(0);
  if (amg->hypre) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  the operator is not symmetric: hypre's own cycle\n"));
    PetscCall(PCView(amg->hypre, viewer));
    PetscFunctionReturn(0);
  }
  PetscCall(PetscViewerASCIIPrintf(viewer,
    "  V(1,1)-cycle in single precision, symmetric Gauss-Seidel, on the hierarchy of hypre's BoomerAMG\n"));
  if (!h) {
    PetscCall(PetscViewerASCIIPrintf(viewer, "  %s\n", amg->why[0] ? amg->why : "not yet set up"));
    PetscFunctionReturn(0);
  }
  n = h->nlevels + (h->dense.N ? 1 : 0);
  for (int i = 0; i < n; i++) {
    const BlockLevel *l = i < h->nlevels ? &h->levels[i] : &h->bottom;

    bytes += l->bytes;
    if (i == 0) unknowns = l->unknowns;
    PetscCall(ViewLevel(h, i, viewer));
  }
  PetscCall(PetscViewerASCIIPrintf(viewer, "  levels=%d, memory=%.1f MB, %.0f bytes per unknown\n", n, bytes / 1e6,
    bytes / PetscMax(unknowns, 1.0)));
  PetscFunctionReturn(0);
}
