# What the makefiles share: where PETSc, its compiler and its HDF5 are, and how a source file is compiled.
# Where PETSc is not installed yet, its variables are empty and nothing fails.

# PETSC_DIR means that PETSc and no other: where it has none, pkg-config would go on to the system's
ifneq ($(PETSC_DIR),)
  override PETSC_DIR := $(abspath $(PETSC_DIR))
  export PETSC_DIR PETSC_ARCH
  petsc_pc := $(PETSC_DIR)$(if $(PETSC_ARCH),/$(PETSC_ARCH))/lib/pkgconfig/PETSc.pc
  ifeq ($(wildcard $(petsc_pc))$(filter clean help,$(MAKECMDGOALS)),)
    $(error PETSC_DIR=$(PETSC_DIR) PETSC_ARCH=$(PETSC_ARCH): there is no PETSc, for there is no $(petsc_pc))
  endif
  export PKG_CONFIG_PATH := $(patsubst %/,%,$(dir $(petsc_pc))):$(PKG_CONFIG_PATH)
endif
comma := ,
# GNU make before 4.4 exports nothing to $(shell)
pkg_config = $(shell PKG_CONFIG_PATH='$(PKG_CONFIG_PATH)' pkg-config $(1) 2>/dev/null)

PETSC_PREFIX := $(or $(PETSC_DIR),$(call pkg_config,--variable=prefix PETSc))
PETSC_CFLAGS := $(call pkg_config,--cflags PETSc)
petsc_libdir := $(call pkg_config,--variable=libdir PETSc)
# PETSC_RPATH= (empty): the loader finds PETSc without it
PETSC_RPATH  ?= $(petsc_libdir)
PETSC_LIBS   := $(call pkg_config,--libs PETSc) $(if $(PETSC_RPATH),-Wl$(comma)-rpath$(comma)$(PETSC_RPATH))

# Not empty where PETSc's scalars are complex
PETSC_COMPLEX := $(shell grep -ls 'define PETSC_USE_COMPLEX' \
                 $(addsuffix /petscconf.h,$(patsubst -I%,%,$(filter -I%,$(PETSC_CFLAGS))) \
                 $(call pkg_config,--variable=includedir PETSc)) /dev/null)

# petscviewerhdf5.h includes hdf5.h, which must be the one of PETSc's MPI; a library beside PETSc's own is the one that
# it uses
mpi_name     := $(if $(findstring Open MPI,$(shell mpiexec --version 2>/dev/null)),openmpi,mpich)
HDF5_CFLAGS  := $(or $(call pkg_config,--cflags hdf5-$(mpi_name)),$(call pkg_config,--cflags hdf5))
HDF5_LIBS    := $(if $(wildcard $(petsc_libdir)/libhdf5.*),-lhdf5, \
                $(or $(call pkg_config,--libs hdf5-$(mpi_name)),$(call pkg_config,--libs hdf5),-lhdf5))
# LAPACK as PETSc was configured with it
LAPACK_LIBS  := $(shell sed -n 's/^BLASLAPACK_LIB *= *//p' /dev/null \
                $(wildcard $(petsc_libdir)/petsc/conf/petscvariables))
# What a program of the mechanics library links beside PETSc
CONTACT_LIBS := $(HDF5_LIBS) -lmetis -lyaml $(LAPACK_LIBS) -lm

ifeq ($(origin CC),default)
  CC := $(or $(call pkg_config,--variable=ccompiler PETSc),mpicc)
endif

# Optimization is the caller's to choose: make CFLAGS='-g -O0', make MARCH=native
CFLAGS ?= -g -O3
MARCH  ?=
ifneq ($(MARCH),)
  override CFLAGS += -march=$(MARCH)
endif
# <mesh.h> is a public header of include/; "src/mesh/meshimpl.h" a private one, by its path from the top
COMPILE_FLAGS = -std=c11 -Wall -Wextra -fPIC -MMD -MP -Iinclude -I. $(PETSC_CFLAGS) $(HDF5_CFLAGS) $(CPPFLAGS) $(CFLAGS)
COMPILE = $(CC) $(COMPILE_FLAGS) -c

# Debian's Python packages serve Debian's Python only
PYTHON := $(firstword $(wildcard /usr/bin/python3) python3)

# As many jobs as cores, unless the caller chose; nproc takes OMP_NUM_THREADS for their number
CORES    := $(or $(shell env -u OMP_NUM_THREADS nproc 2>/dev/null),1)
PARALLEL := $(if $(findstring -j,$(MAKEFLAGS))$(findstring jobserver,$(MAKEFLAGS)),,-j$(CORES))

# Open MPI refuses to run as root unless asked twice, and counts a rank a core unless told otherwise
ifeq ($(shell id -u),0)
  export OMPI_ALLOW_RUN_AS_ROOT := 1
  export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM := 1
endif

# V=1 shows the commands
V ?= 0
ifeq ($(V),0)
  Q   := @
  say = @echo '  $(1) $(2)'
endif
