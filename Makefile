# Two commands do everything on a fresh machine: `make report` and `make test`.
# `make help` lists the rest. Every target sets up its own environment first, and cheaply when it is there.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
ATLAS  := $(BIN)/atlas
JOBS   ?= 2
MB     ?= 1700
KINDS  ?= Prescott Nehalem Sandybridge Haswell SkylakeX
FUZZ_EXAMPLES ?= 10000

.DEFAULT_GOAL := report
.DELETE_ON_ERROR:
.PHONY: help report test figures picture accessibility verify bench stress lint lint-python lint-scripts lint-types lint-floors clean setup sweep gl lock newest lowest release FORCE

help:
	@echo 'make report    the atlas, the paper on trial, the guide and a summary, as pages and PDF: build/report/atlas/index.html'
	@echo 'make test      lint, types, imports and tests'
	@echo 'make figures   every figure as SVG, PDF and PNG in build/figures'
	@echo 'make build/figures/NAME.svg|pdf|png   one figure;   make picture   the picture of the README'
	@echo 'make verify    the proofs about the paper'"'"'s equations'
	@echo 'make bench     error against time;   make stress   the worst errors found, and 10 000 calls with extreme inputs'
	@echo 'make accessibility   the linter axe-core on every page, the search box and what turns, in Chromium: needs node and npm; FRAMES=1 tells frames a second'
	@echo 'make newest    the unit tests with the newest libraries that the ranges allow;   make lowest   with the oldest'
	@echo 'make sweep     Parquet and Dask, for large tables'
	@echo 'make release TAG=v0.2.0   the sdist and the wheel of a tag, in dist/'
	@echo 'make lint      ruff, deno (for scripts), mypy, import-linter;   make clean   removes build/'

# What the report is made from; with nothing changed, make ends without starting Python.
SOURCES := $(shell find atlas figures templates reports -type f -not -path '*/__pycache__/*' -not -name '.*' 2>/dev/null)
MADE    := build/report/.made
BODY    := build/report/.toutatis

report: $(MADE) $(BODY)
	@echo build/report/atlas/index.html
	@echo build/report/atlas.pdf
	@echo build/report/trial.pdf
	@echo build/report/summary.pdf
	@echo build/report/guide/index.html

