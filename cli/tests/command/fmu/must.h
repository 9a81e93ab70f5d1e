/* What is to hold, by a number that the driver ends with where it does not. */
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
