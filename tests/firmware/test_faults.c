/*
 * A complete board with one fault for four of ten seconds. Whatever the fault is, reports continue at their rate,
 * health reports the cause, and no old value is sent as new. Tested on a line with 1200 baud and on USB.
 */
#include <stdio.h>

#include "check.h"
#include "rig.h"

#define FROM_MS 2000U
#define TO_MS 6000U
#define END_MS 10000U
/* A report with everything that is due has 30 bytes and takes 250 ms at 1200 baud. Health has 129 bytes and takes
 * more than a second, during which it has the line to itself. */
#define SLOW_BAUD 1200U
#define SLOW_REPORTS_MIN 3U
#define SLOW_REPORTS_OF_ALL 26U
#define FAST_REPORTS_MIN 95U
/* With only the values that come every 20 ms. */
#define FEW_REPORTS_MIN 45U

typedef struct {
  const char *name;
  rig_fault_t fault;
  uint8_t field; /* the field whose health shows the fault */
  uint8_t status;
  uint8_t cause;      /* up_fault_t; UP_FAULTS: nothing is counted */
  bool others_too;    /* other devices are affected too */
  bool reports_stop;  /* nobody takes the reports */
} case_t;

#define ALWAYS FROM_MS, TO_MS
#define FAILS(who, at, how, hangs) {.from_ms = FROM_MS, .to_ms = TO_MS, .address = (who), .phase = (at), .bus = (how), .hangs_ms = (hangs)}

static const case_t cases[] = {
    {"nothing", {.from_ms = 0U}, RANGE, UP_STATUS_GOOD, UP_FAULTS, false, false},
    {"a chip that is not there", FAILS(RIG_RANGE_ADDRESS, 0U, UP_BUS_NOT_ACKNOWLEDGED, 0U), RANGE, UP_STATUS_FAILED,
     UP_FAULT_NOT_ACKNOWLEDGED, false, false},
    {"a chip that refuses a byte", FAILS(RIG_AXES_ADDRESS, 2U, UP_BUS_NOT_ACKNOWLEDGED, 0U), AXES, UP_STATUS_FAILED,
     UP_FAULT_NOT_ACKNOWLEDGED, false, false},
    {"SDA stuck before a start", FAILS(0xFFU, 0U, UP_BUS_ERROR, 3U), AXES, UP_STATUS_FAILED, UP_FAULT_BUS, true, false},
    {"SDA stuck in an address", FAILS(0xFFU, 0U, UP_BUS_ARBITRATION_LOST, 1U), AXES, UP_STATUS_FAILED,
     UP_FAULT_ARBITRATION, true, false},
    {"SDA stuck in what is written", FAILS(0xFFU, 1U, UP_BUS_ARBITRATION_LOST, 1U), RANGE, UP_STATUS_FAILED,
     UP_FAULT_ARBITRATION, true, false},
    {"SDA stuck in what is read", FAILS(0xFFU, 2U, UP_BUS_TIMED_OUT, 5U), AXES, UP_STATUS_FAILED, UP_FAULT_TIME_OUT,
     true, false},
    {"a transfer that hangs", FAILS(RIG_RANGE_ADDRESS, 1U, UP_BUS_TIMED_OUT, 12U), RANGE, UP_STATUS_FAILED,
     UP_FAULT_TIME_OUT, false, false},
    {"a transfer that hangs for long", FAILS(RIG_RANGE_ADDRESS, 2U, UP_BUS_TIMED_OUT, 300U), RANGE, UP_STATUS_FAILED,
     UP_FAULT_TIME_OUT, true, false},
    {"a capture without edges", {ALWAYS, .capture_is_silent = true}, WHEEL, UP_STATUS_STALE, UP_FAULTS, false, false},
    {"garbage of a serial device", {ALWAYS, .serial_is_garbage = true}, LEVEL, UP_STATUS_FAILED, UP_FAULT_CRC, false,
     false},
    {"a serial device that is silent", {ALWAYS, .serial_is_silent = true}, LEVEL, UP_STATUS_STALE, UP_FAULTS, false,
     false},
    {"rubbish from the host", {ALWAYS, .host_sends_rubbish = true}, RANGE, UP_STATUS_GOOD, UP_FAULTS, false, false},
    {"a host that does not read", {ALWAYS, .host_does_not_read = true}, RANGE, UP_STATUS_GOOD, UP_FAULTS, false, true},
    {"a host that says nothing", {ALWAYS, .host_is_silent = true}, RANGE, UP_STATUS_GOOD, UP_FAULTS, false, false},
    {"an unplugged host", {ALWAYS, .is_unplugged = true}, RANGE, UP_STATUS_GOOD, UP_FAULTS, false, true},
};

