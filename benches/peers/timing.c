// The timing loop: loads one library and measures `eval`, `eval4` and `eval8` as README.md describes.
//
//     timing LIBRARY TASK.bin
//
// Prints one line of JSON: nanoseconds per state, and the error against the references if TASK.bin contains them.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef void eval_fn(const double *y, double t, const double *p, double *qdd);
typedef void setup_fn(const double *p);
typedef void batch_fn(const double *y, const double *t, const double *p, double *qdd);

enum { MAX_N = 64, MAX_LANES = 8, SAMPLES = 151, SAMPLE_NS = 200000, REPEATS = 4 };

static int n, states;
static const double *parameters, *rows; // a row: q, v, t
static eval_fn *eval;
static batch_fn *batch;
static int lanes;
static double *soa, *soa_t; // the same states, component-major in groups of `lanes`

static double now(void) {
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * time.tv_sec + time.tv_nsec;
}

// Results go to many places in turn, so that the stores of a call do not wait for those before it.
static double sink[16][MAX_N * MAX_LANES] __attribute__((aligned(64)));

static int next = 0; // the index of the next state: every call gets another one

static void independent(long calls) {
    for (long i = 0; i < calls; ++i) {
        const double *row = rows + (size_t)next * (2 * n + 1);
        eval(row, row[2 * n], parameters, sink[i & 15]);
        if (++next == states) next = 0;
    }
}

// Every coordinate and velocity depends on the previous results, as in an integrator; the factor 1e-30 keeps
// the numbers unchanged.
static void in_a_row(long calls) {
    static double y[2 * MAX_N] __attribute__((aligned(64))), qdd[MAX_N] __attribute__((aligned(64)));
    for (long i = 0; i < calls; ++i) {
        const double *row = rows + (size_t)next * (2 * n + 1);
        for (int j = 0; j < n; ++j) {
            y[j] = row[j] + 1e-30 * qdd[j];
            y[n + j] = row[n + j] + 1e-30 * qdd[j];
        }
        eval(y, row[2 * n], parameters, qdd);
        if (++next == states) next = 0;
    }
}

