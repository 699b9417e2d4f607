# amgf: build, try, check, install. `make help` lists the targets.
#
# PETSc is found through PETSC_DIR (and PETSC_ARCH) if set, else through pkg-config alone.

# petscamgf.h has the version; while it is 0.x, a plugin and the programs linked with it belong together up to its
# second number
VERSION   := $(subst $(eval) ,.,$(shell \
  sed -n 's/^#define PETSCAMGF_VERSION_[A-Z]* *\([0-9]*\)$$/\1/p' include/petscamgf.h))
SOVERSION := $(basename $(VERSION))

include share/toolchain.mk

.DEFAULT_GOAL := all
include share/configuration.mk

PLUGIN  := lib/libpetscamgf.so
LIBRARY := lib/libcontact.a
# With complex scalars the plugin is PCAMGF alone
only_real       := pc_amgf/blockamg/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c
plugin_sources  := $(wildcard pc_amgf/*.c src/plugin/*.c $(if $(PETSC_COMPLEX),,$(only_real)))
plugin_objects  := $(patsubst %.c,build/%.o,$(plugin_sources))
library_objects := $(filter-out build/src/plugin/%,$(patsubst %.c,build/%.o,$(wildcard src/*/*.c src/*/*/*.c)))
program_objects := $(patsubst %.c,build/%.o,$(wildcard apps/*.c))
# PLUGIN_ONLY=1 builds and installs the plugin alone, which needs PETSc alone
only_plugin     := $(PETSC_COMPLEX)$(PLUGIN_ONLY)
programs        := $(if $(only_plugin),,bin/contact)
# What is linked changes when a source file comes or goes, not only when one changes
source_list := build/sources.list

.PHONY: all complex demo demo-published check check-all check-plugin stress scene-stress clean help dependencies \
  print-contact-libs FORCE
.DELETE_ON_ERROR:
.SUFFIXES:

all: $(PLUGIN) $(if $(PETSC_COMPLEX),complex) \
  $(if $(only_plugin),,$(LIBRARY) $(programs) bin/contact-mesh bin/contact-ccx)

complex: $(PLUGIN)
	@echo 'The scalars of this PETSc are complex: the plugin is PCAMGF alone, for ipfilter and contact need real ones'

build/%.o: %.c makefile share/toolchain.mk $(configuration)
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(COMPILE) $< -o $@

# Which Python makes the page of a run, and converts meshes
# Products and sums become one instruction where the processor has it. Vectors of 8 floats are never arguments of
# functions that are not inlined.
build/pc_amgf/blockamg/sweep.o: COMPILE_FLAGS += -Wno-psabi
build/pc_amgf/blockamg/sweep.o build/tao_ipfilter/subspace/products.o build/src/elasticity/elements/%.o \
  build/src/material/%.o: \
  COMPILE_FLAGS += -ffp-contract=fast
build/src/output/page.o build/src/mesh/gmsh/convert.o build/apps/deck.o: COMPILE_FLAGS += -DCONTACT_PYTHON='"$(PYTHON)"'

$(source_list): FORCE
	@mkdir -p $(@D)
	@objects='$(plugin_objects) $(library_objects) $(program_objects)'; \
	echo "$$objects" | cmp -s - $@ || echo "$$objects" > $@

# PETSc closes what it opened; nodelete keeps the registered types callable until the process ends
$(PLUGIN): $(plugin_objects) $(source_list) $(configuration) include/petscamgf.h
	@mkdir -p $(@D)
	$(call say,LD,$@)
	$(Q)rm -f $@*
	$(Q)$(CC) -shared -Wl,-soname,$(@F).$(SOVERSION) -Wl,-z,nodelete $(CFLAGS) $(LDFLAGS) $(plugin_objects) \
	  $(PETSC_LIBS) -lm -o $@.$(VERSION)
	$(Q)ln -sf $(@F).$(VERSION) $@.$(SOVERSION) && ln -sf $(@F).$(SOVERSION) $@

$(LIBRARY): $(library_objects) $(source_list)
	@mkdir -p $(@D)
	@rm -f $@
	$(call say,AR,$@)
	$(Q)$(AR) rcs $@ $(library_objects)

bin/contact: $(program_objects) $(LIBRARY) $(PLUGIN) $(configuration)
	@mkdir -p $(@D)
	$(call say,LD,$@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $(program_objects) $(LIBRARY) -Llib -lpetscamgf '-Wl,-rpath,$$ORIGIN/../lib' \
	  $(PETSC_LIBS) $(CONTACT_LIBS) -o $@

bin/contact-mesh bin/contact-ccx: share/python/program.sh makefile
	@mkdir -p $(@D)
	$(Q)sed 's|@PYTHON@|$(PYTHON)|; s|@NAME@|$(@F)|; s|@FILE@|$(subst -,_,$(@F)).py|' $< > $@ && chmod 755 $@

.PRECIOUS: build/%.o
-include $(wildcard $(addprefix build/,apps/*.d pc_amgf/*.d pc_amgf/*/*.d tao_ipfilter/*.d tao_ipfilter/*/*.d \
  src/*/*.d src/*/*/*.d))

dependencies:
	@./share/install-deps.sh

# A second make sees what the first one installed. Compiler lines go to a file, whose end is shown when something fails
BUILD_LOG := build/demo/build.log
quiet_build = mkdir -p build/demo; \
  [ -x bin/contact ] || echo 'Building, a minute or two the first time (messages: $(BUILD_LOG))'; \
  $(MAKE) --no-print-directory $(PARALLEL) all > $(BUILD_LOG) 2>&1 || { tail -n 20 $(BUILD_LOG) >&2; exit 1; }

demo: dependencies
	@$(quiet_build)
	@$(PYTHON) -B share/demo/hertz.py build/demo

# The two-block problem of the publication
demo-published: dependencies
	@$(quiet_build)
	bin/contact share/scenes/two_block.yaml -output build/demo/two_block

# One test more than cores: a run waits for its MPI half of a second before it computes
TESTS_PARALLEL = $(if $(PARALLEL),-j$(shell expr $(CORES) + 1))

check: dependencies
	@$(MAKE) --no-print-directory -f tests/makefile $(TESTS_PARALLEL) check

# PCAMGF alone: neither the mechanics library nor contact is built
check-plugin: dependencies
	@$(MAKE) --no-print-directory -f tests/makefile $(TESTS_PARALLEL) check BUILD=$(PLUGIN) TESTS='amgf_* blockamg_*'

# Also tests that are long: those that have _long in their names, and programs on every number of ranks that they are
# for
check-all: dependencies
	@$(MAKE) --no-print-directory -f tests/makefile $(TESTS_PARALLEL) check LONG=1

# STRESS=nlp: nonlinear programs, which need IPOPT; else parts and options of tests/stress/run.py
stress: $(or $(filter nlp,$(STRESS)),scene-stress)

scene-stress: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	@$(MAKE) --no-print-directory -f tests/makefile build/tests/tests/contact_clip
	@mkdir -p build/stress
	$(PYTHON) -B tests/stress/run.py --report build/stress/report.md $(STRESS)

include share/doc.mk
include share/install.mk
include share/packaging.mk
include share/checks.mk
include share/bench.mk
include share/published.mk

clean:
	rm -rf build bin lib

# For scripts that link with the mechanics library
print-contact-libs:
	@echo '$(CONTACT_LIBS)'

help:
	@echo 'make                 builds the plugin $(PLUGIN), the mechanics library and bin/contact'
	@echo 'make demo            installs what is missing, builds, solves a problem with a known answer, compares'
	@echo 'make demo-published  the same for the two-block problem of the publication'
	@echo 'make check           installs what is missing, builds, tests every feature; last line: N passed, N failed'
	@echo '    TESTS="scene_* output_*"  runs only these tests'
	@echo '    TIMEOUT=600               time limit of a run [s]'
	@echo 'make check-plugin    builds and tests the preconditioner alone, two minutes'
	@echo 'make check-all       the same with the long tests: finer meshes, published figures, more numbers of ranks'
	@echo 'make stress          difficult contact problems, 2 hours; tables in build/stress/report.md'
	@echo '    STRESS="units --only *hertz*"  runs only these; STRESS=--resume continues an interrupted run'
	@echo '    STRESS=nlp                nonlinear programs, compared with IPOPT, 20 minutes; tests/stress/nlp*.md'
	@echo 'make bench           measures time against accuracy, at most 45 minutes; pages in build/bench/pages'
	@echo 'make debug           runs quick tests with a PETSc that checks its arguments'
	@echo 'make sanitize        runs small scenes with the address and undefined behaviour sanitizers'
	@echo 'make memcheck        runs small scenes under valgrind'
	@echo 'make tidy            static analysis by clang-tidy'
	@echo 'make format          formats the sources by clang-format 14'
	@echo 'make fuzz            random files as input; FUZZ_TIME=600: time for each reader [s]'
	@echo 'make doc             guides and manual pages in build/doc; needs pandoc'
	@echo 'make install         installs into PREFIX=$(PREFIX); DESTDIR is put in front of it'
	@echo 'make uninstall       removes what make install has installed'
	@echo '    PLUGIN_ONLY=1             all and install: the plugin alone, which needs PETSc alone'
	@echo 'make deb             packages for Debian in build/deb; make deb-check tries them in a bare Debian 12'
	@echo 'make clean           removes build, bin and lib'
	@echo
	@echo 'PETSC_DIR, PETSC_ARCH  the PETSc to use (now: $(or $(PETSC_PREFIX),none found))'
	@echo 'CC, CFLAGS, LDFLAGS    now: $(CC) $(CFLAGS) $(LDFLAGS)'
	@echo 'MARCH=native           adds -march=native; V=1 shows the commands'
