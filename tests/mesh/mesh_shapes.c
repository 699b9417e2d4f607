static char help[] = "Every built-in shape: sizes, faces, parts of faces; vertices on the true surfaces and volumes "
                     "under refinement, with and without facets kept.\n\n";

#include <scene.h>
#include <mesh.h>
#include "../lib/elasticity_problem.h"

/* How far a point is off a surface; p is relative to the body's center */
typedef PetscReal (*Surface)(const PetscReal p[3]);

static PetscReal Norm(const PetscReal p[3], PetscReal a, PetscReal b, PetscReal c)
{
  return PetscSqrtReal(PetscSqr(p[0] / a) + PetscSqr(p[1] / b) + PetscSqr(p[2] / c));
}

static PetscReal Die26(const PetscReal p[3])
{
  return PetscSqrtReal(p[0] * p[0] + (p[2] - 1.5) * (p[2] - 1.5)) - 2.6;
}
static PetscReal Die3(const PetscReal p[3])
{
  return PetscSqrtReal(p[0] * p[0] + (p[2] - 1.5) * (p[2] - 1.5)) - 3;
}
/* At 135 degrees from z to x: below the axis, on the side of x */
static PetscReal DieEnd(const PetscReal p[3])
{
  return (p[0] - (1.5 - p[2])) / PETSC_SQRT2;
}
static PetscReal Ring2(const PetscReal p[3])
{
  return PetscSqrtReal((p[1] - 20) * (p[1] - 20) + (p[2] - 5) * (p[2] - 5)) - 2;
}
static PetscReal BeamArc(const PetscReal p[3])
{
  return PetscSqrtReal(p[0] * p[0] + PetscSqr(p[1] / 0.7)) - 1;
}
static PetscReal BumpArc(const PetscReal p[3])
{
  return PetscSqrtReal(PetscSqr(p[2] / 0.5) + PetscSqr((p[1] - 30) / 2)) - 1;
}
static PetscReal WholeArc(const PetscReal p[3])
{
  return PetscSqrtReal(p[0] * p[0] + p[2] * p[2]) - 1;
}
static PetscReal Sphere1(const PetscReal p[3])
{
  return Norm(p, 1, 1, 1) - 1;
}
static PetscReal Sphere08(const PetscReal p[3])
{
  return Norm(p, 1, 1, 1) - 0.8;
}
static PetscReal Sphere2(const PetscReal p[3])
{
  return Norm(p, 1, 1, 1) - 2;
}
static PetscReal CappedInner(const PetscReal p[3])
{
  const PetscReal q[3] = {p[0] - 0.075, p[1], p[2]};

  return Norm(q, 1, 1, 1) - 0.7;
}
static PetscReal CappedOuter(const PetscReal p[3])
{
  const PetscReal q[3] = {p[0] - 0.075, p[1], p[2]};

  return p[0] > -0.5125 ? Norm(p, 1, 1, 1) - 0.8 : Norm(q, 1, 1, 1) - 0.85;
}
static PetscReal EggInner(const PetscReal p[3])
{
  const PetscReal q[3] = {p[0], p[1] - 1, p[2] - 2};

  return Norm(q, 0.6, 0.7, 0.8) - 1;
}
static PetscReal EggOuter(const PetscReal p[3])
{
  const PetscReal q[3] = {p[0], p[1] - 1, p[2] - 2};

  return Norm(q, 0.8, 0.8, 1.2) - 1;
}
static PetscReal PlaneX(const PetscReal p[3])
{
  return p[0];
}
static PetscReal PlaneY(const PetscReal p[3])
{
  return p[1];
}
static PetscReal PlaneZ(const PetscReal p[3])
{
  return p[2];
}

static PetscReal Cone(const PetscReal p[3])
{
  return PetscSqrtReal(PetscSqr(p[1] - 40) + PetscSqr(p[2])) - (2 - p[0] / 3);
}
static PetscReal Slope(const PetscReal p[3])
{
  return p[2] + 0.5 * p[0] - 1;
}
static PetscReal Hole(const PetscReal p[3])
{
  return PetscSqrtReal(PetscSqr(p[0]) + PetscSqr(p[1] - 0.2)) - 0.5;
}
static PetscReal Notch(const PetscReal p[3])
{
  return PetscSqrtReal(PetscSqr(p[0]) + PetscSqr(p[2])) - 1;
}
static PetscReal Groove(const PetscReal p[3])
{
  return PetscSqrtReal(PetscSqr(p[1]) + PetscSqr(p[2] - 2)) - 1;
}

