/* The shared store of values, with the health of the devices that they come from. */
#include "up_rt.h"

#include <string.h>

#include "up_divide.h"

static up_store_t store;
static mutex_t store_lock;
static uint32_t sequences[UP_FIELDS_COUNT];
static up_health_device_t devices[UP_FIELDS_COUNT];
static up_health_t health = {.devices = devices, .devices_count = UP_FIELDS_COUNT};

void up_store_start(void) {
  chMtxObjectInit(&store_lock);
  up_store_init(&store, up_config.schema, up_config.values);
  health.cycles_ms = up_config.cycles_ms;
}

/* From the 64-bit time stamp: the system time wraps after days, and not at a power of two of milliseconds. */
uint32_t up_now_ms(void) {
  return up_divide(chVTGetTimeStamp(), CH_CFG_ST_FREQUENCY / 1000U);
}

void up_put(size_t field, void *value) {
  if (up_config.transforms[field] != NULL) {
    up_config.transforms[field](value);
  }
  chMtxLock(&store_lock);
  up_store_put(&store, field, value);
  sequences[field]++;
  up_health_note(&health, field, UP_FRESH, up_now_ms());
  chMtxUnlock(&store_lock);
}

static void note(size_t field, up_result_t result) {
  chMtxLock(&store_lock);
  up_health_note(&health, field, result, up_now_ms());
  chMtxUnlock(&store_lock);
}

void up_fail(size_t field) {
  note(field, UP_BUS_ERROR);
}

void up_note_good(size_t field) {
  note(field, UP_FRESH);
}

void up_result(size_t field, up_result_t result, void *value) {
  if (result == UP_FRESH && up_config.filters != NULL && up_config.filters[field].filter != NULL) {
    const up_filtered_t *own = &up_config.filters[field];

    result = up_config.filter(own->filter, own->state, &up_config.schema->fields[field], up_now_ms(), value);
    if (result == UP_NOTHING) {
      /* The device answered; the filter withholds the value from the host. */
      up_note_good(field);
    }
  }
  if (result == UP_FRESH) {
    up_put(field, value);
  } else {
    note(field, result);
  }
}

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  up_result(field, result, value);
}

const up_value_sink_t up_values = {.on_value = on_value};

bool up_get(size_t field, void *value) {
  const void *latest;

  chMtxLock(&store_lock);
  latest = up_store_get(&store, field);
  if (latest != NULL) {
    memcpy(value, latest, up_field_bytes(&up_config.schema->fields[field]));
  }
  chMtxUnlock(&store_lock);
  return latest != NULL;
}

uint32_t up_sequence(size_t field) {
  return sequences[field];
}

uint32_t up_errors(size_t field) {
  uint32_t sum = 0U;
  size_t i;

  for (i = 0U; i < UP_FAULTS; i++) {
    sum += devices[field].counts[i];
  }
  return sum;
}

uint32_t up_age_ms(size_t field) {
  up_health_row_t row;

  up_lock();
  up_health_row(&health, field, up_now_ms(), &row);
  up_unlock();
  return row.age_ms;
}

up_store_t *up_store(void) {
  return &store;
}

up_health_t *up_health(void) {
  return &health;
}

void up_lock(void) {
  chMtxLock(&store_lock);
}

void up_unlock(void) {
  chMtxUnlock(&store_lock);
}
