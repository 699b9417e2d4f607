# make doc: the guides as HTML and the manual pages, in build/doc. pandoc makes the HTML, of Markdown as it stands here.

.PHONY: doc man

guides := $(wildcard share/doc/*.md) share/scenes/README.md share/examples/README.md share/bench/README.md

man: build/doc/man/made

build/doc/man/made: share/doc/manpages.py apps/help.c $(wildcard include/*.h) \
  $(wildcard pc_amgf/*.c pc_amgf/*/*.c src/*/*.c src/*/*/*.c tao_ipfilter/*.c tao_ipfilter/*/*.c)
	@rm -rf $(@D)
	@$(PYTHON) -B share/doc/manpages.py . $(@D) $(VERSION)
	@touch $@

doc: man
	@command -v pandoc > /dev/null || { echo 'make doc needs pandoc, package pandoc' >&2; exit 1; }
	@./share/doc/html.sh build/doc/html README.md $(guides)
	@echo 'build/doc/html/README.html, build/doc/man'
