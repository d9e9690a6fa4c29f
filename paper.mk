# What only this paper needs of make, beside the targets of every replication in the Makefile.

OWN    := CELLS CONFIG ENGINE FAULTS LISTED MINUTES ROTATE SEED TO
CELLS  ?= 40000
CONFIG ?= config/thorough.yaml
MINUTES ?= 1
# The optional rigid-body engine of the study `mechanism`; `ENGINE=` does not install it.
ENGINE ?= engine
GROUPS  = $(if $(value ENGINE),--group "$$ENGINE")
BENCH   = $(UV) run --locked --no-dev --group bench
# What `make clean` keeps, as all copies share it (topheavy.kernel.compiled).
SHARED  = the compiled kernel, in $${NUMBA_CACHE_DIR:-$${XDG_CACHE_HOME:-$$HOME/.cache}}/topheavy

.PHONY: api audit fuzz kill-table benchmark verify-grid cluster-test paper

api: | $(UV) ## write a page of the library's functions: dist/api/topheavy.html
	@$(DEV) python -W 'ignore:Error parsing type annotation' -c "import topheavy; [getattr(topheavy, name) for name in topheavy.__all__]; \
	  from pdoc.__main__ import cli; cli('topheavy -o dist/api --no-show-source --docformat numpy'.split())"

audit: | $(UV) ## 3 hours: finer grids, tighter tolerances, all peers, all faults (CONFIG, CELLS, ROTATE)
	@$(SNAKEMAKE) --configfile "$$CONFIG"
	@$(MAKE) --no-print-directory verify-grid benchmark kill-table
	@echo "results/ is that of $$CONFIG now: 'make reproduce' brings ours back"

kill-table: | $(UV) ## put faults into a copy, one at a time: what catches each? (FAULTS=a,b or ROTATE=3)
	@$(if $(value ROTATE),$(call WHOLE,ROTATE))
	@$(call WHOLE,CORES); $(DEV) python -m replication.commands.kill_table --cores "$$CORES" \
	  $${FAULTS:+"--faults=$$FAULTS"} $${ROTATE:+"--rotate=$$ROTATE"} $${LISTED:+--whole}

fuzz: | $(UV) ## search for inputs on which solvers disagree or a function fails (MINUTES=1, SEED)
	@$(call WHOLE,MINUTES); $(if $(value SEED),$(call WHOLE,SEED);) $(DEV) \
	  python benchmarks/fuzz.py "$$MINUTES" $${SEED:+"$$SEED"}

benchmark: | $(UV) ## time the kernel beside its peers; writes docs/benchmark.csv and .svg (15 minutes)
	@$(BENCH) python benchmarks/benchmark.py

verify-grid: | $(UV) ## compare overturning flags with an independent route (CELLS=40000 a set)
	@$(call WHOLE,CELLS)
	@$(BENCH) python benchmarks/verify_grid.py "$$CELLS"

cluster-test: | $(UV) ## as root on Debian: start SLURM here, compare its bytes with ours (5 minutes)
	@$(RUN) --group cluster profiles/slurm/test/run

paper: | $(UV) ## begin the replication of another paper: make paper TO=../other (FOLLOW-UP.md)
	@$(RUN) python -m replication.commands.new_paper "$$TO"
