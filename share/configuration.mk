# What everything built depends on beside its sources: PETSc, the compiler, its flags. build/configuration has them, and
# changes when they do.

configuration  := build/configuration
petsc_headers  := $(wildcard $(addsuffix /petscconf.h,$(patsubst -I%,%,$(filter -I%,$(PETSC_CFLAGS))))) \
                  $(wildcard $(addsuffix /petscversion.h,$(patsubst -I%,%,$(filter -I%,$(PETSC_CFLAGS)))))
configured_as  := $(CC) $(shell $(CC) --version 2>/dev/null | head -n 1) | $(COMPILE_FLAGS) | \
                  $(LDFLAGS) $(PETSC_LIBS) | \
                  $(call pkg_config,--modversion PETSc) $(realpath $(petsc_headers)) \
                  $(shell cat /dev/null $(petsc_headers) | cksum)

$(configuration): export configured_as := $(configured_as)
$(configuration): FORCE
	@mkdir -p $(@D)
	@printf '%s\n' "$$configured_as" | cmp -s - $@ || printf '%s\n' "$$configured_as" > $@
