/* Chips on a bus that is a table of registers: start, identity, calibration, transfers at their own intervals,
 * faults. */
#include <string.h>

#include "check.h"
#include "up_chip.h"

/* ---- the world ---- */

/* 256 registers; the first byte written is the register address. Transfers fail on request. */
typedef struct {
  uint8_t registers[256];
  uint8_t log[64]; /* the transfers written, each preceded by its length */
  size_t log_size;
  size_t transfers; /* so far */
  size_t fails_at;  /* the number of the transfer that fails, from 1; 0: none */
  bool is_gone;
  up_bus_result_t failure;
  uint32_t transfer_ms; /* the time that each transfer takes */
} world_t;

static uint32_t world_ms;

static up_bus_result_t happens(world_t *world, uint8_t address, const uint8_t *bytes, size_t count) {
  world->transfers++;
  world_ms += world->transfer_ms;
  if (world->is_gone || address != 0x68U) {
    return UP_BUS_NOT_ACKNOWLEDGED;
  }
  if (world->transfers == world->fails_at) {
    return world->failure;
  }
  if (count > 0U && world->log_size + count + 1U <= sizeof world->log) {
    world->log[world->log_size] = (uint8_t)count;
    memcpy(&world->log[world->log_size + 1U], bytes, count);
    world->log_size += count + 1U;
  }
  return UP_BUS_DONE;
}

static up_bus_result_t world_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  world_t *world = context;
  const up_bus_result_t result = happens(world, address, bytes, count);

  if (result == UP_BUS_DONE && count == 2U) {
    world->registers[bytes[0]] = bytes[1];
  }
  return result;
}

static up_bus_result_t world_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                        size_t rx_count) {
  world_t *world = context;
  const up_bus_result_t result = happens(world, address, tx, 0U);
  size_t i;

  for (i = 0U; result == UP_BUS_DONE && i < rx_count; i++) {
    rx[i] = world->registers[(((tx_count > 0U) ? tx[0] : 0U) + i) % 256U];
  }
  return result;
}

/* MCP3008: start, single-ended channel, and the ten bits of the answer after them. */
static up_bus_result_t world_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count) {
  const up_bus_result_t result = happens(context, address, tx, count);
  const unsigned level = 1000U - (tx[1] >> 4);

  if (result == UP_BUS_DONE && count == 3U) {
    rx[0] = 0xFFU;
    rx[1] = (uint8_t)(0xF8U | (level >> 8));
    rx[2] = (uint8_t)level;
  }
  return result;
}

/* The last report to the sink for each field. */
typedef struct {
  up_result_t results[4];
  unsigned reported[4];
  int16_t axes[3];
  int16_t celsius;
  int32_t wide[2];
} received_t;

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  received_t *received = context;

  received->results[field] = result;
  received->reported[field]++;
  CHECK((value != NULL) == (result == UP_FRESH));
  if (value == NULL) {
    return;
  }
  if (field == 0U) {
    memcpy(received->axes, value, sizeof received->axes);
  } else if (field == 1U) {
    memcpy(&received->celsius, value, sizeof received->celsius);
  } else {
    memcpy(&received->wide[field - 2U], value, sizeof received->wide[0]);
  }
}

/* ---- an MPU-6050 with a command ---- */

static const up_field_t fields[] = {
    {"Acceleration", 1U, UP_TYPE_INT16, UP_TO_HOST, true, 3U, 0U},
    {"Celsius", 2U, UP_TYPE_INT16, UP_TO_HOST, false, 1U, 6U},
    {"A", 3U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 8U},
    {"B", 4U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 12U},
    {"Range", 5U, UP_TYPE_UINT8, UP_TO_BOARD, false, 1U, 16U},
};
static const up_schema_t schema = {fields, 5U, false, 0U};

