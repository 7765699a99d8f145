/* SPDX-License-Identifier: MIT

   bench.h - contenders that cannot disturb one another: each lives in a process of its own, and they take turns

   A contender is a function of this program, run in a forked process, or a command.  In its process it prepares itself,
   says who it is (bench_hello), and then runs laps without end: bench_begin, the work, bench_end.  What lies between
   bench_end and the next bench_begin is not timed.  The race gives the word: "laps clock\n" on standard input asks for so
   many laps, the median of which is answered on standard output.  An iterative solver that only calls back ends a lap when
   it evaluates and begins the next when it has its value.

   Short laps are timed by the clock (what it takes to read it is subtracted), long ones by processor time: other jobs on
   the machine then cost a contender its cache, but not its time.                                                         */
#ifndef BENCH_H
#define BENCH_H

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { BENCH_LAPS = 1000, BENCH_ROUNDS = 25, BENCH_CONTENDERS = 16 };
#define BENCH_LONG 1e-4 /* seconds: longer laps are timed by processor time, which takes 3e-7 to read */
#define BENCH_TURN 3e-3 /* seconds of a turn, if a lap is shorter */

#ifdef __GNUC__
#    define BENCH_MAY_BE_UNUSED __attribute__((unused))
#else
#    define BENCH_MAY_BE_UNUSED
#endif

