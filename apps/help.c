/* What the program prints without running a scene */
#include "appsimpl.h"
#include <string.h>

const char AppHelp[] = "Contact of deformable bodies: contact SCENE.yaml [options]. SCENE.yaml describes the model.\n\
contact DECK.inp translates a deck of Abaqus or CalculiX into the scene DECK_deck.yaml and runs it.\n\
  -refine N            number of uniform refinements of the mesh\n\
  -load_steps N        number of load steps of equal size\n\
  -contact_updates N   largest number of contact updates per load step (20); with 1 the gap is not checked\n\
  -accuracy ERROR      choose mesh and tolerances for this relative error of energy and contact force\n\
  -accuracy_adaptive   refine only where the error is large\n\
  -accuracy_order 2    use elements of order 2 on the first mesh before the mesh is refined\n\
  -accuracy_of WHAT    quantities of -accuracy, all with the energy: energy; force (default): force of each pair;\n\
                       pressure: also the largest pressure of each pair; displacement: that of the probes\n\
Results\n\
  -output BASE         write fields for ParaView, BASE.xmf with BASE.h5 and BASE_0001.h5, ..., and a table with a\n\
                       line per load step, BASE.csv\n\
  -output BASE.pvd     also write VTK files, which contain the surfaces of rigid tools\n\
  -output_every N      keep the fields of every Nth load step and of the last one\n\
  -output_last         keep the fields of the last load step only.\n\
                       The table has all load steps. PETSc's -viewer_hdf5_sp_output: in single precision\n\
  -output_gauss        also write the stress at quadrature points, BASE_gauss.xmf\n\
  -summary FILE.json   write all numbers of the run\n\
  -report FILE.html    write a page with scene, pictures, curves, forces, accuracy and time. It also writes\n\
                       -output FILE and -summary FILE.json unless these are given\n\
  -checkpoint_every N  write a checkpoint after every N load steps. A run that is ended by a signal always does\n\
  -checkpoint FILE     name of the checkpoint; default BASE_checkpoint.h5, or <problem>_checkpoint.h5 without -output\n\
  -restart FILE        continue from a checkpoint; ranks, -refine and the later load program may differ\n\
What is printed\n\
  -tables_view         also with -quiet: tables of load steps, solver, forces, energy, errors, meshes of -accuracy,\n\
                       times, memory\n\
  -contact_free        a comparison with the first load step without contact\n\
  -quiet               no line per iteration and no largest values\n\
  -traceback           PETSc's traceback after an error\n\
Without a run\n\
  -scene_check         check the scene, build its mesh, print what would be simulated\n\
  -scene_keys          all keys of scene files with type, unit, meaning and default\n\
  -version, --help     the version; this text\n\
  -help                this text and all options of PETSc\n\
Exit code\n\
  0  all load steps converged, and a requested accuracy was reached\n\
  1  invalid scene, option or file; the message begins with \"contact: error:\"\n\
  2  a load step did not converge\n\
  3  a load step ended with an inconsistent contact gap\n\
  4  the requested accuracy was not reached\n\
  5  ended by SIGINT, SIGTERM or SIGUSR1\n\
  6  results could not be written\n\
  7  out of memory, or an error in the program or in a library\n\n";

/* Returns whether the command is contact --help, -version or -scene_keys, which print a text and do not run a scene */
PetscBool AppAsksForText(int argc, char **argv)
{
  return (PetscBool)(argc == 2 && (!strcmp(argv[1], "--help") || !strcmp(argv[1], "--version") ||
                                    !strcmp(argv[1], "-version") || !strcmp(argv[1], "-scene_keys")));
}

PetscErrorCode AppGetVersions(char text[], size_t length)
{
  char plugin[256], petsc[256];

  PetscFunctionBeginUser;
  PetscCall(PetscAMGFGetVersion(plugin, sizeof(plugin)));
  PetscCall(PetscGetVersion(petsc, sizeof(petsc)));
  PetscCall(PetscSNPrintf(text, length, "contact %d.%d.%d\n%s\nrunning %s\n", PETSCAMGF_VERSION_MAJOR,
    PETSCAMGF_VERSION_MINOR, PETSCAMGF_VERSION_SUBMINOR, plugin, petsc));
  PetscFunctionReturn(0);
}

PetscErrorCode AppSayText(const char word[])
{
  char versions[512];

  PetscFunctionBeginUser;
  if (!strcmp(word, "-scene_keys")) {
    PetscCall(SceneViewKeys(PETSC_VIEWER_STDOUT_WORLD));
    PetscFunctionReturn(0);
  }
  PetscCall(AppGetVersions(versions, sizeof(versions)));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "%s", !strcmp(word, "--help") ? AppHelp : versions));
  PetscFunctionReturn(0);
}