static const uint8_t reset[] = {0x6BU, 0x80U}, wake[] = {0x6BU, 0x00U}, who[] = {0x75U}, is_mpu[] = {0x68U};
static const uint8_t id_bits[] = {0x7EU}, data[] = {0x3BU}, range[] = {0x1CU};
static const up_chip_init_t mpu_init[] = {{reset, 2U, 100U}, {wake, 2U, 0U}};
static const up_chip_identity_t mpu_identity = {who, is_mpu, id_bits, 1U, 1U};
static const up_chip_transfer_t mpu_transfers[] = {{.select = data, .select_count = 1U, .length = 8U, .cycle_ms = 10U}};
static const up_chip_reading_t mpu_readings[] = {
    {.field = 0U, .value = {.word_bytes = 2U, .is_signed = true}},
    {.field = 1U, .offset = 6U, .value = {.word_bytes = 2U, .is_signed = true}},
};
static const up_chip_command_t mpu_commands[] = {
    {.prefix = range, .prefix_count = 1U, .field = 4U, .value = {.word_bytes = 1U, .low = 3U, .bits = 2U}},
};
static const up_chip_t mpu = {
    .init = mpu_init,         .identity = &mpu_identity, .transfers = mpu_transfers, .readings = mpu_readings,
    .commands = mpu_commands, .cycle_ms = 10U,           .address = 0x68U,           .init_count = 2U,
    .transfers_count = 1U,    .readings_count = 2U,      .commands_count = 1U,
};

typedef struct {
  world_t world;
  received_t received;
  up_chip_transfer_state_t transfers[4];
  uint8_t calibration[32];
  uint8_t work[48];
  uint64_t scratch[2];
  up_chip_state_t state;
  up_bus_t bus;
} board_t;

static void set_up(board_t *board, const up_chip_t *chip) {
  memset(board, 0, sizeof *board);
  board->state.transfers = board->transfers;
  board->state.calibration = board->calibration;
  board->state.work = board->work;
  board->state.scratch = board->scratch;
  board->bus.write = world_write;
  board->bus.write_read = world_write_read;
  board->bus.context = &board->world;
  CHECK(up_chip_work_bytes(chip, &schema) <= sizeof board->work);
}

static uint32_t clock_ms(void) {
  return world_ms;
}

static void step(board_t *board, const up_chip_t *chip, uint32_t now_ms) {
  const up_value_sink_t sink = {on_value, &board->received};

  world_ms = now_ms;
  up_chip_step(chip, &board->state, &board->bus, &schema, clock_ms, &sink);
}

static void set_up_mpu(board_t *board) {
  static const uint8_t image[] = {0x00U, 0x10U, 0xFFU, 0xF0U, 0x40U, 0x00U, 0xF1U, 0x70U};

  set_up(board, &mpu);
  board->world.registers[0x75] = 0x68U;
  memcpy(&board->world.registers[0x3B], image, sizeof image);
}

static void test_start(void) {
  static const uint8_t written[] = {2U, 0x6BU, 0x80U, 2U, 0x6BU, 0x00U};
  const uint32_t t0 = 0xFFFFFFD0U; /* the clock wraps during the pause */
  board_t board;

  set_up_mpu(&board);
  step(&board, &mpu, t0);
  CHECK(up_chip_idle_ms(&mpu, &board.state, t0) == 101U);
  step(&board, &mpu, t0 + 100U);
  CHECK(board.world.transfers == 1U && board.received.reported[0] == 0U && !board.state.is_running);
  step(&board, &mpu, t0 + 101U);
  CHECK(board.state.is_running && board.state.counts.starts == 1U && board.received.results[0] == UP_FRESH);
  CHECK(board.received.axes[0] == 16 && board.received.axes[1] == -16 && board.received.axes[2] == 16384);
  CHECK(board.received.results[1] == UP_FRESH && board.received.celsius == -3728);
  CHECK(board.state.counts.causes[UP_FRESH] == 2U);
  CHECK(board.world.log_size == sizeof written && memcmp(board.world.log, written, sizeof written) == 0);
  CHECK(board.world.transfers == 4U && up_chip_idle_ms(&mpu, &board.state, t0 + 101U) == 10U);
  step(&board, &mpu, t0 + 105U);
  CHECK(board.received.reported[0] == 1U);
  step(&board, &mpu, t0 + 111U);
  CHECK(board.received.reported[0] == 2U && board.state.fault == UP_NOTHING);
  /* Alternating 9 ms and 11 ms, as clocks with whole milliseconds round: none is left out, none comes twice. */
  for (uint32_t i = 2U; i < 100U; i++) {
    step(&board, &mpu, t0 + 101U + 10U * i - i % 2U);
    CHECK(board.received.reported[0] == i + 1U);
  }
}

