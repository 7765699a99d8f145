# SPDX-License-Identifier: MIT
# make study: what accuracy costs.  Included by the Makefile, at its end.
STUDIES = $(patsubst tests/study/%.c,$(B)/%,$(wildcard tests/study/study_*.c))

# Each part is a target of its own, too, and takes the words that stand at it.
PARTS = curves onenumber converges arena loops promises delayed public scipy rules cases
PART ?= curves
.PHONY: study curves arena onenumber
study: ### what is measured, PART="arena loops": one part or several; curves alone without; PART=all: hours
	@$(foreach part,$(filter-out $(PARTS) all,$(PART)),echo 'make study: no part $(part); there are: $(PARTS)'; exit 2;)
	@$(foreach part,$(if $(filter all,$(PART)),$(PARTS),$(PART)),$(MAKE) --no-print-directory $(part) && ):

curves: # what accuracy costs: curves, maps and the recommendation, minutes; CSV and pictures in build/study
	@$(REQUIRE) cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(STUDIES) $(B)/tube $(B)/manufactured $(B)/rates
	@B=$(B) CC="$(CC)" sh tests/study/study.sh

# PROBLEMS: all, or some of them, without picture; SEARCH=all or some: search their fixed set-ups anew, minutes;
# CERTIFY="11 12": judge the bound of the error and its sources with these starts and rates, 10 minutes
onenumber: # the run that takes one number against the best fixed set-ups: table, picture, figures; a minute, SEARCH=all: minutes
	@$(REQUIRE) cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(B)/study_one_number $(B)/adaptive
	@B=$(B) JOBS=$(JOBS) SEARCH="$(SEARCH)" CERTIFY="$(or $(CERTIFY),11)" sh tests/study/one_number.sh $(PROBLEMS)

.PHONY: converges card
converges: # where the coupling of the tube stops converging, by either unknown: a map of 238 cells, two minutes
	@$(REQUIRE) cc lapack
	@$(MAKE) --no-print-directory $(B)/tube
	@B=$(B) JOBS=$(JOBS) sh tests/study/converges.sh
	@$(MAKE) --no-print-directory card

card: ### tables and pictures of examples/ACCURACY.md from what make onenumber and make converges have left in tests/study
	@$(REQUIRE) python3 gnuplot
	@python3 tests/study/card.py $(B)/study/card
	@python3 tests/scripts/figures.py $(B) card blind facts restricted restricted-all one one-all one-cells converges

$(B)/study_one_number: $(wildcard examples/adaptive_*.h)
$(B)/study_iqn: examples/tube.c
$(B)/study_rk: tests/stability.h
$(B)/study_%: tests/study/study_%.c tests/study/study.h examples/scene.h $(HEADERS) | $(B)
	$(COMPILE) -o $@ $< $(LINK)

ARENA_FILES = $(wildcard tests/study/arena*.[ch] tests/study/loops*.[ch]) examples/tube.c examples/scene.h $(HEADERS)
# OLD: a file with another version of iqn.h, or a folder with iqn.h in it.  AA: the folder of the sources of cvxgrp/aa
OLD_FILE = $(if $(wildcard $(OLD)/iqn.h),$(OLD)/iqn.h,$(OLD))
AA_FLAGS = $(if $(AA),-DAA -I$(AA)/include)
AA_PARTS = $(if $(AA),$(B)/aa.o)

# SEED: any word makes the seeds, and nobody tunes on yours; judge and dev: those of 0.2.0; several: their mean, too, for
# which tubes and maps of tanh stop is chance.  ARENA: full, quick, or alone (full, but no rivals: 15 seconds a word).
# OLD: another version of iqn.h, whose defaults run beside
ARENA ?= full
GROUPS ?= # all; or some of: charge linear tube heat bodies told synthetic
arena: SEED = judge
arena: # the defaults of iqn.h beside other settings and accelerators on many fixed points, minutes; SEED=word ARENA=quick OLD=old/iqn.h
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/scripts/require.sh cc lapack
	@$(MAKE) --no-print-directory $(B)/arena$(if $(OLD),_old)
	@mkdir -p $(B)/study
	@for word in $(SEED); do \
	   { $(B)/arena$(if $(OLD),_old) $(B) $(ARENA) $$word $(GROUPS); echo $$? >$(B)/arena.status; } | \
	      tee $(B)/study/arena-$(ARENA)-$$word$(if $(strip $(GROUPS)),-part).txt; [ "$$(cat $(B)/arena.status)" = 0 ] || exit 1; \
	done $(if $(word 2,$(SEED)),| $(MEAN_OF_WORDS))
