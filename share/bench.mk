# What accuracy costs in time: runs, tables, figures and pages. An interrupted bench goes on where it stopped

# The parts in their order; BENCH_PARTS="front.py" makes one again. The front page lists the others
BENCH_PARTS ?= elements/choice.py calculix.py effects.py front.py
BENCH_FOLDER ?= build/bench

.PHONY: bench bench-front bench-page

# A part that fails does not keep the others from being made
define make_bench
@failed=; for part in $(1); do echo "== share/bench/$$part"; date +%T; \
  $(PYTHON) -B share/bench/$$part --folder $(BENCH_FOLDER) || \
    failed="$$failed $$part"; done; date +%T; \
  [ -z "$$failed" ] || { echo "bench: these parts failed:$$failed"; exit 1; }
endef

# All pages, into build/bench/pages: 45 minutes at most on two cores
bench: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(call make_bench,$(BENCH_PARTS))

# The front page alone
bench-front: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(call make_bench,front.py)

# Takes the pages that were made into share/bench
bench-page:
	cp -r $(BENCH_FOLDER)/pages/. share/bench
