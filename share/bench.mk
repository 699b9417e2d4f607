# What accuracy costs in time: runs, tables, figures and pages. An interrupted bench goes on where it stopped

# The parts in their order; BENCH_PARTS="run.py" makes one again. The front page finds the references of the others, and
# lists them at the end
BENCH_PARTS ?= front.py elements/choice.py run.py calculix.py effects.py front.py
BENCH_FOLDER ?= build/bench

.PHONY: bench bench-front bench-full bench-page

# A part that fails does not keep the others from being made
define make_bench
@failed=; for part in $(1); do echo "== share/bench/$$part $(2)"; date +%T; \
  $(PYTHON) -B share/bench/$$part --folder $(BENCH_FOLDER) $$([ $$part != run.py ] || echo $(2)) || \
    failed="$$failed $$part"; done; date +%T; \
  [ -z "$$failed" ] || { echo "bench: these parts failed:$$failed"; exit 1; }
endef

# All pages, into build/bench/pages: 45 minutes at most on two cores
bench: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(call make_bench,$(BENCH_PARTS),--size quick)

# The front page alone
bench-front: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(call make_bench,front.py,)

# The pages of settings for larger meshes, two to three hours
bench-full: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(call make_bench,$(BENCH_PARTS),--size full)

# Takes the pages that were made into share/bench
bench-page:
	cp -r $(BENCH_FOLDER)/pages/. share/bench
