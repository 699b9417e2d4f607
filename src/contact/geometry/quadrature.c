/* Quadrature rules on triangles */
#include "geometryimpl.h"
#include <petscdt.h>

/* Creates PETSc's rule on triangles with the fewest points that is exact for polynomials of this degree */
PetscErrorCode ContactRuleCreate(PetscInt degree, ContactRule *rule)
{
  PetscQuadrature  quadrature;
  PetscInt         n;
  const PetscReal *x, *weight; /* The rule is for the triangle (-1, -1), (1, -1), (-1, 1), whose area is 2. */

  PetscFunctionBegin;
  PetscCall(PetscDTSimplexQuadrature(2, degree, PETSCDTSIMPLEXQUAD_MINSYM, &quadrature));
  PetscCall(PetscQuadratureGetData(quadrature, NULL, NULL, &n, &x, &weight));
  PetscCheck(n <= CONTACT_RULE_POINTS, PETSC_COMM_SELF, PETSC_ERR_PLIB,
    "The rule of degree %" PetscInt_FMT " has %" PetscInt_FMT " points, more than %d", degree, n, CONTACT_RULE_POINTS);
  rule->degree = degree;
  rule->n      = n;
  for (PetscInt q = 0; q < n; ++q) {
    rule->barycentric[q][1] = 0.5 * (1.0 + x[2 * q]);
    rule->barycentric[q][2] = 0.5 * (1.0 + x[2 * q + 1]);
    rule->barycentric[q][0] = 1.0 - rule->barycentric[q][1] - rule->barycentric[q][2];
    rule->weight[q]         = 0.5 * weight[q];
  }
  PetscCall(PetscQuadratureDestroy(&quadrature));
  PetscFunctionReturn(0);
}
