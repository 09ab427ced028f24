# Two commands do everything on a fresh machine: `make report` and `make test`.
# `make help` lists the rest. Every target sets up its own environment first, and cheaply when it is there.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
ATLAS  := $(BIN)/atlas
JOBS   ?= 2
FUZZ_EXAMPLES ?= 10000
PACKAGES ?= core exact study
COUNT  ?= 60
SEED   ?= 0

.DEFAULT_GOAL := report
.DELETE_ON_ERROR:
.PHONY: help report test figures picture accessibility verify bench stress mutants lint clean setup lock FORCE

help:
	@echo 'make report    the atlas, the paper on trial and the guide, as pages and PDF: build/report/atlas/index.html'
	@echo 'make test      lint, types, floors and tests'
	@echo 'make figures   every figure as SVG, PDF and PNG in build/figures'
	@echo 'make build/figures/NAME.svg|pdf|png   one figure;   make picture   the picture of the README'
	@echo 'make verify    the proofs about the paper'"'"'s equations'
	@echo 'make bench     error against time;   make stress   the worst errors found, and 10 000 hostile calls'
	@echo 'make mutants   slips of one token in PACKAGES="core exact study": which do the tests not notice?'
	@echo 'make accessibility   the linter axe-core on every page, in Chromium: needs node and npm'
	@echo 'make lint      ruff, mypy, import-linter;   make clean   removes build/'

# What the report is made from; with nothing changed, make ends without starting Python.
SOURCES := $(shell find atlas figures templates reports -type f -not -path '*/__pycache__/*' -not -name '.*' 2>/dev/null)
MADE    := build/report/.made

report: $(MADE)
	@echo build/report/atlas/index.html
	@echo build/report/atlas.pdf
	@echo build/report/trial.pdf
	@echo build/report/guide/index.html