/* Surfaces with the place x of their body's center */
static const struct {
  const char *face;
  PetscReal   x;
  Surface     surface;
} surfaces[] = {
  {"die.inner", 8, Die26},
  {"die.outer", 8, Die3},
  {"die.amin", 8, DieEnd},
  {"ring.outer", 0, Ring2},
  {"beam.arc", 22, BeamArc},
  {"beam.flat", 22, PlaneX},
  {"beam.symmetry", 22, PlaneY},
  {"beam.lmin", 22, PlaneZ},
  {"bump.arc", 0, BumpArc},
  {"bump.flat", 0, PlaneZ},
  {"whole.arc", 30, WholeArc},
  {"whole.flat", 30, PlaneX},
  {"whole.lmax", 30, PlaneY},
  {"shell.inner", 40, Sphere08},
  {"shell.outer", 40, Sphere1},
  {"shell.x0", 40, PlaneX},
  {"shell.y0", 40, PlaneY},
  {"shell.z0", 40, PlaneZ},
  {"capped.inner", 50, CappedInner},
  {"capped.outer", 50, CappedOuter},
  {"egg.inner", 60, EggInner},
  {"egg.outer", 60, EggOuter},
  {"ball.surface", 70, Sphere2},
  {"ball.pole", 70, Sphere2},
  {"ball.x0", 70, PlaneX},
  {"ball.z0", 70, PlaneZ},
  {"globe.surface", 80, Sphere2},
  {"dome.surface", 90, Sphere2},
  {"dome.y0", 90, PlaneY},
  {"hollow.inner", 100, Sphere08},
  {"hollow.outer", 100, Sphere1},
  {"hollow.x0", 100, PlaneX},
  {"frustum.surface", 0, Cone},
  {"frustum.lmin", 0, PlaneX},
  {"wedge.side1", 120, PlaneX},
  {"wedge.side2", 120, Slope},
  {"wedge.side3", 0, PlaneZ},
  {"key.side1", 125, PlaneX},
  {"plate.hole", 130, Hole},
  {"plate.xmax", 132, PlaneX},
  {"quarter.hole", 140, Notch},
  {"quarter.xmax", 140, PlaneX},
  {"quarter.zmin", 140, PlaneZ},
  {"strip.hole", 150, Groove},
  {"strip.ymin", 150, PlaneY},
};

static PetscErrorCode CheckSurfaces(DM dm)
{
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *x;

  PetscFunctionBeginUser;
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (size_t s = 0; s < PETSC_STATIC_ARRAY_LENGTH(surfaces); ++s) {
    IS              vertices;
    const PetscInt *v;
    PetscInt        n, total;
    PetscReal       off = 0;

    PetscCall(MeshGetFaceVertices(dm, surfaces[s].face, &vertices));
    PetscCall(ISGetLocalSize(vertices, &n));
    PetscCall(ISGetIndices(vertices, &v));
    for (PetscInt i = 0; i < n; ++i) {
      PetscInt  offset;
      PetscReal p[3];

      PetscCall(PetscSectionGetOffset(section, v[i], &offset));
      for (PetscInt d = 0; d < 3; ++d) p[d] = PetscRealPart(x[offset + d]) - (d ? 0 : surfaces[s].x);
      off = PetscMax(off, PetscAbsReal(surfaces[s].surface(p)));
    }
    PetscCall(ISRestoreIndices(vertices, &v));
    PetscCall(ISDestroy(&vertices));
    PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &off, 1, MPIU_REAL, MPIU_MAX, PETSC_COMM_WORLD));
    PetscCallMPI(MPI_Allreduce(&n, &total, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
    PetscCheck(total, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "Face %s has no vertices", surfaces[s].face);
    PetscCall(ProblemReport(surfaces[s].face, off, 1e-12));
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscFunctionReturn(0);
}

/* Volume of every body, by 2x2x2 Gauss points: exact for trilinear cells */
static PetscErrorCode Volumes(DM dm, PetscInt nbodies, PetscReal volume[])
{
  Vec                coordinates;
  PetscSection       section;
  const PetscScalar *x;
  PetscInt           start, end;

  PetscFunctionBeginUser;
  PetscCall(PetscArrayzero(volume, nbodies));
  PetscCall(DMGetCoordinatesLocal(dm, &coordinates));
  PetscCall(DMGetCoordinateSection(dm, &section));
  PetscCall(DMPlexGetHeightStratum(dm, 0, &start, &end));
  PetscCall(VecGetArrayRead(coordinates, &x));
  for (PetscInt c = start; c < end; ++c) {
    PetscInt v[8], body;

    PetscCall(DMGetLabelValue(dm, MESH_BODY_LABEL, c, &body));
    PetscCall(MeshGetCellVertices(dm, c, v));
    for (PetscInt q = 0; q < 8; ++q) {
      PetscReal e[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};

      for (PetscInt a = 0; a < 8; ++a) {
        PetscInt offset;

        PetscCall(PetscSectionGetOffset(section, v[a], &offset));
        for (PetscInt k = 0; k < 3; ++k) {
          PetscReal derivative = a >> k & 1 ? 1 : -1;

          for (PetscInt l = 0; l < 3; ++l) {
            const PetscReal xi = (q >> l & 1 ? 1 : -1) / PetscSqrtReal(3);

            if (l != k) derivative *= (a >> l & 1 ? 1 + xi : 1 - xi) / 2;
          }
          for (PetscInt d = 0; d < 3; ++d) e[k][d] += derivative * PetscRealPart(x[offset + d]);
        }
      }
      volume[body] +=
        (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
        8;
    }
  }
  PetscCall(VecRestoreArrayRead(coordinates, &x));
  PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, volume, (PetscMPIInt)nbodies, MPIU_REAL, MPIU_SUM, PETSC_COMM_WORLD));
  PetscFunctionReturn(0);
}

