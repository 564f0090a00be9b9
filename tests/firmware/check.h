/* A minimal test harness that works on a host and on a bare Cortex-M with semihosting. */
#ifndef CHECK_H
#define CHECK_H

#include <stdbool.h>

/* Counts a failure and prints its place; the run continues. */
void check_that(bool holds, const char *what, const char *file, int line);
#define CHECK(condition) check_that((condition), #condition, __FILE__, __LINE__)

/* The numbers of failures and checks so far. */
unsigned check_failures(void);
unsigned check_count(void);

/* The parts of the suite. */
void test_units(void);
void test_values(void);
void test_formulas(void);
void test_chips(void);
void test_filters(void);
void test_messages(void);
void test_outputs(void);
void test_health(void);
void test_timers(void);
void test_reporter(void);
void test_faults_of_a_board(void);
void test_vectors(const char *path);

#endif
