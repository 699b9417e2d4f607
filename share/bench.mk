# What accuracy costs in time: runs, tables, figures and pages. An interrupted bench goes on where it stopped.

# BENCH="--only tolerance" runs some studies. The pages are made in build/front, build/bench, build/choice and build/sharp; bench-page takes them into share/bench
BENCH ?=

.PHONY: bench bench-front bench-knobs bench-full bench-page bench-calculix

build/bench/triad: share/bench/triad.c makefile share/bench.mk
	@mkdir -p $(@D)
	$(call say,CC,$<)
	$(Q)$(CC) -std=c11 -O3 -Wall -Wextra $< -o $@

bench_run = $(PYTHON) -B share/bench/run.py

# At most an hour on two cores
bench: bench-front bench-knobs

# The accuracy page, and the choice of elements: five minutes
bench-front: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	@mkdir -p build/choice build/sharp
	$(PYTHON) -B share/bench/front.py
	$(PYTHON) -B share/bench/elements/choice.py --page build/choice/choice.md
	$(PYTHON) -B share/bench/elements/choice.py --set second --page build/choice/second.md
	$(PYTHON) -B share/bench/elements/sharp.py --page build/sharp/sharp.md

# A page a knob, on small problems: ten minutes on two cores
bench-knobs: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all build/bench/triad
	@$(bench_run) --size quick $(BENCH)

# The same at full size: three hours
bench-full: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all build/bench/triad
	@$(bench_run) --size full $(BENCH)

# The two-block problem beside CalculiX, a quarter of an hour; nothing without ccx
bench-calculix: dependencies
	@$(MAKE) --no-print-directory $(PARALLEL) all
	$(PYTHON) -B share/bench/calculix.py --page share/bench/calculix.md

bench-page:
	-cp build/front/README.md build/front/front.csv build/front/front.png share/bench
	-cp build/choice/choice.md build/choice/second.md build/sharp/sharp.md share/bench/elements
	-cp build/bench/*.md build/bench/bench.csv build/bench/*.png share/bench/knobs
