/* Asserts a condition; if it fails, the driver exits with this number. */
#ifndef MUST
#define MUST
#include <stdio.h>
#include <stdlib.h>

static void must(int holds, int rule) {
    if (holds) return;
    fprintf(stderr, "rule %d is broken\n", rule);
    exit(rule);
}
#endif