/* A pause is counted from the end of the write before it, however long that takes on the bus. */
static void test_slow_bus(void) {
  board_t board;

  set_up_mpu(&board);
  board.world.transfer_ms = 7U;
  step(&board, &mpu, 0U);
  CHECK(world_ms == 7U && up_chip_idle_ms(&mpu, &board.state, world_ms) == 101U);
  step(&board, &mpu, 107U);
  CHECK(board.world.transfers == 1U);
  step(&board, &mpu, 108U);
  CHECK(board.world.transfers == 4U && board.state.is_running);
}

static void test_faults(void) {
  board_t board;

  set_up_mpu(&board);
  board.world.is_gone = true;
  step(&board, &mpu, 0U);
  CHECK(board.received.results[0] == UP_NOT_ACKNOWLEDGED && board.received.results[1] == UP_NOT_ACKNOWLEDGED);
  CHECK(board.received.reported[0] == 1U);
  CHECK(board.state.counts.causes[UP_NOT_ACKNOWLEDGED] == 1U && board.state.fault == UP_NOT_ACKNOWLEDGED);
  CHECK(up_chip_idle_ms(&mpu, &board.state, 0U) == 10U);
  board.world.is_gone = false;
  step(&board, &mpu, 10U);
  step(&board, &mpu, 111U);
  CHECK(board.received.results[0] == UP_FRESH && board.state.fault == UP_NOTHING);
  /* A transfer fails: an error now, then the complete start again, with its pause. */
  board.world.fails_at = board.world.transfers + 1U;
  board.world.failure = UP_BUS_TIMED_OUT;
  board.world.log_size = 0U;
  step(&board, &mpu, 121U);
  CHECK(board.received.results[0] == UP_TIMED_OUT && board.state.counts.causes[UP_TIMED_OUT] == 1U);
  CHECK(board.state.fault == UP_TIMED_OUT);
  CHECK(board.received.reported[0] == 3U && !board.state.is_running);
  step(&board, &mpu, 131U);
  CHECK(board.world.log_size == 3U && board.received.reported[0] == 3U);
  step(&board, &mpu, 232U);
  CHECK(board.received.results[0] == UP_FRESH && board.state.counts.starts == 2U);
}

/* The error of a bus is reported for each value, and counted separately. */
static void test_causes(void) {
  static const up_bus_result_t cases[] = {UP_BUS_NOT_ACKNOWLEDGED, UP_BUS_ERROR, UP_BUS_ARBITRATION_LOST,
                                          UP_BUS_TIMED_OUT};
  board_t board;
  size_t i, cause;

  for (i = 0U; i < sizeof cases / sizeof cases[0]; i++) {
    set_up_mpu(&board);
    step(&board, &mpu, 0U);
    step(&board, &mpu, 101U);
    CHECK(board.received.results[0] == UP_FRESH && board.state.fault == UP_NOTHING);
    board.world.fails_at = board.world.transfers + 1U;
    board.world.failure = cases[i];
    step(&board, &mpu, 111U);
    CHECK(board.received.results[0] == cases[i] && board.received.results[1] == cases[i]);
    CHECK(board.state.fault == cases[i]);
    for (cause = 2U; cause < UP_RESULTS; cause++) {
      CHECK(board.state.counts.causes[cause] == ((cause == (size_t)cases[i]) ? 1U : 0U));
    }
  }
}

