# The tables and figures of the published benchmarks beside ours: share/published/published.py

PUBLISHED ?=

.PHONY: published published-quick published-page

published: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/published/published.py $(PUBLISHED)

published-quick: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/published/published.py --quick $(PUBLISHED)

# Takes the page that was made, and its runs, into share/published
published-page:
	cp build/published/README.md build/published/*.png share/published
	cp build/published/*.run.json share/published/runs