# What is installed may bring a GL library or take it away; so may the variable ATLAS_GL, which stands in the stamp.
GL      := $(wildcard /etc/ld.so.cache /usr/lib/*/dri /usr/share/glvnd/egl_vendor.d)
THERE   := $(wildcard build/report/atlas.pdf)$(wildcard build/report/trial.pdf)$(wildcard build/report/atlas/index.html)
STAMP   := build/report/atlas.pdfbuild/report/trial.pdfbuild/report/atlas/index.html gl=$(ATLAS_GL)

ANEW    := $(if $(filter-out $(THERE) $(shell cat $(MADE) 2>/dev/null),$(STAMP)),FORCE)

$(MADE): $(VENV)/.ready $(SOURCES) $(GL) $(ANEW)
	@$(ATLAS) report atlas trial guide summary >/dev/null
	@echo 'gl=$(ATLAS_GL)' >$@

# The report of a body, which the texts of the others do not change.
$(BODY): $(VENV)/.ready $(filter-out reports/%.md,$(SOURCES)) $(GL) $(ANEW)
	@$(ATLAS) report your_body --from toutatis >/dev/null
	@touch $@

figures: setup
	@$(ATLAS) figure --all

# The film of the README: one precession of a closed motion.
picture: setup
	@$(BIN)/python -c "import atlas; atlas.Hyperbola(0.5, (1.0, 1.2)).closed(1, 1).animate().save('reports/data/precession.gif', writer='pillow', fps=20, dpi=90)"
	@echo reports/data/precession.gif

build/figures/%: FORCE | setup
	@$(ATLAS) figure $(basename $*) --format $(patsubst .%,%,$(suffix $*))

verify: setup
	@$(ATLAS) verify --record

bench: $(VENV)/.bench
	@cd tests && env -u OPENBLAS_CORETYPE ../$(BIN)/python -m benchmarks.run   # so that OpenBLAS chooses the kernels of this processor

stress: $(VENV)/.test $(VENV)/.bench
	@$(BIN)/python -m pytest -n $(JOBS) --dist worksteal -m slow
	@cd tests && ../$(BIN)/python -m stress --record --anew
	@cd tests && for kind in $(KINDS); do OPENBLAS_CORETYPE=$$kind ../$(BIN)/python -m stress --record || test $$? -gt 127; done   # beyond 127: no such instructions here
	@cd tests && ../$(BIN)/python -m stress --arrays
	@cd tests && ../$(BIN)/python -m stress.integrated_tops   # against heyoka
	@cd tests && ../$(BIN)/python -m stress.scalars   # against formulas in mpmath
	@cd tests && ../$(BIN)/python -m stress.three_moments   # an hour
	@HYPOTHESIS_PROFILE=hunt FUZZ_EXAMPLES=$(FUZZ_EXAMPLES) $(BIN)/python -m pytest -n $(JOBS) tests/fuzz

# Needs node, npm and Chromium; `make accessibility FIREFOX=/usr/bin/firefox-esr` looks in that Firefox, and needs Xvfb.
LOOK := $(if $(FIREFOX),xvfb-run -a )node
accessibility: report
	@mkdir -p build/accessibility && cp tests/package.json tests/package-lock.json build/accessibility
	@npm ci --silent --ignore-scripts --prefix build/accessibility
	@$(LOOK) tests/accessibility.mjs build/report/atlas build/accessibility
	@$(LOOK) tests/accessibility.mjs build/report/trial build/accessibility
	@$(LOOK) tests/accessibility.mjs build/report/guide build/accessibility
	@$(LOOK) tests/search.mjs build/report/atlas build/report/trial build/accessibility
	@$(LOOK) tests/search.mjs build/report/guide build/report/atlas build/accessibility
	@$(LOOK) tests/scenes.mjs build/report/atlas build/accessibility

# The scripts of the pages and of their tests; MiniSearch is as its authors wrote it.
SCRIPTS := $(filter-out %/minisearch.js,$(wildcard templates/html/*.js)) $(wildcard tests/*.mjs)
lint: lint-python lint-scripts lint-types lint-floors
lint-python: $(VENV)/.test
	@$(BIN)/ruff check .
	@$(BIN)/ruff check --preview --select D417,DOC102 atlas   # parameters of docstrings are those of signatures
	@$(BIN)/ruff format --check .
lint-scripts: $(VENV)/.test
	@NO_COLOR=1 $(BIN)/deno lint --quiet --no-config $(SCRIPTS)
	@NO_COLOR=1 $(BIN)/deno fmt --quiet --no-config --line-width 100 --check $(SCRIPTS)
lint-types: $(VENV)/.test
	@echo 'types, by mypy: half a minute the first time'
	@$(BIN)/mypy
lint-floors: $(VENV)/.test
	@$(BIN)/lint-imports --no-cache

test: lint
	@echo 'the tests: some minutes on two cores; make stress runs the slow ones'
	@env -u PYTHONDONTWRITEBYTECODE $(BIN)/python -m pytest -n $(JOBS) --dist worksteal -rs -m 'not slow'   # with reasons for what is skipped; without bytecode, each of their programs is compiled

# The sdist and the wheel of a tag, from what the tag holds and nothing else.
release: $(VENV)/.test
	@test -n '$(TAG)' || { echo 'atlas: which release? make release TAG=v0.2.0' >&2; exit 2; }
	@git rev-parse -q --verify 'refs/tags/$(TAG)' >/dev/null || { echo "atlas: there is no tag $(TAG): git tag $(TAG)" >&2; exit 2; }
	@rm -rf build/release && mkdir -p build/release/source && git archive '$(TAG)' | tar -x -C build/release/source
	@cd build/release/source && version=$$(../../../$(BIN)/hatchling version) && test "v$$version" = '$(TAG)' || \
	  { echo "atlas: atlas/__init__.py of $(TAG) says version $$version" >&2; exit 2; }
	@! (cd build/release/source && grep -n 'atlas\.invalid' pyproject.toml SECURITY.md) >&2 || \
	  { echo 'atlas: these addresses are placeholders: put the real ones in their place, commit and tag again' >&2; exit 2; }
	@cd build/release/source && ../../../$(BIN)/hatchling build -d ../../../dist
	@rm -rf build/release

clean:
	rm -rf build

setup: $(VENV)/.ready

sweep: $(VENV)/.sweep

# What another program's settings would bring into ours, or send elsewhere.
unexport PYTHONPATH PYTHONHOME

# Runs a command in silence; where it fails, says in a line what could not be done, and below it what the command said.
quietly = said=$$({ $(1); } 2>&1) || { echo "atlas: $(strip $(2)):"; printf '%s\n' "$$said" | tail -n 5; exit 2; } >&2

# Installs the GL libraries that are missing, where we may; what can't be had is told by the first report.
gl:
	@said=$$($(BIN)/python -P -m atlas.gl) || exit 2; case "$$ATLAS_GL$$said" in "no GL"*apt-get*) \
	  if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then export DEBIAN_FRONTEND=noninteractive; \
	    ($(call quietly,apt-get update -qq && apt-get install -y -qq --no-install-recommends libegl1 libgl1-mesa-dri,apt-get could not install libegl1 libgl1-mesa-dri)) && \
	    echo 'installed libegl1 libgl1-mesa-dri for the shaded figures' || true; fi;; esac

# Makes a target alone: under the lock of this folder, which goes with the process. One that is not there yet needs so many MB.
alone = $(PYTHON) -I -S -c "$$ALONE" $@ $(1) $(MAKE) -s HELD=yes $@
define ALONE
import fcntl, os, shutil, sys, tempfile
target, needed, *command = sys.argv[1:]
here = os.open(".", os.O_RDONLY)
os.set_inheritable(here, True)
try:
    fcntl.flock(here, fcntl.LOCK_EX | fcntl.LOCK_NB)
except OSError:
    print("another make sets up .venv: this one waits for it", flush=True)
    fcntl.flock(here, fcntl.LOCK_EX)
disks = {os.stat(place).st_dev: place for place in (tempfile.gettempdir(), ".")}
for place in disks.values() if not os.path.exists(target) else ():
    wanted = int(needed) if place == "." else int(needed) // 3  # what is downloaded
    free = shutil.disk_usage(place).free // 10**6
    if free < wanted:
        sys.exit(f"atlas: setting up needs {wanted} MB on the disk of {os.path.abspath(place)}, where {free} MB are free")
os.execvp(command[0], command)
endef
$(VENV)/.%: export ALONE := $(ALONE)

# Runs pip with those of the user's settings, of files and of variables, that say how the index is reached, and no others.
define PIP
import ast, os, subprocess, sys
pip = [sys.executable, "-I", "-m", "pip"]
told = subprocess.run([*pip, "config", "list"], capture_output=True, text=True).stdout
kept = "index-url extra-index-url find-links no-index trusted-host cert client-cert proxy timeout default-timeout retries keyring-provider cache-dir"
settings = {name: ast.literal_eval(value) for name, _, value in (line.partition("=") for line in told.splitlines())}
own = {name: value for name, value in os.environ.items() if not name.startswith("PIP_")} | {"PIP_CONFIG_FILE": os.devnull}
for section in ("global", "install", ":env:"):
    own |= {"PIP_" + key.upper().replace("-", "_"): str(settings[name]) for key in kept.split() if settings.get(name := section + "." + key)}
os.execve(sys.executable, [*pip, *sys.argv[1:]], own)
endef
$(VENV)/.%: export PIP := $(PIP)

# Installs what locks hold by uv or by pip, and says each 8 s how far it is.
bring = echo '  the libraries of $(lastword $(1))'; log=$(VENV)/.log; : >$$log; set -- --require-hashes $(addprefix -r ,$(1)); \
  all=$$(grep -h '^[a-z].*==' $(1) | grep -vc 'sys_platform ==\|python_full_version\|implementation'); \
  ( n=0; while sleep 1 && kill -0 $$$$ 2>/dev/null; do n=$$((n + 1)); test $$((n % 8)) != 0 || \
    echo "    of about $$all, $$(grep -c '^Collecting\|^Processing' $$log) found, $$(ls -d $(VENV)/lib/python3*/site-packages/*.dist-info | wc -l) installed"; done ) & tells=$$!; \
  { command -v uv && uv pip install --python $(BIN)/python "$$@"; } >$$log 2>&1 || \
    $(BIN)/python -I -c "$$PIP" install --no-compile --disable-pip-version-check --progress-bar off "$$@" >$$log 2>&1; \
  status=$$?; kill $$tells; test $$status = 0 || { echo 'atlas: pip could not install the libraries:'; tail -n 5 $$log; exit 2; } >&2

# Gives a pip to an environment of a Python that brings none, as Debian's without python3-venv: by uv, by the pip of that
# Python, or the wheel in Debian's package python3-pip-whl, which any user can fetch where apt-get knows it.
pip = sed -n '/^pip==/,/[^\]$$/p' requirements-lock.lock >$(VENV)/pip.lock; uv pip install --python $(BIN)/python --require-hashes -r $(VENV)/pip.lock || \
  $(PYTHON) -I -c "$$PIP" --python $(BIN)/python install --require-hashes -r $(VENV)/pip.lock || { mkdir -p $(VENV)/pip && cd $(VENV)/pip && \
  { ls /usr/share/python-wheels/pip-*.whl || { apt-get download -qq python3-pip-whl && dpkg-deb -x python3-pip-whl_*.deb .; }; } && \
  for one in /usr/share/python-wheels/pip-*.whl "$$PWD"/usr/share/python-wheels/pip-*.whl; do test ! -e "$$one" || break; done && \
  ../bin/python -I "$$one/pip" install --no-index "$$one"; }

# The environment belongs to the folder that stands in .ready: one that was copied, moved or left half-made is made again,
# and one into which a copy of the checkout was installed (pip install .) is put right.
ifneq ($(shell cat $(VENV)/.ready 2>/dev/null)$(wildcard $(VENV)/lib/python3*/site-packages/atlas_charged_body-*),$(CURDIR))
$(VENV)/.ready: FORCE
endif

