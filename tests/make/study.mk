# SPDX-License-Identifier: MIT
# make trade: what accuracy costs.  Included by the Makefile, at its end.
STUDIES = $(patsubst tests/study/%.c,$(B)/%,$(wildcard tests/study/study_*.c))

.PHONY: trade
trade: ## what accuracy costs: curves, maps and the recommendation, minutes; CSV and pictures in build/trade
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/scripts/require.sh cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(STUDIES) $(B)/tube $(B)/manufactured
	@B=$(B) CC="$(CC)" sh tests/study/study.sh

$(B)/study_iqn: examples/tube.c
$(B)/study_%: tests/study/study_%.c tests/study/study.h examples/scene.h $(HEADERS) | $(B)
	$(COMPILE) -o $@ $< $(LINK)
