#!/bin/sh
# Installs what amgf needs and does not find: with apt on Debian and Ubuntu, elsewhere it says what is missing.
# Silent and quick where nothing is missing. What apt says goes to a file, whose end is shown when it fails.
set -u

# PETSc through PETSC_DIR is the user's own: then only the harness and the other libraries are asked for, and petsc4py
# is not
if [ -n "${PETSC_DIR:-}" ]; then
  PKG_CONFIG_PATH=$PETSC_DIR/${PETSC_ARCH:-}/lib/pkgconfig:${PKG_CONFIG_PATH:-}
  export PKG_CONFIG_PATH
fi
python=python3
[ ! -x /usr/bin/python3 ] || python=/usr/bin/python3

have() { command -v "$1" >/dev/null 2>&1; }

have_harness() {
  for dir in "${PETSC_DIR:-}/config" "$(pkg-config --variable=prefix PETSc 2>/dev/null)/share/petsc/examples/config"; do
    [ -f "$dir/gmakegentest.py" ] && return 0
  done
  return 1
}

# The reference BLAS makes a direct factorization ten times slower
have_fast_blas() {
  have update-alternatives || return 0
  blas=$(update-alternatives --list "libblas.so.3-$(gcc -dumpmachine)" 2>/dev/null) || return 0
  [ -n "$blas" ] || return 0
  case $(readlink -f "/usr/lib/$(gcc -dumpmachine)/libblas.so.3") in */blas/libblas.so*) return 1 ;; esac
  return 0
}

have_module() { $python -c "import importlib.util as u, sys; sys.exit(u.find_spec('$1') is None)" 2>/dev/null; }

# One line for each thing that is missing
missing() {
  have pkg-config || echo "pkg-config"
  have mpicc && have mpiexec || echo "an MPI with its compiler wrapper"
  pkg-config --exists PETSc 2>/dev/null ||
    echo "PETSc >= 3.18 with hypre, MUMPS and HDF5 (set PETSC_DIR and PETSC_ARCH)"
  have_harness || echo "PETSc's examples with config/gmakegentest.py"
  for header in metis.h yaml.h hdf5.h; do
    cflags=$(pkg-config --cflags PETSc hdf5-openmpi 2>/dev/null || pkg-config --cflags PETSc hdf5 2>/dev/null \
      || pkg-config --cflags PETSc 2>/dev/null)
    # shellcheck disable=SC2086
    echo "#include <$header>" | "${CC:-mpicc}" $cflags -E - >/dev/null 2>&1 || echo "$header"
  done
  have_fast_blas || echo "an optimized BLAS, for example OpenBLAS"
  petsc4py=petsc4py
  [ -z "${PETSC_DIR:-}" ] || petsc4py=
  for module in numpy matplotlib h5py yaml $petsc4py; do
    have_module $module || echo "Python 3 with $module"
  done
}

# Pictures and mesh formats need these. Elsewhere than on Debian the rest works without them
missing_for_some() {
  have_module vtkmodules || echo "VTK 9 for Python 3"
  have Xvfb || echo "Xvfb"
  have_module meshio || echo "meshio for Python 3"
  have_module netCDF4 || echo "netCDF4 for Python 3"
}

required=$(missing)
optional=$(missing_for_some)
lacking=$(printf '%s\n%s' "$required" "$optional" | sed '/^$/d')
[ -n "$lacking" ] || exit 0

# give_up SENTENCE: an error, unless only what some features need is missing
give_up() {
  if [ -z "$required" ]; then
    echo "$1: pictures or mesh formats are left out (missing: $(echo "$optional" | paste -sd, | sed 's/,/, /g'))"
    exit 0
  fi
  echo "$1. Missing:" >&2
  echo "$required" | sed 's/^/  /' >&2
  exit 1
}

have apt-get || give_up "No apt-get here"
as_root=
if [ "$(id -u)" -ne 0 ]; then
  have sudo || give_up "apt-get needs root, and there is no sudo"
  as_root=sudo
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" >"$log" 2>&1 ||
    { tail -n 5 "$log" >&2; return 1; }
}

echo "Installing: $(echo "$lacking" | paste -sd, | sed 's/,/, /g')"
apt update || give_up "apt-get update failed"
packages="pkg-config openmpi-bin libopenmpi-dev libhdf5-openmpi-dev libmetis-dev libyaml-dev libopenblas0-serial
          python3 python3-numpy python3-matplotlib python3-pil python3-h5py python3-yaml python3-vtk9 xvfb
          python3-meshio python3-netcdf4"
if [ -z "${PETSC_DIR:-}" ]; then
  version=$(apt-cache depends libpetsc-real-dev | sed -n 's/.*Depends: libpetsc-real\([0-9.]*\)-dev.*/\1/p' | head -n 1)
  # the complex one is for a test, which is left out where it is missing; the real one stays the default
  packages="$packages libpetsc-real-dev libpetsc-complex-dev libpetsc$version-dev-examples
            python3-petsc4py python3-petsc4py-real"
fi
# shellcheck disable=SC2086
apt install --no-install-recommends -y $packages || give_up "apt-get could not install the packages"

# A BLAS chosen by hand stays; alternatives in auto mode prefer OpenBLAS
required=$(missing)
[ -z "$required" ] || give_up "apt-get has not installed all"
