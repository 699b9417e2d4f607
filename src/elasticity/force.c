/* Energy, internal force and lumped mass by loops over the cells; no matrix */
#include "elasticity_private.h"

static PetscErrorCode ElasticityGetLocals(Elasticity e, Vec u, Vec *local, const PetscScalar **ul, const PetscScalar **x)
{
  Vec coordinates;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(VecGetArrayRead(coordinates, x));
  PetscCall(DMGetLocalVector(e->dm, local));
  PetscCall(DMGlobalToLocal(e->dm, u, INSERT_VALUES, *local));
  PetscCall(VecGetArrayRead(*local, ul));
  PetscFunctionReturn(0);
}

static PetscErrorCode ElasticityRestoreLocals(Elasticity e, Vec *local, const PetscScalar **ul, const PetscScalar **x)
{
  Vec coordinates;

  PetscFunctionBegin;
  PetscCall(VecRestoreArrayRead(*local, ul));
  PetscCall(DMRestoreLocalVector(e->dm, local));
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(VecRestoreArrayRead(coordinates, x));
  PetscFunctionReturn(0);
}

/*@
  ElasticityEnergy - Computes the elastic energy stored by a displacement

  Collective

  Input Parameters:
+ elasticity - the context
- u          - displacement, global, 3 components a vertex [length]

  Output Parameter:
. energy - stored energy of all bodies [force length]

  Level: beginner

.seealso: `ElasticityForce()`, `ElasticityTangent()`
@*/
PetscErrorCode ElasticityEnergy(Elasticity e, Vec u, PetscReal *energy)
{
  Vec                local;
  const PetscScalar *ul, *x;
  PetscReal          sum = 0;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Force, u, 0, 0, 0));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const BodyMaterial *m = &e->bodies[e->cellbody[c]];
    PetscReal           X[3][8], U[3][8], G[3][8], H[9];

    ElasticityGatherCell(e->cellnodes + 8 * c, x, X);
    ElasticityGatherCell(e->cellnodes + 8 * c, ul, U);
    for (PetscInt q = 0; q < e->basis.npoints; ++q) {
      const PetscReal w = HexGradients(&e->basis, q, X, G);

      HexDisplacementGradient(U, G, H);
      sum += w * m->law->energy(m->lambda, m->mu, H);
    }
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCallMPI(MPI_Allreduce(&sum, energy, 1, MPIU_REAL, MPIU_SUM, PetscObjectComm((PetscObject)e->dm)));
  PetscCall(PetscLogEventEnd(ELASTICITY_Force, u, 0, 0, 0));
  PetscFunctionReturn(0);
}

/*@
  ElasticityForce - Computes the internal force, the derivative of the energy

  Collective

  Input Parameters:
+ elasticity - the context
- u          - displacement, global, 3 components a vertex [length]

  Output Parameter:
. force - dE/du on all rows; on prescribed rows it is the reaction [force]

  Level: beginner

.seealso: `ElasticityEnergy()`, `ElasticityTangent()`
@*/
PetscErrorCode ElasticityForce(Elasticity e, Vec u, Vec force)
{
  Vec                local, flocal;
  const PetscScalar *ul, *x;
  PetscScalar       *fl;

  PetscFunctionBegin;
  PetscCall(PetscLogEventBegin(ELASTICITY_Force, u, force, 0, 0));
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(DMGetLocalVector(e->dm, &flocal));
  PetscCall(VecZeroEntries(flocal));
  PetscCall(VecGetArray(flocal, &fl));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt     *nodes = e->cellnodes + 8 * c;
    const BodyMaterial *m     = &e->bodies[e->cellbody[c]];
    PetscReal           X[3][8], U[3][8], G[3][8], H[9], P[9], F[3][8] = {{0}};

    ElasticityGatherCell(nodes, x, X);
    ElasticityGatherCell(nodes, ul, U);
    for (PetscInt q = 0; q < e->basis.npoints; ++q) {
      const PetscReal w = HexGradients(&e->basis, q, X, G);

      HexDisplacementGradient(U, G, H);
      m->law->stress(m->lambda, m->mu, H, P);
      for (int i = 0; i < 3; ++i) {
        const PetscReal p0 = w * P[3 * i], p1 = w * P[3 * i + 1], p2 = w * P[3 * i + 2];

        for (int a = 0; a < 8; ++a) F[i][a] += p0 * G[0][a] + p1 * G[1][a] + p2 * G[2][a];
      }
    }
    for (int a = 0; a < 8; ++a) {
      for (int i = 0; i < 3; ++i) fl[3 * nodes[a] + i] += F[i][a];
    }
  }
  PetscCall(VecRestoreArray(flocal, &fl));
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscCall(VecZeroEntries(force));
  PetscCall(DMLocalToGlobal(e->dm, flocal, ADD_VALUES, force));
  PetscCall(DMRestoreLocalVector(e->dm, &flocal));
  PetscCall(PetscLogEventEnd(ELASTICITY_Force, u, force, 0, 0));
  PetscFunctionReturn(0);
}

