/* Start of the application, the shared store of values, and the reporter. */
#include "up_rt.h"

#include <string.h>

#include "up_divide.h"
#include "up_doctor.h"
#include "up_life.h"
#include "up_link.h"
#include "up_shell.h"

static up_store_t store;
static mutex_t store_lock;
static uint32_t sequences[UP_FIELDS_COUNT];
static up_health_device_t devices[UP_FIELDS_COUNT];
static up_health_t health = {.devices = devices, .devices_count = UP_FIELDS_COUNT};
/* The common time origin of all threads, so that those of a group keep apart. */
static systime_t start;

__attribute__((weak)) void up_user_init(void) {
}

__attribute__((weak)) void up_user_received(size_t field) {
  (void)field;
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

void up_result(size_t field, up_result_t result, void *value) {
  if (result == UP_FRESH && up_config.filters != NULL && up_config.filters[field].filter != NULL) {
    const up_filtered_t *own = &up_config.filters[field];

    result = up_config.filter(own->filter, own->state, &up_config.schema->fields[field], up_now_ms(), value);
    if (result == UP_NOTHING) {
      /* The device answered; the filter withholds the value from the host. */
      note(field, UP_FRESH);
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

/* A fixed rate: a late cycle does not shift the following ones, and missed ones are skipped, so that threads that
 * keep apart do so for good. */
static void sleep_cycle(systime_t *previous, sysinterval_t cycle) {
  const systime_t next = chTimeAddX(*previous, cycle);
  sysinterval_t late;

  (void)chThdSleepUntilWindowed(*previous, next);
  late = chTimeDiffX(next, chVTGetSystemTime());
  *previous = chTimeAddX(next, late - late % cycle);
}

static THD_FUNCTION(run_task, argument) {
  const up_task_t *task = argument;
  systime_t previous = start;

  chRegSetThreadName(task->name);
  if (task->start_ms > 0U) {
    const systime_t first = chTimeAddX(start, UP_MS2I(task->start_ms));

    (void)chThdSleepUntilWindowed(start, first);
    previous = first;
  }
  for (;;) {
    task->cycle(task->work);
    up_life_beat((size_t)(task - up_config.tasks));
    sleep_cycle(&previous, UP_MS2I(task->delay_ms));
  }
}

static void start_drivers(void) {
  size_t i;

  up_doctor_look_at_inputs();
  for (i = 0U; i < up_config.pads_count; i++) {
    palWriteLine(up_config.pads[i].line, up_config.pads[i].level);
    palSetLineMode(up_config.pads[i].line, up_config.pads[i].mode);
  }
  sense_start();
}

static void start_tasks(void) {
  size_t i;

  start = chVTGetSystemTime();
  for (i = 0U; i < up_config.tasks_count; i++) {
    const up_task_t *task = &up_config.tasks[i];
    /* The argument is a const table, but the kernel's signature has only void pointers. */
    (void)chThdCreateStatic(task->stack, task->stack_bytes, (tprio_t)((int)NORMALPRIO + task->prio), run_task,
                            (void *)(uintptr_t)task);
  }
}

static void report_cycle(void) {
  sense_poll();
  if (up_shell_cycle()) {
    up_link_pause();
  } else {
    up_link_cycle();
  }
}

int main(void) {
  systime_t previous;

  halInit();
  chSysInit();
  up_life_init();
  chMtxObjectInit(&store_lock);
  up_store_init(&store, up_config.schema, up_config.values);
  health.cycles_ms = up_config.cycles_ms;
  up_user_init();
  start_drivers();
  start_tasks();
  up_link_start();
  up_shell_start();
  up_life_start();
  previous = chVTGetSystemTime();
  for (;;) {
    report_cycle();
    up_life_cycle();
    sleep_cycle(&previous, UP_MS2I(up_config.report_ms));
  }
}
