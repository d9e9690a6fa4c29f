# The machine's part of make, which the Makefile of a paper includes. Before, a paper may set options of
# uv in GROUPS, and names of its variables in OWN. All commands use uv and the committed lock file. If uv
# is missing, the first command installs it into .uv/ (delete that folder to remove it).

CORES      ?= 2
PYTHON     ?= python3
UV_VERSION := 0.13.8

# Snakemake starts its jobs by a shell and does not quote the path of their Python.
UNQUOTED := ' " $$ ` & ; | < > ( ) * ? [ ] { } \ :
ifneq ($(words $(CURDIR))$(strip $(foreach c,$(UNQUOTED),$(findstring $(c),$(CURDIR)))),1)
$(error the path $(CURDIR) has a space or one of $(UNQUOTED) in it; expected letters, digits \
  and . _ - / alone: move the folder, delete its .venv, and run again)
endif

# In an unpacked archive, anybody may have put a .uv: there it is kept outside.
UV_HOME := $(if $(wildcard SHA256SUMS),$(or $(XDG_CACHE_HOME),$(HOME)/.cache)/replication-uv-$(UV_VERSION),.uv)
UV  := $(shell command -v uv 2>/dev/null || echo $(UV_HOME)/bin/uv)
RUN = $(UV) run --locked --no-dev $(GROUPS)
DEV = $(UV) run --locked $(GROUPS)

.DEFAULT_GOAL := help
# A paper that has faults has a kill table.
include $(if $(wildcard tests/faults/*.yaml studies/*/faults.yaml),src/replication/make/kill.mk)

# A run starts a hundred Pythons. Where compiled modules are not kept, each would compile all anew.
export PYTHONDONTWRITEBYTECODE :=

# Commands receive these variables unchanged through the environment, so that neither make nor the
# shell can interpret a value as code.
GIVEN := CORES FAULTS FROM ITEM NAME ROTATE TO $(OWN)
$(foreach name,$(GIVEN),$(eval override $(name) := $$(value $(name))))
export $(GIVEN)
WHOLE = case "$$$(1)" in ''|0*|*[!0-9]*) \
  echo "$(1) is '$$$(1)'; expected a whole number from 1 on" >&2; exit 2;; esac
SNAKEMAKE = $(call WHOLE,CORES); exec $(RUN) python -m replication.commands.run --cores "$$CORES"

.PHONY: help reproduce claim check trace verify archive html test lint schema publish \
  study update unlock clean

LISTED = $(wordlist 2,9,$(MAKEFILE_LIST)) $(firstword $(MAKEFILE_LIST))
LINES  = while IFS='|' read -r target text; do printf '  %-17s %s\n' "$$target" "$$text"; done
help: ## show this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1|\2/p' $(LISTED) | $(LINES)
	@echo; echo "for maintainers"
	@sed -n 's/^\([a-z-]*\):.*##- \(.*\)/make \1|\2/p' $(LISTED) | $(LINES)

reproduce: | $(UV) ## compute every result, check every claim, compile the report (CORES=2)
	@$(SNAKEMAKE)

claim: | $(UV) ## begin a claim, or judge one that the ledger has: make claim NAME=my_claim
	@$(RUN) python -m replication.commands.new_claim "$$NAME"
	@$(SNAKEMAKE) "claim_$$NAME"

check: | $(UV) ## judge every claim again from the published files; no run (RELEASE=1: none older than its texts)
	@$(RUN) python -m steps.recheck

trace: | $(UV) ## from a figure, table, finding or claim to its source (ITEM=results/claims.json)
	@$(RUN) python -m replication.commands.trace "$$ITEM"

verify: | $(UV) ## compare every file of a finished run with its RO-Crate
	@python=$$($(UV) python find --system --no-project --no-config '>=3.11') && \
	  "$$python" -I -S src/replication/commands/verify.py

archive: | $(UV) ##- after a run: one .zip in dist/ with the source and the results
	@$(RUN) python -m replication.commands.archive

OPENING = --report-metadata src/replication/pages/opening.yaml \
  --report-stylesheet src/replication/pages/opening.css
