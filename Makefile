SHELL := /bin/bash
CORES ?= 2
RUNS ?= 20000
# Beside .venv, not in the temporary folder of the machine.
TEMPORARY = TMPDIR="$(CURDIR)/.cache"
PIN = $(TEMPORARY) .venv/bin/uv pip compile --universal --generate-hashes --python-version 3.11 --no-annotate --no-header \
	--no-emit-find-links --no-emit-index-url --cache-dir .cache/uv
unexport PYTHONDONTWRITEBYTECODE PYTHONHOME CDPATH
export OMP_NUM_THREADS := 1
export WHEELS
# Snakemake gives up where neither this nor the list of users tells a home.
export HOME ?= $(CURDIR)/.cache/home

.PHONY: help figures studies check-figures check-studies accept report archive benchmark attack test test-quick test-all explore lock wheels cluster-tools development clean set-up matrix dist release
.DEFAULT_GOAL := help

# A progress bar in a terminal; plain lines elsewhere, and with V=1 all that Snakemake says.
BUILD = .venv/bin/snakemake --cores $(CORES) $(if $(V),--quiet host,$$([ ! -t 2 ] || echo --logger rich))

help:  ## list these commands
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { name[++n] = $$1; does[n] = $$2; if (length($$1) > w) w = length($$1) } \
		END { for (i = 1; i <= n; i++) printf "%-" w "s  %s\n", name[i], does[i] }' $(MAKEFILE_LIST)
	@printf '\nTo figures, studies, check-figures, check-studies, report, archive and accept may be added:\n%s\n%s\n%s\n' \
		'CORES=4        the number of cores (2 unless said)' 'V=1            everything that Snakemake says' \
		'WHEELS=folder  all packages come from there, none from the network'

figures: set-up  ## build the figures of the chapter and the charts of speed against accuracy into results/
	@$(BUILD)

studies: set-up  ## build what goes beyond the chapter: sweeps, maps, companion figures, claims, proofs, machines
	@$(BUILD) -- studies
	@$(BUILD)

check-figures: set-up  ## compare the chapter's figures with the reference set figures/ (STRICT=1: it fails if pixels cannot be)
	@$(BUILD) -- figure_check$(if $(STRICT),_strict)

check-studies: set-up  ## compare the figures of the studies with figures/studies/
	@$(BUILD) -- study_check$(if $(STRICT),_strict)

report: development  ## build both and the report, results/report/index.html, with a PDF
	@$(BUILD) -- report

archive: development  ## pack sources, results and what describes them into one file to cite and to run elsewhere, results/archive/
	@$(BUILD) -- archive

accept: export REASON := $(REASON)
accept: set-up  ## make the new figures the reference set (REASON="why", FIGURES="fig10_06 ...", PICTURES=1: pixels alone)
	.venv/bin/python -m vibroimpact_pipeline.figure_check.accept --reason "$$REASON" $(if $(PICTURES),--pictures) $(FIGURES)

benchmark: set-up  ## time per impact of every method, with its error (a minute or two, one core)
	.venv/bin/python workflow/scripts/benchmark.py

attack: development  ## attack what the certificates of runs say, 20 000 runs of each kind (RUNS=20000; a core for a quarter of an hour)
	.venv/bin/pytest -s tests/exact/engine/test_attack.py --attack=$(RUNS)

# Tests that need no build of the figures: formulas, orbits, the core of the engine, the config, the map of the repository.
QUICK = $(addprefix tests/,system theory exact/orbits \
	$(addprefix exact/engine/test_,$(addsuffix .py,simulation contact coincident_events certificate)) integrators/test_contact_laws.py \
	figures/test_specs.py figures/test_notebooks.py pipeline/test_config_reading.py docs/test_map.py) \
	$(wildcard $(addprefix tests/studies/,sweeps absorbers regimes/test_classification.py report/test_report_text.py))
# Import contracts of the chapter, and of the studies if they are there.
CONTRACTS = for config in pyproject.toml $(wildcard tests/studies/importlinter.toml) ; do .venv/bin/lint-imports --config $$config || exit; done

test-quick: development  ## lint, import contracts, tests of formulas, orbits, engine and config (under a minute)
	.venv/bin/ruff check
	@$(CONTRACTS)
	.venv/bin/pytest --numprocesses 2 --dist worksteal $(QUICK)

test: development  ## lint, import contracts, the test suite, one run of the real pipeline
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	@$(CONTRACTS)
	.venv/bin/snakefmt --check Snakefile workflow
	.venv/bin/python -m vibroimpact.compile
	.venv/bin/pytest --numprocesses 2 --dist worksteal

test-all: export THOROUGH := 1
test-all: test  ## the same and what takes minutes: Slurm under faults, a second build to the byte, all kinds of a fault

matrix: set-up  ## set up, build and test on each Python, with locked, lowest, newest packages (PYTHONS="3.12" PACKAGES="lock")
	@.venv/bin/python workflow/matrix.py $(if $(PYTHONS),--python $(PYTHONS)) $(if $(PACKAGES),--packages $(PACKAGES))

dist: set-up  ## build wheel and source distribution into dist/, check them as a package index would
	rm -rf dist
	.venv/bin/python -m hatchling build -d dist
	$(TEMPORARY) .venv/bin/uv tool run --cache-dir .cache/uv twine==7.0.0 check --strict dist/*

release: set-up  ## write a version into every file that bears it, and date the changes (VERSION=0.2.0)
	@.venv/bin/python workflow/release.py "$(VERSION)"

explore: development  ## property-based tests with new random examples (SEED=... draws those of another run again)
	@seed=$${SEED:-$$RANDOM}; again="make explore SEED=$$seed"; echo "$$again"; \
	.venv/bin/pytest --numprocesses 2 -m hypothesis --hypothesis-profile explore --hypothesis-seed $$seed \
		|| { echo "The same examples again: $$again"; exit 1; }

# Versions of environment.lock, whose packages are left out.
BESIDE = --constraint environment.lock $$(sed -n 's/^\([a-z][^=]*\)==.*/--no-emit-package \1/p' environment.lock)
lock: set-up  ## pin every package anew: of builds environment.lock, of report and tests development.lock, of clusters cluster.lock
	$(PIN) --upgrade --extra pipeline --extra integrators --extra set-up pyproject.toml -o environment.lock
	sed -i '1i # Read by pip and uv: pip install --require-hashes --no-deps -r environment.lock (workflow/set_up.sh does it).' environment.lock
	$(PIN) --upgrade --all-extras --excludes <(printf '%s\n' snakemake-executor-plugin-slurm jupyterlab) \
		$(BESIDE) pyproject.toml -o development.lock
	$(PIN) --upgrade --extra cluster $(BESIDE) --constraint development.lock pyproject.toml -o cluster.lock

wheels:  ## fill a folder with all packages (WHEELS=folder), from which set-up needs no network
	@test -n "$$WHEELS" || { echo "Name the folder: make wheels WHEELS=folder" >&2; exit 1; }
	WHEELS= workflow/set_up.sh
	workflow/pip.sh download --require-hashes --no-deps --no-build-isolation --dest "$$WHEELS" \
		-r environment.lock -r development.lock -r cluster.lock

cluster-tools:  ## install what Snakemake needs for Slurm, cluster.lock (docs/running.md; again after each new set-up)
	@workflow/set_up.sh cluster

development:  ## install what report, archive and tests need, development.lock; their commands do it by themselves
	@workflow/set_up.sh development

clean:  ## delete results and caches, keep the environment
	rm -rf results .snakemake .cache .pytest_cache .ruff_cache .import_linter_cache

set-up:
	@workflow/set_up.sh