static void test_identity(void) {
  board_t board;
  size_t before;

  set_up_mpu(&board);
  board.world.registers[0x75] = 0x70U; /* an MPU-6500 */
  step(&board, &mpu, 0U);
  step(&board, &mpu, 101U);
  CHECK(board.received.results[0] == UP_WRONG_IDENTITY && board.state.fault == UP_WRONG_IDENTITY);
  CHECK(board.state.counts.causes[UP_WRONG_IDENTITY] == 1U && board.state.identity_seen == 0x70U);
  before = board.world.log_size;
  for (uint32_t now_ms = 111U; now_ms < 1000U; now_ms += 10U) {
    step(&board, &mpu, now_ms);
    CHECK(board.received.results[0] == UP_WRONG_IDENTITY && board.state.fault == UP_WRONG_IDENTITY);
    if (board.state.counts.causes[UP_WRONG_IDENTITY] < 16U) {
      CHECK(board.world.log_size == before);
    }
  }
  /* It was read, and only seldom written to: every 16th time it is started again, with a pause of ten cycles. */
  CHECK(board.state.counts.causes[UP_FRESH] == 0U && board.state.counts.starts == 0U);
  CHECK(board.state.counts.causes[UP_WRONG_IDENTITY] == 57U && board.world.log_size == before + 3U * 6U);
  before = board.world.log_size;
  board.world.registers[0x75] = 0xE9U; /* the significant bits are right */
  step(&board, &mpu, 1000U);
  CHECK(board.world.log_size == before + 3U);
  step(&board, &mpu, 1101U);
  CHECK(board.received.results[0] == UP_FRESH);
}

static void test_command(void) {
  board_t board;
  uint8_t level = 2U;

  set_up_mpu(&board);
  CHECK(up_chip_write(&mpu, &board.state, &board.bus, &schema, mpu_commands, &level) == UP_NOTHING);
  step(&board, &mpu, 0U);
  step(&board, &mpu, 101U);
  CHECK(up_chip_write(&mpu, &board.state, &board.bus, &schema, mpu_commands, &level) == UP_FRESH);
  CHECK(board.world.registers[0x1C] == 0x10U && board.state.counts.written == 1U);
  level = 9U;
  CHECK(up_chip_write(&mpu, &board.state, &board.bus, &schema, mpu_commands, &level) == UP_FRESH);
  CHECK(board.world.registers[0x1C] == 0x18U);
  board.world.is_gone = true;
  CHECK(up_chip_write(&mpu, &board.state, &board.bus, &schema, mpu_commands, &level) == UP_NOT_ACKNOWLEDGED);
  CHECK(up_chip_write(&mpu, &board.state, &board.bus, &schema, mpu_commands, &level) == UP_NOTHING);
}

/* ---- several triggered measurements of one converter, and an untriggered one with its own interval ---- */

static const uint8_t first_trigger[] = {0x01U, 0xC1U}, second_trigger[] = {0x01U, 0xD1U}, at0[] = {0x00U}, at9[] = {9U};
static const up_chip_transfer_t ads_transfers[] = {
    {.trigger = first_trigger, .trigger_count = 2U, .select = at0, .select_count = 1U, .length = 2U, .cycle_ms = 40U,
     .wait_ms = 9U},
    {.trigger = second_trigger, .trigger_count = 2U, .select = at0, .select_count = 1U, .length = 2U, .cycle_ms = 40U,
     .wait_ms = 9U},
    {.select = at9, .select_count = 1U, .length = 2U, .cycle_ms = 100U, .wait_ms = 25U},
};
static const up_chip_reading_t ads_readings[] = {
    {.field = 2U, .transfer = 0U, .value = {.word_bytes = 2U, .is_signed = true}},
    {.field = 3U, .transfer = 1U, .value = {.word_bytes = 2U, .is_signed = true}},
    {.field = 1U, .transfer = 2U, .value = {.word_bytes = 2U, .is_signed = true}},
};
static const up_chip_t ads = {
    .transfers = ads_transfers, .readings = ads_readings, .cycle_ms = 10U,
    .address = 0x68U,           .transfers_count = 3U,    .readings_count = 3U,
};

