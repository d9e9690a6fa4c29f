# `make` lists the commands. Those of every replication are the machine's; below are this paper's.

OWN    := CELLS CONFIG ENGINE MINUTES SEED
CELLS  ?= 40000
CONFIG ?= config/thorough.yaml
MINUTES ?= 1
# The optional rigid-body engine of the study `mechanism`; `ENGINE=` does not install it.
ENGINE ?= engine
GROUPS  = $(if $(value ENGINE),--group "$$ENGINE")
BENCH   = $(UV) run --locked --no-dev --group bench
# What `make clean` keeps, as all copies share it (topheavy.kernel.compiled).
SHARED  = the compiled kernel, in $${NUMBA_CACHE_DIR:-$${XDG_CACHE_HOME:-$$HOME/.cache}}/topheavy

include src/replication/make/machine.mk

.PHONY: notebooks api audit fuzz benchmark stills verify-grid cluster-test paper words

lint: words
words: | $(UV)
	$(DEV) python -m steps.words

paper: | $(UV) ##- begin the replication of another paper: make paper TO=../other (studies/FOLLOW-UP.md)
	@$(RUN) python -m replication.commands.new_paper "$$TO"

notebooks: | $(UV) ## open the notebooks in JupyterLab: the derivation, and a frame to play with
	@$(UV) run --locked $(GROUPS) --group notebooks jupyter lab notebooks

api: | $(UV) ## write a page of the library's functions: dist/api/topheavy.html
	@$(DEV) python -W 'ignore:Error parsing type annotation' -c "import topheavy; [getattr(topheavy, name) for name in dir(topheavy)]; \
	  from pdoc.__main__ import cli; rooms = 'bodies forces ground outcomes proven risk second'.split(); \
	  cli(['topheavy', *(f'topheavy.{room}' for room in rooms), *'-o dist/api --no-show-source --docformat numpy'.split()])"

audit: | $(UV) ##- 3 hours: finer grids, tighter tolerances, all peers, all faults (CONFIG, CELLS, ROTATE)
	@$(SNAKEMAKE) --configfile "$$CONFIG"
	@$(MAKE) --no-print-directory verify-grid benchmark kill-table
	@echo "results/ is that of $$CONFIG now: 'make reproduce' brings ours back"

fuzz: | $(UV) ##- search for inputs on which solvers disagree or a function fails (MINUTES=1, SEED)
	@$(call WHOLE,MINUTES); $(if $(value SEED),$(call WHOLE,SEED);) $(DEV) \
	  python benchmarks/fuzz.py "$$MINUTES" $${SEED:+"$$SEED"}

benchmark: | $(UV) ##- time the kernel beside its peers; writes docs/benchmark.csv and .svg (15 minutes)
	@$(BENCH) python benchmarks/benchmark.py

stills: | $(UV) ##- take the pictures of docs/explorer.html anew, at three sizes of screen
	@$(RUN) python -m steps.explorer_still

verify-grid: | $(UV) ##- compare overturning flags with an independent route (CELLS=40000 a set)
	@$(call WHOLE,CELLS)
	@$(BENCH) python benchmarks/verify_grid.py "$$CELLS"

cluster-test: | $(UV) ##- as root on Debian: start SLURM here, compare its bytes with ours (5 minutes)
	@$(RUN) --group cluster profiles/slurm/test/run