static void groups(long calls) {
    for (long i = 0; i < calls; ++i) {
        batch(soa + (size_t)next * 2 * n * lanes, soa_t + (size_t)next * lanes, parameters, sink[i & 15]);
        if (++next == states / lanes) next = 0;
    }
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Nanoseconds per call: the median over samples of about 200 us, repeated while it exceeds the first quartile by more
// than 5 %; the run with the least disturbance is kept.
static double nanoseconds(void (*pass)(long)) {
    long calls = 1;
    next = 0;
    for (;;) {
        const double start = now();
        pass(calls);
        const double spent = now() - start;
        if (spent > SAMPLE_NS / 2) {
            calls = (long)(calls * SAMPLE_NS / spent) + 1;
            break;
        }
        calls *= 2;
    }
    double best = INFINITY, quietest = INFINITY;
    for (int repeat = 0; repeat < REPEATS; ++repeat) {
        double sample[SAMPLES];
        for (int i = 0; i < SAMPLES; ++i) {
            const double start = now();
            pass(calls);
            sample[i] = (now() - start) / calls;
        }
        qsort(sample, SAMPLES, sizeof *sample, ascending);
        const double median = sample[SAMPLES / 2], unrest = median / sample[SAMPLES / 4];
        if (unrest < quietest) {
            quietest = unrest;
            best = median;
        }
        if (unrest <= 1.05) break;
    }
    return best;
}

// Max over components of |qdd - reference|, relative to max |reference|.
static double error_of(const double *qdd, int stride, const double *reference) {
    double difference = 0, greatest = 0;
    for (int j = 0; j < n; ++j) {
        // The reference is the sum of two numbers.
        const double d = fabs((qdd[j * stride] - reference[j]) - reference[n + j]);
        if (!(d <= difference)) difference = d; // NaN counts as well
        greatest = fmax(greatest, fabs(reference[j]));
    }
    return difference / greatest;
}

static void print_errors(const char *name, double *errors, int count) {
    int bad = 0;
    for (int i = 0; i < count; ++i) bad |= !isfinite(errors[i]);
    if (bad) {
        printf(", \"%s_median_error\": null, \"%s_worst_error\": null", name, name);
        return;
    }
    qsort(errors, count, sizeof *errors, ascending);
    const double median = count % 2 ? errors[count / 2] : (errors[count / 2 - 1] + errors[count / 2]) / 2;
    printf(", \"%s_median_error\": %.17g, \"%s_worst_error\": %.17g", name, median, name, errors[count - 1]);
}

static void *checked(void *value, const char *what) {
    if (!value) {
        fprintf(stderr, "%s: %s\n", what, dlerror());
        exit(1);
    }
    return value;
}

int main(int count, char **words) {
    if (count != 3) return 2;
    // Runs on one core, the last one that this process may use; the first one handles the interrupts
    // on most computers.
    cpu_set_t allowed, one;
    sched_getaffinity(0, sizeof allowed, &allowed);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE; ++i)
        if (CPU_ISSET(i, &allowed)) {
            CPU_ZERO(&one);
            CPU_SET(i, &one);
        }
    sched_setaffinity(0, sizeof one, &one);

    FILE *file = checked(fopen(words[2], "rb"), words[2]);
    double sizes[4];
    if (fread(sizes, sizeof *sizes, 4, file) != 4) return 1;
    n = (int)sizes[0];
    states = (int)sizes[2];
    const size_t p_count = (size_t)sizes[1], judged = (size_t)sizes[3];
    const size_t all = p_count + (size_t)states * (2 * n + 1) + judged * 2 * n;
    double *data = aligned_alloc(64, (all * sizeof *data + 63) / 64 * 64);
    if (!data || n > MAX_N || fread(data, sizeof *data, all, file) != all) return 1;
    fclose(file);
    parameters = data;
    rows = data + p_count;
    const double *references = rows + (size_t)states * (2 * n + 1);

    void *library = checked(dlopen(words[1], RTLD_NOW | RTLD_LOCAL), words[1]);
    eval = (eval_fn *)checked(dlsym(library, "eval"), "eval");
    setup_fn *setup = (setup_fn *)dlsym(library, "eval_setup");
    if (setup) setup(parameters);

    double *errors = malloc((judged + 1) * sizeof *errors);
    for (size_t i = 0; i < judged; ++i) {
        const double *row = rows + i * (2 * n + 1);
        double qdd[MAX_N];
        eval(row, row[2 * n], parameters, qdd);
        errors[i] = error_of(qdd, 1, references + i * 2 * n);
    }
    printf("{\"judged\": %zu", judged);
    if (judged) print_errors("eval", errors, (int)judged);
    printf(", \"thr\": %.4f", nanoseconds(independent));
    printf(", \"lat\": %.4f", nanoseconds(in_a_row));
    for (lanes = 4; lanes <= MAX_LANES; lanes *= 2) {
        batch = (batch_fn *)dlsym(library, lanes == 4 ? "eval4" : "eval8");
        if (!batch) continue;
        soa = aligned_alloc(64, (size_t)states * 2 * n * sizeof *soa);
        soa_t = aligned_alloc(64, (size_t)states * sizeof *soa_t);
        if (!soa || !soa_t) return 1;
        for (int i = 0; i < states; ++i) {
            const double *row = rows + (size_t)i * (2 * n + 1);
            for (int j = 0; j < 2 * n; ++j) soa[((size_t)(i / lanes) * 2 * n + j) * lanes + i % lanes] = row[j];
            soa_t[i] = row[2 * n];
        }
        for (size_t i = 0; i + lanes <= judged; i += lanes) {
            double qdd[MAX_N * MAX_LANES] __attribute__((aligned(64)));
            batch(soa + i * 2 * n, soa_t + i, parameters, qdd);
            for (int k = 0; k < lanes; ++k) errors[i + k] = error_of(qdd + k, lanes, references + (i + k) * 2 * n);
        }
        const char *name = lanes == 4 ? "eval4" : "eval8";
        if (judged) print_errors(name, errors, (int)(judged / lanes * lanes));
        printf(", \"%s\": %.4f", name, nanoseconds(groups) / lanes);
        free(soa);
        free(soa_t);
    }
    printf("}\n");
    return 0;
}
