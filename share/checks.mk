# Checks beyond `make check`: PETSc with debugging, sanitizers, valgrind, static analysis, fuzzing. Each builds in a
# folder of its own, a copy of the sources, so that nothing of the ordinary build changes.

SUPPRESSIONS   := $(CURDIR)/tests/suppressions
# After an error PETSc leaves its objects as they are: those tests are not asked for leaks
SANITIZE_TESTS  ?= scene_view* material_* output_* elasticity_derivatives* contact_clip* contact_patch contact_deep* \
                   ipfilter_reasons* ipfilter_fallbacks* ipfilter_bounds*
SANITIZE_ERRORS ?= fuzz_corpus* mesh_gmsh* mesh_errors* scene_errors* ipfilter_complete*
DEBUG_TESTS     ?= $(SANITIZE_TESTS) $(SANITIZE_ERRORS) amgf_* ipfilter_* mesh_* contact_gap* elasticity_mixed* \
                   elasticity_follower* step_models load_steps gmsh_ranks
SANITIZE_FLAGS := -g -O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined
FUZZ_FLAGS     := -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,address,undefined \
                  -fno-sanitize-recover=undefined
FUZZ_TIME      ?= 600
TIDY_FILES     ?= $(wildcard src/*/*.c src/*/*/*.c apps/*.c pc_amgf/*.c pc_amgf/*/*.c tao_ipfilter/*.c \
                  tao_ipfilter/*/*.c)
