/* The channel under the portable reporter, and what the reporter needs from this system. */
#include "up_link.h"

#include "sense_model.h"
#include "up_control.h"
#include "up_life.h"
#include "up_shell.h"

static up_reporter_t reporter;
static uint8_t frame[SENSE_REPORT_FRAME_BYTES];
static uint8_t buffer[SENSE_COMMAND_BUFFER_BYTES];

/* ---- the channel ---- */

static bool is_open(void *context) {
  (void)context;
  return up_channel_is_open();
}

static size_t read_bytes(void *context, uint8_t *bytes, size_t size) {
  (void)context;
  return chnReadTimeout(up_channel(), bytes, size, TIME_IMMEDIATE);
}

static size_t room(void *context) {
  (void)context;
  return up_channel_room();
}

/* Fewer than there was room for if USB has sent a buffer meanwhile that was only begun. */
static size_t write_bytes(void *context, const uint8_t *bytes, size_t size) {
  (void)context;
  return chnWriteTimeout(up_channel(), bytes, size, TIME_IMMEDIATE);
}

static const up_channel_t channel = {
    .is_open = is_open,
    .read = read_bytes,
    .room = room,
    .write = write_bytes,
    .room_max = UP_CHANNEL_ROOM_MAX,
};

/* ---- what the reporter needs ---- */

#if defined(SENSE_HAS_COMMANDS)
static sense_values_t received;

void up_fall_back(size_t field, const void *value) {
  static uint64_t changed[(UP_VALUE_BYTES_MAX + 7U) / 8U];

  /* The user's transform works on its own copy of the value. */
  memcpy(changed, value, up_field_bytes(&up_config.schema->fields[field]));
  up_put(field, changed);
  sense_apply(field, changed);
}

static void apply(void *context, size_t field, const void *value) {
  (void)context;
#if UP_HAS_CONTROL == TRUE
  if (!up_control_yields(field, value)) {
    return;
  }
#endif
  up_io_lock();
  up_fall_back(field, value);
  up_io_unlock();
  up_user_received(field);
}
#endif

static void failsafe(void *context) {
  (void)context;
#if UP_HAS_CONTROL == TRUE
  up_control_host_is_silent();
#endif
  up_io_lock();
  sense_failsafe();
  up_io_unlock();
}

static void describe(void *context, up_health_board_t *board) {
  (void)context;
  board->reset_cause = up_reset_cause();
  board->reset_device = up_reset_device();
  board->load_percent = up_load_percent();
  board->stack_left_bytes = up_stack_left();
}

#if UP_SHELL == TRUE
static bool intercept(void *context, uint8_t byte) {
  (void)context;
  return up_shell_wants(byte);
}
#endif

static void lock(void *context) {
  (void)context;
  up_lock();
}

static void unlock(void *context) {
  (void)context;
  up_unlock();
}

static uint32_t now_us(void) {
  return (uint32_t)(chVTGetTimeStamp() * UP_STEP_US);
}

void up_link_start(void) {
  static up_reporter_config_t config = {
      .reports = &sense_reports,
      .commands = &sense_commands,
      .channel = &channel,
      .frame = frame,
      .frame_bytes = sizeof frame,
      .buffer = buffer,
      .buffer_bytes = sizeof buffer,
      .silence_ms = UP_SILENCE_MS,
      .failsafe = failsafe,
      .describe = describe,
      .lock = lock,
      .unlock = unlock,
#if UP_SHELL == TRUE
      .intercept = intercept,
#endif
#if defined(SENSE_HAS_COMMANDS)
      .received = &received,
      .apply = apply,
#endif
  };

  config.schema = up_config.schema;
  config.store = up_store();
  config.health = up_health();
  config.cycle_ms = up_config.report_ms;
  /* The generated sizes and tables are made together; this checks that they still match. */
  if (!up_reporter_init(&reporter, &config, up_now_ms())) {
    chSysHalt("frame sizes");
  }
  up_channel_start();
}

void up_link_cycle(void) {
  const bool was_open = reporter.is_open;

  up_reporter_cycle(&reporter, up_now_ms(), now_us());
  if (was_open && !reporter.is_open) {
    up_shell_channel_closed();
  }
}

void up_link_pause(void) {
  up_reporter_pause(&reporter, up_now_ms());
}

bool up_link_peek(uint8_t byte) {
  return up_reporter_peek(&reporter, byte);
}

const up_reporter_t *up_link_reporter(void) {
  return &reporter;
}
