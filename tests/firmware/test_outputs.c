/* The pulse trains of RC receivers, and H-bridges. */
#include <string.h>

#include "check.h"
#include "up_drive.h"
#include "up_ppm.h"

static const up_field_t six = {"Channels", 1U, UP_TYPE_UINT16, UP_TO_HOST, true, 6U, 0U};
static const up_ppm_config_t ppm = {.tick_hz = 2000000U, .gap_ticks = 5400U, .min_ticks = 1000U};

/* A train of `count` channels of 1000, 1100, 1200 ... us and the gap after it, in ticks of half a microsecond. */
static void train(up_ppm_raw_t *raw, uint32_t *time, uint32_t count) {
  uint32_t i;

  for (i = 0U; i < count; i++) {
    *time += 2U * (1000U + 100U * i);
    up_ppm_on_edge(&ppm, raw, *time);
  }
  *time += 2U * 8000U;
  up_ppm_on_edge(&ppm, raw, *time);
}

static void test_ppm(void) {
  up_ppm_raw_t raw;
  uint32_t time = 0xFFFFF000U, seen = 0U, i; /* the counter wraps within the first train */
  uint16_t channels[6];

  memset(&raw, 0, sizeof raw);
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING);
  up_ppm_on_edge(&ppm, &raw, time);
  train(&raw, &time, 6U); /* it began before reception started: only its gap counts */
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING);
  train(&raw, &time, 8U);
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_FRESH && raw.channels_count == 8U);
  for (i = 0U; i < 6U; i++) {
    CHECK(channels[i] == 1000U + 100U * i);
  }
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING);
  train(&raw, &time, 5U);
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_INVALID);
  /* A disturbance: the train is discarded, the next one counts. */
  up_ppm_on_edge(&ppm, &raw, time + 100U);
  train(&raw, &time, 6U);
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING && raw.spoilt == 1U);
  train(&raw, &time, 6U);
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_FRESH);
  train(&raw, &time, 17U); /* more channels than any receiver has */
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING && raw.spoilt == 2U);
  up_ppm_on_interval(&ppm, &raw, 20000U); /* silence is not a train */
  CHECK(up_ppm_read(&ppm, &raw, &seen, &six, channels) == UP_NOTHING && raw.trains == 3U);
}

/* ---- H-bridges ---- */

typedef struct {
  uint32_t outputs[3];
  bool was_wrong; /* both inputs at once, or a direction with the strength of the other */
} bridge_t;

static void drive_to(bridge_t *bridge, const up_drive_t *drive, up_drive_state_t *state, int16_t value) {
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  const size_t count = up_drive(drive, state, UP_TYPE_INT16, &value, writes);
  const int32_t wanted = (value > (int32_t)drive->full)    ? (int32_t)drive->full
                         : (value < -(int32_t)drive->full) ? -(int32_t)drive->full
                                                           : value;
  const bool has_pins = drive->mode == (uint8_t)UP_DRIVE_DIRECTION_PINS;
  size_t i;

  for (i = 0U; i < count; i++) {
    const uint32_t *o = bridge->outputs;
    bridge->outputs[writes[i].output] = writes[i].value;
    if (has_pins) {
      bridge->was_wrong = bridge->was_wrong || (o[1] != 0U && o[2] != 0U) ||
                          (o[0] != 0U && ((wanted > 0) ? o[2] != 0U : (wanted < 0) && o[1] != 0U));
    } else {
      bridge->was_wrong = bridge->was_wrong || (o[0] != 0U && o[1] != 0U);
    }
  }
  if (has_pins) {
    CHECK(bridge->outputs[1] == ((wanted > 0) ? 1U : 0U) && bridge->outputs[2] == ((wanted < 0) ? 1U : 0U));
    CHECK(bridge->outputs[0] == (uint32_t)((wanted < 0) ? -wanted : wanted));
  } else {
    CHECK(bridge->outputs[0] == (uint32_t)((wanted > 0) ? wanted : 0));
    CHECK(bridge->outputs[1] == (uint32_t)((wanted < 0) ? -wanted : 0));
  }
}

static void check_bridge(up_drive_mode_t mode, uint32_t pin) {
  static const int16_t values[] = {0, 500, 900, -200, -32768, 32767, 0, -1, 1, 0, 0, 1000, -1000};
  const up_drive_t drive = {.mode = (uint8_t)mode, .full = 1000U};
  up_drive_state_t state = {0, false};
  /* The state before the first value. */
  bridge_t bridge = {{0U, pin, 0U}, false};
  size_t i;

  for (i = 0U; i < sizeof values / sizeof values[0]; i++) {
    drive_to(&bridge, &drive, &state, values[i]);
  }
  CHECK(!bridge.was_wrong);
}

static void test_drive(void) {
  const up_drive_t drive = {.mode = UP_DRIVE_TWO_PWM, .full = 100U};
  up_drive_state_t state = {0, false};
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  const float real = -49.5F;

  check_bridge(UP_DRIVE_DIRECTION_PINS, 0U);
  check_bridge(UP_DRIVE_DIRECTION_PINS, 1U);
  check_bridge(UP_DRIVE_TWO_PWM, 0U);
  check_bridge(UP_DRIVE_TWO_PWM, 700U);
  CHECK(up_drive(&drive, &state, UP_TYPE_FLOAT32, &real, writes) == 2U);
  CHECK(writes[0].output == 0U && writes[0].value == 0U && writes[1].output == 1U && writes[1].value == 50U);
}

void test_outputs(void) {
  test_ppm();
  test_drive();
}
