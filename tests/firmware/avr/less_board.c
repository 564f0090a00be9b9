/*
 * Of less.c: a chip with transfers that fail, and the link to a host that only asks.
 */
#include "less.h"

#include "up_chip.h"
#include "up_reporter.h"

/* The checksum of the link. */
#ifndef LINK
#define LINK UP_LINK_CRC16
#endif

/* ---- a chip ---- */

static UP_ROM uint8_t trigger[] = {0U, 0x51U}, select[] = {2U};
#define SLOW {.trigger = trigger, .trigger_count = 2U, .select = select, .select_count = 1U, .cycle_ms = 90U, .wait_ms = 65U, .length = 2U}
static UP_ROM up_chip_transfer_t transfers[] = {
    SLOW,
#if !defined(LEAST)
    {.select = select, .select_count = 1U, .wait_ms = 30U, .length = 2U},
    {.trigger = trigger, .trigger_count = 1U, .select = select, .select_count = 1U, .length = 2U},
#endif
};
#define TRANSFERS (sizeof transfers / sizeof transfers[0])
static UP_ROM up_chip_reading_t readings[] = {
    {.field = 2U * UP_TYPE_UINT8, .transfer = 0U, .value = {.word_bytes = 2U}},
#if !defined(LEAST)
    {.field = 2U * UP_TYPE_INT16, .transfer = 1U, .value = {.word_bytes = 2U, .is_signed = true}},
    {.field = 2U * UP_TYPE_INT8, .transfer = 2U, .value = {.word_bytes = 2U, .low = 3U, .is_signed = true}},
#endif
};
static UP_ROM up_chip_t chip = {
    .transfers = transfers, .transfers_count = TRANSFERS, .readings = readings, .readings_count = TRANSFERS,
    .cycle_ms = 40U, .address = 0x73U,
};
static UP_ROM up_schema_t schema = {.fields = fields, .fields_count = 2U * TYPES};
static uint32_t bus_ms;

static up_bus_result_t bus_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  (void)context;
  note_word(address);
  note(bytes, count);
  bus_ms += below(3U);
  return (below(20U) == 0U) ? UP_BUS_NOT_ACKNOWLEDGED : UP_BUS_DONE;
}

static up_bus_result_t bus_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                      size_t rx_count) {
  uint8_t bytes[4];

  (void)up_put_32(bytes, number());
  memcpy(rx, bytes, (rx_count < sizeof bytes) ? rx_count : sizeof bytes);
  return bus_write(context, address, tx, tx_count);
}

static UP_ROM up_bus_t bus = {.write = bus_write, .write_read = bus_write_read};

static uint32_t clock_ms(void) {
  return bus_ms;
}

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  note_word(1000U * field + (uint32_t)result);
  if (result == UP_FRESH) {
    note(value, up_field_bytes(&fields[field]));
  }
}

static void run_chip(void) {
  static const up_value_sink_t sink = {.on_value = on_value};
  static uint8_t work[8];
  static uint64_t scratch[1];
  static up_chip_transfer_state_t states[TRANSFERS];
  static up_chip_state_t state = {.transfers = states, .work = work, .scratch = scratch};
  unsigned turn;

  bus_ms = 0xFFFFF000U;
  for (turn = 0U; turn < TURNS; turn++) {
    up_chip_step(&chip, &state, &bus, &schema, clock_ms, &sink);
    note_word(up_chip_idle_ms(&chip, &state, bus_ms));
    note_word(state.fault);
    bus_ms += (below(2U) == 0U) ? 40U : below(400U);
  }
  tell("chip");
}

/* ---- a host that only asks ---- */

static size_t put(const uint8_t *due, const void *values, uint8_t *payload) {
  return ((due[0] & 1U) == 0U) ? 0U : (size_t)(up_put_8(up_put_8(payload, 1U), *(const uint8_t *)values) - payload);
}

static up_item_t item(uint8_t id) {
  (void)id;
  return UP_ITEM_NONE;
}

