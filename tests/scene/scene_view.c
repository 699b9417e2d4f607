static char help[] = "A scene that is viewed and read again is the same scene: -scene FILE.\n";

#include <scene.h>
#include <petscviewer.h>

static PetscErrorCode ViewToFile(Scene scene, const char file[])
{
  PetscViewer viewer;

  PetscFunctionBeginUser;
  PetscCall(PetscViewerASCIIOpen(PETSC_COMM_WORLD, file, &viewer));
  PetscCall(SceneView(scene, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscFunctionReturn(0);
}

/* The two views, byte by byte on the first rank */
static PetscErrorCode CompareViews(const char first[], const char second[])
{
  PetscMPIInt rank;
  FILE       *a, *b;
  int         c;

  PetscFunctionBeginUser;
  PetscCallMPI(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank) PetscFunctionReturn(0);
  PetscCall(PetscFOpen(PETSC_COMM_SELF, first, "r", &a));
  PetscCall(PetscFOpen(PETSC_COMM_SELF, second, "r", &b));
  do {
    c = fgetc(a);
    PetscCheck(c == fgetc(b), PETSC_COMM_SELF, PETSC_ERR_PLIB, "%s and %s differ", first, second);
  } while (c != EOF);
  PetscCall(PetscFClose(PETSC_COMM_SELF, a));
  PetscCall(PetscFClose(PETSC_COMM_SELF, b));
  PetscFunctionReturn(0);
}

static PetscErrorCode CompareBodies(Scene a, Scene b)
{
  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < a->nbodies; ++i) {
    const SceneBody *x = &a->bodies[i], *y = &b->bodies[i];
    PetscBool        same;

    PetscCall(PetscStrcmp(x->name, y->name, &same));
    same = same && x->shape == y->shape && x->material.type == y->material.type;
    same = same && x->material.young == y->material.young && x->material.poisson == y->material.poisson;
    for (PetscInt d = 0; d < 3; ++d)
      same = same && x->lower[d] == y->lower[d] && x->upper[d] == y->upper[d] && x->cells[d] == y->cells[d];
    PetscCheck(same, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "Body \"%s\" changed", x->name);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CompareBoundary(Scene a, Scene b)
{
  PetscBool same, face;

  PetscFunctionBeginUser;
  for (PetscInt i = 0; i < a->ndisplacements; ++i) {
    const SceneDisplacement *x = &a->displacements[i], *y = &b->displacements[i];

    PetscCall(PetscStrcmp(x->name, y->name, &same));
    PetscCall(PetscStrcmp(x->face, y->face, &face));
    for (PetscInt d = 0; d < 3; ++d)
      same = same && x->fixed[d] == y->fixed[d] && (!x->fixed[d] || x->value[d] == y->value[d]);
    PetscCheck(same && face, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "Displacement \"%s\" changed", x->name);
  }
  for (PetscInt i = 0; i < a->npairs; ++i) {
    PetscCall(PetscStrcmp(a->pairs[i].mortar, b->pairs[i].mortar, &same));
    PetscCall(PetscStrcmp(a->pairs[i].nonmortar, b->pairs[i].nonmortar, &face));
    PetscCheck(same && face, PETSC_COMM_WORLD, PETSC_ERR_PLIB, "Contact pair \"%s\" changed", a->pairs[i].name);
  }
  PetscFunctionReturn(0);
}

static PetscErrorCode CompareScenes(Scene a, Scene b)
{
  PetscBool same;

  PetscFunctionBeginUser;
  PetscCall(PetscStrcmp(a->name, b->name, &same));
  PetscCheck(same && a->refine == b->refine && a->nsteps == b->nsteps, PETSC_COMM_WORLD, PETSC_ERR_PLIB,
    "Problem, refine or load steps changed");
  PetscCheck(a->nbodies == b->nbodies && a->ndisplacements == b->ndisplacements && a->npairs == b->npairs,
    PETSC_COMM_WORLD, PETSC_ERR_PLIB, "A list changed its length");
  for (PetscInt i = 0; i < a->nsteps; ++i)
    PetscCheck(a->ramps[0].factor[i] == b->ramps[0].factor[i], PETSC_COMM_WORLD, PETSC_ERR_PLIB,
      "Load factor %" PetscInt_FMT " changed", i);
  PetscCall(CompareBodies(a, b));
  PetscCall(CompareBoundary(a, b));
  PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
  Scene     scene, again;
  char      file[PETSC_MAX_PATH_LEN] = "";
  PetscBool set;

  PetscFunctionBeginUser;
  PetscCall(PetscInitialize(&argc, &argv, NULL, help));
  PetscCall(PetscOptionsGetString(NULL, NULL, "-scene", file, sizeof(file), &set));
  PetscCall(SceneLoad(PETSC_COMM_WORLD, file, &scene));
  PetscCall(SceneView(scene, PETSC_VIEWER_STDOUT_WORLD));
  PetscCall(ViewToFile(scene, "viewed.yaml"));
  PetscCall(PetscOptionsClearValue(NULL, "-refine"));
  PetscCall(PetscOptionsClearValue(NULL, "-load_steps"));
  PetscCall(PetscOptionsClearValue(NULL, "-model"));
  PetscCall(PetscOptionsClearValue(NULL, "-contact_updates"));
  PetscCall(SceneLoad(PETSC_COMM_WORLD, "viewed.yaml", &again));
  PetscCall(CompareScenes(scene, again));
  PetscCall(ViewToFile(again, "again.yaml"));
  PetscCall(CompareViews("viewed.yaml", "again.yaml"));
  PetscCall(SceneDestroy(&again));
  PetscCall(SceneDestroy(&scene));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}

/*TEST

  test:
    suffix: every_key
    nsize: {{1 3}}
    args: -scene scene_every_key.yaml
    localrunfiles: scene_every_key.yaml
    output_file: output/scene_view_every_key.out

  test:
    suffix: fewest_keys
    args: -scene scene_fewest_keys.yaml -refine 2 -load_steps 3
    localrunfiles: scene_fewest_keys.yaml

  test:
    suffix: two_block
    args: -scene ${AMGF_DIR}/share/scenes/two_block.yaml

  test:
    suffix: command_line
    args: -scene scene_fewest_keys.yaml -model quadratic -contact_updates 4 -load_steps 2 -refine 1
    localrunfiles: scene_fewest_keys.yaml

  test:
    suffix: resampled
    args: -scene scene_every_key.yaml -load_steps 8
    localrunfiles: scene_every_key.yaml
    filter: sed -n -e "/^load/,/^refine/p" -e /^displacement_bounds/p

TEST*/
