# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

SHELL := /bin/bash
PYTHON ?=
DEMO_FLAGS ?=
TEST_FLAGS ?=
BENCH_FLAGS ?=
TRUTH_FLAGS ?=
SOAK_FLAGS ?=
MUTANTS_FLAGS ?=
FUZZ_FLAGS ?=

.DEFAULT_GOAL := help
.PHONY: help setup demo test lint coverage bench truth mutants fuzz soak clean

help:
	@echo 'make setup   make .venv (ROS included, where there is none) and build the packages'
	@echo 'make demo    simulated hand and node, questions, pictures in build/demo/'
	@echo '             (DEMO_FLAGS=--keep runs until Ctrl-C)'
	@echo 'make test    all tests (TEST_FLAGS goes to pytest)'
	@echo 'make lint    style of the code'
	@echo 'make coverage  branch coverage of the tests (TEST_FLAGS goes to pytest)'
	@echo 'make bench   the figures of docs/performance.md (BENCH_FLAGS goes to it)'
	@echo 'make truth   prediction against physics, docs/truth.md (TRUTH_FLAGS goes to it)'
	@echo 'make mutants whether the tests notice changes of the code (MUTANTS_FLAGS goes to it)'
	@echo 'make fuzz    a million spoilt messages, judged, docs/reliability.md (FUZZ_FLAGS goes to it)'
	@echo 'make soak    ten minutes at 200 Hz with random faults, docs/reliability.md'
	@echo '             (SOAK_FLAGS="--seconds 120" is the short form of make test)'
	@echo 'make clean   remove .venv, build/, install/ and log/'
	@echo 'PYTHON=/path/to/python3.12 chooses the interpreter'

setup:
	@PYTHON='$(PYTHON)' scripts/setup.sh

demo: setup
	@. ./env.sh && exec install/grasp_quality_hand/lib/grasp_quality_hand/demo $(DEMO_FLAGS)

test: setup
	@. ./env.sh && exec scripts/test.sh $(TEST_FLAGS)

lint: setup
	@. ./env.sh && exec scripts/lint.sh

coverage: setup
	@. ./env.sh && exec scripts/coverage.sh $(TEST_FLAGS)

bench: setup
	@. ./env.sh && exec python -m benchmarks $(BENCH_FLAGS)

truth: setup
	@. ./env.sh && exec python -m benchmarks.truth $(TRUTH_FLAGS)

mutants: setup
	@. ./env.sh && exec python scripts/mutants.py $(MUTANTS_FLAGS)

fuzz: setup
	@. ./env.sh && exec python -m benchmarks.fuzz $(FUZZ_FLAGS)

soak: setup
	@. ./env.sh && exec python -m benchmarks.soak $(SOAK_FLAGS)

clean:
	rm -rf .venv build install log .pytest_cache .hypothesis
	find . -name __pycache__ -prune -exec rm -rf {} +
