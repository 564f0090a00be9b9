/* What can be checked about the wires without the host. */
#include "up_doctor.h"

#if UP_SHELL == TRUE

#include <string.h>

/* The time in which a pad with its own resistor and a wire settles. */
#define SETTLE_US 100U

static bool floats[UP_INPUTS_COUNT + 1U];

/* ---- inputs ---- */

static bool level_with(ioline_t line, iomode_t mode) {
  palSetLineMode(line, mode);
  chThdSleepMicroseconds(SETTLE_US);
  return palReadLine(line) == PAL_HIGH;
}

void up_doctor_look_at_inputs(void) {
  size_t i;

  for (i = 0U; i < up_config.inputs_count; i++) {
    const ioline_t line = up_config.inputs[i].line;
    const bool follows_up = level_with(line, PAL_MODE_INPUT_PULLUP);
    const bool follows_down = !level_with(line, PAL_MODE_INPUT_PULLDOWN);

    floats[i] = follows_up && follows_down;
    palSetLineMode(line, PAL_MODE_INPUT);
  }
}

/* ---- the report ---- */

typedef struct {
  void (*say)(void *context, const char *subject, const char *verdict);
  void *context;
  size_t count;
} report_t;

static void say(report_t *report, const char *subject, const char *verdict) {
  report->say(report->context, subject, verdict);
  report->count++;
}

static void say_inputs(report_t *report) {
  size_t i;

  for (i = 0U; i < up_config.inputs_count; i++) {
    if (floats[i]) {
      say(report, up_config.inputs[i].title,
          up_config.inputs[i].is_bus ? "no resistor pulls this wire up: a bus needs one of 2.2 to 10 kOhm"
                                     : "nobody drove this wire at the start: is it connected?");
    }
  }
}

static const char *verdict_of(const up_chip_state_t *state) {
  static const char *const verdicts[] = {
      [UP_NOTHING] = NULL,
      [UP_FRESH] = NULL,
      [UP_INVALID] = "answers with what is no measurement",
      [UP_WRONG_CRC] = "answers with wrong checksums: a bad wire or too fast a bus",
      [UP_NOT_ACKNOWLEDGED] = "does not answer: check power, address and wires",
      [UP_BUS_ERROR] = "the bus fails: check SCL, SDA and their resistors",
      [UP_ARBITRATION_LOST] = "somebody else drives its bus: check SCL, SDA and their resistors",
      [UP_TIMED_OUT] = "its bus hangs: check SCL, SDA and their resistors",
      [UP_WRONG_IDENTITY] = "another part answers, or the right one on a bad wire",
  };

  if (state->fault >= sizeof verdicts / sizeof verdicts[0]) {
    return "fails";
  }
  return verdicts[state->fault];
}

static void say_chips(report_t *report) {
  size_t i;

  for (i = 0U; i < up_config.chips_count; i++) {
    const char *verdict = verdict_of(up_config.chips[i].state);

    if (verdict != NULL) {
      say(report, up_config.chips[i].title, verdict);
    }
  }
}

/* The I2C addresses that the specification does not reserve. */
#define ADDRESS_FIRST 0x08U
#define ADDRESS_LAST 0x77U

static bool is_expected(const up_probe_t *probe, uint8_t address) {
  return memchr(probe->expected, (int)address, probe->expected_count) != NULL;
}

static void put_hex(char *text, uint8_t byte) {
  static const char digits[] = "0123456789abcdef";

  text[0] = digits[byte >> 4];
  text[1] = digits[byte & 15U];
}

static void say_probe(report_t *report, const up_probe_t *probe) {
  char verdict[] = "answers at 0x00, where the design has nothing";
  uint8_t address;

  for (address = ADDRESS_FIRST; address <= ADDRESS_LAST; address++) {
    if (!is_expected(probe, address) && probe->answers(probe->bus, address)) {
      put_hex(&verdict[13], address);
      say(report, probe->title, verdict);
    }
  }
}

static void say_edges(report_t *report) {
  static uint64_t value[(UP_VALUE_BYTES_MAX + 7U) / 8U];
  size_t i;

  for (i = 0U; i < up_config.edges_count; i++) {
    const up_edges_t *one = &up_config.edges[i];
    const up_field_t *field = &up_config.schema->fields[one->field];

    memset(value, 0, sizeof value);
    if (!up_get(one->field, value) || up_element_load(field->type, value) == 0U) {
      say(report, one->title, "no edge since the start: turn it, then ask again");
    }
  }
}

size_t up_doctor_run(void (*sayer)(void *context, const char *subject, const char *verdict), void *context) {
  report_t report = {sayer, context, 0U};
  size_t i;

  say_inputs(&report);
  say_chips(&report);
  for (i = 0U; i < up_config.probes_count; i++) {
    say_probe(&report, &up_config.probes[i]);
  }
  say_edges(&report);
  return report.count;
}

#else

void up_doctor_look_at_inputs(void) {
}

#endif
