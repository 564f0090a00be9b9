/* The user's controllers, and their guard. */
#include "up_control.h"

#if UP_HAS_CONTROL == TRUE

#include <string.h>

#include "sense_model.h"
#include "up_checksum.h"

/* The record is the board's own: the schema's hash is part of it. */
#define KEPT_MAGIC 0x4B455054U
#define CRC_POLYNOMIAL 0x1021U
/* The guard wakes once in the shortest cycle, and lets a controller miss one. */
#define MISSED_CYCLES 2U

/* How often an unchanged count is reported. */
#define REPEAT_MS 1000U

static const up_controls_t *all;
static mutex_t lock;
static uint8_t is_hosts[UP_FIELD_BITMAP_BYTES];

void up_io_lock(void) {
  chMtxLock(&lock);
}

void up_io_unlock(void) {
  chMtxUnlock(&lock);
}

/* ---- what survives a reset ---- */

static uint16_t sum_of_record(void) {
  return up_crc16_of(CRC_POLYNOMIAL, (const uint8_t *)&all->record[2], all->record_bytes - 2U * sizeof(uint32_t));
}

static bool is_record_right(void) {
  return all->record[0] == (KEPT_MAGIC ^ up_config.schema->hash) && all->record[1] == sum_of_record();
}

static void write_record(void) {
  all->record[0] = KEPT_MAGIC ^ up_config.schema->hash;
  all->record[1] = sum_of_record();
  cacheBufferFlush(all->record, all->record_bytes);
}

/* Where a field is kept; NULL if it is not. */
static uint8_t *kept(size_t field) {
  size_t i;

  for (i = 0U; i < all->kept_count; i++) {
    if (all->kept[i].field == field) {
      return (uint8_t *)&all->record[2] + all->kept[i].offset;
    }
  }
  return NULL;
}

void up_control_begin(size_t field, const void *value) {
  static uint64_t first[(UP_VALUE_BYTES_MAX + 7U) / 8U];
  const size_t bytes = up_field_bytes(&up_config.schema->fields[field]);
  uint8_t *place = kept(field);

  if (place != NULL && !is_record_right()) {
    place = NULL;
  }
  memcpy(first, (place != NULL) ? place : value, bytes);
  up_put(field, first);
}

/* ---- whom an actuator obeys ---- */

bool up_control_yields(size_t field, const void *value) {
  uint8_t *place = kept(field);

  if (all->owners[field] == (uint8_t)UP_OWNER_CODE) {
    return false;
  }
  if (all->owners[field] == (uint8_t)UP_OWNER_CODE_OR_HOST) {
    up_bit_set(is_hosts, field);
  }
  if (place != NULL) {
    if (!is_record_right()) {
      size_t i;

      for (i = 0U; i < all->kept_count; i++) {
        (void)up_get(all->kept[i].field, (uint8_t *)&all->record[2] + all->kept[i].offset);
      }
    }
    memcpy(place, value, up_field_bytes(&up_config.schema->fields[field]));
    write_record();
  }
  return true;
}

void up_control_host_is_silent(void) {
  memset(is_hosts, 0, sizeof is_hosts);
}

/* ---- what code gets and sets ---- */

static bool newest(size_t field, void *value, uint32_t *age_us, uint8_t *status) {
  up_health_row_t row;
  const bool has_value = up_get(field, value);

  up_lock();
  up_health_row(up_health(), field, up_now_ms(), &row);
  up_unlock();
  *age_us = (row.age_ms > UINT32_MAX / 1000U) ? UINT32_MAX : row.age_ms * 1000U;
  *status = row.status;
  return has_value;
}

bool up_control_get(size_t field, void *value, uint32_t *age_us) {
  uint8_t status;

  return newest(field, value, age_us, &status) && status == (uint8_t)UP_STATUS_GOOD;
}

bool up_control_given(size_t field, void *value, uint32_t *age_us) {
  uint8_t status;

  return newest(field, value, age_us, &status);
}

