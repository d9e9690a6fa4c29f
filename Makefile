# `make` lists the commands. All use uv and its lock; where uv is missing, the first command installs it
# into .uv/. A word in capitals is a variable: make reproduce CORES=4.

CORES  ?= 2
PYTHON ?= python3
UV     := $(shell command -v uv 2>/dev/null || echo .uv/bin/uv)
RUN     = $(UV) run --locked --no-dev
DEV     = $(UV) run --locked
# Each job is a Python, which would compile modules anew if they were not kept.
export PYTHONDONTWRITEBYTECODE :=
export NAME DIR

.DEFAULT_GOAL := help
.PHONY: help reproduce unlock check audit refute test lint study publish notebooks faults archive cluster-test clean

help: ## list the commands
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1|\2/p' Makefile | \
	  while IFS='|' read -r name text; do printf '  %-18s %s\n' "$$name" "$$text"; done

reproduce: | $(UV) ## compute every result, check every claim, compile article and supplement (CORES=2)
	@echo "A first run takes 2 to 15 minutes on two cores; a later one repeats only what a change affects."
	@mkdir -p .snakemake && touch .snakemake/begun
	@$(RUN) python -m snakemake --cores "$(CORES)"; code=$$?; \
	if [ $$code != 0 ] && ls .snakemake/locks/* > /dev/null 2>&1; then \
	  echo "A run was killed in this folder, or another one goes on. If there is no other: make unlock"; \
	elif [ $$code != 0 ] && [ results/logs/expected.log -nt .snakemake/begun ]; then cat results/logs/expected.log; \
	elif [ $$code = 0 ] && ! [ results/summary.txt -nt .snakemake/begun ]; then cat results/summary.txt; fi; \
	exit $$code

unlock: | $(UV) ## after a killed run: let the next run begin
	@$(RUN) python -m snakemake --unlock

check: | $(UV) ## without a run: checksums, parameters, verdicts and pages of what is published
	@$(RUN) python -m documents.check

audit: | $(UV) ## without a run: recompute what README says by one file, from the equations
	@$(RUN) python -I src/audit.py

refute: | $(UV) ## which sentence does a motion contradict? MOTION=file or lobes; or search: SENTENCE=id MINUTES=10
	@$(RUN) python src/refute.py $(if $(MOTION),--motion "$(MOTION)") $(if $(SENTENCE),--sentence "$(SENTENCE)") \
	  $(if $(MINUTES),--minutes "$(MINUTES)") $(if $(SEED),--seed "$(SEED)") $(if $(DRAWS),--draws "$(DRAWS)") $(if $(ADD),--add "$(ADD)")

test: | $(UV) ## run the tests
	@OMP_NUM_THREADS=1 $(DEV) pytest --numprocesses "$(CORES)" --dist worksteal

lint: | $(UV) ## check style, types, spelling and the rules; changes nothing
	$(DEV) ruff check
	$(DEV) ruff format --check
	$(DEV) mypy
	$(DEV) codespell
	$(DEV) snakefmt --check --compact-diff Snakefile rules studies
	$(DEV) check-jsonschema --builtin-schema vendor.citation-file-format CITATION.cff
	$(DEV) check-jsonschema --builtin-schema vendor.github-workflows .github/workflows/*.yaml
	$(DEV) check-jsonschema --builtin-schema vendor.dependabot .github/dependabot.yml
	$(UV) export --locked --no-dev $(EXPORT) | cmp - requirements.txt
EXPORT = --no-hashes --no-header --no-annotate --no-emit-project

study: | $(UV) ## copy studies/bent, as a repository of its own: make study DIR=../bridge NAME=bridge
	@expr "$$NAME" : '[a-z][a-z0-9_]*$$' >/dev/null && case "$$NAME" in results|dist|wheels|tests|topheavy) false;; esac || \
	  { echo "NAME is '$$NAME'; expected lower case, digits, _, and none of results, dist, wheels, tests, topheavy"; exit 1; }
	@test -n "$$DIR" && test ! -e "$$DIR" || { echo "DIR is '$$DIR'; expected the path of a new folder"; exit 1; }
	@mkdir "$$DIR" && cp LICENSE .gitignore "$$DIR" && cp -R data/records "$$DIR"
	@tar -C studies/bent --exclude results --exclude '.snakemake' --exclude '.venv' --exclude '*cache*' -c . | tar -C "$$DIR" -x
	@$(UV) build --quiet --wheel --no-create-gitignore --out-dir "$$DIR/wheels"
	@cd "$$DIR" && sed -i.old 's|"bent"|"'"$$NAME"'"|; s|path = "../.."|path = "$(WHEEL)"|' pyproject.toml && \
	  sed -i.old 's|../../data/||' config.yaml && sed -i.old 's|bent|'"$$NAME"'|g' README.md CITATION.cff report.typ && \
	  rm *.old && mv tests/test_bent.py "tests/test_$$NAME.py"
	@$(UV) lock --quiet --project "$$DIR"
	@ls -A "$$DIR" && printf "Next: cd '%s' && '%s' run snakemake --cores 2\n" "$$DIR" "$(abspath $(UV))"
WHEEL = wheels/topheavy-$(shell sed -n 's/^version = "\(.*\)"/\1/p' pyproject.toml)-py3-none-any.whl

publish: | $(UV) ## copy the results of a run to docs/ and tests/reference/; read the diff, then commit it
	@$(RUN) python -m documents.publish

notebooks: | $(UV) ## open the notebooks in JupyterLab
	@$(UV) run --locked --group notebooks jupyter lab notebooks/paper.ipynb

faults: | $(UV) ## put deliberate errors into a copy, one at a time: does a test catch each?
	@$(DEV) python tests/faults/run.py -j "$(CORES)"

archive: ## pack the commit into dist/, with the checksums of its files; snakemake --archive packs too little
	@test -e .git || { echo "This folder is no clone of git, so that it has no commit to pack"; exit 1; }
	@mkdir -p dist && git archive --prefix=topheavy/ --output=dist/topheavy.zip HEAD
	@git ls-files -z | xargs -0 sha256sum > dist/SHA256SUMS

cluster-test: | $(UV) ## as root on Debian: the shards on a SLURM of one node give the same bytes
	@$(RUN) --group cluster profiles/slurm/test

clean: ## remove what the workflow and the tools wrote; keep the environment
	rm -rf results dist .snakemake figures/*.svg studies/*/results studies/*/.snakemake paper/*.pdf .*_cache .hypothesis

.uv/bin/uv:
	@$(PYTHON) -m venv --clear .uv || { echo "On Debian: apt install python3-venv"; rm -rf .uv; exit 1; }
	@.uv/bin/python -m pip install --quiet --disable-pip-version-check uv==0.13.8
