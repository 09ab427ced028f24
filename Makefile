# Two commands do everything on a fresh machine: `make report` and `make test`.
# `make help` lists the rest. Every target sets up its own environment first, and cheaply when it is there.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
ATLAS  := $(BIN)/atlas
JOBS   ?= 2

.DEFAULT_GOAL := report
.DELETE_ON_ERROR:
.PHONY: help report test figures verify bench stress rebuilds curves lint clean setup lock FORCE

help:
	@echo 'make report    build/report/atlas/index.html and build/report/atlas.pdf'
	@echo 'make test      lint, types, floors and tests'
	@echo 'make figures   every figure as SVG, PDF and PNG in build/figures'
	@echo 'make build/figures/NAME.svg|pdf|png   one figure'
	@echo 'make verify    the proofs about the paper'"'"'s equations'
	@echo 'make bench     error against time;   make stress   the worst errors found'
	@echo 'make rebuilds  how long each kind of change takes;   make curves   points drawn against error'
	@echo 'make lint      ruff, mypy, import-linter;   make clean   removes build/'

# What the report is made from; with nothing changed, make ends without starting Python.
SOURCES := $(shell find atlas figures templates reports -type f -not -path '*/__pycache__/*' -not -name '.*' 2>/dev/null)
MADE    := build/report/.made

report: $(MADE)
	@echo build/report/atlas/index.html
	@echo build/report/atlas.pdf

$(MADE): $(VENV)/.ready $(SOURCES) $(if $(wildcard build/report/atlas.pdf),$(if $(wildcard build/report/atlas/index.html),,FORCE),FORCE)
	@$(ATLAS) report >/dev/null
	@touch $@

figures: setup
	@$(ATLAS) figure --all

build/figures/%: FORCE | setup
	@$(ATLAS) figure $(basename $*) --format $(patsubst .%,%,$(suffix $*))

verify: setup
	@$(ATLAS) verify --record
	@$(ATLAS) verify --mutants --record

bench: setup $(VENV)/.bench
	@env -u OPENBLAS_CORETYPE $(ATLAS) bench   # so that OpenBLAS chooses the kernels of this processor

stress: setup
	@$(ATLAS) stress

rebuilds: setup
	@$(BIN)/python -m atlas.build.rebuilds --store

curves: setup
	@$(BIN)/python -m atlas.study.curves

lint: setup
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/lint-imports --no-cache

test: lint
	@$(BIN)/python -m pytest -n $(JOBS)

clean:
	rm -rf build

setup: $(VENV)/.ready

$(VENV)/.ready: pyproject.toml requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo 'atlas needs Python 3.11 or newer; say make PYTHON=/path/to/python3.11'; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then echo 'installing python3-venv'; apt-get update -qq && apt-get install -y -qq python3-venv >/dev/null; \
	  else echo 'this Python has no venv; install it: sudo apt-get install python3-venv'; exit 2; fi; }
	@echo 'setting up $(VENV) from requirements.lock (once)'
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install -qq --disable-pip-version-check --require-hashes -r requirements.lock
	@$(BIN)/python -m pip install -qq --disable-pip-version-check --no-deps --no-build-isolation -e .
	@$(BIN)/python -m atlas.render.gl --install
	@touch $@

$(VENV)/.bench: requirements-bench.lock | setup
	@$(BIN)/python -m pip install -qq --disable-pip-version-check --require-hashes -r requirements-bench.lock || echo 'heyoka could not be installed: the benchmark goes on without that peer'
	@touch $@

# Rewrites the locks from pyproject.toml, for every Python from 3.11 up.
lock: | setup
	@$(BIN)/python -m pip install -qq --disable-pip-version-check 'uv==0.13.8'
	@$(BIN)/uv pip compile -q --universal --python-version 3.11 --generate-hashes --no-header --no-annotate --extra test pyproject.toml -o requirements.lock
	@$(BIN)/uv pip compile -q --universal --python-version 3.11 --generate-hashes --no-header --no-annotate --extra bench -c requirements.lock pyproject.toml -o requirements-bench.lock