/* A quarter of the cap of height h of a sphere */
static PetscReal Cap(PetscReal radius, PetscReal h)
{
  return PETSC_PI * h * h * (3 * radius - h) / 12;
}

static PetscErrorCode CheckVolumes(Scene scene, PetscInt levels)
{
  const PetscReal exact[] = {6, PETSC_PI / 4 * (9 - 2.6 * 2.6) * 5.2, 270. / 360 * PETSC_PI * 3,
    PETSC_PI / 4 * 0.7 * 2.5, PETSC_PI / 4, PETSC_PI / 2, PETSC_PI / 6 * (1 - 0.512),
    /* the sphere of 0.8 up to the crease, the cap beyond, less the inner sphere */
    PETSC_PI / 4 * (0.64 * 0.5125 - 0.5125 * 0.5125 * 0.5125 / 3) + Cap(0.85, 0.2625) - Cap(0.7, 0.625),
    PETSC_PI / 6 * (0.8 * 0.8 * 1.2 - 0.6 * 0.7 * 0.8), PETSC_PI / 6 * 8, PETSC_PI * 32 / 3, PETSC_PI * 16 / 3,
    PETSC_PI * 2 / 3 * (1 - 0.512), PETSC_PI * 7, 2, 1, 4.5 - PETSC_PI / 8, 6 - PETSC_PI / 4, 8 - PETSC_PI / 2};
  PetscReal       volume[2][PETSC_STATIC_ARRAY_LENGTH(exact)], first[PETSC_STATIC_ARRAY_LENGTH(exact)];
  const PetscInt  n = scene->nbodies;

  PetscFunctionBeginUser;
  PetscCheck(n == (PetscInt)PETSC_STATIC_ARRAY_LENGTH(exact), PETSC_COMM_WORLD, PETSC_ERR_PLIB,
    "The scene has %" PetscInt_FMT " bodies", n);
  for (PetscInt curved = 1; curved >= 0; --curved) {
    for (PetscInt b = 0; b < n; ++b) scene->bodies[b].curved = curved ? PETSC_TRUE : PETSC_FALSE;
    for (PetscInt l = curved ? levels - 1 : levels; l <= levels; ++l) {
      DM dm;

      PetscCall(MeshCreate(PETSC_COMM_WORLD, n, scene->bodies, l, &dm));
      PetscCall(Volumes(dm, n, volume[l == levels]));
      if (curved && l == levels) PetscCall(CheckSurfaces(dm));
      PetscCall(DMDestroy(&dm));
    }
    if (!curved) {
      DM dm;

      PetscCall(MeshCreate(PETSC_COMM_WORLD, n, scene->bodies, 0, &dm));
      PetscCall(Volumes(dm, n, first));
      PetscCall(DMDestroy(&dm));
    }
    for (PetscInt b = 0; b < n; ++b) {
      const PetscReal error = PetscAbsReal(volume[1][b] - exact[b]),
                      ratio = PetscAbsReal(volume[0][b] - exact[b]) / error;

      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s: ", scene->bodies[b].name));
      if (!curved)
        PetscCall(
          ProblemReport("facets kept, volume changes", PetscAbsReal(volume[1][b] - first[b]) / first[b], 1e-12));
      else if (error < 1e-12 * exact[b]) PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume exact\n"));
      else if (ratio > 3.6 && ratio < 4.6 && error < 0.02 * exact[b])
        PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume of second order\n"));
      else
        PetscCall(PetscPrintf(PETSC_COMM_WORLD, "volume %g instead of %g, error falls by %g\n", (double)volume[1][b],
          (double)exact[b], (double)ratio));
    }
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CheckSizes(Scene scene, PetscInt refine)
{
  DM         dm;
  Vec        u;
  PetscInt   n;
  PetscReal *volume;

  PetscFunctionBeginUser;
  PetscCall(MeshCreate(PETSC_COMM_WORLD, scene->nbodies, scene->bodies, refine, &dm));
  PetscCall(DMCreateGlobalVector(dm, &u));
  PetscCall(VecGetSize(u, &n));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "unknowns %" PetscInt_FMT "\n", n));
  PetscCall(PetscMalloc1(scene->nbodies, &volume));
  PetscCall(Volumes(dm, scene->nbodies, volume));
  for (PetscInt b = 0; b < scene->nbodies; ++b) {
    PetscInt nfaces;
    char   **faces;

    PetscCall(
      PetscPrintf(PETSC_COMM_WORLD, "%s: volume %.6f, facets and vertices", scene->bodies[b].name, (double)volume[b]));
    PetscCall(MeshGetFaceNames(PETSC_COMM_WORLD, &scene->bodies[b], &nfaces, &faces));
    for (PetscInt f = 0; f < nfaces; ++f) {
      char     name[64];
      IS       facets, rows;
      PetscInt nfacets, nrows;

      PetscCall(PetscSNPrintf(name, sizeof(name), "%s.%s", scene->bodies[b].name, faces[f]));
      PetscCall(MeshGetFacets(dm, name, &facets));
      PetscCall(ISGetLocalSize(facets, &nfacets));
      PetscCallMPI(MPI_Allreduce(MPI_IN_PLACE, &nfacets, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD));
      PetscCall(MeshGetFaceDofs(dm, name, 0, &rows));
      PetscCall(ISGetSize(rows, &nrows));
      PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s %s %" PetscInt_FMT " %" PetscInt_FMT, f ? "," : ":", faces[f],
        nfacets, nrows));
      PetscCall(ISDestroy(&facets));
      PetscCall(ISDestroy(&rows));
    }
    PetscCall(MeshRestoreFaceNames(&nfaces, &faces));
    PetscCall(PetscPrintf(PETSC_COMM_WORLD, "\n"));
  }
  PetscCall(PetscFree(volume));
  PetscCall(VecDestroy(&u));
  PetscCall(DMDestroy(&dm));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Scene     scene;
  PetscBool volumes = PETSC_FALSE;
  PetscInt  refine  = 0;
  char      file[PETSC_MAX_PATH_LEN];

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-scene", file, sizeof(file), NULL));
  PetscCall(PetscOptionsGetBool(NULL, NULL, "-volumes", &volumes, NULL));
  PetscCall(PetscOptionsGetInt(NULL, NULL, "-levels", &refine, NULL));
  PetscCall(SceneLoad(PETSC_COMM_WORLD, file, &scene));
  if (volumes) PetscCall(CheckVolumes(scene, refine));
  else PetscCall(CheckSizes(scene, refine));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

   test:
      suffix: sizes
      nsize: {{1 2 3}}
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_shapes.yaml -levels 1
      output_file: output/mesh_shapes_sizes.out

   test:
      suffix: curved
      nsize: {{1 3}}
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_shapes.yaml -volumes -levels 2
      output_file: output/mesh_shapes_curved.out

   # n of the published meshes 1 and 2 is exact: 7,902 and 53,547
   test:
      suffix: beam_sphere_1
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_beam_sphere.yaml

   test:
      suffix: beam_sphere_2
      nsize: {{1 3}}
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_beam_sphere.yaml -levels 1
      output_file: output/mesh_shapes_beam_sphere_2.out

   # two touching bodies from one Gmsh file beside a box: no common nodes, and no surface of the file on a body
   # that it does not bound
   test:
      suffix: gmsh
      nsize: {{1 2 3}}
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_gmsh.yaml -levels 1
      output_file: output/mesh_shapes_gmsh.out

   test:
      suffix: ironing
      args: -scene ${AMGF_DIR}/tests/mesh/mesh_ironing.yaml

TEST*/