static rig_t rig;

static bool is_well(const up_health_row_t *row, bool may_be_unused) {
  return row->status == UP_STATUS_GOOD || (may_be_unused && row->status == UP_STATUS_NEVER);
}

/* The health that the host received while the fault lasted. */
static void check_health_in_fault(const case_t *one) {
  const up_health_row_t *row = &rig.rows[one->field];
  size_t i;

  CHECK(rig.has_health && row->status == one->status);
  CHECK(rig.board.uptime_ms > FROM_MS && rig.board.reset_cause == UP_CAUSE_POWER && rig.board.load_percent == 7U);
  for (i = 0U; i < UP_FAULTS; i++) {
    CHECK((row->counts[i] > 0U) == (i == one->cause));
  }
  for (i = 0U; i < RIG_FIELDS; i++) {
    CHECK(i == one->field || one->others_too || is_well(&rig.rows[i], i >= MOTOR));
  }
}

static void check_rate(const case_t *one, uint32_t baud) {
  const unsigned fast = one->fault.capture_is_silent ? FEW_REPORTS_MIN : FAST_REPORTS_MIN;
  const unsigned least = (baud == 0U) ? fast : SLOW_REPORTS_MIN;
  size_t second;

  for (second = 0U; second < 10U; second++) {
    const bool is_in_fault = second >= FROM_MS / 1000U && second < TO_MS / 1000U;
    /* Answers to requests from that time come first. */
    const bool is_ending = second == TO_MS / 1000U || (baud != 0U && second == TO_MS / 1000U + 1U);
    if (one->reports_stop && (is_in_fault || is_ending)) {
      CHECK(is_ending || rig.reports_in_second[second] <= 1U);
    } else {
      const bool has_health = baud != 0U && second % 4U < 2U;
      CHECK(has_health || rig.reports_in_second[second] >= least);
    }
  }
  CHECK(baud == 0U || one->reports_stop || rig.reports >= SLOW_REPORTS_OF_ALL);
}

static void check_host(const case_t *one) {
  if (one->fault.host_is_silent || one->fault.is_unplugged) {
    CHECK(rig.failsafes == 1U);
  } else {
    CHECK(rig.failsafes == 0U);
  }
  /* Each command that was sent completely arrived once, and nothing else did. */
  CHECK(rig.motor == rig.commanded && rig.applied == rig.commands && !rig.lamp);
  CHECK((rig.reporter.decoder.dropped_bytes > 0U) == one->fault.host_sends_rubbish);
}

static void run_case(const case_t *one, uint32_t baud) {
  const unsigned failures = check_failures();
  const bool has_lost = one->fault.is_unplugged;

  rig_start(&rig, &one->fault, baud);
  rig_run(&rig, FROM_MS);
  rig.has_health = false;
  rig_run(&rig, TO_MS - 100U);
  if (!one->fault.host_is_silent && !one->reports_stop) {
    check_health_in_fault(one);
  }
  if (one->reports_stop) {
    CHECK(rig.reporter.counts.reports_refused > 100U || (one->fault.is_unplugged && baud == 0U));
  }
  rig_run(&rig, END_MS);
  CHECK(is_well(&rig.rows[one->field], false) && rig.hellos >= 1U);
  check_rate(one, baud);
  check_host(one);
  CHECK(rig.old_values == 0U && (rig.lost == 0U || has_lost));
  CHECK(rig.late_reports <= (one->reports_stop ? 2U : 0U));
  CHECK(rig.decoder.dropped_bytes == 0U || has_lost);
  if (check_failures() != failures) {
    printf("in: %s, %u baud: %u reports, %u late, %u old, %u lost, %u dropped\n", one->name, (unsigned)baud, rig.reports,
           rig.late_reports, rig.old_values, rig.lost, (unsigned)rig.decoder.dropped_bytes);
  }
}

void test_faults_of_a_board(void) {
  size_t i;

  for (i = 0U; i < sizeof cases / sizeof cases[0]; i++) {
    run_case(&cases[i], SLOW_BAUD);
    run_case(&cases[i], 0U);
  }
}
