# Packages for Debian: share/packaging/README.md

deb_tree := build/deb/amgf-$(VERSION)

.PHONY: deb deb-check

# Needs the packages that share/packaging/debian/control names, and dpkg-dev
deb:
	@rm -rf build/deb
	@$(call copied_tree,$(deb_tree))
	@cp -r share/packaging/debian $(deb_tree)/debian
	@printf 'amgf (%s) unstable; urgency=medium\n\n  * See share/doc/changelog.md.\n\n -- %s  %s\n' $(VERSION) \
	  "$$(sed -n 's/^Maintainer: //p' share/packaging/debian/control)" "$$(date -R)" > $(deb_tree)/debian/changelog
	cd $(deb_tree) && env -u MAKEFLAGS -u MFLAGS dpkg-buildpackage -b -us -uc
	@ls build/deb/*.deb

# Needs mmdebstrap, root and the network
deb-check:
	share/packaging/check.sh build/deb
