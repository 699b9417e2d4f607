# The tables and figures of the published benchmarks beside ours: share/published/published.py

# PUBLISHED="--runs two_block/2/own:900" makes some runs, PUBLISHED=--kept the page alone
PUBLISHED ?=

.PHONY: published published-quick published-page published-cases

build/published/cpuclock.so: share/published/cpuclock.c share/published.mk
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)gcc -std=c11 -D_GNU_SOURCE -O2 -Wall -Wextra -shared -fPIC $< -o $@

published: dependencies build/published/cpuclock.so
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/published/published.py $(PUBLISHED)

published-quick: dependencies build/published/cpuclock.so
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/published/published.py --quick $(PUBLISHED)

# Takes the page that was made, and its runs, into share/published
published-page:
	cp build/published/README.md build/published/*.png share/published
	cp build/published/*.run.json share/published/runs

# The page of cases whose values others published
published-cases:
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/published/cases.py
	cp build/published/cases/cases.md share/published