static void test_turns(void) {
  static const uint8_t written[] = {2U, 0x01U, 0xC1U, 2U, 0x01U, 0xD1U, 2U, 0x01U, 0xC1U, 2U, 0x01U, 0xD1U};
  board_t board;
  uint32_t now_ms;

  set_up(&board, &ads);
  for (now_ms = 0U; now_ms < 80U; now_ms += 10U) {
    step(&board, &ads, now_ms);
    if (now_ms == 0U) {
      /* One millisecond more than it needs, because it was triggered during a millisecond that had already begun. */
      CHECK(board.received.reported[2] == 0U && up_chip_idle_ms(&ads, &board.state, now_ms) == 10U);
    }
    if (now_ms == 20U) {
      CHECK(board.received.reported[2] == 1U && board.received.reported[3] == 1U && board.received.reported[1] == 0U);
      CHECK(up_chip_idle_ms(&ads, &board.state, now_ms) == 5U);
    }
  }
  CHECK(board.received.reported[2] == 2U && board.received.reported[3] == 2U && board.received.reported[1] == 1U);
  CHECK(board.world.log_size == sizeof written && memcmp(board.world.log, written, sizeof written) == 0);
  for (; now_ms < 2000U; now_ms += 10U) {
    step(&board, &ads, now_ms);
  }
  CHECK(board.received.reported[2] == 50U && board.received.reported[3] == 50U && board.received.reported[1] == 20U);
  /* A second without a step: the missed measurements are left out. */
  step(&board, &ads, 3000U);
  step(&board, &ads, 3010U);
  step(&board, &ads, 3020U);
  CHECK(board.received.reported[2] == 51U && board.received.reported[3] == 51U && board.received.reported[1] == 21U);
}

/* If it is called whenever there is something to do, a chip is as fast and as regular as its tables state. */
static void test_idle(void) {
  board_t board;
  uint32_t now_ms = 0U, steps = 0U;

  set_up(&board, &ads);
  while (now_ms < 4000U) {
    uint32_t idle_ms;
    step(&board, &ads, now_ms);
    steps++;
    idle_ms = up_chip_idle_ms(&ads, &board.state, now_ms);
    now_ms += (idle_ms == 0U) ? 1U : idle_ms;
  }
  CHECK(board.received.reported[2] == 100U && board.received.reported[3] == 100U && board.received.reported[1] == 40U);
  CHECK(steps < 500U);
}

/* A transfer that is made slightly early does not make the next one due earlier, and one that is late makes up for none
 * that was missed: each stays on its grid. */
static void test_grid(void) {
  static const up_chip_transfer_t transfers[] = {{.select = at9, .select_count = 1U, .length = 2U, .cycle_ms = 100U}};
  static const up_chip_reading_t readings[] = {{.field = 2U, .value = {.word_bytes = 2U}}};
  static const up_chip_t chip = {.transfers = transfers, .readings = readings, .cycle_ms = 10U, .address = 0x68U,
                                 .transfers_count = 1U, .readings_count = 1U};
  static const uint32_t times_ms[] = {0U, 97U, 98U, 196U, 198U, 297U, 300U, 1050U, 1060U, 1100U};
  static const unsigned reported[] = {1U, 1U, 2U, 2U, 3U, 3U, 4U, 5U, 5U, 6U};
  board_t board;
  size_t i;

  set_up(&board, &chip);
  for (i = 0U; i < sizeof reported / sizeof reported[0]; i++) {
    step(&board, &chip, times_ms[i]);
    CHECK(board.received.reported[2] == reported[i]);
  }
}

/* A measurement without a conversion time is triggered and read in one step. */
static void test_no_wait(void) {
  static const up_chip_transfer_t transfers[] = {{.trigger = first_trigger, .trigger_count = 2U, .length = 2U}};
  static const up_chip_reading_t readings[] = {{.field = 2U, .value = {.word_bytes = 2U}}};
  static const up_chip_t chip = {.transfers = transfers, .readings = readings, .cycle_ms = 10U, .address = 0x68U,
                                 .transfers_count = 1U, .readings_count = 1U};
  board_t board;

  set_up(&board, &chip);
  board.world.registers[0] = 1U;
  step(&board, &chip, 0U);
  CHECK(board.received.results[2] == UP_FRESH && board.received.wide[0] == 0x01C1 && board.received.reported[2] == 1U);
  step(&board, &chip, 10U);
  CHECK(board.received.reported[2] == 2U);
}

