SHELL := /bin/bash
CORES ?= 2
RUNS ?= 20000
# Temporary files are stored in the checkout, not in the temporary folder of the system.
TEMPORARY = TMPDIR="$(CURDIR)/.cache"
PIN = $(TEMPORARY) .venv/bin/uv pip compile --universal --generate-hashes --python-version 3.11 --no-annotate --no-header \
	--no-emit-find-links --no-emit-index-url --cache-dir .cache/uv
unexport PYTHONDONTWRITEBYTECODE PYTHONHOME CDPATH
export OMP_NUM_THREADS := 1
export WHEELS STRICT
# Set HOME if it is undefined, since Snakemake fails if neither HOME nor the user database defines a home directory.
export HOME ?= $(CURDIR)/.cache/home

.PHONY: help figures studies check-figures check-studies accept report archive benchmark attack test test-quick test-all explore lock wheels cluster-tools development clean set-up matrix dist release
.DEFAULT_GOAL := help

# In a terminal, a build shows a progress bar; elsewhere, it shows plain lines. With V=1, it shows all output of Snakemake.
BUILD = .venv/bin/snakemake --cores $(CORES) $(if $(V),--quiet host,$$([ ! -t 2 ] || echo --logger rich))

help:  ## show this help
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { name[++n] = $$1; does[n] = $$2; if (length($$1) > w) w = length($$1) } \
		END { for (i = 1; i <= n; i++) printf "%-" w "s  %s\n", name[i], does[i] }' $(MAKEFILE_LIST)
	@printf '\nOptions of figures, studies, check-figures, check-studies, report, archive and accept:\n%s\n%s\n%s\n' \
		'CORES=4        number of cores (default: 2)' 'V=1            show the full output of Snakemake' \
		'WHEELS=folder  install all packages from this folder, without network'

figures: set-up  ## build the figures of the chapter and the work-precision charts into results/
	@$(BUILD)

studies: set-up  ## build the studies (sweeps, maps, companion figures, claims, proofs, machines) into results/
	@$(BUILD) -- studies
	@$(BUILD)

check-figures: set-up  ## compare the chapter's figures with the reference set figures/ (STRICT=1: fail if other library versions drew the reference)
	@$(BUILD) -- figure_check

check-studies: set-up  ## compare the figures of the studies with the reference set figures/studies/ (STRICT=1: as above)
	@$(BUILD) -- study_check

report: development  ## build figures, studies and the report: results/report/index.html, and an article as PDF
	@$(BUILD) -- report

archive: development  ## build figures and studies; pack sources, results and metadata into one citable file, in results/archive/
	@$(BUILD) -- archive

accept: export REASON := $(REASON)
accept: set-up  ## accept new figures into the reference set (REASON="why", FIGURES="fig10_06 ...", PICTURES=1: only pictures)
	.venv/bin/python -m vibroimpact_pipeline.figure_check.accept --reason "$$REASON" $(if $(PICTURES),--pictures) $(FIGURES)

benchmark: set-up  ## measure time per impact and error of every method (1 to 2 minutes on one core)
	.venv/bin/python workflow/scripts/benchmark.py

attack: development  ## stress-test the error estimates of runs with 20 000 runs of each kind (RUNS=20000; 15 minutes on one core)
	.venv/bin/pytest -s tests/exact/engine/test_attack.py --attack=$(RUNS)

# Tests that do not build figures: formulas, orbits, core of the engine, config, map of the repository.
QUICK = $(addprefix tests/,system theory exact/orbits \
	$(addprefix exact/engine/test_,$(addsuffix .py,simulation contact coincident_events certificate)) integrators/test_contact_laws.py \
	figures/test_specs.py figures/test_notebooks.py pipeline/test_config_reading.py docs/test_map.py) \
	$(wildcard $(addprefix tests/studies/,sweeps absorbers regimes/test_classification.py report/test_report_text.py))