# What is installed may bring a GL library or take it away; so may the variable ATLAS_GL, which stands in the stamp.
GL      := $(wildcard /etc/ld.so.cache /usr/lib/*/dri /usr/share/glvnd/egl_vendor.d)
THERE   := $(wildcard build/report/atlas.pdf)$(wildcard build/report/trial.pdf)$(wildcard build/report/atlas/index.html)
STAMP   := build/report/atlas.pdfbuild/report/trial.pdfbuild/report/atlas/index.html gl=$(ATLAS_GL)

$(MADE): $(VENV)/.ready $(SOURCES) $(GL) $(if $(filter-out $(THERE) $(shell cat $(MADE) 2>/dev/null),$(STAMP)),FORCE)
	@$(ATLAS) report >/dev/null
	@$(ATLAS) report trial >/dev/null
	@$(ATLAS) report guide >/dev/null
	@echo 'gl=$(ATLAS_GL)' >$@

figures: setup
	@$(ATLAS) figure --all

# The picture of the README: one precession, moment by moment, small.
picture: setup
	@$(ATLAS) figure film_strip --format png >/dev/null
	@$(BIN)/python -c "from PIL import Image; im = Image.open('build/figures/film_strip.png').convert('RGB'); im.resize((1000, round(1000 * im.height / im.width)), Image.Resampling.LANCZOS).quantize(128).save('reports/data/precession.png', optimize=True)"
	@echo reports/data/precession.png

build/figures/%: FORCE | setup
	@$(ATLAS) figure $(basename $*) --format $(patsubst .%,%,$(suffix $*))

verify: setup
	@$(ATLAS) verify --record
	@$(ATLAS) verify --mutants --all --record

bench: setup $(VENV)/.bench
	@env -u OPENBLAS_CORETYPE $(ATLAS) bench --store   # so that OpenBLAS chooses the kernels of this processor

stress: setup
	@$(ATLAS) stress
	@HYPOTHESIS_PROFILE=hunt FUZZ_EXAMPLES=$(FUZZ_EXAMPLES) $(BIN)/python -m pytest -n $(JOBS) tests/fuzz

# Needs node, npm and Chromium.
accessibility: report
	@npm install --silent --no-save --prefix build/accessibility axe-core@4.14.1 playwright-core@1.65.1
	@node tests/accessibility.mjs build/report/atlas build/accessibility
	@node tests/accessibility.mjs build/report/trial build/accessibility
	@node tests/accessibility.mjs build/report/guide build/accessibility

mutants: setup
	@$(BIN)/python tests/mutants.py $(PACKAGES) --count $(COUNT) --seed $(SEED) --jobs $(JOBS)

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

# The environment belongs to the folder that stands in .ready: one that was copied, moved or left half-made is made again.
ifneq ($(shell cat $(VENV)/.ready 2>/dev/null),$(CURDIR))
$(VENV)/.ready: FORCE
endif

$(VENV)/.ready: pyproject.toml requirements.lock
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo 'atlas needs Python 3.11 or newer; say make PYTHON=/path/to/python3.11'; exit 2; }
	@$(PYTHON) -c 'import ensurepip, venv' 2>/dev/null || { \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then echo 'installing python3-venv'; \
	    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq python3-venv; } >/dev/null 2>&1 || { echo 'python3-venv could not be installed by apt-get'; exit 2; }; \
	  else echo 'this Python has no venv; install it: sudo apt-get install python3-venv'; exit 2; fi; }
	@test "$$(cat $@ 2>/dev/null)" = '$(CURDIR)' || rm -rf $(VENV)
	@rm -f $@
	@test -d $(VENV) || { echo 'setting up .venv, once: 1.4 GB on disk'; echo '  a virtual environment'; $(PYTHON) -m venv $(VENV); }
	@if command -v uv >/dev/null; then echo '  the libraries of requirements.lock, by uv' && uv pip install -q --python $(BIN)/python --require-hashes -r requirements.lock; else false; fi || \
	  { echo '  the libraries of requirements.lock, by pip: half a minute or more' && $(BIN)/python -m pip install -qq --no-compile --disable-pip-version-check --require-hashes -r requirements.lock; }
	@ln -sfn ../../../../atlas "$$($(BIN)/python -c 'import sysconfig; print(sysconfig.get_path("purelib"))')/atlas"
	@printf '#!/bin/sh\n# The program of the checkout in whose .venv this stands.\nexec "$$(dirname -- "$$(readlink -f -- "$$0")")/python" -P -m atlas "$$@"\n' >$(ATLAS) && chmod +x $(ATLAS)
	@echo '  GL libraries for shaded figures' && $(BIN)/python -m atlas.draw.gl --install
	@env -u PYTHONDONTWRITEBYTECODE $(BIN)/python -c 'from atlas.places import settle_matplotlib; settle_matplotlib(); import fontTools.subset, fontTools.ttLib.tables.otTables, matplotlib.figure, matplotlib._constrained_layout, matplotlib.backends.backend_pdf, matplotlib.backends.backend_svg, pyvista'   # writes their bytecode, without which each worker compiles them for 1.5 s
	@echo '$(CURDIR)' >$@

$(VENV)/.bench: requirements-bench.lock | setup
	@$(BIN)/python -m pip install -qq --disable-pip-version-check --require-hashes -r requirements-bench.lock || echo 'heyoka could not be installed: the benchmark goes on without that peer'
	@touch $@

# Rewrites the locks from pyproject.toml, for every Python from 3.11 up.
lock: | setup
	@$(BIN)/python -m pip install -qq --disable-pip-version-check 'uv==0.13.8'
	@$(BIN)/uv pip compile -q --universal --python-version 3.11 --generate-hashes --no-header --no-annotate --extra test pyproject.toml -o requirements.lock
	@$(BIN)/uv pip compile -q --universal --python-version 3.11 --generate-hashes --no-header --no-annotate --extra bench -c requirements.lock pyproject.toml -o requirements-bench.lock