/* ---- checksums, SPI, formulas ---- */

static const uint8_t measure[] = {0x24U, 0x00U};
static const up_chip_transfer_t sht_transfers[] = {
    {.trigger = measure, .trigger_count = 2U, .length = 6U, .cycle_ms = 100U, .wait_ms = 16U}};
static const up_chip_reading_t sht_readings[] = {
    {.field = 2U, .value = {.word_bytes = 2U, .crc = UP_CRC_SENSIRION}},
    {.field = 3U, .offset = 3U, .value = {.word_bytes = 2U, .crc = UP_CRC_SENSIRION}},
};
static const up_chip_t sht = {.transfers = sht_transfers, .readings = sht_readings, .cycle_ms = 100U, .address = 0x68U,
                              .transfers_count = 1U, .readings_count = 2U};

static void test_crc(void) {
  static const uint8_t image[] = {0xBEU, 0xEFU, 0x92U, 0x66U, 0x66U, 0x93U};
  board_t board;

  set_up(&board, &sht);
  memcpy(board.world.registers, image, sizeof image);
  step(&board, &sht, 0U);
  step(&board, &sht, 16U);
  CHECK(board.received.reported[2] == 0U);
  step(&board, &sht, 17U);
  CHECK(board.received.results[2] == UP_FRESH && board.received.wide[0] == 0xBEEF && board.received.wide[1] == 0x6666);
  board.world.registers[5] ^= 0x10U;
  step(&board, &sht, 100U);
  step(&board, &sht, 200U);
  CHECK(board.received.results[2] == UP_FRESH && board.received.results[3] == UP_WRONG_CRC);
  CHECK(board.state.counts.causes[UP_WRONG_CRC] == 1U && board.state.fault == UP_WRONG_CRC && board.state.is_running);
}

static void test_exchange(void) {
  static const uint8_t channel0[] = {0x01U, 0x80U, 0x00U}, channel3[] = {0x01U, 0xB0U, 0x00U};
  static const up_chip_transfer_t transfers[] = {
      {.select = channel0, .exchange = true, .length = 3U},
      {.select = channel3, .exchange = true, .length = 3U},
  };
  static const up_chip_reading_t readings[] = {
      {.field = 2U, .transfer = 0U, .value = {.word_bytes = 3U, .bits = 10U}},
      {.field = 3U, .transfer = 1U, .value = {.word_bytes = 3U, .bits = 10U}},
  };
  static const up_chip_t mcp3008 = {.transfers = transfers, .readings = readings, .cycle_ms = 10U, .address = 0x68U,
                                    .transfers_count = 2U, .readings_count = 2U};
  board_t board;

  set_up(&board, &mcp3008);
  CHECK(up_chip_work_bytes(&mcp3008, &schema) == 6U);
  step(&board, &mcp3008, 0U); /* a bus without exchanges */
  CHECK(board.received.results[2] == UP_BUS_ERROR && board.state.counts.causes[UP_BUS_ERROR] == 1U);
  board.bus.exchange = world_exchange;
  step(&board, &mcp3008, 10U);
  CHECK(board.received.results[2] == UP_FRESH && board.received.wide[0] == 992 && board.received.wide[1] == 989);
}

