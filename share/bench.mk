# What accuracy costs in time: runs, tables, figures and a page by share/bench/run.py. An interrupted bench goes on where it stopped.

# BENCH="--only tolerance" runs some; build/bench/README.md is the page, bench-page takes it into share/bench
BENCH ?=

.PHONY: bench bench-quick bench-page bench-calculix

build/bench/triad: share/bench/triad.c makefile share/bench.mk
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(CC) -std=c11 -O3 -Wall -Wextra $< -o $@

bench_run = $(PYTHON) -B share/bench/run.py

bench: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all build/bench/triad
	@$(bench_run) --size full $(BENCH)

bench-quick: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all build/bench/triad
	@$(bench_run) --size quick $(BENCH)

# The two-block problem beside CalculiX, a quarter of an hour; nothing without ccx
bench-calculix: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/bench/calculix.py --page share/bench/calculix.md

bench-page:
	cp build/bench/README.md build/bench/bench.csv build/bench/*.png share/bench
