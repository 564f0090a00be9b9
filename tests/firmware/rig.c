#include "rig.h"

#include <string.h>

#include "check.h"
#include "up_encode.h"

static bool is_on(const rig_t *rig) {
  return rig->now_ms >= rig->fault->from_ms && rig->now_ms < rig->fault->to_ms;
}

static uint32_t random_of(rig_t *rig) {
  rig->seed = rig->seed * 1664525U + 1013904223U;
  return rig->seed >> 16;
}

/* ---- the bus and its chips ---- */

static const uint8_t trigger[] = {0x00U, 0x51U}, at2[] = {0x02U}, at3b[] = {0x3BU};
static const up_chip_transfer_t range_transfers[] = {{.trigger = trigger, .trigger_count = 2U, .select = at2,
                                                      .select_count = 1U, .length = 2U, .cycle_ms = RIG_CHIP_MS,
                                                      .wait_ms = 15U}};
static const up_chip_transfer_t axes_transfers[] = {{.select = at3b, .select_count = 1U, .length = 6U,
                                                     .cycle_ms = RIG_CHIP_MS}};
static const up_chip_reading_t range_readings[] = {{.field = RANGE, .value = {.word_bytes = 2U}}};
static const up_chip_reading_t axes_readings[] = {{.field = AXES, .value = {.word_bytes = 2U, .is_signed = true}}};
static const up_chip_t chips[] = {
    {.transfers = range_transfers, .readings = range_readings, .cycle_ms = RIG_CHIP_MS, .address = RIG_RANGE_ADDRESS,
     .transfers_count = 1U, .readings_count = 1U},
    {.transfers = axes_transfers, .readings = axes_readings, .cycle_ms = RIG_CHIP_MS, .address = RIG_AXES_ADDRESS,
     .transfers_count = 1U, .readings_count = 1U},
};

static up_bus_result_t happens(rig_t *rig, uint8_t address, uint8_t last_phase) {
  const rig_fault_t *fault = rig->fault;
  const bool is_meant = fault->address == 0xFFU || fault->address == address;

  if (!is_on(rig) || fault->bus == UP_BUS_DONE || !is_meant || fault->phase > last_phase) {
    return UP_BUS_DONE;
  }
  rig->bus_busy_until_ms += fault->hangs_ms;
  return fault->bus;
}

static up_bus_result_t bus_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  rig_t *rig = context;
  const up_bus_result_t result = happens(rig, address, 1U);

  CHECK(count == 2U && bytes[0] == 0x00U);
  if (result == UP_BUS_DONE) {
    rig->triggered_ms = rig->now_ms;
  }
  return result;
}

static up_bus_result_t bus_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                      size_t rx_count) {
  rig_t *rig = context;
  const uint32_t measured_ms = (address == RIG_RANGE_ADDRESS) ? rig->triggered_ms : rig->now_ms;

  CHECK(tx_count == 1U && tx[0] == ((address == RIG_RANGE_ADDRESS) ? 0x02U : 0x3BU));
  memset(rx, 0, rx_count);
  (void)up_put_16(rx, (uint16_t)measured_ms);
  return happens(rig, address, 2U);
}

/* ---- the board's threads ---- */

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  rig_t *rig = context;

  if (result == UP_FRESH) {
    up_store_put(&rig->store, field, value);
  }
  up_health_note(&rig->health, field, result, rig->now_ms);
}

/* The clock that the chips use. */
static uint32_t step_ms;

static uint32_t bus_now_ms(void) {
  return step_ms;
}

static void run_chips(rig_t *rig) {
  const up_value_sink_t sink = {on_value, rig};
  size_t i;

  if (rig->now_ms % 5U != 0U || rig->now_ms < rig->bus_busy_until_ms) {
    return;
  }
  step_ms = rig->now_ms;
  rig->bus_busy_until_ms = rig->now_ms;
  for (i = 0U; i < 2U; i++) {
    up_chip_step(&chips[i], &rig->chips[i], &rig->bus, &rig_schema, bus_now_ms, &sink);
  }
}