static void test_formula(void) {
  /* The data sheet's example for the BMP280, as it is in the registers. */
  static const uint8_t trimming[] = {0x70U, 0x6BU, 0x43U, 0x67U, 0x18U, 0xFCU, 0x7DU, 0x8EU, 0x43U, 0xD6U, 0xD0U,
                                     0x0BU, 0x27U, 0x0BU, 0x8CU, 0x00U, 0xF9U, 0xFFU, 0x8CU, 0x3CU, 0xF8U, 0xC6U,
                                     0x70U, 0x17U};
  static const uint8_t image[] = {0x65U, 0x5AU, 0xC0U, 0x7EU, 0xEDU, 0x00U};
  static const uint8_t at88[] = {0x88U}, atf7[] = {0xF7U};
  static const up_chip_calibration_t calibration[] = {{at88, 1U, 24U}};
  static const up_chip_transfer_t transfers[] = {{.select = atf7, .select_count = 1U, .length = 6U}};
  static const up_chip_reading_t readings[] = {
      {.field = 2U, .computed = true, .output = 0U},
      {.field = 3U, .computed = true, .output = 1U},
  };
  static const up_chip_t bmp = {.calibration = calibration, .transfers = transfers, .readings = readings,
                                .formula = &up_formula_bmp280, .cycle_ms = 10U, .address = 0x68U,
                                .calibration_count = 1U, .transfers_count = 1U, .readings_count = 2U};
  board_t board;

  set_up(&board, &bmp);
  memcpy(&board.world.registers[0x88], trimming, sizeof trimming);
  memcpy(&board.world.registers[0xF7], image, sizeof image);
  step(&board, &bmp, 0U);
  CHECK(board.received.wide[0] == 2508 && board.received.wide[1] == 25767233);
  board.world.registers[0xFA] = 0x80U;
  board.world.registers[0xFB] = 0x00U;
  step(&board, &bmp, 10U);
  CHECK(board.received.results[2] == UP_INVALID && board.state.counts.causes[UP_INVALID] == 2U);
  CHECK(board.state.fault == UP_INVALID);
}

static uint32_t failures_of(const up_chip_state_t *state) {
  return state->counts.causes[UP_NOT_ACKNOWLEDGED] + state->counts.causes[UP_BUS_ERROR] +
         state->counts.causes[UP_ARBITRATION_LOST] + state->counts.causes[UP_TIMED_OUT];
}

/* A bad wire: transfers fail at random, another part answers sometimes, time jumps. A wrong part gives no values,
 * failures are reported, and once the wire is good again the chip soon recovers. */
static void test_bad_wire(void) {
  board_t board;
  uint32_t seed = 11U, now_ms = 0xFFFF0000U, i, fresh = 0U;

  set_up_mpu(&board);
  for (i = 0U; i < 30000U; i++) {
    const unsigned reported = board.received.reported[0];
    const uint32_t failed = failures_of(&board.state);
    bool is_good;
    seed = seed * 1664525U + 1013904223U;
    is_good = (i / 1000U) % 2U == 1U;
    board.world.registers[0x75] = (!is_good && (seed >> 16) % 10U == 0U) ? 0xFFU : 0x68U;
    board.world.is_gone = !is_good && (seed >> 8) % 40U == 0U;
    board.world.fails_at = (!is_good && (seed >> 20) % 20U == 0U) ? board.world.transfers + 1U + (seed >> 30) : 0U;
    board.world.failure = (up_bus_result_t)((unsigned)UP_NOT_ACKNOWLEDGED + (seed >> 12) % 4U);
    board.world.log_size = 0U;
    step(&board, &mpu, now_ms);
    if (board.received.reported[0] != reported && board.received.results[0] == UP_FRESH) {
      fresh++;
      CHECK(!board.state.has_wrong_identity && board.state.is_running && board.state.fault == UP_NOTHING);
      CHECK(board.received.axes[1] == -16 && board.received.results[1] == UP_FRESH);
    }
    if (failures_of(&board.state) != failed) {
      CHECK(board.received.reported[0] != reported && board.received.results[0] == board.state.fault && !board.state.is_running);
    }
    CHECK(board.state.counts.causes[UP_FRESH] == 2U * fresh);
    if (i % 1000U > 30U && is_good) {
      CHECK(board.state.is_running && board.received.reported[0] != reported);
    }
    now_ms += 10U + ((!is_good && (seed >> 24) == 7U) ? 100000U : 0U);
  }
  CHECK(fresh > 20000U && board.state.counts.starts > 100U && board.state.counts.causes[UP_WRONG_IDENTITY] > 10U);
}

void test_chips(void) {
  test_start();
  test_slow_bus();
  test_faults();
  test_causes();
  test_identity();
  test_command();
  test_turns();
  test_idle();
  test_grid();
  test_no_wait();
  test_crc();
  test_exchange();
  test_formula();
  test_bad_wire();
}