# The environment finds the checkout by checkout.pth, which names a folder with nothing but a link to atlas/: a relative
# path, so that it holds in any encoding and in a copy; and pip, which installs into site-packages, writes nothing there.
$(VENV)/.ready: pyproject.toml requirements.lock
ifndef HELD
	@said=$$($(PYTHON) -I -S -c 'import sys; print(sys.version.split()[0]); sys.exit(sys.hexversion < 0x30b0000)' 2>&1) || \
	  { echo "atlas needs Python 3.11 or newer; $(PYTHON) says: $$said. Another one: make PYTHON=/path/to/python3.11" >&2; exit 2; }
	@$(call alone,$(MB))
else
	@said=$$($(PYTHON) -I -c 'import ensurepip, venv' 2>&1) || case "$$said" in \
	  *"No module named 'ensurepip'"*|*"No module named 'venv'"*) \
	    if [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null; then echo 'installing python3-venv'; \
	      $(call quietly,apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq python3-venv,apt-get could not install python3-venv); fi;; \
	  *) echo "atlas: $(PYTHON) does not start:" >&2; printf '%s\n' "$$said" | tail -n 5 >&2; exit 2;; esac
	@test "$$(cat $@ 2>/dev/null)" = "$$(pwd -P)" || rm -rf $(VENV)
	@rm -f $@ $(VENV)/lib/python3*/site-packages/atlas 2>/dev/null || true   # a link, of older checkouts
	@test -d $(VENV) || { echo 'setting up .venv, once: 1.2 GB on disk'; echo '  a virtual environment'; \
	  if $(PYTHON) -I -c 'import ensurepip, venv' 2>/dev/null; then $(call quietly,$(PYTHON) -I -m venv $(VENV),the virtual environment could not be made); \
	  else { { $(PYTHON) -I -m venv --without-pip $(VENV) || uv venv --python $(PYTHON) $(VENV); } && ( $(pip) ); } >/dev/null 2>&1 || \
	    { rm -rf $(VENV); echo 'atlas: this Python has no venv; install it: sudo apt-get install python3-venv' >&2; exit 2; }; fi; }
	@$(call bring,requirements.lock)
	@if [ -n "$$(echo $(VENV)/lib/python3*/site-packages/atlas_charged_body-*/RECORD | grep -v '\*')" ]; then $(call quietly,$(BIN)/python -I -c "$$PIP" uninstall -q -y atlas-charged-body,pip could not remove its copy of the checkout); fi
	@mkdir -p $(VENV)/checkout && ln -sfn ../../atlas $(VENV)/checkout/atlas
	@$(BIN)/python -I -c 'import pathlib, sysconfig; (pathlib.Path(sysconfig.get_path("purelib")) / "checkout.pth").write_text("../../../checkout\n")'
	@printf '#!/bin/sh\n# The program of the checkout in whose .venv this stands, and of its libraries alone.\nunset PYTHONPATH PYTHONHOME\nbin="$$(dirname -- "$$(readlink -f -- "$$0")")"\nset -- "$$bin/python" -P "$$bin/../checkout/atlas/__main__.py" "$$@"\n# while Python starts, Ctrl-C waits, where this env can do that: atlas/__main__.py heeds it\nenv --block-signal=INT true 2>/dev/null && set -- env --block-signal=INT "$$@"\nexec "$$@"\n' >$(ATLAS) && chmod +x $(ATLAS)
	@echo '  GL libraries for shaded figures' && $(MAKE) -s gl
	@env -u PYTHONDONTWRITEBYTECODE $(BIN)/python -P -c 'from atlas.places import settle_matplotlib; settle_matplotlib(); import fontTools.subset, fontTools.ttLib.tables.otTables, matplotlib.figure, matplotlib._constrained_layout, matplotlib.backends.backend_pdf, matplotlib.backends.backend_svg, pyvista, scipy.optimize, atlas.cli.fit, atlas.fitting'   # writes their bytecode, without which each worker compiles them for 1.5 s, and each fit for 1.3 s
	@pwd -P >$@
