# SPDX-License-Identifier: MIT
# make trade: what accuracy costs.  Included by the Makefile, at its end.
TRADES = $(patsubst tests/%.c,$(B)/%,$(wildcard tests/trade_*.c))
SCRIPTS := $(filter-out tests/trade%.sh,$(SCRIPTS))

.PHONY: trade
trade: ## what accuracy costs: curves, maps and the recommendation, minutes; CSV and pictures in build/trade
	@CC="$(CC)" LDLIBS="$(LDLIBS)" sh tests/require.sh cc lapack gnuplot?
	@$(MAKE) --no-print-directory $(TRADES) $(B)/tube $(B)/manufactured
	@B=$(B) CC="$(CC)" sh tests/trade.sh

$(B)/trade_iqn: examples/tube.c
$(B)/trade_%: tests/trade_%.c tests/trade.h examples/scene.h $(HEADERS) | $(B)
	$(COMPILE) -o $@ $< $(LINK)
