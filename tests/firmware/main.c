/*
 * Runs the unit tests of the runtime's core, then every vector file of the command line. Prints one summary line; the
 * exit status is 0 only if every check passed.
 */
#include <stdio.h>

#include "check.h"

static unsigned failures, checks;

void check_that(bool holds, const char *what, const char *file, int line) {
  checks++;
  if (!holds) {
    failures++;
    printf("%s:%d: %s\n", file, line, what);
  }
}

unsigned check_failures(void) { return failures; }
unsigned check_count(void) { return checks; }

int main(int argc, char **argv) {
  int i;

  test_units();
  test_values();
  test_formulas();
  test_chips();
  test_filters();
  test_messages();
  test_outputs();
  test_health();
  test_timers();
  test_reporter();
  test_faults_of_a_board();
  for (i = 1; i < argc; i++) {
    test_vectors(argv[i]);
  }
  printf("%d vector files, %u checks, %u failures\n", argc - 1, checks, failures);
  return (failures == 0U) ? 0 : 1;
}