#define SUM_BYTES ((LINK) == UP_LINK_NONE ? 0U : 1U + (unsigned)(LINK))
extern UP_ROM up_wire_t reports, commands;
UP_ROM up_wire_t reports = {
    .hash = 0xDA7B1F5EU, .values_bytes_max = 2U, .health_bytes = UP_HEALTH_BOARD_BYTES + UP_HEALTH_DEVICE_BYTES,
    .payload_bytes_max = UP_HEALTH_BOARD_BYTES + UP_HEALTH_DEVICE_BYTES + SUM_BYTES, .head_bytes = 3U,
    .direction = UP_TO_HOST, .checksum = LINK, .put = put,
};
UP_ROM up_wire_t commands = {
    .hash = 0xDA7B1F5EU, .payload_bytes_max = 2U + SUM_BYTES, .head_bytes = 2U, .direction = UP_TO_BOARD,
    .checksum = LINK, .item = item,
};

static uint8_t coming[24];
static size_t coming_size;

static bool is_open(void *context) {
  (void)context;
  return true;
}

static size_t read_bytes(void *context, uint8_t *bytes, size_t size) {
  (void)context;
  size = (size < coming_size) ? size : coming_size;
  memcpy(bytes, coming, size);
  coming_size -= size;
  memmove(coming, &coming[size], coming_size);
  return size;
}

static size_t room(void *context) {
  (void)context;
  return 64U;
}

static size_t write_bytes(void *context, const uint8_t *bytes, size_t size) {
  (void)context;
  note(bytes, size);
  return size;
}

static void fall_back(void *context) {
  (void)context;
  note_word(0xFA11U);
}

static UP_ROM up_channel_t channel = {
    .is_open = is_open, .read = read_bytes, .room = room, .write = write_bytes, .room_max = 64U};
static UP_ROM uint32_t cycles_ms[] = {30U};
static uint8_t value, frame[64], buffer[24];
static up_store_t store;
static up_health_device_t device;
static up_health_t health = {.devices = &device, .devices_count = 1U, .cycles_ms = cycles_ms};
extern UP_ROM up_reporter_config_t config;
UP_ROM up_reporter_config_t config = {
    .schema = &schema, .reports = &reports, .commands = &commands, .channel = &channel, .store = &store,
    .health = &health, .frame = frame, .frame_bytes = sizeof frame, .buffer = buffer, .buffer_bytes = sizeof buffer,
    .cycle_ms = 20U, .silence_ms = 300U, .failsafe = fall_back,
};

/* Requests, whole, cut off, or with a wrong byte; and what could be the beginning of one. */
static void say_something(void) {
  const size_t size = (below(2U) == 0U) ? up_encode_hello_request(&commands, coming, sizeof coming)
                                        : up_encode_health_request(&commands, coming, sizeof coming);
  size_t i;

  coming_size = size;
  switch (below(6U)) {
  case 0U:
    coming_size = below((uint32_t)size);
    break;
  case 1U:
    coming[below((uint32_t)size)] = (uint8_t)below(256U);
    break;
  case 2U:
    for (i = 0U; i < sizeof coming; i++) {
      coming[i] = (uint8_t)"0123457:,,\0\0\1\xFF"[below(14U)];
    }
    coming_size = below(sizeof coming);
    break;
  default:
    break;
  }
}

static void run_reporter(void) {
  static up_reporter_t reporter;
  uint32_t now_ms = 0xFFFFFFC0U;
  unsigned turn;

  up_store_init(&store, &schema, &value);
  note_word(up_reporter_init(&reporter, &config, now_ms) ? 1U : 0U);
  for (turn = 0U; turn < 4U * TURNS; turn++) {
    now_ms += (below(40U) == 0U) ? 320U : 20U;
    if (below(3U) > 0U) {
      say_something();
    }
    if (below(3U) == 0U) {
      up_reporter_listen(&reporter, now_ms);
    }
    value++;
    if (below(4U) == 0U) {
      up_store_put(&store, 0U, &value);
      up_health_note(&health, 0U, (up_result_t)below(UP_RESULTS), now_ms);
    }
    up_reporter_cycle(&reporter, now_ms, now_ms * 1000U);
    coming_size = 0U;
  }
  note_word(reporter.counts.reports_sent);
  tell("reporter");
}

void run_board(void) {
  run_chip();
  run_reporter();
}
