#include "up_rt.h"

#include <Arduino.h>
#include <string.h>

#include "sense_model.h"
#if UP_HAS_CONTROL
#include "up_control.h"
#endif
#include "up_life.h"
#include "up_reporter.h"

/* The latest values, and how their devices are. */
static up_store_t store;
static up_health_device_t devices[UP_FIELDS_COUNT];
static up_health_t health = {.devices = devices, .devices_count = UP_FIELDS_COUNT};
uint64_t up_scratch[(UP_VALUE_BYTES_MAX + 7U) / 8U];

uint32_t up_now_ms(void) {
  return millis();
}

uint8_t up_type_of(size_t field) {
  return sense_schema.fields[field].type;
}

/* ---- values ---- */

void up_put(size_t field, const void *value) {
  up_store_put(&store, field, value);
  up_health_note(&health, field, UP_FRESH, up_now_ms());
}

void up_note_good(size_t field) {
  up_health_note(&health, field, UP_FRESH, up_now_ms());
}

void up_result(size_t field, up_result_t result, void *value) {
#if UP_HAS_FILTERS
  if (result == UP_FRESH && sense_filters[field].filter != UP_ROM_NULL) {
    result = up_filter_apply(sense_filters[field].filter, sense_filters[field].state, &sense_schema.fields[field],
                             up_now_ms(), value);
    if (result == UP_NOTHING) {
      /* The device has answered; the filter keeps the value back. */
      up_note_good(field);
    }
  }
#endif
  if (result == UP_FRESH) {
    sense_transforms[field](value);
    up_put(field, value);
  } else {
    up_health_note(&health, field, result, up_now_ms());
  }
}

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  up_result(field, result, value);
}

const up_value_sink_t up_values = {.on_value = on_value};

bool up_get(size_t field, void *value) {
  const void *latest = up_store_get(&store, field);

  if (latest != NULL) {
    memcpy(value, latest, up_field_bytes(&sense_schema.fields[field]));
  }
  return latest != NULL;
}

bool up_is_good(size_t field, uint32_t *age_ms) {
  up_health_row_t row;

  up_health_row(&health, field, up_now_ms(), &row);
  *age_ms = row.age_ms;
  return row.status == (uint8_t)UP_STATUS_GOOD;
}

/* ---- what is set ---- */

__attribute__((weak)) void up_user_init(void) {
}

__attribute__((weak)) void up_user_received(size_t field) {
  (void)field;
}

void up_set(size_t field, const void *value) {
  memmove(up_scratch, value, up_field_bytes(&sense_schema.fields[field]));
  sense_transforms[field](up_scratch);
  up_put(field, up_scratch);
  sense_apply(field, up_scratch);
}

void up_fall_back(size_t field, const void *value) {
  up_store_put(&store, field, value);
  sense_apply(field, value);
}

#if UP_USES_COMMANDS
/* The host has set an actuator; where a controller has it, that decides. */
static void on_set(void *context, size_t field, const void *value) {
  (void)context;
#if UP_HAS_CONTROL
  if (!up_control_yields(field)) {
    return;
  }
#endif
  up_set(field, value);
  up_user_received(field);
}
#endif

static void on_silence(void *context) {
  (void)context;
#if UP_HAS_CONTROL
  up_control_host_is_silent();
#endif
  sense_failsafe();
}

/* ---- the link ---- */

static void describe(void *context, up_health_board_t *board) {
  (void)context;
  up_life_describe(board);
}

static UP_ROM up_channel_t channel = {
    .is_open = sense_link_is_open,
    .read = sense_link_read,
    .room = sense_link_room,
    .write = sense_link_write,
    .room_max = UP_LINK_ROOM_BYTES,
};
static uint8_t frame[SENSE_REPORT_FRAME_BYTES];
#if UP_USES_COMMANDS
static uint8_t buffer[SENSE_COMMAND_BUFFER_BYTES];
static sense_values_t received;
#endif
UP_ROM up_reporter_config_t UP_REPORTER_CONFIG = {
    .schema = &sense_schema,
    .reports = &sense_reports,
    .commands = &sense_commands,
    .channel = &channel,
    .store = &store,
    .health = &health,
    .frame = frame,
    .frame_bytes = sizeof frame,
#if UP_USES_COMMANDS
    .buffer = buffer,
    .buffer_bytes = sizeof buffer,
    .received = &received,
    .apply = on_set,
#endif
    .cycle_ms = UP_REPORT_MS,
    .silence_ms = UP_SILENCE_MS,
    .failsafe = on_silence,
    .describe = describe,
};
static up_reporter_t reporter;

