/* The reporter over a channel that accepts little, tears frames, and closes. */
#include <string.h>

#include "check.h"
#include "model_model.h"
#include "up_reporter.h"

typedef struct {
  uint8_t out[512], in[64];
  size_t out_size, in_size, room, room_max, accepts_most;
  bool is_open;
  unsigned applied, intercepted, locked, failsafes;
  int16_t motor;
  model_values_t values, received;
  up_store_t store;
  up_health_device_t devices[3];
  up_health_t health;
  uint8_t frame[MODEL_REPORT_FRAME_BYTES], buffer[MODEL_COMMAND_BUFFER_BYTES];
  up_channel_t channel;
  up_reporter_config_t config;
  up_reporter_t reporter;
} desk_t;

static bool is_open(void *context) {
  return ((desk_t *)context)->is_open;
}

static size_t read_bytes(void *context, uint8_t *bytes, size_t size) {
  desk_t *desk = context;

  size = (size < desk->in_size) ? size : desk->in_size;
  memcpy(bytes, desk->in, size);
  desk->in_size -= size;
  memmove(desk->in, &desk->in[size], desk->in_size);
  return size;
}

static size_t room(void *context) {
  return ((desk_t *)context)->room;
}

static size_t write_bytes(void *context, const uint8_t *bytes, size_t size) {
  desk_t *desk = context;

  CHECK(size <= desk->room && size > 0U);
  size = (size < desk->accepts_most) ? size : desk->accepts_most;
  memcpy(&desk->out[desk->out_size], bytes, size);
  desk->out_size += size;
  desk->room -= size;
  return size;
}

static void apply(void *context, size_t field, const void *value) {
  desk_t *desk = context;

  CHECK(field == 2U && desk->locked == 0U);
  memcpy(&desk->motor, value, sizeof desk->motor);
  desk->applied++;
}

static bool intercept(void *context, uint8_t byte) {
  desk_t *desk = context;

  desk->intercepted += (byte == (uint8_t)'q') ? 1U : 0U;
  return byte == (uint8_t)'q';
}

static void failsafe(void *context) {
  ((desk_t *)context)->failsafes++;
}

static void lock(void *context) {
  ((desk_t *)context)->locked++;
}

static void unlock(void *context) {
  ((desk_t *)context)->locked--;
}

static void set_up(desk_t *desk, size_t room_max) {
  const up_channel_t channel = {is_open, read_bytes, room, write_bytes, desk, room_max};

  memset(desk, 0, sizeof *desk);
  desk->room = room_max;
  desk->room_max = room_max;
  desk->accepts_most = SIZE_MAX;
  desk->is_open = true;
  desk->channel = channel;
  up_store_init(&desk->store, &model_schema, &desk->values);
  desk->health.devices = desk->devices;
  desk->health.devices_count = 3U;
  desk->config.schema = &model_schema;
  desk->config.reports = &model_reports;
  desk->config.commands = &model_commands;
  desk->config.channel = &desk->channel;
  desk->config.store = &desk->store;
  desk->config.health = &desk->health;
  desk->config.frame = desk->frame;
  desk->config.frame_bytes = sizeof desk->frame;
  desk->config.buffer = desk->buffer;
  desk->config.buffer_bytes = sizeof desk->buffer;
  desk->config.received = &desk->received;
  desk->config.cycle_ms = 10U;
  desk->config.apply = apply;
  desk->config.intercept = intercept;
  desk->config.failsafe = failsafe;
  desk->config.lock = lock;
  desk->config.unlock = unlock;
  desk->config.context = desk;
  desk->config.silence_ms = 100U;
  CHECK(up_reporter_init(&desk->reporter, &desk->config, 0U));
}

/* One cycle, in which the line sends all that it has; compares the bytes that the host then has received. */
static bool cycle(desk_t *desk, uint32_t now_ms, const void *wanted, size_t size) {
  desk->out_size = 0U;
  up_reporter_cycle(&desk->reporter, now_ms, now_ms * 1000U);
  desk->room = desk->room_max;
  CHECK(desk->locked == 0U);
  return desk->out_size == size && (size == 0U || memcmp(desk->out, wanted, size) == 0);
}

static void put_rear(desk_t *desk, uint8_t rear) {
  up_store_put(&desk->store, 1U, &rear);
}

static void skip_hello(desk_t *desk) {
  CHECK(cycle(desk, 0U, desk->out, 8U) && memcmp(desk->out, "5:\0", 3U) == 0);
}

static void test_turns(void) {
  desk_t desk;

  set_up(&desk, 256U);
  put_rear(&desk, 9U);
  skip_hello(&desk);
  CHECK(cycle(&desk, 10U, "2:\x13\x09,", 5U) && cycle(&desk, 20U, NULL, 0U));
  CHECK(desk.reporter.counts.reports_sent == 1U && desk.reporter.counts.reports_refused == 1U);
  /* A host that repeats its request does not prevent reports. */
  memcpy(desk.in, "2:\0\1,2:\0\1,", 10U);
  desk.in_size = 10U;
  put_rear(&desk, 8U);
  CHECK(cycle(&desk, 30U, desk.out, 74U) && memcmp(desk.out, "70:\xff\x01", 5U) == 0);
  memcpy(desk.in, "1:\0,", 4U);
  desk.in_size = 4U;
  CHECK(cycle(&desk, 40U, "2:\x13\x08,", 5U) && cycle(&desk, 50U, desk.out, 8U) && cycle(&desk, 60U, NULL, 0U));
}