MEAN_OF_WORDS = awk '/^runs that fail/ {print; sum += $$4; n++} END {printf "mean of %d words: %.1f\n", n, sum / n}'

.PHONY: rules
rules: # what each rule of iqn.h buys: arena and hosts' own loops without it, half an hour; NAMES=part of a row's name
	@$(REQUIRE) cc lapack
	@mkdir -p $(B)/study
	@B=$(B) CC="$(CC)" LDLIBS="$(LDLIBS)" python3 tests/study/rules.py $(if $(NAMES),-n '$(NAMES)',| tee $(B)/study/rules.txt)

# The defaults beside hosts' own loops.  With AA: cvxgrp/aa, too
.PHONY: loops
loops: SEED = dev
# KINDS: all, or some of "aquifer", "classes", ...; several words of SEED: their sum, too
loops: # hosts' own loops, and maps with several fixed points: iqn.h beside damping, Aitken, Anderson; SEED=word OLD=old/iqn.h AA=folder
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/scripts/require.sh cc lapack
	@$(MAKE) --no-print-directory $(B)/loops$(if $(OLD),_old)
	@$(if $(AA),,echo 'cvxgrp/aa is left out: AA=folder gives its sources')
	@mkdir -p $(B)/study
	@for word in $(SEED); do \
	   { $(B)/loops$(if $(OLD),_old) $$word $(KINDS); echo $$? >$(B)/loops.status; } | tee $(B)/study/loops-$$word$(if $(KINDS),-part)$(if $(OLD),-old).txt; \
	   [ "$$(cat $(B)/loops.status)" = 0 ] || exit 1; \
	done $(if $(word 2,$(SEED)),| $(SUM_OF_WORDS))
# "loops of hosts, NAME above 1.1: A of N (worst W); given up: G of M windows; ..." of all words
SUM_OF_WORDS = awk '{print} /^loops of hosts/ {name = $$0; sub(/ *above.*/, "", name); split($$0, part, "1.1: "); split(part[2], n, " "); \
   split($$0, part, "given up: "); split(part[2], m, " "); if (!(name in above)) order[++count] = name; \
   above[name] += n[1]; hosts[name] += n[3]; up[name] += m[1]; windows[name] += m[3]} \
   END {for (i = 1; i <= count; i++) printf "all words: %s above 1.1: %d of %d; given up: %d of %d windows\n", \
   order[i], above[order[i]], hosts[order[i]], up[order[i]], windows[order[i]]}'

.PHONY: promises
promises: SEED = dev
promises: # springs with stops, rings of fields, units far apart, closed volumes: right and wrong endings; SEED=word OLD=old/iqn.h
	@CC="$(CC)" sh tests/scripts/require.sh cc
	@$(MAKE) --no-print-directory $(B)/study_promises $(if $(OLD),$(B)/study_promises_old)
	@mkdir -p $(B)/study
	@for word in $(SEED); do $(B)/study_promises $$word $(ONLY) | tee $(B)/study/promises-$$word$(if $(ONLY),-part).txt; \
	   $(if $(OLD),echo 'with $(OLD)'; $(B)/study_promises_old $$word $(ONLY);) done
.PHONY: $(B)/study_promises_old # whatever OLD was before
$(B)/study_promises_old: tests/study/study_promises.c tests/study/arena.h $(OLD_FILE)
	@mkdir -p $(B)/old/as_it_is
	@cp $(OLD_FILE) $(B)/old/as_it_is/iqn.h
	$(CC) -std=c99 $(WARN) $(CFLAGS) $(CPPFLAGS) -I$(B)/old/as_it_is -o $@ $< -lm
$(B)/study_promises: tests/study/arena.h
$(B)/study_promises $(B)/study_promises_old: CPPFLAGS += -Wno-unused-function # of arena.h it takes a part

# PETSc asks for the compiler of MPI; what is not installed is left out, with a sentence.
.PHONY: public
public: # fixed points from papers and public examples: iqn.h beside numpy, KINSOL, PETSc, SciPy, aa; a minute; OLD=old/iqn.h AA=folder
	@$(REQUIRE) cc numpy? sundials? petsc?
	@mkdir -p $(B)/study
	@$(MAKE) --no-print-directory $(B)/public.so $(if $(OLD),$(B)/public_old.so)
	@for python in python3 /usr/bin/python3; do if $$python -c 'import scipy' 2>/dev/null; then \
	   $$python tests/study/study_public.py $(B)/public.so $(if $(OLD),$(B)/public_old.so) | tee $(B)/study/public.txt; exit; fi; done; echo 'skipped: SciPy is not installed (Debian: python3-scipy)'