static void run_capture(rig_t *rig) {
  static const up_capture_config_t config = {.mode = UP_CAPTURE_COUNT, .tick_hz = 1000000U};
  const bool is_silent = is_on(rig) && rig->fault->capture_is_silent;
  uint32_t count;

  if (!is_silent && rig->now_ms % 5U == 0U) {
    rig->raw.edges++;
  }
  if (rig->now_ms % RIG_REPORT_MS == 0U &&
      up_capture_read(&config, &rig->capture, &rig->raw, true, rig->now_ms, UP_TYPE_UINT32, &count)) {
    on_value(rig, WHEEL, UP_FRESH, &count);
  }
}

static void run_serial(rig_t *rig) {
  static const uint8_t start[] = {'L'};
  static const up_message_field_t fields[] = {{.field = LEVEL, .value = {.word_bytes = 1U}}};
  static const up_message_t message = {.start = start, .start_count = 1U, .length = 1U, .bytes_max = 3U,
                                       .checksum = UP_CHECKSUM_SUM8, .fields = fields, .fields_count = 1U};
  const up_value_sink_t sink = {on_value, rig};
  uint8_t bytes[3] = {'L', 0U, 0U};
  size_t i;

  if (rig->now_ms % RIG_LEVEL_MS != 0U || (is_on(rig) && rig->fault->serial_is_silent)) {
    return;
  }
  bytes[1] = (uint8_t)(rig->now_ms / RIG_LEVEL_MS);
  bytes[2] = (uint8_t)('L' + bytes[1]);
  if (is_on(rig) && rig->fault->serial_is_garbage) {
    for (i = 1U; i < sizeof bytes; i++) {
      bytes[i] = (uint8_t)random_of(rig);
    }
    bytes[2] = (uint8_t)('L' + bytes[1] + 1U);
  }
  up_message_feed(&message, &rig->message, &rig_schema, bytes, sizeof bytes, &sink);
}

/* ---- the board's link ---- */

static bool channel_is_open(void *context) {
  const rig_t *rig = context;

  return rig->baud != 0U || !(is_on(rig) && rig->fault->is_unplugged);
}

static size_t channel_read(void *context, uint8_t *bytes, size_t size) {
  rig_t *rig = context;

  size = (size < rig->to_board_size) ? size : rig->to_board_size;
  memcpy(bytes, rig->to_board, size);
  rig->to_board_size -= size;
  memmove(rig->to_board, &rig->to_board[size], rig->to_board_size);
  return size;
}

static size_t channel_room(void *context) {
  const rig_t *rig = context;

  return sizeof rig->queue - rig->queued;
}

static size_t channel_write(void *context, const uint8_t *bytes, size_t size) {
  rig_t *rig = context;

  CHECK(size <= channel_room(rig));
  memcpy(&rig->queue[rig->queued], bytes, size);
  rig->queued += size;
  return size;
}

static void apply(void *context, size_t field, const void *value) {
  rig_t *rig = context;

  up_store_put(&rig->store, field, value);
  up_health_note(&rig->health, field, UP_FRESH, rig->now_ms);
  if (field == MOTOR) {
    memcpy(&rig->motor, value, sizeof rig->motor);
    rig->applied++;
  } else {
    memcpy(&rig->lamp, value, sizeof rig->lamp);
  }
}

static void failsafe(void *context) {
  rig_t *rig = context;

  rig->failsafes++;
  rig->motor = 0;
}

static void describe(void *context, up_health_board_t *board) {
  (void)context;
  board->reset_cause = UP_CAUSE_POWER;
  board->load_percent = 7U;
}

/* ---- the host ---- */

static void check_age(rig_t *rig, uint32_t stamp_ms, uint32_t measured_ms, uint32_t cycle_ms) {
  rig->old_values += (stamp_ms - measured_ms > 2U * cycle_ms) ? 1U : 0U;
}

