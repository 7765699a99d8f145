# SPDX-License-Identifier: MIT
# Checks: sanitizers, fuzzing, coverage, lint, other flags and machines, and the installation.  Included by the Makefile.
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 20
PACKAGE = waveform_iqn_rk

FUZZERS = $(patsubst tests/fuzz/%.c,$(B)/%,$(wildcard tests/fuzz/fuzz_*.c))
TESTS += $(FUZZERS)
# Not test_stability: it is about LAPACK's eigenvalues.
PLAIN = $(patsubst tests/%.c,$(B)/plain_%,$(filter-out tests/test_stability.c,$(wildcard tests/test_*.c))) $(patsubst tests/fuzz/%.c,$(B)/plain_%,$(wildcard tests/fuzz/fuzz_*.c))
# Without warnings: some depend on what the optimiser has inlined, and make test has asked for them already.
SUB = $(MAKE) --no-print-directory $(SIDE) WARN=-w

.PHONY: units plain sanitize valgrind coverage fuzz lint same install flags mutants portability anyblas cleanroom

$(B)/fuzz_%: tests/fuzz/fuzz_%.c tests/fuzz/fuzz.h $(HEADERS) | $(B)
	$(COMPILE) -o $@ $< $(LINK)

$(B)/libfuzzer_%: tests/fuzz/fuzz_%.c tests/fuzz/fuzz.h $(HEADERS) | $(B)
	clang -std=c99 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DFUZZ_LIBFUZZER -I. -o $@ $< $(LINK)

# As test_% and fuzz_%, but with tests/portable in the place of cmocka and LAPACK.
PORTABLE = tests/portable/cmocka.h tests/portable/dgels.c
$(B)/plain_test_%: tests/test_%.c tests/check.h $(PORTABLE) $(HEADERS) | $(B)
	$(COMPILE) -Itests/portable -o $@ $< tests/portable/dgels.c -lm
$(B)/plain_fuzz_%: tests/fuzz/fuzz_%.c tests/fuzz/fuzz.h $(PORTABLE) $(HEADERS) | $(B)
	$(COMPILE) -Itests/portable -o $@ $< tests/portable/dgels.c -lm

units: $(TESTS)
	@CMOCKA_MESSAGE_OUTPUT=TAP prove -j $(JOBS) -e 'sh tests/scripts/tap.sh' $(TESTS)

plain: $(PLAIN)
	@prove -j $(JOBS) -e '$(RUN)' $(PLAIN)

ASAN = -g -O1 -fno-omit-frame-pointer -DSTACK_IS_WATCHED -fno-sanitize-recover=all -fsanitize=address,undefined,float-cast-overflow
MSAN = -g -O1 -fno-omit-frame-pointer -DSTACK_IS_WATCHED -fno-sanitize-recover=all -fsanitize=memory -fsanitize-memory-track-origins

sanitize: ### the tests under the address, undefined-behaviour and memory sanitizers of gcc and clang
	@$(REQUIRE) gcc clang clang-runtime lapack cmocka prove
	@$(SUB) units B=$(B)/asan-gcc CC=gcc CFLAGS="$(ASAN)"
	@$(SUB) units B=$(B)/asan-clang CC=clang CFLAGS="$(ASAN)"
	@$(SUB) plain B=$(B)/msan CC=clang CFLAGS="$(MSAN)"

valgrind: ### the tests under valgrind, with fewer pseudo-random inputs and shorter runs
	@$(REQUIRE) cc lapack cmocka prove valgrind
	@$(SUB) $(patsubst $(B)/%,$(B)/valgrind/%,$(TESTS)) B=$(B)/valgrind CFLAGS="-g -O1" CPPFLAGS="-DFUZZ_COUNT=300 -DLESS=9 -DSTACK_IS_WATCHED"
	@CMOCKA_MESSAGE_OUTPUT=TAP prove -j $(JOBS) -e 'sh tests/scripts/tap.sh valgrind -q --error-exitcode=9 --leak-check=full' $(patsubst $(B)/%,$(B)/valgrind/%,$(TESTS))

coverage: ### every line of the headers reached by the tests, and 96 % of the branches; what is not
	@$(REQUIRE) gcc lapack cmocka prove
	@rm -rf $(B)/coverage
	@# Without the pragmas that ask for optimisation: what they inline would count once for every copy.
	@mkdir -p $(B)/coverage/plain && for h in $(HEADERS); do sed 's/^# *pragma GCC optimize.*//' $$h >$(B)/coverage/plain/$$h; done
	@$(SUB) units B=$(B)/coverage CC=gcc CFLAGS="-O0 --coverage -fprofile-update=atomic -I$(abspath $(B))/coverage/plain"
	@cd $(B)/coverage && for p in *.gcda; do mkdir -p $$p.d && (cd $$p.d && ln -s $(CURDIR)/tests $(CURDIR)/examples $(addprefix $(CURDIR)/,$(HEADERS)) . && gcov -b -c ../$$p >/dev/null 2>&1); done
	@sh tests/scripts/coverage.sh $(B)/coverage $(HEADERS) $(wildcard examples/rk_proof.h)

