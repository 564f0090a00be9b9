/* The reporter in C over a channel that a script opens, fills and tears; see core.c. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "up_reporter.h"

#define ROOM_MAX 64U
#define FIELDS 5U

static const up_field_t fields[FIELDS] = {
    {"a", 17U, UP_TYPE_UINT16, UP_TO_HOST, false, 1U, 0U},
    {"b", 18U, UP_TYPE_UINT8, UP_TO_HOST, true, 40U, 2U},
    {"c", 33U, UP_TYPE_INT16, UP_TO_BOARD, false, 1U, 42U},
    {"d", 34U, UP_TYPE_BOOL, UP_TO_BOARD, true, 2U, 44U},
    {"e", 20U, UP_TYPE_UINT32, UP_TO_HOST, false, 1U, 48U},
};
static const uint32_t cycles_ms[FIELDS] = {10U, 0U, 0U, 0U, 100U};

static up_schema_t schema = {fields, FIELDS, false, 0xC0FFEE17U};
static uint8_t values[52], received[52], frame[512], buffer[512];
static up_wire_t reports, commands;
static up_store_t store;
static up_health_device_t devices[FIELDS];
static up_health_t health;
static up_reporter_config_t config;
static up_reporter_t reporter;
static up_channel_t channel;
static bool is_open;
static uint64_t accepts;
static size_t room;
static const uint8_t *coming;
static size_t coming_size;

static size_t put(const uint8_t *due, const void *from, uint8_t *payload) {
  uint8_t *at = payload;
  size_t i;

  for (i = 0U; i < FIELDS; i++) {
    const uint8_t *value = (const uint8_t *)from + fields[i].offset;
    if (up_bit_get(due, i)) {
      at = up_put_8(at, fields[i].id);
      at = up_put_array(at, value, up_type_bytes(fields[i].type), fields[i].count);
    }
  }
  return (size_t)(at - payload);
}

static up_item_t item(uint8_t id) {
  const up_field_t *field = up_schema_find(&schema, id, UP_TO_BOARD);

  return (field == NULL) ? UP_ITEM_NONE : UP_ITEM(up_field_bytes(field), field->type == UP_TYPE_BOOL);
}

static void take(const uint8_t *items, const uint8_t *end, void *to, uint8_t *taken) {
  while (items < end) {
    const up_field_t *field = up_schema_find(&schema, items[0], UP_TO_BOARD);
    up_get_array(&items[1], (uint8_t *)to + field->offset, up_type_bytes(field->type), field->count);
    up_bit_set(taken, (size_t)(field - fields));
    items += 1U + up_field_bytes(field);
  }
}

static bool channel_is_open(void *context) {
  (void)context;
  return is_open;
}

static size_t channel_read(void *context, uint8_t *bytes, size_t size) {
  (void)context;
  size = (size < coming_size) ? size : coming_size;
  memcpy(bytes, coming, size);
  coming += size;
  coming_size -= size;
  return size;
}

static size_t channel_room(void *context) {
  (void)context;
  return room;
}

static size_t channel_write(void *context, const uint8_t *bytes, size_t size) {
  size_t i;

  (void)context;
  if (accepts == 1U) {
    return 0U;
  }
  size = (accepts == 0U) ? size : (size + 1U) / 2U;
  printf(" w");
  for (i = 0U; i < size; i++) {
    printf("%02x", (unsigned)bytes[i]);
  }
  room -= size;
  return size;
}

static void apply(void *context, size_t field, const void *value) {
  const uint8_t *memory = value;
  const size_t size = up_type_bytes(fields[field].type);
  size_t i;

  (void)context;
  printf(" a%u", (unsigned)field);
  for (i = 0U; i < fields[field].count; i++) {
    printf(":%" PRIx64, up_element_load(fields[field].type, &memory[i * size]));
  }
}

static void failsafe(void *context) {
  (void)context;
  printf(" failsafe");
}

static bool intercept(void *context, uint8_t byte) {
  (void)context;
  return byte == (uint8_t)'?';
}

static up_wire_t wire(bool is_report, bool has_stamp, up_link_checksum_t checksum) {
  up_wire_t one = {.hash = schema.hash, .checksum = (uint8_t)checksum, .put = put, .item = item, .take = take};
  const size_t sums = UP_WIRE_CHECKSUM_BYTES(&one);

  one.direction = is_report ? (uint8_t)UP_TO_HOST : (uint8_t)UP_TO_BOARD;
  one.has_stamp = is_report && has_stamp;
  one.values_bytes_max = (uint16_t)(is_report ? 49U + (has_stamp ? 6U : 0U) : 6U);
  one.health_bytes = is_report ? (uint16_t)(UP_HEALTH_BOARD_BYTES + FIELDS * UP_HEALTH_DEVICE_BYTES) : 0U;
  one.payload_bytes_max = (uint16_t)((is_report ? one.health_bytes : one.values_bytes_max) + sums);
  one.head_bytes = (uint8_t)(is_report ? 4U : 2U);
  return one;
}

void begin_reporter(const uint64_t *how) {
  static const char *const names[] = {"none", "crc16", "crc32"};
  static const up_link_checksum_t checksums[] = {UP_LINK_NONE, UP_LINK_CRC16, UP_LINK_CRC32};

  memset(&config, 0, sizeof config);
  memset(devices, 0, sizeof devices);
  memset(&health, 0, sizeof health);
  memset(values, 0, sizeof values);
  schema.checksum = names[how[1]];
  reports = wire(true, how[0] != 0U, checksums[how[1]]);
  commands = wire(false, how[0] != 0U, checksums[how[1]]);
  up_store_init(&store, &schema, values);
  health.devices = devices;
  health.cycles_ms = cycles_ms;
  health.devices_count = FIELDS;
  channel.is_open = channel_is_open;
  channel.read = channel_read;
  channel.room = channel_room;
  channel.write = channel_write;
  channel.room_max = ROOM_MAX;
  config.schema = &schema;
  config.reports = &reports;
  config.commands = &commands;
  config.channel = &channel;
  config.store = &store;
  config.health = &health;
  config.frame = frame;
  config.frame_bytes = sizeof frame;
  config.buffer = buffer;
  config.buffer_bytes = sizeof buffer;
  config.received = received;
  config.cycle_ms = (uint32_t)how[2];
  config.silence_ms = (uint32_t)how[3];
  config.apply = apply;
  config.failsafe = failsafe;
  config.intercept = intercept;
  printf(" %u", (unsigned)up_reporter_init(&reporter, &config, 0U));
}

void put_value(size_t field, const uint8_t *bytes) {
  uint64_t value[8];

  up_get_array(bytes, value, up_type_bytes(fields[field].type), fields[field].count);
  up_store_put(&store, field, value);
}

void note_outcome(size_t field, unsigned outcome, uint32_t now_ms) {
  up_health_note(&health, field, (up_result_t)outcome, now_ms);
}

/* `how`: open, the part of what is written that is accepted, room, paused, whether counts are told. */
void cycle(uint64_t now_us, const uint64_t *how, const uint8_t *bytes, size_t size) {
  is_open = how[0] != 0U;
  accepts = how[1];
  room = (size_t)how[2];
  coming = bytes;
  coming_size = size;
  if (how[3] != 0U) {
    up_reporter_pause(&reporter, (uint32_t)(now_us / 1000U));
  } else {
    up_reporter_cycle(&reporter, (uint32_t)(now_us / 1000U), (uint32_t)now_us);
  }
  if (how[4] != 0U) {
    printf(" %" PRIu32 " %" PRIu32, reporter.counts.reports_sent, reporter.counts.reports_refused);
    printf(" %" PRIu32 " %" PRIu32, reporter.counts.frames_torn, reporter.counts.values_dropped);
  }
}