static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  rig_t *rig = context;
  const uint32_t stamp_ms = stamp->time_us / 1000U;
  rig_values_t values;
  uint8_t taken[1] = {0U};

  memset(&values, 0, sizeof values);
  rig_reports.take(items, &items[size], &values, taken);
  if (up_bit_get(taken, RANGE)) {
    /* Triggered in one cycle, read in the next. */
    check_age(rig, stamp_ms, values.RIG_Range, 2U * RIG_CHIP_MS);
  }
  if (up_bit_get(taken, AXES)) {
    check_age(rig, stamp_ms, (uint16_t)values.RIG_Axes[0], RIG_CHIP_MS);
  }
  if (up_bit_get(taken, LEVEL)) {
    check_age(rig, (stamp_ms / RIG_LEVEL_MS) % 256U, values.RIG_Level, 1U);
  }
  rig->lost += (rig->has_counter && stamp->counter != rig->next_counter) ? 1U : 0U;
  rig->next_counter = (uint8_t)(stamp->counter + 1U);
  rig->has_counter = true;
  /* The frame's own time on the line, plus a cycle. */
  rig->late_reports += (rig->now_ms - stamp_ms > ((rig->baud == 0U) ? 2U : 46U * 10000U / rig->baud + 2U)) ? 1U : 0U;
  if (rig->now_ms - rig->last_report_ms > rig->longest_gap_ms) {
    rig->longest_gap_ms = rig->now_ms - rig->last_report_ms;
  }
  rig->last_report_ms = rig->now_ms;
  rig->reports_in_second[(rig->now_ms / 1000U) % 10U]++;
  rig->reports++;
}

static void on_hello(void *context, uint32_t hash) {
  rig_t *rig = context;

  CHECK(hash == rig_reports.hash);
  rig->hellos++;
}

static void on_health(void *context, const uint8_t *payload, size_t size) {
  rig_t *rig = context;
  size_t i;

  CHECK(up_health_read_board(payload, size, &rig->board));
  for (i = 0U; i < RIG_FIELDS; i++) {
    CHECK(up_health_read_row(payload, size, i, &rig->rows[i]));
  }
  CHECK(!up_health_read_row(payload, size, i, &rig->rows[0]));
  rig->has_health = true;
}

static void send_bytes(rig_t *rig, const uint8_t *bytes, size_t size) {
  CHECK(rig->to_board_size + size <= sizeof rig->to_board);
  memcpy(&rig->to_board[rig->to_board_size], bytes, size);
  rig->to_board_size += size;
}

static size_t command(rig_t *rig, int16_t motor, uint8_t *frame) {
  static const uint8_t due[] = {1U << MOTOR};
  rig_values_t values;

  memset(&values, 0, sizeof values);
  values.RIG_Motor = motor;
  (void)rig;
  return up_encode_values(&rig_commands, NULL, due, &values, frame, RIG_COMMAND_FRAME_BYTES);
}

/* Sends a command that is torn, has one wrong bit, is too long, has an unknown identifier or an invalid bool, or
 * just noise. */
static void send_rubbish(rig_t *rig) {
  static const uint8_t oversized[] = "9999:", unknown[] = "4:\x63\x01\x02\x03,", lamp[] = "2:\x06\x02,";
  uint8_t bytes[RIG_COMMAND_FRAME_BYTES];
  const size_t size = command(rig, 32767, bytes);
  size_t i;

  switch (random_of(rig) % 6U) {
  case 0U:
    send_bytes(rig, bytes, random_of(rig) % size);
    break;
  case 1U:
    bytes[random_of(rig) % size] ^= (uint8_t)(1U << (random_of(rig) % 8U));
    send_bytes(rig, bytes, size);
    break;
  case 2U:
    send_bytes(rig, oversized, sizeof oversized - 1U);
    break;
  case 3U:
    send_bytes(rig, unknown, sizeof unknown - 1U);
    break;
  case 4U:
    send_bytes(rig, lamp, sizeof lamp - 1U);
    break;
  default:
    for (i = 0U; i < sizeof bytes; i++) {
      bytes[i] = (uint8_t)random_of(rig);
    }
    send_bytes(rig, bytes, sizeof bytes);
    break;
  }
}

