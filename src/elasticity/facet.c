/* Facets of the bodies' faces: their nodes and shape functions */
#include "elasticityimpl.h"

/* Shape functions of a facet on [0,1]^2 and their derivatives, of 4 nodes around it, or of 9: then of its edges, and of its middle */
void FacetShape(PetscInt n, PetscReal s, PetscReal t, PetscReal N[], PetscReal Ns[], PetscReal Nt[])
{
  static const PetscInt place[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  const PetscReal       at[2]       = {s, t};
  PetscReal             L[2][3], D[2][3];

  for (PetscInt d = 0; d < 2; ++d) {
    const PetscReal x = at[d];

    L[d][0] = n == 4 ? 1 - x : (1 - x) * (1 - 2 * x);
    L[d][1] = 4 * x * (1 - x);
    L[d][2] = n == 4 ? x : x * (2 * x - 1);
    D[d][0] = n == 4 ? -1 : 4 * x - 3;
    D[d][1] = 4 - 8 * x;
    D[d][2] = n == 4 ? 1 : 4 * x - 1;
  }
  for (PetscInt a = 0; a < n; ++a) {
    N[a]  = L[0][place[a][0]] * L[1][place[a][1]];
    Ns[a] = D[0][place[a][0]] * L[1][place[a][1]];
    Nt[a] = L[0][place[a][0]] * D[1][place[a][1]];
  }
}

/* A facet of this rank; x: coordinates of the nodes */
PetscErrorCode FacetGet(Elasticity e, PetscInt point, const PetscScalar x[], Facet *facet)
{
  PetscSection section;
  PetscInt     nodes[FACET_MAX_NODES];

  PetscFunctionBegin;
  PetscCall(DMGetLocalSection(e->dm, &section));
  PetscCall(MeshGetFacetNodes(e->dm, point, &facet->n, nodes));
  for (PetscInt a = 0; a < facet->n; ++a) {
    PetscCall(PetscSectionGetOffset(section, nodes[a], &facet->offset[a]));
    for (PetscInt d = 0; d < 3; ++d) facet->X[a][d] = PetscRealPart(x[facet->offset[a] + d]);
  }
  PetscFunctionReturn(0);
}