static double bench_clock(int processor)
{
    struct timespec t;
    clock_gettime(processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int bench_ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The given part of the numbers lies below the answer; numbers in any order, at most BENCH_LAPS. */
static double bench_quantile(const double *t, int count, double part)
{
    double sorted[BENCH_LAPS];
    memcpy(sorted, t, (size_t)count * sizeof *t);
    qsort(sorted, (size_t)count, sizeof *sorted, bench_ascending);
    return sorted[(int)(part * (count - 1) + 0.5)];
}

static BENCH_MAY_BE_UNUSED double *bench_memory(size_t count)
{
    double *p = (double *)calloc(count ? count : 1, sizeof *p);
    if (!p) {
        fprintf(stderr, "no memory for %lu numbers\n", (unsigned long)count);
        exit(1);
    }
    return p;
}

static BENCH_MAY_BE_UNUSED void bench_random(ptrdiff_t n, double *x) /* in [-1, 1) */
{
    static unsigned long long state = 1;
    ptrdiff_t i;
    for (i = 0; i < n; i++) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        x[i] = (double)(state >> 11) / 4503599627370496.0 - 1;
    }
}

/* ---- in the process of a contender ------------------------------------------------------------------------------------ */

static struct {
    double lap[BENCH_LAPS], begun, reading;
    int count, wanted, processor, calls; /* calls in a lap; 0: one */
} bench_turn;

static BENCH_MAY_BE_UNUSED void bench_wait(void) /* for the word; the end of the race is the end of the process */
{
    char line[64];
    if (!fgets(line, sizeof line, stdin) || sscanf(line, "%d %d", &bench_turn.wanted, &bench_turn.processor) != 2) exit(0);
    if (bench_turn.wanted > BENCH_LAPS) exit(1);
    bench_turn.count = 0;
}

static BENCH_MAY_BE_UNUSED void bench_hello(const char *who)
{
    double least = 1;
    int i;
    for (i = 0; i < 1000; i++) {
        const double start = bench_clock(0), t = bench_clock(0) - start;
        if (t < least) least = t;
    }
    bench_turn.reading = least;
    printf("%s\n", who);
    fflush(stdout);
    bench_wait();
}

static BENCH_MAY_BE_UNUSED void bench_begin(void)
{
    bench_turn.begun = bench_clock(bench_turn.processor);
}

static BENCH_MAY_BE_UNUSED void bench_end(void)
{
    const double t = bench_clock(bench_turn.processor) - bench_turn.begun;
    bench_turn.lap[bench_turn.count++] = (bench_turn.processor ? t : t - bench_turn.reading) / (bench_turn.calls ? bench_turn.calls : 1);
    if (bench_turn.count < bench_turn.wanted) return;
    printf("%.17g\n", bench_quantile(bench_turn.lap, bench_turn.count, 0.5));
    fflush(stdout);
    bench_wait();
}

/* Laps of so many calls each that a lap takes some microseconds. */
static BENCH_MAY_BE_UNUSED void bench_laps(const char *who, void (*call)(void *), void *state)
{
    double t = 0;
    int calls, i;
    for (calls = 1; t < 5e-6 && calls < 1 << 12; calls *= 2) {
        t = bench_clock(0);
        for (i = 0; i < calls; i++) call(state);
        t = bench_clock(0) - t;
    }
    bench_turn.calls = calls;
    bench_hello(who);
    for (;;) {
        bench_begin();
        for (i = 0; i < calls; i++) call(state);
        bench_end();
    }
}

/* ---- in the race ---------------------------------------------------------------------------------------------------------- */

typedef struct contender {
    const char *name;
    void (*live)(const void *problem); /* in a process of its own, without end; or, where NULL, */
    const char *command;               /* for the shell, run from the folder of the sources */
    const char *package;               /* of Debian, where it comes from */
} contender;

/* With BENCH_OLD ours and the other version are two programs compiled alike, bench_.._this and bench_.._old, without the
   peers: where the linker puts a call of 20 ns makes up to 1.2 between two programs that share its source. */
static BENCH_MAY_BE_UNUSED void bench_versions(contender *ours, contender *other, const char *what, const char *arguments)
{
    static char command[2][400];
    const char *bin = getenv("BENCH_BIN");
    if (!getenv("BENCH_OLD")) return;
    snprintf(command[0], sizeof command[0], "exec '%s/bench_%s_this' %s", bin ? bin : "build", what, arguments);
    snprintf(command[1], sizeof command[1], "exec '%s/bench_%s_old' %s", bin ? bin : "build", what, arguments);
    ours->live = NULL;
    ours->command = command[0];
    other->command = command[1];
}

typedef struct race {
    int count, rounds;
    int here[BENCH_CONTENDERS];
    char who[BENCH_CONTENDERS][80]; /* version and how it was compiled */
    double time[BENCH_CONTENDERS][BENCH_ROUNDS];
} race;

typedef struct bench_pipe {
    pid_t pid;
    FILE *to, *from;
} bench_pipe;

static BENCH_MAY_BE_UNUSED bench_pipe bench_start(const contender *c, const void *problem)
{
    bench_pipe p = {0, NULL, NULL};
    int to[2], from[2];
    fflush(stdout);
    if (pipe(to) || pipe(from) || (p.pid = fork()) < 0) {
        perror("bench");
        exit(1);
    }
    if (p.pid == 0) {
        dup2(to[0], 0);
        dup2(from[1], 1);
        close(to[0]), close(to[1]), close(from[0]), close(from[1]);
        if (c->live) c->live(problem);
        else execlp("sh", "sh", "-c", c->command, (char *)NULL);
        _exit(1);
    }
    close(to[0]), close(from[1]);
    p.to = fdopen(to[1], "w");
    p.from = fdopen(from[0], "r");
    return p;
}

static BENCH_MAY_BE_UNUSED double bench_ask(const bench_pipe *p, int laps, int processor) /* negative: it is gone */
{
    char line[80];
    fprintf(p->to, "%d %d\n", laps, processor);
    fflush(p->to);
    return fgets(line, sizeof line, p->from) ? atof(line) : -1;
}

static BENCH_MAY_BE_UNUSED void bench_stop(const bench_pipe *p) /* the end of its input is the end of the process */
{
    fclose(p->to);
    fclose(p->from);
    waitpid(p->pid, NULL, 0);
}

/* All contenders on one problem: `fill` laps untimed, then rounds of turns. */
static BENCH_MAY_BE_UNUSED void bench_race(race *r, const contender *c, int count, const void *problem, int fill, int rounds)
{
    bench_pipe p[BENCH_CONTENDERS];
    int k, i, laps[BENCH_CONTENDERS], processor[BENCH_CONTENDERS];
    r->count = count;
    r->rounds = rounds;
    memset(r->here, 0, sizeof r->here);
    for (k = 0; k < count; k++) {
        double t;
        p[k] = bench_start(c + k, problem);
        r->here[k] = fgets(r->who[k], sizeof r->who[k], p[k].from) != NULL;
        r->who[k][strcspn(r->who[k], "\n")] = 0;
        if (!r->here[k]) continue;
        t = bench_ask(p + k, fill + 1, 0);
        if (t < BENCH_LONG) t = bench_ask(p + k, 25, 0);
        laps[k] = t > BENCH_TURN / 3 ? 3 : t * BENCH_LAPS > BENCH_TURN ? (int)(BENCH_TURN / t) : BENCH_LAPS;
        processor[k] = t > BENCH_LONG;
    }
    for (i = 0; i < rounds; i++)
        for (k = 0; k < count; k++)
            if (r->here[k]) r->here[k] = (r->time[k][i] = bench_ask(p + k, laps[k], processor[k])) > 0;
    while (k-- > 0) bench_stop(p + k); /* the newest first: it holds copies of the pipes of those before it */
}

/* Time of k over that of reference, of the same round: other jobs then slow both alike.  part 0.5: the median. */
static BENCH_MAY_BE_UNUSED double bench_ratio(const race *r, int k, int reference, double part)
{
    double ratio[BENCH_ROUNDS];
    int i;
    for (i = 0; i < r->rounds; i++) ratio[i] = r->time[k][i] / r->time[reference][i];
    return bench_quantile(ratio, r->rounds, part);
}

static BENCH_MAY_BE_UNUSED double bench_median(const race *r, int k)
{
    return bench_quantile(r->time[k], r->rounds, 0.5);
}

/* The first Python that has SciPy; arguments follow. */
#define bench_scipy \
    "for p in python3 /usr/bin/python3; do $p -c 'import scipy' 2>/dev/null && exec $p tests/bench/peer_scipy.py \"$@\"; done; exit 1"

/* ---- what the last lines of make bench, and the documents, are made from ------------------------------------------------- */

static BENCH_MAY_BE_UNUSED void bench_note(const char *file, const char *key, double value, double limit)
{
    const char *folder = getenv("BENCH_NOTES");
    char path[400];
    FILE *f;
    if (!folder || snprintf(path, sizeof path, "%s/%s", folder, file) >= (int)sizeof path || !(f = fopen(path, "a"))) return;
    fprintf(f, "%s\t%.4g\t%.4g\n", key, value, limit);
    fclose(f);
}

/* Who stood in a column, and where it comes from if it is not here. */
static BENCH_MAY_BE_UNUSED void bench_names(const char *bench, const race *r, const contender *c, int count)
{
    const char *folder = getenv("BENCH_NOTES");
    char path[400];
    FILE *f = NULL;
    int k;
    if (folder && snprintf(path, sizeof path, "%s/names", folder) < (int)sizeof path) f = fopen(path, "a");
    for (k = 0; k < count; k++) {
        if (!r->here[k] && !*c[k].package) continue; /* another version of a header, which nobody has named */
        if (r->here[k]) printf("  %s: %s\n", c[k].name, r->who[k]);
        else printf("  %s: not here (Debian: %s)\n", c[k].name, c[k].package);
        if (f && r->here[k]) fprintf(f, "%s\t%s\t%s\n", bench, c[k].name, r->who[k]);
        else if (f) fprintf(f, "%s\t%s\tnot here (Debian: %s)\n", bench, c[k].name, c[k].package);
    }
    if (f) fclose(f);
}

/* A goal is met where value <= limit. */
static BENCH_MAY_BE_UNUSED void bench_goal(const char *key, double value, double limit)
{
    bench_note("goals", key, value, limit);
}

/* Exponent of growth: least squares of log t over log x. */
static BENCH_MAY_BE_UNUSED double bench_exponent(int count, const double *x, const double *t)
{
    double sx = 0, st = 0, sxx = 0, sxt = 0;
    int i;
    for (i = 0; i < count; i++) {
        const double a = log(x[i]), b = log(t[i]);
        sx += a;
        st += b;
        sxx += a * a;
        sxt += a * b;
    }
    return (count * sxt - sx * st) / (count * sxx - sx * sx);
}

#endif
