/* Rigid body modes of the bodies, and the restraints of a link as rows of their coefficients */
#include "supportsimpl.h"
#include <vector3.h>

/* Gets the positions of n vertices at the displacement of the nodes [length] */
PetscErrorCode SupportGetPlaces(const Support *support, PetscInt n, const PetscInt vertices[], PetscReal x[][3])
{
  PetscSection       section;
  const PetscScalar *u;

  PetscFunctionBegin;
  PetscCall(MeshGetVertexCoordinates(support->dm, n, vertices, x));
  if (!support->u) PetscFunctionReturn(0);
  PetscCall(DMGetLocalSection(support->dm, &section));
  PetscCall(VecGetArrayRead(support->u, &u));
  for (PetscInt i = 0; i < n; ++i) {
    PetscInt offset;

    PetscCall(PetscSectionGetOffset(section, vertices[i], &offset));
    for (PetscInt d = 0; d < 3; ++d) x[i][d] += PetscRealPart(u[offset + d]);
  }
  PetscCall(VecRestoreArrayRead(support->u, &u));
  PetscFunctionReturn(0);
}

/* Collective. Computes the centre, and half of the largest side, of every body's bounding box at the displacement u, a
   global vector or NULL [length] */
PetscErrorCode SupportMeasureBodies(Support *support, Vec u)
{
  PetscReal *boxes;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(6 * support->nbodies, &boxes));
  PetscCall(MeshGetBodyBoxes(support->dm, u, support->nbodies, boxes));
  for (PetscInt i = 0; i < 3 * support->nbodies; ++i) {
    const PetscReal lower = boxes[6 * (i / 3) + i % 3], upper = boxes[6 * (i / 3) + 3 + i % 3];

    support->center[i / 3][i % 3] = (lower + upper) / 2;
    support->size[i / 3]          = PetscMax(support->size[i / 3], (upper - lower) / 2);
  }
  PetscCall(PetscFree(boxes));
  PetscFunctionReturn(0);
}

/* Adds to a row of the coefficients of t and r: sign times the component along `direction` of the rigid motion t + r x
   (x - center)/size of body b at the point x */
void SupportSetRow(const Support *support, PetscInt b, const PetscReal direction[3], const PetscReal x[3],
  PetscReal sign, PetscReal row[6])
{
  PetscReal arm[3], moment[3];

  for (PetscInt d = 0; d < 3; ++d) arm[d] = (x[d] - support->center[b][d]) / support->size[b];
  VectorCross(arm, direction, moment);
  for (PetscInt d = 0; d < 3; ++d) {
    row[d] += sign * direction[d];
    row[3 + d] += sign * moment[d];
  }
}

/* Adds a motion of body b to the row of the last link */
void SupportAddMotion(Support *support, PetscInt b, const PetscReal direction[3], const PetscReal x[3], PetscReal sign)
{
  SupportSetRow(support, b, direction, x, sign,
    support->row + (b == support->links[support->nlinks - 1].body[0] ? 0 : 6));
}

/* Adds the outer product of the row, multiplied by a weight, to the link's matrix, and sets the row to zero */
PetscErrorCode SupportAddRow(Support *support, PetscReal weight)
{
  PetscReal *gram = support->gram[support->nlinks - 1];

  PetscFunctionBegin;
  for (PetscInt i = 0; i < SUPPORT_BLOCK; ++i) {
    for (PetscInt j = 0; support->row[i] != 0 && j < SUPPORT_BLOCK; ++j)
      gram[i * SUPPORT_BLOCK + j] += weight * support->row[i] * support->row[j];
  }
  PetscCall(PetscArrayzero(support->row, SUPPORT_BLOCK));
  PetscFunctionReturn(0);
}

/* Begins a link between bodies a and b. If b is negative or equal to a, the link is between body a and the ground. */
void SupportBeginLink(Support *support, PetscInt a, PetscInt b, SupportKind kind)
{
  support->links[support->nlinks++] = (SupportLink){{a, b == a ? PETSC_DECIDE : b}, kind};
}
