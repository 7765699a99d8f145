# SPDX-License-Identifier: MIT
# make run and make test are the two commands; make help lists what else a user needs, make help-all the rest.
# GNU make reads the next three lines as "if the variable NEVER: is set", which it is not; BSD make stops at the second.
ifdef NEVER:
.error This Makefile needs GNU make; on BSD systems: gmake
endif

CC ?= cc
CXX ?= c++
CFLAGS ?= -O2
LDLIBS ?= -llapack -lblas
B ?= build
# Small matrices: threads of OpenBLAS would wait for each other on a busy machine.
export OPENBLAS_NUM_THREADS ?= 1
ifneq ($(words $(B)),1)
$(error B, the folder to build in, takes a name without spaces, not '$(B)')
endif
ifeq ($(origin FC),default)
FC = gfortran
endif

WARN = -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wmissing-prototypes -Werror
COMPILE = $(CC) -std=c99 $(WARN) $(CFLAGS) $(CPPFLAGS) -I.
LINK = $(LDFLAGS) $(LDLIBS) -lm

HEADERS = waveform.h iqn.h rk.h
TESTS = $(patsubst tests/%.c,$(B)/%,$(wildcard tests/test_*.c))
SCENES = $(patsubst examples/%.c,$(B)/%,$(filter-out examples/mpi.c,$(wildcard examples/*.c))) $(B)/masses
SCRIPTS = $(addprefix tests/scripts/,compile.sh outside.sh host_check.sh snippets.sh documents.sh figures.sh vectors.sh install.sh same.sh scenes.sh table.sh page.sh mpi.sh)

# Second sources and peers, where they are installed.
has = $(shell printf '\043include <$(1)>\n' | $(CC) -E -x c - >/dev/null 2>&1 && echo yes)
PEERS = $(if $(call has,gsl/gsl_version.h),-DHAVE_GSL) $(if $(call has,sundials/sundials_config.h),-DHAVE_SUNDIALS)
PEER_LIBS = $(if $(findstring GSL,$(PEERS)),-lgsl) \
            $(if $(findstring SUNDIALS,$(PEERS)),-lsundials_arkode -lsundials_kinsol -lsundials_nvecserial)

# make run and make test install what they lack, and say so before; any other target only with INSTALL=1.
REQUIRE = CC="$(CC)" LDLIBS="$(LDLIBS)" INSTALL="$(INSTALL)" sh tests/scripts/require.sh

# Builds run side by side, unless the -j of the command line says how many.
JOBS ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
SIDE = $(if $(findstring jobserver,$(MAKEFLAGS)),,-j $(JOBS))

.PHONY: help help-all run test table cases hosts page pagetest wheel scenes lapack lists clean

help: # what a user needs: the targets with ##; the others have ###
	@sed -n 's/^\([a-z]*\):.* ## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST)
	@echo '  make help-all	the other targets: checks, studies, measurements'

help-all:
	@sed -n 's/^\([a-z]*\):.* ###* \(.*\)/\1\t\2/p' $(MAKEFILE_LIST) | expand -t 14 | sed 's/^/  make /'

run: INSTALL = 1
run: ## two scenes beside exact and published answers; pictures into build/
	@$(REQUIRE) cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(B)/oscillator $(B)/tube
	@B=$(B) sh examples/run.sh

test: INSTALL = 1
test: ## every test that takes seconds
	@$(REQUIRE) cc c++ lapack cmocka prove mpi? sundials? gsl?
	@$(MAKE) --no-print-directory $(SIDE) $(TESTS) scenes
	@B=$(B) CC="$(CC)" CXX="$(CXX)" LDLIBS="$(LDLIBS)" CMOCKA_MESSAGE_OUTPUT=TAP prove -j $(JOBS) -e 'sh tests/scripts/tap.sh' $(TESTS) $(SCRIPTS)

table: $(B)/table ## a Butcher table typed in, FILE=mine.txt: its order, stability, dense output, and C to paste
	@$(if $(FILE),$(B)/table $(FILE),echo 'built; now: $(B)/table FILE, or make table FILE=...')

cases: scenes # the published cases, in full: minutes
	@B=$(B) prove -v -e '' tests/scripts/cases_heat.sh

scenes: $(SCENES) $(if $(shell command -v mpicc),$(if $(wildcard examples/mpi.c),$(B)/mpi)) ### build the examples

hosts: ## hosts in other languages and around other codes, as far as those are installed
	@$(REQUIRE) cc prove c++? gfortran? numpy? venv? sundials? gsl? pkg-config? petsc? opencl? unzip? ngspice? openfoam? calculix? octave? dolfinx? gpaw?
	@B=$(B) CC="$(CC)" CXX="$(CXX)" FC="$(FC)" CFLAGS="$(CFLAGS)" prove -v -e '' examples/hosts/run.sh

page: ## build/page.html: the trade of speed for accuracy to play with, in one file that works offline
	@$(REQUIRE) cc clang lld wasi-libc
	@$(MAKE) --no-print-directory $(B)/page.html
	@echo "$(B)/page.html: $$(wc -c <$(B)/page.html) bytes; open it in a browser"

pagetest: ### the page under node and in Chromium beside the same program for a terminal; pictures into build/page
	@$(REQUIRE) cc clang lld wasi-libc nodejs chromium?
	@$(MAKE) --no-print-directory $(B)/masses $(B)/page.html
	@CC="$(CC)" prove -v -e node tests/page/page_test.mjs :: $(B)

wheel: ## kit.py with its library as a Python wheel, without network: $(B)/waveform_iqn_rk-*.whl
	@$(REQUIRE) cc numpy
	@mkdir -p $(B) && for p in python3 /usr/bin/python3; do $$p -c 'import numpy' 2>/dev/null && break; done; \
	   CC="$(CC)" $$p examples/hosts/wheel.py $(B)

lists: ### put the list at the end of each test file into the order of its tests
	@$(REQUIRE) python3
	@python3 tests/scripts/lists.py

clean: ### remove what was built
	rm -rf $(B)

lapack: # what every scene needs, asked once before the first is built
	@$(REQUIRE) cc lapack

$(B):
	@mkdir -p $@

$(B)/test_stability: tests/stability.h
$(B)/test_%: tests/test_%.c tests/check.h tests/column_at.h $(HEADERS) | $(B)
	$(COMPILE) $(PEERS) -o $@ $< -lcmocka $(PEER_LIBS) $(LINK)

$(addprefix $(B)/,table bounce gark manufactured multirate rates test_rk test_stability fuzz_rk study_rk study_flags): examples/rk_proof.h
$(B)/adaptive: $(wildcard examples/adaptive_*.h)
$(B)/oscillator: examples/oscillator.h

$(B)/mpi: examples/mpi.c examples/scene.h $(HEADERS) | $(B)
	OMPI_CC="$(CC)" mpicc -std=c99 $(filter-out -Wpedantic,$(WARN)) $(CFLAGS) $(CPPFLAGS) -I. -o $@ $< $(LINK)

# The page: the same program for a terminal and, without crt, imports and file system, for a browser.  Bits must be equal.
PAGE = examples/page
SAME = -fno-fast-math -ffp-contract=off -I$(PAGE)/..
$(B)/masses: $(PAGE)/masses.c examples/oscillator.h $(HEADERS) | $(B)
	$(COMPILE) $(SAME) -o $@ $< -lm
$(B)/masses.wasm: $(PAGE)/masses.c examples/oscillator.h $(HEADERS) | $(B)
	clang --target=wasm32-wasi -std=c99 $(WARN) -Os -DRK_STATIC $(SAME) -I. -nostdlib -o $@ $< -lc \
	   -Wl,--no-entry,--strip-all,-z,stack-size=65536,--export=run,--export=setting_start,--export=list_start,--export=list_length,--export=wf_message,--export=iqn_message
$(B)/page.html: $(B)/masses.wasm $(wildcard $(PAGE)/*.* $(PAGE)/../ACCURACY.md)
	@sh $(PAGE)/build.sh $(abspath $(B)) >$@.part
	@[ $$(wc -c <$@.part) -lt 204800 ] || { echo "$@: 204800 bytes at most"; exit 1; }
	@mv $@.part $@

$(B)/%: examples/%.c examples/scene.h $(HEADERS) | $(B) lapack
	$(COMPILE) -o $@ $< $(LINK)

include tests/make/checks.mk tests/make/bench.mk tests/make/study.mk
