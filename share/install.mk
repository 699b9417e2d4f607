# What make install puts where below DESTDIR and PREFIX, and make uninstall takes away.

PREFIX  ?= /usr/local
DESTDIR ?=

petsc_version := $(call pkg_config,--modversion PETSc)
petsc_release := $(subst ., ,$(petsc_version))
petsc_minor   := $(word 2,$(petsc_release))
petsc_scalars := $(if $(PETSC_COMPLEX),complex,real)
petsc_indices := $(if $(shell grep -hs 'define PETSC_USE_64BIT_INDICES' $(petsc_headers) /dev/null),64,32)
package_files := petscamgf.pc $(if $(only_plugin),,contact.pc)

# What a pkg-config file says of this PREFIX and this PETSc
fill_in = sed -e 's|@PREFIX@|$(PREFIX)|' -e 's|@VERSION@|$(VERSION)|' \
  -e 's|@PETSC_VERSION@|$(petsc_version)|' -e 's|@PETSC_PREFIX@|$(PETSC_PREFIX)|' \
  -e 's|@PETSC_RELEASE@|$(word 1,$(petsc_release)).$(petsc_minor)|' \
  -e 's|@PETSC_NEXT@|$(word 1,$(petsc_release)).$(shell expr 0$(petsc_minor) + 1)|' \
  -e 's|@PETSC_SCALARS@|$(petsc_scalars)|' -e 's|@PETSC_INDICES@|$(petsc_indices)|' \
  -e 's|@CONTACT_LIBS@|$(strip $(CONTACT_LIBS))|'

# $(call put,MODE,FILES,FOLDER): lines of install.sh
put = $(foreach file,$(2),'$(1) $(file) $(3)/$(notdir $(file))')

contact_headers = $(filter-out include/petscamgf.h include/petsccompat.h,$(wildcard include/*.h))

# The program contact, and what belongs to it
installed_contact = $(call put,644,$(LIBRARY),lib) $(call put,644,$(contact_headers),include/contact) \
  $(foreach folder,plot report python python/contact python/contact/meshes python/contact/decks, \
    $(call put,644,$(wildcard share/$(folder)/*.py),share/amgf/$(folder))) \
  $(foreach folder,scenes materials options gmsh, \
    $(call put,644,$(wildcard share/$(folder)/*.*),share/amgf/$(folder)))

installed = $(call put,755,$(programs) $(if $(programs),bin/contact-mesh bin/contact-ccx),bin) \
  $(call put,755,$(PLUGIN).$(VERSION),lib) \
  'link $(notdir $(PLUGIN)).$(VERSION) $(PLUGIN).$(SOVERSION)' \
  'link $(notdir $(PLUGIN)).$(SOVERSION) $(PLUGIN)' \
  $(foreach file,$(package_files),'644 @FOLDER@/$(file) lib/pkgconfig/$(file)') \
  $(call put,644,include/petscamgf.h,include) \
  $(if $(only_plugin),,$(installed_contact)) \
  $(call put,644,$(wildcard share/examples/*.*) share/examples/makefile,share/amgf/examples) \
  $(call put,644,$(wildcard share/doc/*.md),share/doc/amgf) \
  $(call put,644,$(wildcard share/doc/pictures/*.png),share/doc/amgf/pictures) \
  $(foreach section,1 3,$(call put,644,$(sort $(wildcard build/doc/man/man$(section)/*)),share/man/man$(section)))

.PHONY: install install-files uninstall

# The manual pages are there only when a second make looks for them
install: all man
	@$(MAKE) --no-print-directory install-files

install-files:
	@folder=$$(mktemp -d) && $(foreach file,$(package_files),$(fill_in) share/$(file).in > $$folder/$(file) &&) \
	  printf '%s\n' $(installed) | sed "s|@FOLDER@|$$folder|" | ./share/install.sh '$(DESTDIR)$(PREFIX)'; \
	  code=$$?; rm -rf "$$folder"; exit $$code

uninstall:
	./share/uninstall.sh '$(DESTDIR)$(PREFIX)'
