/* The user's controllers. */
#include "up_control.h"

#include "up_divide.h"
#include "up_link.h"

#define US_A_SECOND 1000000U

static mutex_t lock;

void up_control_start(void) {
  chMtxObjectInit(&lock);
}

void up_control_lock(void) {
  chMtxLock(&lock);
}

void up_control_unlock(void) {
  chMtxUnlock(&lock);
}

bool up_control_get(size_t field, void *value, uint32_t *age_us) {
  up_health_row_t row;
  const bool has_value = up_get(field, value);

  up_lock();
  up_health_row(up_health(), field, up_now_ms(), &row);
  up_unlock();
  *age_us = (row.age_ms > UINT32_MAX / 1000U) ? UINT32_MAX : row.age_ms * 1000U;
  return has_value && (row.status == UP_STATUS_GOOD || up_config.cycles_ms[field] == 0U);
}

#if defined(SENSE_HAS_COMMANDS)
void up_control_set(size_t field, const void *value) {
  up_fall_back(field, value);
}
#endif

void up_control_report(size_t field, void *value) {
  up_result(field, UP_FRESH, value);
}

void up_control_cycle(const void *work) {
  const up_control_t *control = work;
  up_control_state_t *state = control->state;
  const systime_t began = chVTGetSystemTime();
  const sysinterval_t every = UP_MS2I(control->every_ms);
  const sysinterval_t since = state->has_begun ? chTimeDiffX(state->began, began) : 0U;
  sysinterval_t took;

  control->run(state->has_begun ? TIME_I2US(since) : 0U);
  took = chTimeDiffX(began, chVTGetSystemTime());
  /* A cycle was left out, or the step itself took too long. */
  if ((state->has_begun && since >= every + every / 2U) || took >= every || TIME_I2US(took) > control->takes_us) {
    state->late++;
  }
  if (!state->has_begun || state->late != 0U) {
    uint32_t late = state->late;

    up_result(control->field, UP_FRESH, &late);
  } else {
    up_note_good(control->field);
  }
  state->began = began;
  state->has_begun = true;
}