/* ---- the loop ---- */

/* When the next cycle of a task begins, and when it goes on. */
typedef struct {
  uint32_t next_ms;
  uint32_t wake_ms;
} task_state_t;

#if UP_TASKS_COUNT > 0
static task_state_t states[UP_TASKS_COUNT];
#endif
static uint32_t reported_ms;

/* Half the range of the clock is ahead, half of it is in the past. */
static bool is_due(uint32_t when_ms, uint32_t now_ms) {
  return now_ms - when_ms < 0x80000000U;
}

#if UP_TASKS_COUNT > 0
/* Begins a cycle: the one after it is on the same grid. Cycles that nobody had time for are counted. */
static void begin(UP_ROM up_task_t *task, task_state_t *state, uint32_t now_ms) {
  state->next_ms += task->delay_ms;
  while (is_due(state->next_ms, now_ms)) {
    state->next_ms += task->delay_ms;
    up_health_note(&health, task->field, UP_TIMED_OUT, now_ms);
  }
}

static void run(UP_ROM up_task_t *task, task_state_t *state, uint32_t turn_ms) {
  uint32_t now_ms;
  uint32_t wait_ms;

  if (!is_due(state->wake_ms, turn_ms)) {
    return;
  }
  if (is_due(state->next_ms, turn_ms)) {
    begin(task, state, turn_ms);
  }
  up_life_enter(task->field);
  wait_ms = task->cycle(task->work);
  up_life_leave();
  now_ms = up_now_ms();
  state->wake_ms = state->next_ms;
  if (wait_ms > 0U && !is_due(state->next_ms, now_ms + wait_ms)) {
    state->wake_ms = now_ms + wait_ms;
  }
}
#endif

void up_setup(void) {
#if UP_TASKS_COUNT > 0
  uint8_t i;
#endif

  up_life_start();
  up_store_init(&store, &sense_schema, &sense_values);
  health.cycles_ms = sense_cycles_ms;
  sense_link_start();
  (void)up_reporter_init(&reporter, &UP_REPORTER_CONFIG, up_now_ms());
  sense_start();
  up_user_init();
#if UP_HAS_CONTROL
  sense_control_start();
#endif
  reported_ms = up_now_ms();
#if UP_TASKS_COUNT > 0
  for (i = 0U; i < UP_TASKS_COUNT; i++) {
    states[i].next_ms = reported_ms + sense_tasks[i].start_ms;
    states[i].wake_ms = states[i].next_ms;
  }
#endif
}

static void listen(void) {
  up_reporter_listen(&reporter, up_now_ms());
  sense_drain();
}

/* A turn looks at the clock once: what is due at the same moment runs in the order of the table, whenever in a turn that
 * moment comes. Otherwise the time from one step of a controller to the next would change by what runs before it. */
void up_loop(void) {
  const uint32_t turn_ms = up_now_ms();
#if UP_TASKS_COUNT > 0
  uint8_t i;

  for (i = 0U; i < UP_TASKS_COUNT; i++) {
    listen();
    run(&sense_tasks[i], &states[i], turn_ms);
  }
#endif
  listen();
  if (is_due(reported_ms + UP_REPORT_MS, turn_ms)) {
    sense_poll();
    up_reporter_cycle(&reporter, up_now_ms(), UP_WIRE_STAMPS ? micros() : 0U);
    /* Cycles are on a grid, from which those are missing that nobody had time for. */
    do {
      reported_ms += UP_REPORT_MS;
    } while (is_due(reported_ms + UP_REPORT_MS, up_now_ms()));
  }
  up_life_turn();
}