LIBFUZZERS = $(addprefix $(B)/libfuzzer_,$(basename $(or $(HEADER),$(HEADERS))))
fuzz: ### libFuzzer on each header for FUZZ_SECONDS=20; HEADER=waveform.h: on one
	@$(REQUIRE) clang clang-runtime lapack
	@$(SUB) $(LIBFUZZERS)
	@for f in $(LIBFUZZERS); do mkdir -p $$f.corpus && \
	   $$f -max_total_time=$(FUZZ_SECONDS) -max_len=1024 -timeout=20 -print_final_stats=1 -artifact_prefix=$$f. $$f.corpus \
	   >$$f.log 2>&1 || { tail -50 $$f.log; exit 1; }; \
	   echo "$${f##*_}: $$(sed -n 's/^stat::number_of_executed_units: *//p' $$f.log) inputs, nothing broken"; done

lint: ### gcc -fanalyzer, clang --analyze, cppcheck, clang-tidy; studies and benches compile; lists of tests in order; make rules finds its lines; for information what a reader must hold in the head
	@$(REQUIRE) gcc clang lapack cmocka cppcheck clang-tidy python3
	@mkdir -p $(B)/lint
	@{ echo '#define WF_IMPLEMENTATION'; echo '#define IQN_IMPLEMENTATION'; echo '#define RK_IMPLEMENTATION'; echo '#define RK_PROOF_IMPLEMENTATION'; \
	   for h in $(HEADERS) examples/rk_proof.h; do echo "#include \"$$h\""; done; } >$(B)/lint/headers.c
	gcc -std=c99 -O2 $(WARN) -fanalyzer -Wno-analyzer-use-of-uninitialized-value -I. -c -o $(B)/lint/headers.o $(B)/lint/headers.c
	clang -std=c99 --analyze -Xclang -analyzer-werror -I. $(B)/lint/headers.c -o $(B)/lint/headers.plist
	cppcheck --quiet --std=c99 --error-exitcode=1 --enable=warning,portability,style $(SUPPRESS) -I. $(B)/lint/headers.c
	clang-tidy --quiet --warnings-as-errors='*' --header-filter='(waveform|iqn|rk|rk_proof)\.h' \
	   --checks='-*,$(TIDY)' $(B)/lint/headers.c -- -std=c99 -I. 2>$(B)/lint/tidy || { cat $(B)/lint/tidy; exit 1; }
	@$(MAKE) --no-print-directory $(STUDIES) $(B)/arena $(B)/peer_rk bench_programs
	@python3 tests/scripts/lists.py --check
	@python3 tests/study/rules.py --check
	@python3 tests/scripts/readable.py $(HEADERS) $(wildcard examples/*.[ch] examples/hosts/*.[ch] tests/*.[ch])

# Uninitialised values are left to clang --analyze, the memory sanitizer and valgrind: gcc 12 and cppcheck take an array
# that a callee fills, or that is filled in part, for one.  rk.h: NULL meets an output of length > 0 in no call.  Style that is
# meant: locals at the head of a function, one statement a line behind one condition; and what cppcheck cannot see: a loop that
# runs at least once, a member that is read through a pointer.
SUPPRESS = --suppress=variableScope --suppress=duplicateCondition --suppress=knownConditionTrueFalse:iqn.h --suppress=unreadVariable:iqn.h --suppress=missingIncludeSystem --suppress=toomanyconfigs --suppress=nullPointerArithmetic:rk.h --suppress=uninitvar
TIDY = bugprone-*,-bugprone-easily-swappable-parameters,-bugprone-macro-parentheses,-bugprone-narrowing-conversions,-bugprone-reserved-identifier,-bugprone-branch-clone,-bugprone-implicit-widening-of-multiplication-result,clang-analyzer-*,-clang-analyzer-security.insecureAPI.*,-clang-analyzer-security.FloatLoopCounter,misc-redundant-expression,misc-misplaced-const

same: ### what the three headers share is the same text, in the same order
	@prove -v -e sh tests/scripts/same.sh

flags: ### the tests from -O0 to -Ofast -march=native, by gcc and clang, and with each BLAS installed; ROW="gcc -Ofast": one row
	@$(REQUIRE) gcc clang lapack cmocka prove
	@set -e; n=0; for f in $(if $(ROW),'$(ROW)','gcc -O0' 'gcc -O3 -march=native' 'gcc -std=gnu11 -O3 -march=native' 'gcc -Ofast' 'gcc -Ofast -march=native' 'clang -O2' 'clang -O2 -mfma -U__FMA__' 'clang -O3 -ffast-math' 'clang -Ofast -march=native'); do \
	   n=$$((n + 1)); echo "$$f"; \
	   $(SUB) -s units B=$(B)/flags$$n CC=$${f%% *} CFLAGS="$${f#* }" \
	   CPPFLAGS="-DFUZZ_COUNT=3000 $$(case $$f in *fast*) echo -DFUZZ_CRASHES_ONLY; esac)"; done
	@set -e; n=0; for l in $(if $(ROW),,'-llapack -lblas' -lopenblas '-llapack -lblis'); do n=$$((n + 1)); \
	   if LDLIBS="$$l" CC="$(CC)" sh -c '. tests/scripts/links.sh'; then echo "$$l"; \
	   $(SUB) -s units B=$(B)/blas$$n LDLIBS="$$l" FUZZERS=; else echo "skipped: $$l is not installed"; fi; done

anyblas: ### the tests of the scenes with each BLAS and its kernels, and with inputs moved by 1e-13
	@$(REQUIRE) cc lapack openblas? blis?
	@$(MAKE) --no-print-directory scenes
	@B=$(B) sh tests/scripts/anyblas.sh

cleanroom: ### a minimal Debian root, and in it the README's commands
	@$(REQUIRE) git debootstrap
	@sh tests/scripts/cleanroom.sh

# SEED: any word; TIME: stop after these seconds; LEAST: the score that is asked for; FIRST, LAST: lines; RULES=0: all mutants count
SEED ?= 1
COUNT ?= 100
LEAST ?= 95
mutants: ### whether the unit tests notice wrong lines; SEED=word COUNT=100 TIME=seconds LEAST=95 HEADER=iqn.h, or all three
	@$(REQUIRE) cc lapack cmocka python3
	@failed=0; for h in $(or $(HEADER),$(HEADERS)); do CC="$(CC)" LDLIBS="$(LDLIBS)" python3 tests/mutants/mutants.py $$h \
	   seed=$(SEED) count=$(COUNT) seconds=$(TIME) least=$(LEAST) first=$(FIRST) last=$(LAST) rules=$(RULES) || failed=1; done; exit $$failed

BIG ?= s390x-linux-gnu-gcc
BIGRUN ?= qemu-s390x
portability: ### the tests with 32 bits, and on a big-endian machine under emulation
	@mkdir -p $(B)
	@if echo 'int main(void) { return 0; }' | gcc -m32 -x c - -o $(B)/m32 2>/dev/null; then echo 'gcc -m32'; \
	   $(SUB) -s plain B=$(B)/m32-sse CC=gcc CFLAGS="-O2 -m32 -msse2 -mfpmath=sse" CPPFLAGS="-DFUZZ_COUNT=3000"; \
	   else echo 'skipped: gcc -m32 (Debian: gcc-multilib)'; fi
	@if command -v $(firstword $(BIG)) >/dev/null && command -v $(firstword $(BIGRUN)) >/dev/null; then echo '$(BIG)'; \
	   $(SUB) -s plain B=$(B)/big CC="$(BIG)" CFLAGS="-O2 -static -D__float128='long double'" CPPFLAGS="-DFUZZ_COUNT=300" RUN="$(BIGRUN)"; \
	   else echo 'skipped: big-endian (Debian: gcc-s390x-linux-gnu qemu-user, not beside gcc-multilib)'; fi

VERSION = $(shell sed -n 's/^\#define WF_VERSION \([0-9]*\).*/\1/p' waveform.h | awk '{ printf "%d.%d.%d", $$1 / 10000, $$1 / 100 % 100, $$1 % 100 }')
install: ## the headers, pkg-config and CMake files to PREFIX=/usr/local
	@install -d $(DESTDIR)$(PREFIX)/include $(DESTDIR)$(PREFIX)/lib/pkgconfig $(DESTDIR)$(PREFIX)/lib/cmake/$(PACKAGE) || \
	   { echo "cannot write to $(DESTDIR)$(PREFIX); choose another place: make install PREFIX=\$$HOME/.local"; exit 1; }
	install -m 644 $(HEADERS) examples/rk_proof.h $(DESTDIR)$(PREFIX)/include
	@sh tests/scripts/package.sh $(PACKAGE) $(VERSION) $(DESTDIR)$(PREFIX)/lib