PETSC = $(if $(shell command -v mpicc),$(shell pkg-config --cflags --libs petsc 2>/dev/null))
PUBLIC = $(if $(PETSC),OMPI_CC="$(CC)" mpicc,$(CC)) -std=c99 $(CFLAGS) -shared -fPIC
.PHONY: $(B)/public.so $(B)/public_old.so # whatever OLD and AA were before
$(B)/public.so: tests/study/public_rivals.c iqn.h $(AA_PARTS) | $(B)
	$(PUBLIC) -I. $(AA_FLAGS) $(if $(PETSC),-DHAVE_PETSC) $(if $(findstring SUNDIALS,$(PEERS)),-DHAVE_KINSOL) -o $@ $< $(AA_PARTS) $(PETSC) \
	   $(if $(findstring SUNDIALS,$(PEERS)),-lsundials_kinsol -lsundials_nvecserial) $(LINK)
$(B)/public_old.so: tests/study/public_rivals.c $(OLD_FILE)
	@mkdir -p $(B)/old/as_it_is
	@cp $(OLD_FILE) $(B)/old/as_it_is/iqn.h
	$(CC) -std=c99 $(CFLAGS) -shared -fPIC -I$(B)/old/as_it_is -o $@ $< -lm

.PHONY: delayed
delayed: SEED = dev
delayed: # delayed pairs (iqn_delay) in jobs with sub-steps: evaluations with and without; SEED=word
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/scripts/require.sh cc lapack
	@if grep -q iqn_delay iqn.h; then $(MAKE) --no-print-directory $(B)/delayed && mkdir -p $(B)/study && \
	   for word in $(SEED); do $(B)/delayed $$word | tee $(B)/study/delayed-$$word.txt; done; \
	   else echo 'skipped: this iqn.h has no iqn_delay'; fi
$(B)/delayed: tests/study/delayed.c $(wildcard tests/study/arena*.h) examples/tube.c examples/scene.h $(HEADERS) | $(B)
	$(COMPILE) -Wno-unused-function -o $@ $< $(LINK)

$(B)/arena: $(ARENA_FILES) | $(B)
	$(COMPILE) -o $@ tests/study/arena.c $(LINK)

.PHONY: $(B)/loops $(B)/aa.o # whatever AA was before
$(B)/loops: $(ARENA_FILES) $(AA_PARTS) | $(B)
	$(COMPILE) $(AA_FLAGS) -o $@ tests/study/loops.c $(AA_PARTS) $(LINK)
$(B)/aa.o: $(AA)/src/aa.c | $(B)
	$(CC) -O2 -w -fPIC -I$(AA)/include -c -o $@ $<
.PHONY: $(B)/arena_old $(B)/loops_old # whatever OLD was before
$(B)/arena_old $(B)/loops_old: $(B)/%_old: $(ARENA_FILES) $(AA_PARTS) $(OLD_FILE)
	@mkdir -p $(B)/old
	@sed 's/iqn/iqnold/g; s/IQN/IQNOLD/g' $(OLD_FILE) >$(B)/old/iqnold.h
	@sed 's/iqn/iqnold/g; s/IQN/IQNOLD/g' tests/study/arena_kit.h >$(B)/old/iqnold_kit.h
	$(COMPILE) -DOLD $(AA_FLAGS) -I$(B)/old -o $@ tests/study/$*.c $(AA_PARTS) $(LINK)

.PHONY: scipy
scipy: # adaptive runs of bs3, dp5 and dop853, and stiff ones: evaluations beside SciPy's at equal tolerance; two minutes
	@$(REQUIRE) cc lapack
	@$(MAKE) --no-print-directory $(B)/peer_rk $(B)/stiff
	@mkdir -p $(B)/study
	@for python in python3 /usr/bin/python3; do if $$python -c 'import scipy' 2>/dev/null; then \
	   $(B)/peer_rk | $$python tests/study/peer_rk.py && \
	   for r in 1e-3 1e-6 1e-9; do $(B)/stiff --rtol $$r; done | $$python tests/study/peer_stiff.py >$(B)/study/stiff.txt; \
	   status=$$?; cat $(B)/study/stiff.txt; exit $$status; fi; done; $(B)/peer_rk; echo 'skipped: SciPy is not installed (Debian: python3-scipy)'

$(B)/peer_rk: tests/study/peer_rk.c rk.h | $(B)
	$(COMPILE) -o $@ $< -lm