#if defined(SENSE_HAS_COMMANDS)
void up_control_set(size_t field, const void *value) {
  if (!up_bit_get(is_hosts, field)) {
    up_io_lock();
    up_fall_back(field, value);
    up_io_unlock();
  }
}
#endif

void up_control_report(size_t field, void *value) {
  up_result(field, UP_FRESH, value);
}

/* ---- steps ---- */

/* The time that has passed since the counter was read, in microseconds. */
#if PORT_SUPPORTS_RT == TRUE
#define CLOCK() chSysGetRealtimeCounterX()
#define CLOCKS_A_US (UP_CORE_HZ / 1000000U)
static uint32_t clock_us(rtcnt_t since) {
  return (uint32_t)(chSysGetRealtimeCounterX() - since) / CLOCKS_A_US;
}
#else
#define CLOCK() chVTGetSystemTime()
static uint32_t clock_us(systime_t since) {
  return (uint32_t)chTimeDiffX(since, chVTGetSystemTime()) * UP_STEP_US;
}
#endif

static void tell(const up_control_t *control) {
  uint32_t late = control->state->late;

  up_result(control->field, UP_FRESH, &late);
  control->state->told_ms = up_now_ms();
}

void up_control_cycle(const void *work) {
  const up_control_t *control = work;
  up_control_state_t *state = control->state;
  const systime_t began = chVTGetSystemTime();
  const uint32_t every = UP_MS2I(control->every_ms);
  const sysinterval_t since = state->has_begun ? chTimeDiffX(state->began, began) : (sysinterval_t)0;
  uint32_t took_us;

  if (!state->has_begun) {
    /* The guard waits for the end of the first step, too. */
    state->ended_ms = up_now_ms();
    state->has_begun = true;
  }
  up_io_lock();
  sense_poll();
  up_io_unlock();
  {
    const uint32_t clock = (uint32_t)CLOCK();

    control->run((uint32_t)since * UP_STEP_US);
    took_us = clock_us(clock);
  }
  /* A cycle was left out, or the step itself took too long. */
  if ((uint32_t)since >= every + (every + 1U) / 2U || took_us > control->takes_us) {
    state->late++;
    tell(control);
  } else if (up_now_ms() - state->told_ms >= REPEAT_MS) {
    tell(control);
  } else {
    up_note_good(control->field);
  }
  state->began = began;
  state->ended_ms = up_now_ms();
  state->has_hung = false;
}

/* ---- the guard ---- */

static void look_at(const up_control_t *control) {
  up_control_state_t *state = control->state;
  const uint32_t since_ms = up_now_ms() - state->ended_ms;

  if (!state->has_begun || state->has_hung || since_ms <= MISSED_CYCLES * control->every_ms) {
    return;
  }
  state->has_hung = true;
  if (control->fall_back != NULL) {
    up_io_lock();
    control->fall_back();
    up_io_unlock();
  }
  state->late++;
  tell(control);
}

static THD_FUNCTION(guard, argument) {
  sysinterval_t cycle = TIME_MAX_INTERVAL;
  systime_t previous = chVTGetSystemTime();
  size_t i;

  (void)argument;
  chRegSetThreadName("guard of controllers");
  for (i = 0U; i < all->count; i++) {
    const sysinterval_t every = UP_MS2I(all->all[i]->every_ms);

    cycle = (every < cycle) ? every : cycle;
  }
  for (;;) {
    previous = chThdSleepUntilWindowed(previous, chTimeAddX(previous, cycle));
    for (i = 0U; i < all->count; i++) {
      look_at(all->all[i]);
    }
  }
}

void up_control_start(const up_controls_t *controls) {
  size_t i;

  all = controls;
  chMtxObjectInit(&lock);
  all->begin();
  for (i = 0U; i < all->count; i++) {
    all->all[i]->init();
  }
  (void)chThdCreateStatic(all->stack, all->stack_bytes, (tprio_t)((int)NORMALPRIO + all->prio), guard, NULL);
}

#endif
