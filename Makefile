# Two commands: `make study` and `make test`. Each first makes .venv from the locks when it is
# missing or stale.  PYTHON=/path/to/python chooses the interpreter the environment is made from.

TIER ?= standard
CORES ?= all
STUDY = .venv/bin/python workflow/scripts/run_study.py --tier '$(TIER)' --cores '$(CORES)'
IN_ENVIRONMENT = PATH="$(CURDIR)/.venv/bin:$$PATH"
TESTS = pytest -q -n 2 --dist worksteal --benchmark-disable
USUAL = not slow and not cluster and not page

# The marker's name holds what the environment was made from, and where: a moved checkout, another
# lock or an interpreter that is gone asks for a new one.
INPUTS = build.lock requirements.lock pyproject.toml
ID := $(shell { pwd; cat $(INPUTS) 2>/dev/null; } | cksum | tr -d ' ')
ALIVE := $(shell .venv/bin/python -c "print(1)" 2>/dev/null)
READY = .venv/.$(if $(ALIVE),ready,broken)-$(ID)

MAKEFLAGS += --no-print-directory
.NOTPARALLEL:
.PHONY: help study test test-long test-all test-slow test-page test-cluster test-wheel check docs wheel lock figures bench references clean
.PHONY: environment test-crate test-formats test-container test-hostile test-faults test-pythons test-strangers
# Libraries of another environment must not get in.
unexport PYTHONPATH PYTHONHOME
export PYTHON

help:  ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "%-10s %s\n", $$1, $$2 }' Makefile

environment: $(READY)  ## make the Python environment .venv

study: $(READY)  ## simulate, grade, draw and report all studies (TIER=preview|standard|reference CORES=n)
	@exec $(STUDY)

test: $(READY)  ## run the tests, without those of the other test targets
	@$(IN_ENVIRONMENT) $(TESTS) -m 'not long and $(USUAL)'

test-long: $(READY)  ## run the tests of whole studies, and the other seeds of those of `make test`
	@$(IN_ENVIRONMENT) $(TESTS) -m 'long and $(USUAL)'

test-all: $(READY)  ## run the tests of `make test` and `make test-long` together, which saves repeated work
	@$(IN_ENVIRONMENT) $(TESTS) -m '$(USUAL)'

test-slow: $(READY)  ## run the slow tests
	@$(IN_ENVIRONMENT) pytest -q -n 2 --benchmark-disable -m 'slow and not cluster'

test-cluster: .venv/.slurm-$(ID)  ## run a study on a Slurm installation with one node (root; Debian: slurmctld slurmd slurm-client munge)
	@$(IN_ENVIRONMENT) pytest -q --benchmark-disable -m cluster tests/workflow/test_cluster.py

test-crate: .venv/.crate-$(ID)  ## check the run crate of a study against the profiles of run crates
	@$(IN_ENVIRONMENT) RISERSTUDY_CRATE_PYTHON='$(CURDIR)/.venv/crate/bin/python' pytest -q --benchmark-disable tests/crate

test-formats: .venv/.formats-$(ID)  ## read time series of other programs by qats (installs Qt, 0.7 GB)
	@$(IN_ENVIRONMENT) pytest -q --benchmark-disable tests/dataset/external

test-container: .venv/.container-$(ID)  ## lint Containerfile, run its steps in a clean root (root; Debian: mmdebstrap)
	@$(IN_ENVIRONMENT) RISERSTUDY_CLEAN_ROOT=1 pytest -q -s --benchmark-disable tests/workflow/test_container.py

test-page: $(READY)  ## open the report in Chromium (Debian: chromium, chromium-driver)
	@$(IN_ENVIRONMENT) pytest -q --benchmark-disable -m page

check: $(READY)  ## check format, lint, types, import rules and spelling
	@$(IN_ENVIRONMENT) sh workflow/scripts/check.sh

lock:  ## resolve the dependencies again and write the lock files (developers)
	@sh workflow/scripts/with_python.sh workflow/scripts/make_locks.py

docs: $(READY)  ## build the pages into build/docs, warnings as errors
	@$(IN_ENVIRONMENT) sphinx-build -q -W -b html docs build/docs

wheel:  ## build the package into dist/
	@sh workflow/scripts/with_python.sh workflow/scripts/make_wheel.py

test-wheel: $(READY)  ## install the wheel into an empty environment and run a separate study with it
	@$(IN_ENVIRONMENT) pytest -q -s tests/workflow/test_wheel.py

test-hostile: $(READY)  ## run the program with damaged and hostile input
	@$(IN_ENVIRONMENT) python tests/fuzz/run.py
	@RISERSTUDY_INVARIANTS=5000 $(IN_ENVIRONMENT) pytest -q -n 2 --benchmark-disable tests/invariants

test-faults: $(READY)  ## kill runs, fill disks, break caches; write docs/faults.md (root for read-only and full disks)
	@$(IN_ENVIRONMENT) python tests/faults/run.py --write docs/faults.md

test-pythons: $(READY)  ## compare results of one core and two cores, and of the installed Pythons 3.11 to 3.14
	@$(IN_ENVIRONMENT) python tests/pythons/run.py python3.11 python3.12 python3.13 python3.14

test-strangers: $(READY)  ## run a short study with other users, locales and settings; write docs/machines.md (root for other users)
	@$(IN_ENVIRONMENT) python tests/strangers/run.py --write docs/machines.md

figures: $(READY)  ## draw the figures, and simulate only missing points
	@exec $(STUDY) figures

references: $(READY)  ## compute reference solutions that are missing or outdated
	@$(IN_ENVIRONMENT) python -m chapters.numerics.make_references $(CASES)

bench: .venv/.bench-$(ID)  ## time the engine and other simulators alternately
	@$(IN_ENVIRONMENT) python benchmarks/run.py

clean:  ## remove results and stored points; keep environment and compiled kernels
	@rm -rf results logs "$${RISERSTUDY_CACHE:-.cache}/points"

$(READY):
	@sh workflow/scripts/with_python.sh workflow/scripts/make_environment.py .venv/.ready-$(ID)

# It needs an older release of a library that riserstudy prints with, so it has an environment of its own.
.venv/.crate-$(ID): crate.lock $(READY)
	@.venv/bin/python -m venv .venv/crate
	@.venv/crate/bin/python workflow/scripts/installer.py crate.lock
	@touch $@

.venv/.bench-$(ID) .venv/.slurm-$(ID) .venv/.formats-$(ID) .venv/.container-$(ID): .venv/.%-$(ID): %.lock $(READY)
	@.venv/bin/python workflow/scripts/installer.py $<
	@touch $@
