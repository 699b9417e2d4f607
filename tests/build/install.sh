# make install, as programs outside see it: with pkg-config alone, C and C++ compile, link and run against the plugin
# and against the mechanics library; every header stands by itself; PETSc's version is in the pkg-config file, which
# refuses another; installing twice leaves one copy, make uninstall none.
. "$AMGF_DIR/tests/lib/own_folder.sh"
prefix=$work/opt/amgf
installs() { make -C "$AMGF_DIR" --no-print-directory "$@" > log 2>&1 || cat log; }
installs install PREFIX="$prefix"
(cd "$prefix" && find . | sort) > first
touch "$prefix/share/amgf/scenes/of_the_user.yaml"
installs install PREFIX="$prefix"
(cd "$prefix" && find . ! -name of_the_user.yaml | sort) | diff first - && echo "installed twice: the same files"
rm "$prefix/share/amgf/scenes/of_the_user.yaml"
for name in bin/contact lib/libpetscamgf.so lib/libcontact.a lib/pkgconfig/petscamgf.pc lib/pkgconfig/contact.pc \
  include/petscamgf.h include/contact/step.h share/amgf/scenes/two_block.yaml share/amgf/examples/makefile \
  share/doc/amgf/guide.md share/man/man1/contact.1 share/man/man3/PCAMGF.3 share/man/man3/TAOIPFILTER.3; do
  [ -e "$prefix/$name" ] || echo "not installed: $name"
done
cd "$prefix/share/doc/amgf" || exit 1
grep -oh '([^()]*pictures/[a-z_]*\.png' ./*.md | cut -c2- | sort -u | while read -r picture; do
  [ -e "$picture" ] || echo "not installed: $picture"
done
cd "$work" || exit 1
echo "manual pages in section 3 that are not the plugin's:" \
  "$(cd "$prefix/share/man/man3" && find . -name '*.3' ! -name 'PC*' ! -name 'P[eE]*' ! -name 'T[aA]*' | wc -l)"

export PKG_CONFIG_PATH=$prefix/lib/pkgconfig:${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}${PKG_CONFIG_PATH:-}
rpath=-Wl,-rpath,$(pkg-config --variable=libdir PETSc)
pkg-config --print-requires petscamgf | sed 's/[0-9.]*$/RELEASE/'
[ "$(pkg-config --variable=petsc_version petscamgf)" = "$(pkg-config --modversion PETSc)" ] &&
  echo "it says which PETSc"

cat > plugin.c << 'C'
#include <petscamgf.h>
#if PETSCAMGF_VERSION_LT(0, 1, 0) || !PETSCAMGF_VERSION_GE(0, 1, 0)
  #error "an older release"
#endif
int main(int argc, char **argv)
{
  char version[128];
  PC   pc;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(PCCreate(PETSC_COMM_WORLD, &pc));
  PetscCall(PCSetType(pc, PCAMGF));
  PetscCall(PCAMGFSetCycle(pc, PC_AMGF_BFB));
  PetscCall(PCDestroy(&pc));
  PetscCall(PetscAMGFGetVersion(version, sizeof(version)));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "plugin: %.9s\n", version));
  PetscCall(PetscFinalize());
  return 0;
}
C
cat > library.c << 'C'
#include <contact/step.h>
int main(int argc, char **argv)
{
  Scene      scene;
  Simulation simulation;
  StepState  state;

  PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
  PetscCall(PetscAMGFInitializePackage());
  PetscCall(SceneLoad(PETSC_COMM_WORLD, argv[1], &scene));
  PetscCall(SimulationCreate(PETSC_COMM_WORLD, scene, &simulation));
  PetscCall(SimulationSetFromOptions(simulation));
  PetscCall(SimulationSetUp(simulation));
  PetscCall(SimulationStep(simulation, 0, &state));
  PetscCall(PetscPrintf(PETSC_COMM_WORLD, "library: converged %s\n", PetscBools[state.report->converged]));
  PetscCall(SimulationDestroy(&simulation));
  PetscCall(SceneDestroy(&scene));
  PetscCall(PetscFinalize());
  return 0;
}
C
cp plugin.c plugin.cc
cp library.c library.cc
for language in c cc; do
  compiler=mpicc
  [ $language = c ] || compiler=mpicxx
  $compiler -Wall -Werror plugin.$language -o plugin_$language $(pkg-config --cflags --libs petscamgf) $rpath \
    && ./plugin_$language
  $compiler -Wall -Werror library.$language -o library_$language $(pkg-config --cflags --libs contact) $rpath \
    && ./library_$language "$prefix/share/amgf/scenes/cantilever.yaml" -refine 0
done
for header in $(cd "$prefix/include" && ls *.h contact/*.h); do
  echo "#include <$header>" > alone.c
  mpicc -Wall -Werror -fsyntax-only alone.c $(pkg-config --cflags contact) > err 2>&1 \
    || { echo "$header alone:"; head -n 3 err; }
done
"$prefix/bin/contact" "$prefix/share/amgf/scenes/gmsh_blocks.yaml" -scene_check > out &&
  echo "contact: a scene with its mesh"

installs uninstall PREFIX="$prefix"
[ ! -e "$work/opt" ] && echo "uninstalled: nothing left"

# Staged for a package, beside something of another
mkdir stage
echo kept > stage/theirs
installs install DESTDIR="$work/stage" PREFIX=/opt/amgf
grep -c "$work" stage/opt/amgf/lib/pkgconfig/*.pc | sed 's|.*/||'
touch stage/opt/amgf/include/theirs.h
installs uninstall DESTDIR="$work/stage" PREFIX=/opt/amgf
find stage | sort