endif

# What sweeps (Parquet, Dask), the tests, the benchmark and the locks need beside: each brought by its target.
$(VENV)/.test: $(VENV)/.sweep
$(VENV)/.%: requirements-%.lock $(VENV)/.ready
ifndef HELD
	@$(call alone,500)
else
	@( $(call bring,requirements.lock $<) )$(if $(filter bench,$*), || echo 'heyoka could not be installed: the benchmark goes on without that peer')
	@touch $@
endif

# Rewrites the locks from pyproject.toml with the newest versions, for every Python from 3.11 up; `make lock RENEW=` keeps
# those that they have. A lock beside requirements.lock holds what is not in that one.
RENEW = --upgrade
COMPILE = $(BIN)/uv pip compile -q --universal --python-version 3.11 --no-header --no-annotate pyproject.toml
lock: | $(VENV)/.lock
	@mkdir -p build/lock && grep -h '==' requirements*.lock | sed 's/ *\\$$//' | sort -u >build/lock/all
	@$(COMPILE) $(RENEW) --all-extras -o build/lock/all
	@$(COMPILE) --generate-hashes -c build/lock/all -o requirements.lock
	@for extra in sweep test bench lock; do \
	  $(COMPILE) --generate-hashes -c build/lock/all --extra $$extra -o build/lock/$$extra && \
	  awk 'function pin() { if (more && !(all in there)) printf "%s", all; there[all]; all = ""; more = FNR < NR } \
	    /^[a-z]/ { pin() } { all = all $$0 "\n" } END { pin() }' requirements.lock build/lock/$$extra >requirements-$$extra.lock || exit 2; done

# The unit tests with the newest and with the lowest versions that the ranges of pyproject.toml allow.
RANGE_newest = highest
RANGE_lowest = lowest-direct
newest lowest: | $(VENV)/.lock
	@rm -rf build/$@ && $(PYTHON) -I -m venv build/$@
	@$(BIN)/uv pip install -q --python build/$@/bin/python --resolution $(RANGE_$@) -r pyproject.toml --extra test --extra sweep
	@build/$@/bin/python -I -c 'import pathlib, sysconfig; (pathlib.Path(sysconfig.get_path("purelib")) / "checkout.pth").write_text("../../../../../.venv/checkout\n")'
	@build/$@/bin/python -m pytest -n $(JOBS) tests/unit
