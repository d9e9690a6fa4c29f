# `make` lists the commands. All use uv and the committed lock file. If uv is missing, the first
# command installs it into .uv/ (delete that folder to remove it).

CORES      ?= 2
PYTHON     ?= python3
UV_VERSION := 0.13.8

# Snakemake starts its jobs by a shell and does not quote the path of their Python.
UNQUOTED := ' " $$ ` & ; | < > ( ) * ? [ ] { } \ :
ifneq ($(words $(CURDIR))$(strip $(foreach c,$(UNQUOTED),$(findstring $(c),$(CURDIR)))),1)
$(error the path $(CURDIR) has a space or one of $(UNQUOTED) in it; expected letters, digits \
  and . _ - / alone: move the folder, delete its .venv, and run again)
endif

UV  := $(shell command -v uv 2>/dev/null || echo .uv/bin/uv)
# The optional rigid-body engine of the study `mechanism`; `ENGINE=` does not install it.
ENGINE ?= engine
RUN := $(UV) run --locked --no-dev $(if $(value ENGINE),--group "$$ENGINE")
DEV := $(UV) run --locked $(if $(value ENGINE),--group "$$ENGINE")
BENCH := $(UV) run --locked --no-dev --group bench
CELLS ?= 40000
CONFIG ?= config/thorough.yaml

# A run starts a hundred Pythons. Where compiled modules are not kept, each would compile all anew.
export PYTHONDONTWRITEBYTECODE :=

# Commands receive these variables unchanged through the environment, so that neither make nor the
# shell can interpret a value as code.
GIVEN := CORES CELLS CONFIG ENGINE FAULTS ITEM NAME ROTATE
$(foreach name,$(GIVEN),$(eval override $(name) := $$(value $(name))))
export $(GIVEN)
WHOLE = case "$$$(1)" in ''|0*|*[!0-9]*) \
  echo "$(1) is '$$$(1)'; expected a whole number from 1 on" >&2; exit 2;; esac
SNAKEMAKE = $(call WHOLE,CORES); $(RUN) snakemake --cores "$$CORES"

.PHONY: help reproduce check trace verify html audit test lint publish study kill-table benchmark verify-grid unlock clean
.DEFAULT_GOAL := help

help: ## show this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1|\2/p' Makefile | \
	  while IFS='|' read -r target text; do printf '  %-16s %s\n' "$$target" "$$text"; done

reproduce: | $(UV) ## compute every result, check every claim, compile the report (CORES=2)
	@$(SNAKEMAKE)

check: | $(UV) ## judge every claim again from the published findings, tables and pages; no run
	@$(RUN) python -m steps.recheck

trace: | $(UV) ## show the origin of a figure, table, finding or claim (ITEM=figures/heavier.svg)
	@$(RUN) python -m replication.commands.trace "$$ITEM"

verify: | $(UV) ## compare every file of a finished run with results/manifest.json
	@$(RUN) python -m replication.commands.verify

html: | $(UV) ## after a run: write results/report.html with every figure, caption and verdict
	@test -e results/manifest.json || { \
	  echo "there is no finished run; run 'make reproduce' first" >&2; exit 1; }
	@$(RUN) snakemake --report results/report.html --quiet all
	@$(RUN) python -m replication.commands.check_html results/report.html

test: | $(UV) ## run the tests
	@$(call WHOLE,CORES); $(DEV) pytest --numprocesses "$$CORES" --dist loadfile

lint: export VALIDATE_PYPROJECT_NO_NETWORK = 1
lint: | $(UV) ## check style, types, spelling, wording and schemas; changes nothing
	$(DEV) ruff check
	$(DEV) ruff format --check
	$(DEV) mypy
	$(DEV) codespell
	$(DEV) python -m replication.commands.words
	$(DEV) snakefmt --check --compact-diff Snakefile $(wildcard src/*/*.smk studies/*/*.smk)
	$(DEV) check-jsonschema --check-metaschema config/config.schema.yaml
	$(DEV) check-jsonschema --schemafile config/config.schema.yaml config/config.yaml
	for study in studies/*/; do \
	  $(DEV) check-jsonschema --check-metaschema $${study}config.schema.yaml && \
	  $(DEV) check-jsonschema --schemafile $${study}config.schema.yaml $${study}config.yaml || exit 1; done
	$(DEV) check-jsonschema --check-metaschema paper/assumptions.schema.yaml
	$(DEV) check-jsonschema --schemafile paper/assumptions.schema.yaml paper/assumptions.yaml
	$(DEV) check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
	$(DEV) check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/ci.yaml
	$(DEV) validate-pyproject pyproject.toml
# Snakemake's lint demands a conda environment or container for every rule. One lock file serves all
# rules here, so we ignore this demand and no other.
	$(DEV) snakemake --lint 2>&1 | awk ' \
	  { text = text $$0 "\n" } \
	  /^Lints for|^Congratulations/ { ran = 1 } \
	  /^    \* / && !/\* Specify a conda environment or container for each rule/ { found = 1 } \
	  END { if (found || !ran) { printf "%s", text; exit 1 } }'

publish: | $(UV) ## copy results to docs/ and tests/reference/; read the diff, then commit it
	@$(RUN) python -m steps.publish

audit: | $(UV) ## finer grids, tighter tolerances, all solvers, all faults; one hour (CONFIG, CELLS, ROTATE)
	@$(SNAKEMAKE) --configfile "$$CONFIG"
	@$(MAKE) --no-print-directory verify-grid benchmark kill-table
	@echo "results/ is that of $$CONFIG now: 'make reproduce' brings ours back"

study: | $(UV) ## create a follow-up study: make study NAME=my_study (FOLLOW-UP.md)
	@$(RUN) python -m replication.commands.new_study "$$NAME"

kill-table: | $(UV) ## insert errors into a copy, one at a time, and find what catches each (FAULTS=a,b or ROTATE=3)
	@$(if $(value ROTATE),$(call WHOLE,ROTATE))
	@$(DEV) python -m replication.commands.kill_table \
	  $${FAULTS:+"--faults=$$FAULTS"} $${ROTATE:+"--rotate=$$ROTATE"}

benchmark: | $(UV) ## time the Taylor solver and other solvers; writes docs/benchmark.csv and .svg (5 minutes)
	@$(BENCH) python benchmarks/benchmark.py

verify-grid: | $(UV) ## compare outcomes with an independent solver (CELLS=40000 a set)
	@$(call WHOLE,CELLS)
	@$(BENCH) python benchmarks/verify_grid.py "$$CELLS"

unlock: | $(UV) ## unlock the directory after a run was killed (no other run may be active)
	@$(RUN) snakemake --unlock

clean: ## delete all output of the workflow and the tools; keep the environment
	rm -rf results .snakemake figures/*.svg studies/*/figures/*.svg paper/report.pdf
	rm -rf .kill_table.jsonl .pytest_cache .ruff_cache .mypy_cache .hypothesis
	find src figures studies tests benchmarks faults -name __pycache__ -type d -prune -exec rm -rf {} +

.uv/bin/uv:
	@echo "uv is not on the PATH: fetching uv $(UV_VERSION) into .uv/"
	@$(PYTHON) -m venv --clear .uv || { \
	  echo "'$(PYTHON) -m venv .uv' failed. On Debian or Ubuntu 'apt install python3-venv' helps;"; \
	  echo "anywhere, installing uv does: https://docs.astral.sh/uv/getting-started/installation/"; \
	  rm -rf .uv; exit 1; } >&2
	@.uv/bin/python -m pip install --quiet --disable-pip-version-check uv==$(UV_VERSION)
