# make install, make uninstall: what goes where below DESTDIR and PREFIX.

PREFIX  ?= /usr/local
DESTDIR ?=

petsc_version := $(call pkg_config,--modversion PETSc)
petsc_release := $(subst ., ,$(petsc_version))
petsc_minor   := $(word 2,$(petsc_release))
petsc_scalars := $(if $(PETSC_COMPLEX),complex,real)
petsc_indices := $(if $(shell grep -hs 'define PETSC_USE_64BIT_INDICES' $(petsc_headers) /dev/null),64,32)
package_files := build/pkgconfig/petscamgf.pc $(if $(PETSC_COMPLEX),,build/pkgconfig/contact.pc)

build/pkgconfig/%.pc: share/%.pc.in FORCE
	@mkdir -p $(@D)
	@sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@VERSION@|$(VERSION)|' -e 's|@PETSC_VERSION@|$(petsc_version)|' -e 's|@PETSC_PREFIX@|$(PETSC_PREFIX)|' \
	  -e 's|@PETSC_RELEASE@|$(word 1,$(petsc_release)).$(petsc_minor)|' -e 's|@PETSC_NEXT@|$(word 1,$(petsc_release)).$(shell expr 0$(petsc_minor) + 1)|' \
	  -e 's|@PETSC_SCALARS@|$(petsc_scalars)|' -e 's|@PETSC_INDICES@|$(petsc_indices)|' $< > $@

# $(call put,MODE,FILES,FOLDER): lines of install.sh
put = $(foreach file,$(2),'$(1) $(file) $(3)/$(notdir $(file))')

installed = $(call put,755,$(programs),bin) $(call put,755,$(PLUGIN).$(VERSION),lib) \
            'link $(notdir $(PLUGIN)).$(VERSION) $(PLUGIN).$(SOVERSION)' 'link $(notdir $(PLUGIN)).$(SOVERSION) $(PLUGIN)' \
            $(call put,644,$(package_files),lib/pkgconfig) $(call put,644,include/petscamgf.h,include) \
            $(if $(PETSC_COMPLEX),,$(call put,644,$(LIBRARY),lib) $(call put,644,$(filter-out include/petscamgf.h,$(wildcard include/*.h)),include/contact)) \
            $(foreach kind,scenes options gmsh examples,$(call put,644,$(wildcard share/$(kind)/*.* share/$(kind)/makefile),share/amgf/$(kind))) \
            $(call put,644,$(wildcard share/doc/*.md),share/doc/amgf)

.PHONY: install uninstall

install: all $(package_files)
	@printf '%s\n' $(installed) | ./share/install.sh '$(DESTDIR)$(PREFIX)'

uninstall:
	./share/uninstall.sh '$(DESTDIR)$(PREFIX)'
