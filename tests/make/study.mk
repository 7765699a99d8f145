# SPDX-License-Identifier: MIT
# make study: what accuracy costs.  Included by the Makefile, at its end.
STUDIES = $(patsubst tests/study/%.c,$(B)/%,$(wildcard tests/study/study_*.c))

.PHONY: study arena onenumber
study: ### what accuracy costs: curves, maps and the recommendation, minutes; CSV and pictures in build/study
	@$(REQUIRE) cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(STUDIES) $(B)/tube $(B)/manufactured $(B)/rates
	@B=$(B) CC="$(CC)" sh tests/study/study.sh

# PROBLEMS: all, or some of them, without picture; SEARCH=all or some: search their fixed set-ups anew, minutes
onenumber: ### the run that takes one number against the best fixed set-ups: table, picture, figures; a minute, SEARCH=all: minutes
	@$(REQUIRE) cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(B)/study_one_number $(B)/adaptive
	@B=$(B) SEARCH="$(SEARCH)" sh tests/study/one_number.sh $(PROBLEMS)

$(B)/study_one_number: $(wildcard examples/adaptive_*.h)
$(B)/study_iqn: examples/tube.c
$(B)/study_rk: tests/stability.h
$(B)/study_%: tests/study/study_%.c tests/study/study.h examples/scene.h $(HEADERS) | $(B)
	$(COMPILE) -o $@ $< $(LINK)

# SEED: any word makes the seeds, and nobody tunes on yours; judge and dev: those of 0.2.0; several: their mean, too, for
# which tubes and maps of tanh stop is chance.  ARENA: full, quick, or alone (full, but no rivals: 15 seconds a word).
# OLD: a file with another version of iqn.h, whose defaults run beside
ARENA ?= full
GROUPS ?= # all; or some of: charge linear tube heat bodies told synthetic
arena: SEED = judge
arena: ### the defaults of iqn.h beside other settings and accelerators on many fixed points, minutes; SEED=word ARENA=quick OLD=old/iqn.h
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/scripts/require.sh cc lapack
	@$(MAKE) --no-print-directory $(B)/arena$(if $(OLD),_old)
	@mkdir -p $(B)/study
	@for word in $(SEED); do \
	   { $(B)/arena$(if $(OLD),_old) $(B) $(ARENA) $$word $(GROUPS); echo $$? >$(B)/arena.status; } | \
	      tee $(B)/study/arena-$(ARENA)-$$word$(if $(strip $(GROUPS)),-part).txt; [ "$$(cat $(B)/arena.status)" = 0 ] || exit 1; \
	done $(if $(word 2,$(SEED)),| $(MEAN_OF_WORDS))
MEAN_OF_WORDS = awk '/^runs that fail/ {print; sum += $$4; n++} END {printf "mean of %d words: %.1f\n", n, sum / n}'

ARENA_FILES = $(wildcard tests/study/arena*.[ch]) examples/tube.c examples/scene.h $(HEADERS)
$(B)/arena: $(ARENA_FILES) | $(B)
	$(COMPILE) -o $@ tests/study/arena.c $(LINK)
.PHONY: $(B)/arena_old # whatever OLD was before
$(B)/arena_old: $(ARENA_FILES) $(OLD)
	@mkdir -p $(B)/old
	@sed 's/iqn/iqnold/g; s/IQN/IQNOLD/g' $(OLD) >$(B)/old/iqnold.h
	@sed 's/iqn/iqnold/g; s/IQN/IQNOLD/g' tests/study/arena_kit.h >$(B)/old/iqnold_kit.h
	$(COMPILE) -DOLD -I$(B)/old -o $@ tests/study/arena.c $(LINK)

.PHONY: scipy
scipy: ### adaptive runs of bs3, dp5 and dop853, and stiff ones: evaluations beside SciPy's at equal tolerance; two minutes
	@$(REQUIRE) cc lapack
	@$(MAKE) --no-print-directory $(B)/peer_rk $(B)/stiff
	@mkdir -p $(B)/study
	@for python in python3 /usr/bin/python3; do if $$python -c 'import scipy' 2>/dev/null; then \
	   $(B)/peer_rk | $$python tests/study/peer_rk.py && \
	   for r in 1e-3 1e-6 1e-9; do $(B)/stiff --rtol $$r; done | $$python tests/study/peer_stiff.py >$(B)/study/stiff.txt; \
	   status=$$?; cat $(B)/study/stiff.txt; exit $$status; fi; done; $(B)/peer_rk; echo 'skipped: SciPy is not installed (Debian: python3-scipy)'

$(B)/peer_rk: tests/study/peer_rk.c rk.h | $(B)
	$(COMPILE) -o $@ $< -lm
