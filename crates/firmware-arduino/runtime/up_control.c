#include "up_control.h"

#include <Arduino.h>
#include <string.h>

#include "up_encode.h"

/* How often an unchanged count is told. */
#define REPEAT_MS 1000U

static uint8_t is_hosts[UP_FIELD_BITMAP_BYTES];

bool up_control_yields(size_t field) {
  if (sense_owners[field] == (uint8_t)UP_OWNER_CODE) {
    return false;
  }
  if (sense_owners[field] == (uint8_t)UP_OWNER_CODE_OR_HOST) {
    up_bit_set(is_hosts, field);
  }
  return true;
}

void up_control_host_is_silent(void) {
  memset(is_hosts, 0, sizeof is_hosts);
}

/* ---- what code gets and sets ---- */

static uint32_t us_of(uint32_t ms) {
  return (ms > UINT32_MAX / 1000U) ? UINT32_MAX : ms * 1000U;
}

bool up_control_get(size_t field, void *value, uint32_t *age_us) {
  uint32_t age_ms;
  const bool is_good = up_is_good(field, &age_ms);

  *age_us = us_of(age_ms);
  return up_get(field, value) && is_good;
}

bool up_control_given(size_t field, void *value, uint32_t *age_us) {
  uint32_t age_ms;

  (void)up_is_good(field, &age_ms);
  *age_us = us_of(age_ms);
  return up_get(field, value);
}

void up_control_set(size_t field, const void *value) {
  if (!up_bit_get(is_hosts, field)) {
    up_set(field, value);
  }
}

void up_control_report(size_t field, void *value) {
  up_result(field, UP_FRESH, value);
}

/* ---- steps ---- */

static void tell(UP_ROM up_control_t *control) {
  uint32_t late = control->state->late;

  up_result(control->field, UP_FRESH, &late);
  control->state->told_ms = up_now_ms();
}

uint32_t up_control_cycle(UP_ROM void *work) {
  UP_ROM up_control_t *control = work;
  up_control_state_t *state = control->state;
  const uint32_t began_us = micros();
  const uint32_t since_us = state->has_begun ? began_us - state->began_us : 0U;

  sense_poll();
  control->run(since_us);
  /* A cycle was left out, or the step itself took too long. */
  if (since_us >= control->every_us + control->every_us / 2U || micros() - began_us > control->takes_us) {
    state->late++;
    tell(control);
  } else if (!state->has_begun || up_now_ms() - state->told_ms >= REPEAT_MS) {
    tell(control);
  } else {
    up_note_good(control->field);
  }
  state->began_us = began_us;
  state->has_begun = true;
  return 0U;
}