# Check the import contracts of the chapter, and those of the studies if the studies are installed.
CONTRACTS = for config in pyproject.toml $(wildcard tests/studies/importlinter.toml) ; do .venv/bin/lint-imports --config $$config || exit; done

test-quick: development  ## run linters and the tests of formulas, orbits, engine and config (less than a minute)
	.venv/bin/ruff check
	@$(CONTRACTS)
	.venv/bin/pytest --numprocesses 2 --dist worksteal $(QUICK)

test: development  ## run linters and the test suite, including one run of the pipeline
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	@$(CONTRACTS)
	.venv/bin/snakefmt --check Snakefile workflow
	.venv/bin/python -m vibroimpact.compile
	.venv/bin/pytest --numprocesses 2 --dist worksteal

test-all: export THOROUGH := 1
test-all: test  ## run `test` and all slow tests, such as builds on Slurm with faults and a byte-identical rebuild

# Run a tool that is not in the locks.
TOOL = $(TEMPORARY) .venv/bin/uv tool run --cache-dir .cache/uv

matrix: set-up  ## set up, build and test with each Python and locked, lowest and newest packages (NOX="--python 3.12 -k lock")
	$(TOOL) nox==2026.10.20 --session matrix --envdir .cache/nox $(NOX)

dist: set-up  ## build wheel and source distribution into dist/ and check their metadata
	rm -rf dist
	.venv/bin/python -m hatchling build -d dist
	$(TOOL) twine==7.0.0 check --strict dist/*

release: set-up  ## set the version in all files and date the changelog entry (VERSION=0.2.0)
	$(TOOL) bump-my-version==1.8.1 bump --new-version "$(VERSION)"

explore: development  ## run property-based tests with new random examples (SEED=... repeats a run)
	@seed=$${SEED:-$$RANDOM}; again="make explore SEED=$$seed"; echo "$$again"; \
	.venv/bin/pytest --numprocesses 2 -m hypothesis --hypothesis-profile explore --hypothesis-seed $$seed \
		|| { echo "To repeat these examples: $$again"; exit 1; }

# Options that make uv use the versions in environment.lock but leave out its packages, which are already installed.
BESIDE = --constraint environment.lock $$(sed -n 's/^\([a-z][^=]*\)==.*/--no-emit-package \1/p' environment.lock)
lock: set-up  ## update all locks: environment.lock (builds), development.lock (report, tests), cluster.lock (Slurm)
	$(PIN) --upgrade --extra pipeline --extra integrators --extra set-up pyproject.toml -o environment.lock
	sed -i '1i # Read by pip and uv: pip install --require-hashes --no-deps -r environment.lock (workflow/set_up.sh does it).' environment.lock
	$(PIN) --upgrade --all-extras --excludes <(printf '%s\n' snakemake-executor-plugin-slurm jupyterlab) \
		$(BESIDE) pyproject.toml -o development.lock
	$(PIN) --upgrade --extra cluster $(BESIDE) --constraint development.lock pyproject.toml -o cluster.lock

wheels:  ## download all packages to a folder, for a set-up without network (WHEELS=folder)
	@test -n "$$WHEELS" || { echo "WHEELS: not set, expected a folder: make wheels WHEELS=folder" >&2; exit 1; }
	WHEELS= workflow/set_up.sh
	workflow/pip.sh download --require-hashes --no-deps --no-build-isolation --dest "$$WHEELS" \
		-r environment.lock -r development.lock -r cluster.lock

cluster-tools:  ## install the Slurm plugin of Snakemake from cluster.lock (repeat after each set-up; see docs/running.md)
	@workflow/set_up.sh cluster

development:  ## install the packages of development.lock; report, archive and tests do this automatically
	@workflow/set_up.sh development

clean:  ## delete results and caches; keep the environment
	rm -rf results .snakemake .cache .pytest_cache .ruff_cache .import_linter_cache

set-up:
	@workflow/set_up.sh
