# SPDX-License-Identifier: MIT
# make bench: speed beside floors written by hand and the peers installed.  Included by the Makefile.
BENCHES = $(addprefix $(B)/bench_,iqn rk waveform host $(if $(has_openmp),threads))
FLOORFLAGS ?= -O3 -march=native -ffast-math

has_odeint = $(shell printf '\043include <boost/numeric/odeint.hpp>\n' | $(CXX) -std=c++17 -E -x c++ - >/dev/null 2>&1 && echo yes)
has_openmp = $(shell echo 'int main(void) { return 0; }' | $(CC) -fopenmp -x c -o /dev/null - 2>/dev/null && echo yes)
has_petsc = $(shell command -v mpicc >/dev/null && pkg-config petsc 2>/dev/null && echo yes)

.PHONY: bench bench_programs
bench: ### speed as ratios to floors and peers, growth, memory, size; which goals are not met: five minutes; ONLY="iqn rk": a part; OLD=folder: beside the headers there
	@CXX="$(CXX)" $(REQUIRE) cc gsl? sundials? odeint? petsc? scipy?
	@$(MAKE) --no-print-directory bench_programs
	@$(if $(ONLY),,rm -rf $(B)/bench)
	@B=$(B) CC="$(CC)" CFLAGS="$(CFLAGS)" $(if $(OLD),BENCH_OLD="$(OLD)") sh tests/bench/bench.sh $(ONLY)

# The same programs with the headers in OLD, 0.2.0 or later (mkdir old; git archive 776872c~1 | tar -x -C old), whatever OLD was before,
# and with those here, compiled alike
OLD_BENCHES = $(if $(OLD),$(addprefix $(B)/bench_,iqn_old rk_old waveform_old))
THIS_BENCHES = $(OLD_BENCHES:_old=_this)
.PHONY: $(OLD_BENCHES) $(THIS_BENCHES)
bench_programs: $(BENCHES) $(OLD_BENCHES) $(THIS_BENCHES) $(if $(has_odeint),$(B)/peer_odeint) $(if $(has_petsc),$(B)/peer_petsc)

$(B)/bench_%: tests/bench/bench_%.c $(B)/floors.o tests/bench/bench.h tests/bench/floors.h tests/bench/peer_sundials.h $(HEADERS) | $(B)
	$(COMPILE) $(PEERS) -o $@ $< $(B)/floors.o $(PEER_LIBS) -lm

$(OLD_BENCHES): $(B)/bench_%_old: tests/bench/bench_%.c $(B)/floors.o | $(B)
	$(COMPILE) -w -iquote "$(OLD)" -o $@ $< $(B)/floors.o -lm
$(THIS_BENCHES): $(B)/bench_%_this: tests/bench/bench_%.c $(B)/floors.o | $(B)
	$(COMPILE) -w -iquote . -o $@ $< $(B)/floors.o -lm

$(B)/bench_threads: override CFLAGS += -fopenmp
$(B)/floors.o: tests/bench/floors.c tests/bench/floors.h | $(B)
	$(CC) -std=c99 $(WARN) $(FLOORFLAGS) -c -o $@ $<

$(B)/peer_odeint: tests/bench/peer_odeint.cc tests/bench/bench.h | $(B)
	$(CXX) -std=c++17 -O3 -march=native -o $@ $<

$(B)/peer_petsc: tests/bench/peer_petsc.c tests/bench/bench.h | $(B)
	OMPI_CC="$(CC)" mpicc -O2 -o $@ $< $$(pkg-config --cflags --libs petsc) -lm

.PHONY: figures
figures: ### write what make bench, make study and the scenes have measured into the documents
	@$(REQUIRE) python3
	@$(MAKE) --no-print-directory scenes $(B)/peer_rk
	@OPENBLAS_NUM_THREADS=1 python3 tests/scripts/figures.py $(B)