/*@
  ElasticityLumpedMass - Computes the row-sum lumped mass of unit density, the integral of each vertex's shape function

  Collective

  Input Parameter:
. elasticity - the context

  Output Parameter:
. mass - new global vector, the same value for the 3 components of a vertex [length^3]

  Level: intermediate

.seealso: `ElasticityCreate()`
@*/
PetscErrorCode ElasticityLumpedMass(Elasticity e, Vec *mass)
{
  Vec                coordinates, local;
  const PetscScalar *x;
  PetscScalar       *ml;

  PetscFunctionBegin;
  PetscCall(DMGetCoordinatesLocal(e->dm, &coordinates));
  PetscCall(DMGetLocalVector(e->dm, &local));
  PetscCall(VecZeroEntries(local));
  PetscCall(VecGetArrayRead(coordinates, &x));
  PetscCall(VecGetArray(local, &ml));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const PetscInt *nodes = e->cellnodes + 8 * c;
    PetscReal       X[3][8], G[3][8];

    ElasticityGatherCell(nodes, x, X);
    for (PetscInt q = 0; q < e->basis.npoints; ++q) {
      const PetscReal w = HexGradients(&e->basis, q, X, G);

      for (int a = 0; a < 8; ++a) {
        for (int i = 0; i < 3; ++i) ml[3 * nodes[a] + i] += w * e->basis.N[q][a];
      }
    }
  }
  PetscCall(VecRestoreArray(local, &ml));
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCall(DMCreateGlobalVector(e->dm, mass));
  PetscCall(VecZeroEntries(*mass));
  PetscCall(DMLocalToGlobal(e->dm, local, ADD_VALUES, *mass));
  PetscCall(DMRestoreLocalVector(e->dm, &local));
  PetscFunctionReturn(0);
}

/*@
  ElasticityCellStress - Computes the Cauchy stress averaged over each cell, and the von Mises stress of that average

  Collective

  Input Parameters:
+ elasticity - the context
- u          - displacement, global, 3 components a vertex [length]

  Output Parameter:
. stress - 7 values a local cell, in the order of the mesh's cells: xx yy zz xy yz zx, von Mises [force/length^2]; free with `PetscFree()`

  Level: intermediate

.seealso: `ElasticityForce()`
@*/
PetscErrorCode ElasticityCellStress(Elasticity e, Vec u, PetscReal *stress[])
{
  Vec                local;
  const PetscScalar *ul, *x;

  PetscFunctionBegin;
  PetscCall(ElasticityGetLocals(e, u, &local, &ul, &x));
  PetscCall(PetscCalloc1(7 * e->ncells, stress));
  for (PetscInt c = 0; c < e->ncells; ++c) {
    const BodyMaterial *m = &e->bodies[e->cellbody[c]];
    PetscReal           X[3][8], U[3][8], G[3][8], H[9], sigma[6], *s = *stress + 7 * c, volume = 0;

    ElasticityGatherCell(e->cellnodes + 8 * c, x, X);
    ElasticityGatherCell(e->cellnodes + 8 * c, ul, U);
    for (PetscInt q = 0; q < e->basis.npoints; ++q) {
      const PetscReal w = HexGradients(&e->basis, q, X, G);

      HexDisplacementGradient(U, G, H);
      m->law->cauchy(m->lambda, m->mu, H, sigma);
      for (int k = 0; k < 6; ++k) s[k] += w * sigma[k];
      volume += w;
    }
    for (int k = 0; k < 6; ++k) s[k] /= volume;
    s[6] = PetscSqrtReal(0.5 * (PetscSqr(s[0] - s[1]) + PetscSqr(s[1] - s[2]) + PetscSqr(s[2] - s[0])) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
  }
  PetscCall(ElasticityRestoreLocals(e, &local, &ul, &x));
  PetscFunctionReturn(0);
}
