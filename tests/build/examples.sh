# The examples from an installed copy, on two ranks: each prints what its first comment says. Those for whose
# Python module this machine has no counterpart are left out; AMGF_INSTALL=1 installs it, with apt. Of those, what fails
# is printed.
. "$AMGF_DIR/tests/lib/own_folder.sh"
make -C "$AMGF_DIR" --no-print-directory install PREFIX="$work/amgf" > log 2>&1 || cat log
petsc_packages=${PETSC_DIR:+$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:}
export PKG_CONFIG_PATH=$work/amgf/lib/pkgconfig:$petsc_packages${PKG_CONFIG_PATH:-}
cp -r amgf/share/amgf/examples . && cd examples || exit 1
make CFLAGS='-g -O2 -Wall -Werror' > log 2>&1 || cat log
plugin=$(pkg-config --variable=plugin petscamgf)

# told FILE: the lines of its first comment after "Output:"
told() { awk '/Output:$/ {on = 1; next} on && /^( *\*\/|""")/ {exit} on {sub(/^ +/, ""); print}' "$1"; }

# example FILE COMMAND...
example() {
  local file=$1
  shift
  timeout 1200 mpiexec --oversubscribe -n 2 "$@" > out 2> err
  if told "$file" | diff - out > difference; then $said "$file: as told"; else
    echo "$file:"
    cat difference
    head -n 5 err
  fi
}

# has MODULE PACKAGE: of the PETSc in use
has() {
  "$PYTHON" "$AMGF_DIR/tests/lib/petsc4py_of.py" "$(pkg-config --variable=libdir PETSc)" 2> /dev/null || return 1
  "$PYTHON" -c "import $1" 2> /dev/null && return
  [ -n "${AMGF_INSTALL:-}" ] && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$2" \
    > /dev/null 2>&1 && "$PYTHON" -c "import $1"
}

said=echo
example ties_ksp.c ./ties_ksp -dll_append "$plugin" -pc_type amgf
example wall_snes.c ./wall_snes -dll_append "$plugin" -pc_type amgf
example obstacle_tao.c ./obstacle_tao -dll_append "$plugin" -tao_type ipfilter
example friction_tao.c ./friction_tao
example press_library.c ./press_library "$work/amgf/share/amgf/scenes/patch_test.yaml"
said=: # whether they are run depends on the machine
has petsc4py petsc4py && example ties_petsc4py.py "$PYTHON" ties_petsc4py.py -dll_append "$plugin" -pc_type amgf
has slepc4py python3-slepc4py && example modes_slepc4py.py "$PYTHON" modes_slepc4py.py -dll_append "$plugin" \
  -st_pc_type amgf
has dolfinx python3-dolfinx && example beam_dolfinx.py "$PYTHON" beam_dolfinx.py -dll_append "$plugin" -pc_type amgf
ls ./*.c ./*.py | while read -r file; do grep -q "^example ${file#./} " "$AMGF_DIR/tests/build/examples.sh" ||
  grep -q "&& example ${file#./} " "$AMGF_DIR/tests/build/examples.sh" || echo "$file is not run"; done
exit 0
