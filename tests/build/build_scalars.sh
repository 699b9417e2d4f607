# Complex scalars, without a PETSc that has them: PCAMGF compiles, ipfilter and contact refuse in one sentence, and the
# makefile, seeing them in petscconf.h, leaves both out and says so. tests/build/build_complex_long.sh runs what is
# built.
set -u
unset MAKEFLAGS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
headers=$(pkg-config --cflags PETSc)

# compile FILE...: with PETSc's own headers, told that scalars are complex
compile() { mpicc -std=c11 -Wall -Wextra -Werror=incompatible-pointer-types -fsyntax-only -DPETSC_USE_COMPLEX \
  -I"$AMGF_DIR/include" -I"$AMGF_DIR" $headers "$@"; }

compile "$AMGF_DIR"/pc_amgf/*.c "$AMGF_DIR"/src/plugin/*.c && echo "PCAMGF compiles"
for file in tao_ipfilter/ipfilter.c src/run/simulation.c; do
  compile "$AMGF_DIR/$file" > refusal 2>&1 && echo "$file compiles"
  grep -o '[a-z]* needs a PETSc with real scalars' refusal | sort -u
done

mkdir -p "$work/include" "$work/lib/pkgconfig"
echo '#define PETSC_USE_COMPLEX 1' > "$work/include/petscconf.h"
cat > "$work/lib/pkgconfig/PETSc.pc" << PC
Name: PETSc
Description: complex
Version: 3.18.5
Cflags: -I$work/include
Libs: -lpetsc_complex
PC
make -C "$AMGF_DIR" --no-print-directory -Bn V=1 PETSC_DIR="$work" PETSC_ARCH= all > commands
grep -q -- '-c pc_amgf/amgf.c' commands && echo "make: compiles PCAMGF"
grep -E -- '-c (pc_amgf/blockamg/|tao_ipfilter/|src/|apps/)' commands | grep -qv -- '-c src/plugin/' ||
  echo "make: and nothing else"
sed -n "s/^echo '\(.*\)'$/make: \1/p" commands
