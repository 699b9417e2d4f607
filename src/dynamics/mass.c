/* The mass matrix, nodes without mass, momentum and kinetic energy */
#include "dynamicsimpl.h"
#include <mesh.h>

/* Returns whether the nodes of a face have no mass because of a contact pair */
static PetscBool MassFaceIsLight(Scene scene, const SceneContactPair *pair, const char face[])
{
  return (PetscBool)(!SceneContactPairHasFriction(pair) && SceneFaceBody(scene, face)->material.type != MATERIAL_RIGID);
}

/* Sets `mark` to 1 at the light nodes of contact pairs, and to 0 elsewhere */
static PetscErrorCode MassMarkLight(const Constraints *c, Vec mark)
{
  Scene scene = c->bodies.scene;

  PetscFunctionBegin;
  PetscCall(VecZeroEntries(mark));
  for (PetscInt k = 0; k < 2 * scene->npairs; ++k) {
    const SceneContactPair *pair = &scene->pairs[k / 2];
    const char             *face = k % 2 ? pair->mortar : pair->nonmortar;

    if (MassFaceIsLight(scene, pair, face)) PetscCall(MeshFaceSet(c->bodies.dm, face, 0, 1.0, mark));
  }
  PetscFunctionReturn(0);
}

/* Marks in d->inert the rows whose velocity follows from equations of motion */
static PetscErrorCode MassMarkInert(const Constraints *c, Dynamics *d)
{
  PetscScalar *a;
  PetscInt     n;

  PetscFunctionBegin;
  PetscCall(VecDuplicate(c->bodies.mass, &d->inert));
  PetscCall(MatGetDiagonal(d->mass, d->inert));
  PetscCall(VecGetLocalSize(d->inert, &n));
  PetscCall(VecGetArray(d->inert, &a));
  for (PetscInt i = 0; i < n; ++i) a[i] = PetscRealPart(a[i]) > 0.0 ? 1.0 : 0.0;
  PetscCall(VecRestoreArray(d->inert, &a));
  PetscCall(PrescribedSet(c->prescribed, 0.0, d->inert));
  PetscFunctionReturn(0);
}

/* Returns the density of a body. That of a rigid surface gives the cube in the mesh the mass of the surface. */
static PetscReal MassGetDensity(const SceneBody *body)
{
  SceneSurfaceCube cube;

  if (!SceneBodyIsSurface(body)) return body->material.density;
  SceneSurfaceGetCube(body, &cube);
  return body->own[SURFACE_MASS] / (cube.size * cube.size * cube.size);
}

PetscErrorCode MassCreate(const Constraints *c, Dynamics *d)
{
  Scene          scene = c->bodies.scene;
  const MassType type  = scene->dynamics.mass;
  PetscReal     *density;
  Vec            light = NULL;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(scene->nbodies, &density));
  for (PetscInt b = 0; b < scene->nbodies; ++b) density[b] = MassGetDensity(&scene->bodies[b]);
  if (type == MASS_REDISTRIBUTED && scene->npairs) {
    PetscCall(VecDuplicate(c->bodies.mass, &light));
    PetscCall(MassMarkLight(c, light));
  }
  PetscCall(ElasticitySetMass(c->bodies.elasticity, density, (PetscBool)(type == MASS_CONSISTENT), light));
  PetscCall(ElasticityCreateMass(c->bodies.elasticity, &d->mass));
  PetscCall(VecDestroy(&light));
  PetscCall(PetscFree(density));
  PetscCall(MassMarkInert(c, d));
  PetscFunctionReturn(0);
}

/* Collective. Computes the centre of mass of each undeformed body [length] */
PetscErrorCode MassGetCentres(const Constraints *c, const Dynamics *d, PetscReal centres[][3])
{
  const VertexPlaces *places  = &c->bodies.places;
  const PetscInt      nbodies = c->bodies.scene->nbodies;
  PetscReal          *mass, *moment;
  Vec                 ones, product;

  PetscFunctionBegin;
  PetscCall(PetscMalloc2(3 * nbodies, &mass, 3 * nbodies, &moment));
  PetscCall(VecDuplicate(places->x, &ones));
  PetscCall(VecDuplicate(ones, &product));
  PetscCall(VecSet(ones, 1.0));
  PetscCall(MatMult(d->mass, ones, product));
  PetscCall(VertexPlacesSum(places, product, nbodies, mass));
  PetscCall(MatMult(d->mass, places->x, product));
  PetscCall(VertexPlacesSum(places, product, nbodies, moment));
  for (PetscInt i = 0; i < 3 * nbodies; ++i) centres[i / 3][i % 3] = moment[i] / mass[3 * (i / 3)];
  PetscCall(VecDestroy(&product));
  PetscCall(VecDestroy(&ones));
  PetscCall(PetscFree2(mass, moment));
  PetscFunctionReturn(0);
}

/* Collective. Computes the kinetic energy v^T M v/2 [force length], the momentum sum M v, and the angular momentum
   about the origin (spin), of all bodies at the displacement u */
PetscErrorCode MassMeasure(const Constraints *c, const Dynamics *d, Vec u, PetscReal *kinetic, PetscReal momentum[3],
  PetscReal spin[3])
{
  const PetscInt nbodies = c->bodies.scene->nbodies;
  PetscScalar    twice, sum;
  BodyMotion    *motions;
  Vec            product, moved;

  PetscFunctionBegin;
  PetscCall(PetscMalloc1(nbodies, &motions));
  PetscCall(VecDuplicate(u, &product));
  PetscCall(VecDuplicate(u, &moved));
  PetscCall(MatMult(d->mass, d->velocity, product));
  PetscCall(VecDot(product, d->velocity, &twice));
  *kinetic = 0.5 * PetscRealPart(twice);
  for (PetscInt k = 0; k < 6; ++k) { /* products with unit translations and rotations of all bodies */
    for (PetscInt b = 0; b < nbodies; ++b)
      motions[b] = (BodyMotion){.t = {k == 0, k == 1, k == 2}, .w = {k == 3, k == 4, k == 5}};
    PetscCall(VertexPlacesMove(&c->bodies.places, u, motions, moved));
    PetscCall(VecDot(product, moved, &sum));
    (k < 3 ? momentum : spin)[k % 3] = PetscRealPart(sum);
  }
  PetscCall(VecDestroy(&moved));
  PetscCall(VecDestroy(&product));
  PetscCall(PetscFree(motions));
  PetscFunctionReturn(0);
}