static void run_host(rig_t *rig) {
  uint8_t frame[RIG_COMMAND_FRAME_BYTES];

  if (is_on(rig) && (rig->fault->host_is_silent || rig->fault->is_unplugged)) {
    return;
  }
  if (is_on(rig) && rig->fault->host_sends_rubbish && rig->now_ms % 7U == 0U) {
    send_rubbish(rig);
  }
  if (rig->now_ms % 100U == 50U) {
    rig->commanded = (int16_t)(rig->now_ms / 100U);
    rig->commands++;
    send_bytes(rig, frame, command(rig, rig->commanded, frame));
  }
  /* At 1200 baud, health takes a second. */
  if (rig->now_ms % ((rig->baud == 0U) ? 1000U : 4000U) == 500U) {
    send_bytes(rig, frame, up_encode_health_request(&rig_commands, frame, sizeof frame));
  }
}

static void run_line(rig_t *rig) {
  size_t size = rig->queued;

  if (is_on(rig) && (rig->fault->host_does_not_read || rig->fault->is_unplugged)) {
    if (rig->fault->is_unplugged && rig->baud == 0U) {
      rig->queued = 0U;
    }
    return;
  }
  if (rig->baud != 0U) {
    rig->bits = (rig->queued == 0U) ? 0U : rig->bits + rig->baud;
    size = rig->bits / 10000U;
    size = (size < rig->queued) ? size : rig->queued;
    rig->bits -= (uint32_t)size * 10000U;
  }
  up_decoder_feed(&rig->decoder, rig->queue, size);
  rig->queued -= size;
  memmove(rig->queue, &rig->queue[size], rig->queued);
}

/* ---- the whole rig ---- */

void rig_start(rig_t *rig, const rig_fault_t *fault, uint32_t baud) {
  static const uint32_t cycles_ms[RIG_FIELDS] = {2U * RIG_CHIP_MS, RIG_CHIP_MS, 100U, RIG_LEVEL_MS, 0U, 0U};
  const up_bus_t bus = {bus_write, bus_write_read, NULL, rig};
  const up_channel_t channel = {channel_is_open, channel_read, channel_room, channel_write, rig, RIG_QUEUE_BYTES};
  const up_sink_t sink = {on_values, on_hello, on_health, rig};
  size_t i;

  memset(rig, 0, sizeof *rig);
  rig->fault = fault;
  rig->baud = baud;
  rig->seed = 7U;
  rig->bus = bus;
  rig->channel = channel;
  rig->sink = sink;
  up_store_init(&rig->store, &rig_schema, &rig->values);
  rig->health.devices = rig->devices;
  rig->health.cycles_ms = cycles_ms;
  rig->health.devices_count = RIG_FIELDS;
  for (i = 0U; i < 2U; i++) {
    rig->chips[i].transfers = &rig->transfers[i];
    rig->chips[i].work = rig->work;
    rig->chips[i].scratch = rig->scratch;
    CHECK(up_chip_work_bytes(&chips[i], &rig_schema) <= sizeof rig->work);
  }
  rig->message.buffer = rig->message_buffer;
  rig->message.scratch = rig->message_scratch;
  rig->config.schema = &rig_schema;
  rig->config.reports = &rig_reports;
  rig->config.commands = &rig_commands;
  rig->config.channel = &rig->channel;
  rig->config.store = &rig->store;
  rig->config.health = &rig->health;
  rig->config.frame = rig->frame;
  rig->config.frame_bytes = sizeof rig->frame;
  rig->config.buffer = rig->buffer;
  rig->config.buffer_bytes = sizeof rig->buffer;
  rig->config.received = &rig->received;
  rig->config.cycle_ms = RIG_REPORT_MS;
  rig->config.silence_ms = RIG_SILENCE_MS;
  rig->config.apply = apply;
  rig->config.failsafe = failsafe;
  rig->config.describe = describe;
  rig->config.context = rig;
  CHECK(up_reporter_init(&rig->reporter, &rig->config, 0U));
  CHECK(up_decoder_init(&rig->decoder, &rig_reports, rig->host_buffer, sizeof rig->host_buffer, &rig->sink));
}

void rig_run(rig_t *rig, uint32_t until_ms) {
  for (; rig->now_ms < until_ms; rig->now_ms++) {
    run_host(rig);
    run_chips(rig);
    run_capture(rig);
    run_serial(rig);
    if (rig->now_ms % RIG_REPORT_MS == 0U) {
      up_reporter_cycle(&rig->reporter, rig->now_ms, rig->now_ms * 1000U);
    }
    run_line(rig);
  }
}