static void test_little_room(void) {
  desk_t desk;

  set_up(&desk, 3U);
  CHECK(cycle(&desk, 0U, "5:\0", 3U) && cycle(&desk, 10U, desk.out, 3U) && cycle(&desk, 20U, desk.out, 2U));
  put_rear(&desk, 7U);
  CHECK(cycle(&desk, 30U, "2:\x13", 3U));
  /* Values that arrived in between are in the next report. */
  put_rear(&desk, 6U);
  CHECK(cycle(&desk, 40U, "\x07,", 2U) && desk.reporter.counts.reports_sent == 1U);
  CHECK(cycle(&desk, 50U, "2:\x13", 3U));
  /* Closed in the middle of a frame: it is torn, and its value is due again. */
  desk.is_open = false;
  CHECK(cycle(&desk, 60U, NULL, 0U) && desk.reporter.counts.frames_torn == 1U);
  desk.is_open = true;
  CHECK(cycle(&desk, 70U, "5:\0", 3U) && cycle(&desk, 80U, desk.out, 3U) && cycle(&desk, 90U, desk.out, 2U));
  CHECK(cycle(&desk, 100U, "2:\x13", 3U) && cycle(&desk, 110U, "\x06,", 2U));
  CHECK(desk.reporter.counts.reports_sent == 2U);
  put_rear(&desk, 5U);
  desk.accepts_most = 0U;
  CHECK(cycle(&desk, 120U, NULL, 0U) && desk.reporter.counts.frames_torn == 2U);
  /* Less room than was promised: the rest follows. */
  desk.accepts_most = 1U;
  CHECK(cycle(&desk, 122U, "2", 1U) && cycle(&desk, 124U, ":", 1U) && cycle(&desk, 126U, "\x13", 1U));
  desk.accepts_most = SIZE_MAX;
  CHECK(cycle(&desk, 128U, "\x05,", 2U) && desk.reporter.counts.frames_torn == 2U);
  put_rear(&desk, 5U);
  CHECK(cycle(&desk, 130U, "2:\x13", 3U) && cycle(&desk, 140U, "\x05,", 2U));
}

static void test_receiving(void) {
  desk_t desk;

  set_up(&desk, 256U);
  skip_hello(&desk);
  /* A `q` within a frame is part of a value. */
  memcpy(desk.in, "q3:\x28qq,q3:\x28\0\x05,2:\x28\0,", 19U);
  desk.in_size = 19U;
  CHECK(cycle(&desk, 10U, NULL, 0U) && desk.applied == 2U && desk.motor == 5 && desk.intercepted == 2U);
  CHECK(desk.reporter.decoder.dropped_bytes == 5U);
  /* After digits, only a digit or a colon is part of a frame. */
  memcpy(desk.in, "12q", 3U);
  desk.in_size = 3U;
  CHECK(cycle(&desk, 11U, NULL, 0U) && desk.intercepted == 3U);
  CHECK(cycle(&desk, 109U, NULL, 0U) && desk.failsafes == 0U && cycle(&desk, 110U, NULL, 0U) && desk.failsafes == 1U);
  /* Actuators fall back whoever uses the channel; a byte that another reader has read counts. */
  CHECK(!up_reporter_peek(&desk.reporter, '1') && !up_reporter_peek(&desk.reporter, ':'));
  CHECK(!up_reporter_peek(&desk.reporter, 0U) && up_reporter_peek(&desk.reporter, ','));
  up_reporter_pause(&desk.reporter, 209U);
  CHECK(desk.failsafes == 1U);
  up_reporter_pause(&desk.reporter, 210U);
  CHECK(desk.failsafes == 2U);
  CHECK(cycle(&desk, 220U, desk.out, 8U));
}

static void test_old_values(void) {
  static const uint32_t cycles_ms[] = {20U, 50U, 0U};
  const uint16_t front = 300U;
  desk_t desk;

  set_up(&desk, 256U);
  desk.health.cycles_ms = cycles_ms;
  skip_hello(&desk);
  up_store_put(&desk.store, 0U, &front);
  up_health_note(&desk.health, 0U, UP_FRESH, 10U);
  put_rear(&desk, 9U);
  up_health_note(&desk.health, 1U, UP_FRESH, 10U);
  desk.room = 100U;
  up_reporter_cycle(&desk.reporter, 20U, 20000U);
  desk.room = 256U;
  /* 41 ms are more than two cycles of one device, and less than one cycle of the other. */
  CHECK(cycle(&desk, 51U, "2:\x13\x09,", 5U) && desk.reporter.counts.values_dropped == 1U);
  up_store_put(&desk.store, 0U, &front);
  up_health_note(&desk.health, 0U, UP_FRESH, 60U);
  CHECK(cycle(&desk, 100U, "3:\x11\x01\x2c,", 6U) && desk.reporter.counts.values_dropped == 1U);
}

static void test_sizes(void) {
  desk_t desk;

  set_up(&desk, 256U);
  desk.config.frame_bytes--;
  CHECK(!up_reporter_init(&desk.reporter, &desk.config, 0U));
  desk.config.frame_bytes++;
  desk.config.buffer_bytes = MODEL_COMMAND_FRAME_BYTES - 1U;
  CHECK(!up_reporter_init(&desk.reporter, &desk.config, 0U));
}

void test_reporter(void) {
  test_turns();
  test_little_room();
  test_receiving();
  test_old_values();
  test_sizes();
}