FORMAT_FILES   ?= $(wildcard $(foreach folder,include pc_amgf pc_amgf/* tao_ipfilter tao_ipfilter/* src/* src/*/* apps \
                  tests tests/* share/bench,$(folder)/*.c $(folder)/*.h))
tree_parts     := $(wildcard *.md CITATION.cff .clang-format .clang-tidy .style.yapf .ci) makefile pc_amgf \
                  tao_ipfilter src include apps share tests
copied_tree     = mkdir -p $(1) && rm -rf $(addprefix $(1)/,$(tree_parts)) && cp -a $(tree_parts) $(1)

# $(call small_scenes,TREE,PROGRAM...): the small scenes by the program of that tree, in a folder there
small_scenes    = mkdir -p $(1)/scenes && cd $(1)/scenes && AMGF_DIR=$(CURDIR) OMP_NUM_THREADS=1 bash \
                  $(CURDIR)/tests/lib/small_scenes.sh $(2) $(CURDIR)/$(1)/bin/contact

# Debian's PETSc with its own checks and no optimization: package libpetsc-real3.18-dbg
DEBUG_PETSC ?= PETSC_DIR=$(PETSC_PREFIX)-debug PETSC_ARCH=

.PHONY: format debug sanitize memcheck tidy fuzz nlp

debug:
	@$(call copied_tree,build/debug)
	@env -u PKG_CONFIG_PATH $(DEBUG_PETSC) CFLAGS='-g -O1' $(MAKE) --no-print-directory -C build/debug check \
	  TIMEOUT=600 TESTS='$(DEBUG_TESTS)'

# SANITIZE_ERRORS='*': all quick tests; those fail that load the plugin into a program built without sanitizers, as
# Python is
sanitize:
	@$(call copied_tree,build/sanitize)
	@LSAN_OPTIONS=suppressions=$(SUPPRESSIONS)/lsan.supp:print_suppressions=0 UBSAN_OPTIONS=print_stacktrace=1; \
	  export LSAN_OPTIONS UBSAN_OPTIONS; \
	  run='$(MAKE) --no-print-directory -C build/sanitize check TIMEOUT=600' && \
	  ASAN_OPTIONS=fast_unwind_on_malloc=0 $$run CFLAGS='$(SANITIZE_FLAGS)' TESTS='$(SANITIZE_TESTS)' && \
	  (export ASAN_OPTIONS=fast_unwind_on_malloc=0 && $(call small_scenes,build/sanitize)) && \
	  ASAN_OPTIONS=fast_unwind_on_malloc=0:detect_leaks=0 $$run CFLAGS='$(SANITIZE_FLAGS)' TESTS='$(SANITIZE_ERRORS)'

# Instructions of AVX-512 are beyond valgrind, and its threads take turns
MEMCHECK := OPENBLAS_CORETYPE=Haswell valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite \
            --errors-for-leak-kinds=definite --num-callers=30 --suppressions=$(SUPPRESSIONS)/valgrind.supp \
            $(addprefix --suppressions=,$(wildcard /usr/share/openmpi/openmpi-valgrind.supp))

memcheck:
	@$(call copied_tree,build/memcheck)
	@$(MAKE) --no-print-directory -C build/memcheck all CFLAGS='-g -O1'
	$(MEMCHECK) build/memcheck/bin/contact tests/contact/contact_patch.yaml -scene_check > /dev/null
	$(MEMCHECK) build/memcheck/bin/contact tests/contact/contact_patch.yaml -quiet
	@$(call small_scenes,build/memcheck,env $(MEMCHECK))
	mpiexec --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 -n 2 env $(MEMCHECK) \
	  build/memcheck/bin/contact tests/contact/contact_patch.yaml -quiet
	@echo 'memcheck: clean'

# Writes the sources in the style of .clang-format, and Python, where there is yapf, in that of .style.yapf
format:
	@clang-format -i $(FORMAT_FILES)
	@if command -v yapf3 > /dev/null; then yapf3 -i -p -r share tests; fi

tidy:
	@mkdir -p build; clean=0; \
	for tool in clang-format clang-tidy; do command -v $$tool > /dev/null || \
	  { echo "tidy: there is no $$tool"; exit 1; }; done; \
	for file in $(FORMAT_FILES); do \
	  clang-format --dry-run -Werror $$file 2> /dev/null || \
	    { echo "tidy: $$file is not as .clang-format has it"; clean=1; }; \
	done; \
	for file in $(TIDY_FILES); do \
	  clang-tidy --quiet $$file -- -std=c11 -Iinclude -I. $(PETSC_CFLAGS) $(HDF5_CFLAGS) \
	    $(shell $(CC) --showme:compile 2>/dev/null) 2> build/tidy.err || clean=1; \
	done; exit $$clean
	@echo 'tidy: clean'

# Findings are left in build/fuzz/found-*; what is worth keeping of them goes to tests/fuzz/corpus
fuzz:
	@$(call copied_tree,build/fuzz)
	@OMPI_CC=clang $(MAKE) --no-print-directory -C build/fuzz lib/libcontact.a lib/libpetscamgf.so CFLAGS='$(FUZZ_FLAGS)'
	@for target in gmsh scene; do \
	  case $$target in scene) seeds='share/scenes tests/mesh tests/scene';; *) seeds=share/gmsh;; esac; \
	  mkdir -p build/fuzz/corpus-$$target && \
	  OMPI_CC=clang $(CC) $(FUZZ_FLAGS) -fsanitize=fuzzer -std=c11 -Iinclude $(PETSC_CFLAGS) \
	    tests/fuzz/$$target.c build/fuzz/lib/libcontact.a \
	    -Lbuild/fuzz/lib -lpetscamgf -Wl,-rpath,$(CURDIR)/build/fuzz/lib $(PETSC_LIBS) $(CONTACT_LIBS) \
	      -o build/fuzz/$$target && \
	  PETSC_OPTIONS=-no_signal_handler ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 \
	    build/fuzz/$$target build/fuzz/corpus-$$target tests/fuzz/corpus/$$target $$seeds \
	    -artifact_prefix=build/fuzz/found-$$target- -max_len=4096 -timeout=20 -rss_limit_mb=2000 \
	      -malloc_limit_mb=1000 -fork=1 -max_total_time=$(FUZZ_TIME) || exit 1; \
	done

# The nonlinear programs beside IPOPT (coinor-libipopt-dev), a program of its own because IPOPT brings another MUMPS.
# The table goes to tests/stress/nlp.md, that of 500 drawn at random to
# tests/stress/nlp_random.md, that of the same programs in other forms to tests/stress/nlp_forms.md
nlp: all
	@mkdir -p build/nlp
	$(CC) -std=c11 -D_GNU_SOURCE -Wall -Wextra -O2 -Iinclude $(PETSC_CFLAGS) tests/stress/nlp_tao.c \
	  -o build/nlp/tao -Llib -lpetscamgf -Wl,-rpath,$(CURDIR)/lib $(PETSC_LIBS) -lm
	$(CC) -std=c11 -D_GNU_SOURCE -Wall -Wextra -O2 $(PETSC_CFLAGS) $(shell pkg-config --cflags ipopt) \
	  -c tests/stress/nlp_ipopt.c -o build/nlp/ipopt.o
	gcc build/nlp/ipopt.o -o build/nlp/ipopt $(shell pkg-config --libs ipopt) -lm
	$(PYTHON) -B tests/stress/nlp.py --folder build/nlp
	$(PYTHON) -B tests/stress/nlp_random.py --folder build/nlp
	$(PYTHON) -B tests/stress/nlp_forms.py --folder build/nlp