html: | $(UV) ## after a run: write results/report.html with every figure, caption and verdict
	@test -e results/ro-crate-metadata.json || { \
	  echo "there is no finished run; run 'make reproduce' first" >&2; exit 1; }
	@$(RUN) snakemake --report results/report.html $(OPENING) --quiet all || { \
	  $(RUN) snakemake --report results/report.html $(OPENING) all; exit 1; } # --quiet hides the error, too
	@$(RUN) python -m replication.commands.check_html results/report.html

test: | $(UV) ## run the tests
	@$(call WHOLE,CORES); OMP_NUM_THREADS=1 $(DEV) pytest --numprocesses "$$CORES" --dist loadfile --no-loadscope-reorder

LEDGER_SCHEMA = src/replication/judging/claims.schema.yaml
SCHEMAS = $(wildcard config/*.schema.yaml studies/*/*.schema.yaml paper/*.schema.yaml)
lint: export VALIDATE_PYPROJECT_NO_NETWORK = 1
lint: | $(UV) ##- check style, types, spelling, wording and schemas; changes nothing
	$(DEV) ruff check
	$(DEV) ruff format --check
	$(DEV) mypy
	$(DEV) codespell
	$(DEV) python -m replication.commands.readers
	@$(DEV) python -m replication.pages.blanks
	$(DEV) snakefmt --check --compact-diff Snakefile $(wildcard src/*/*.smk studies/*/*.smk)
	$(DEV) python -m replication.inputs.configuration $(SCHEMAS)
	$(DEV) check-jsonschema --check-metaschema $(LEDGER_SCHEMA)
	$(DEV) check-jsonschema --schemafile $(LEDGER_SCHEMA) paper/claims.yaml
	$(DEV) check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
	$(DEV) check-jsonschema --builtin-schema vendor.github-workflows $(wildcard .github/workflows/*.yaml)
	$(DEV) validate-pyproject pyproject.toml src/replication/pyproject.toml
# Snakemake's lint demands a conda environment or container for every rule. One lock file serves all
# rules here, so we ignore this demand and no other.
	$(DEV) snakemake --lint 2>&1 | awk ' \
	  { text = text $$0 "\n" } \
	  /^Lints for|^Congratulations/ { ran = 1 } \
	  /^    \* / && !/\* Specify a conda environment or container for each rule/ { found = 1 } \
	  END { if (found || !ran) { printf "%s", text; exit 1 } }'

schema: | $(UV) ##- draft what the schemas of the configs say of sections that they lack
	@$(RUN) python -m replication.commands.draft_schema

publish: | $(UV) ##- copy results to docs/ and tests/reference/; read the diff, then commit it
	@$(RUN) python -m steps.publish

study: | $(UV) ## begin a follow-up study: make study NAME=my_study (studies/FOLLOW-UP.md)
	@$(RUN) python -m replication.commands.new_study "$$NAME"

update: | $(UV) ##- replace the machine of a paper by a newer one: make update FROM=../folder or a git URL
	@$(UV) run --no-project --no-config --python '>=3.11' python -I -S src/replication/commands/update.py "$$FROM"

unlock: | $(UV) ##- after a killed run left the folder locked; refused beside a run
	@$(RUN) snakemake --unlock

clean: ##- remove all that the workflow and the tools wrote; keep the environment
	rm -rf results dist .snakemake figures/*.svg studies/*/figures/*.svg paper/*.pdf
	rm -rf .pytest_cache .ruff_cache .mypy_cache .hypothesis
	find . \( -name .venv -o -name .uv \) -prune -o -name __pycache__ -type d -prune -exec rm -rf {} +
	@$(if $(value SHARED),echo "kept: $(SHARED)")

$(UV_HOME)/bin/uv:
	@echo "uv is not on the PATH: fetching uv $(UV_VERSION) into $(UV_HOME)/"
	@$(PYTHON) -m venv --clear $(UV_HOME) || { \
	  echo "'$(PYTHON) -m venv $(UV_HOME)' failed. On Debian or Ubuntu 'apt install python3-venv' helps;"; \
	  echo "anywhere, installing uv does: https://docs.astral.sh/uv/getting-started/installation/"; \
	  rm -rf $(UV_HOME); exit 1; } >&2
	@$(UV_HOME)/bin/python -m pip install --quiet --disable-pip-version-check uv==$(UV_VERSION)
