/*
 * The tables of all drivers of the library with the core, as a program: each line on stdin is a request. The generator
 * prints `tables.c`; the test lists the parts at its end.
 *
 *   unit INDEX                        begins a case with a part that has not been started
 *   registers SIZE MASK ALONE         bytes of a register address, its read bit, 1 if registers are not read in bursts
 *   register AT BYTES                 the part's registers from AT on
 *   after TRIGGER AT BYTES            like `register`, once TRIGGER was the last write
 *   answer TRIGGER BYTES              bytes read without a register after TRIGGER; `-` means after any write
 *   exchange SENT RECEIVED
 *   run                               as many cycles as every reading needs
 *   faults SEED                       from now on random transfers fail, determined by SEED; 0 means none
 *   steps COUNT                       COUNT steps, some early or late; prints all that is sent, read and reported
 *   trace ON                          whether every value is printed, before and after its filter
 *   later MS                          lets time pass
 *   feed BYTES                        bytes received on the serial port
 *   asked REQUEST ANSWER              the answer to a request on a serial line
 *   raw FIELD NUMBER                  a measurement of the hardware
 *   edges COUNT US...                 the times from one edge to the next
 *   frame FIELD BYTES                 data of a received CAN frame that has the field
 *   command FIELD COUNT NUMBERS...    prints `written BYTES`, or `output NUMBER VALUE` for each
 *                                     write and `commanded`, or `frame BYTES` with eight bytes
 *   end                               prints the outcome of each field, the fault, and `end`
 *
 * Bytes are in hexadecimal, all other numbers in decimal.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "up_chip.h"
#include "up_convert.h"
#include "up_compose.h"
#include "up_drive.h"
#include "up_exchange.h"
#include "up_filter.h"
#include "up_message.h"
#include "up_ppm.h"
#include "up_value.h"

/* The tables of a device besides those of its part; NULL if it has none. */
typedef struct {
  const up_filter_t *filter;
  up_filter_state_t *filter_state;
  size_t filter_words;
  const up_formula_t *formula;
  const int32_t *parameters;
  uint8_t output;
  const up_ppm_config_t *train;
  const up_drive_t *bridge;
  const up_value_t *can;
  uint8_t can_byte;
  const up_compose_t *compose;
} unit_field_t;

typedef struct {
  const up_schema_t *schema;
  const unit_field_t *fields;
  const up_chip_t *chip;
  up_chip_state_t *chip_state;
  size_t work_bytes;
  size_t kept_bytes;
  const up_message_t *message;
  up_message_state_t *message_state;
  const up_message_init_t *message_init;
  const up_exchange_t *exchanges;
  size_t exchanges_count;
} unit_t;

#include "tables.c"

#define BYTES_MAX 512U
#define ENTRIES_MAX 256U
#define VALUE_BYTES_MAX 2048U
#define STEPS_MAX 2000U
#define FILL 0xA5U

typedef struct {
  uint8_t bytes[BYTES_MAX];
  size_t count;
} block_t;

typedef enum { REGISTER, ANSWER, EXCHANGE } entry_kind_t;

typedef struct {
  entry_kind_t kind;
  block_t trigger; /* or the bytes sent in an exchange */
  uint32_t at;
  block_t block;
} entry_t;

static struct {
  const unit_t *unit;
  size_t register_bytes;
  uint8_t read_mask;
  bool alone;
  entry_t entries[ENTRIES_MAX];
  size_t entries_count;
  block_t written;
  bool prints;
  bool traces;
  uint32_t seed;
  uint32_t now_ms;
  up_result_t results[UP_FIELDS_MAX];
  uint64_t values[UP_FIELDS_MAX][VALUE_BYTES_MAX / 8U];
  up_drive_state_t bridges[UP_FIELDS_MAX];
} test;

static void fail(const char *why) {
  fprintf(stderr, "%s\n", why);
  exit(2);
}

static void check(bool holds, const char *what) {
  if (!holds) {
    fail(what);
  }
}

static uint32_t ask(void) {
  uint32_t number = 0U;

  check(scanf("%" SCNu32, &number) == 1, "a number is missing");
  return number;
}

static int64_t ask_signed(void) {
  int64_t number = 0;

  check(scanf("%" SCNd64, &number) == 1, "a number is missing");
  return number;
}

static void ask_bytes(block_t *block) {
  static char text[2U * BYTES_MAX + 2U];
  unsigned byte;
  size_t i;

  check(scanf("%1025s", text) == 1, "bytes are missing");
  block->count = (text[0] == '-') ? 0U : strlen(text) / 2U;
  for (i = 0U; i < block->count; i++) {
    check(sscanf(&text[2U * i], "%2x", &byte) == 1, "a byte is none");
    block->bytes[i] = (uint8_t)byte;
  }
}

static bool is_same(const block_t *block, const uint8_t *bytes, size_t count) {
  return block->count == count && memcmp(block->bytes, bytes, count) == 0;
}

/* ---- randomness: the other end draws the same numbers ---- */

static uint32_t draw(uint32_t limit) {
  test.seed = test.seed * 1664525U + 1013904223U;
  return (test.seed >> 16) % limit;
}

static uint32_t now_ms(void) {
  return test.now_ms;
}

/* Determines the result and the duration of a transfer, and prints a line of the trace. */
static up_bus_result_t fate(const char *what, const uint8_t *bytes, size_t count) {
  static const up_bus_result_t faults[] = {UP_NOT_ACKNOWLEDGED, UP_BUS_ERROR, UP_ARBITRATION_LOST, UP_TIMED_OUT};
  up_bus_result_t result = UP_BUS_DONE;
  size_t i;

  if (test.seed != 0U && draw(9U) == 0U) {
    result = faults[draw(4U)];
  }
  if (test.seed != 0U) {
    test.now_ms += draw(3U);
  }
  if (test.traces) {
    printf("%s %u ", what, (unsigned)result);
    for (i = 0U; i < count; i++) {
      printf("%02X", (unsigned)bytes[i]);
    }
    printf("\n");
  }
  return result;
}

/* ---- the part on its bus ---- */

static entry_t *add(entry_kind_t kind) {
  entry_t *entry = &test.entries[test.entries_count];

  check(test.entries_count < ENTRIES_MAX, "too many entries");
  test.entries_count++;
  memset(entry, 0, sizeof *entry);
  entry->kind = kind;
  return entry;
}

/* Whether the entry applies now: its trigger is the last write. */
static bool holds(const entry_t *entry) {
  return entry->trigger.count == 0U || is_same(&entry->trigger, test.written.bytes, test.written.count);
}

static up_bus_result_t bus_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  const up_bus_result_t result = fate("write", bytes, count);
  size_t i;

  (void)context;
  check(address == test.unit->chip->address, "another address");
  check(count > 0U && count <= BYTES_MAX, "nothing is written, or too much");
  if (result != UP_BUS_DONE) {
    return result;
  }
  memcpy(test.written.bytes, bytes, count);
  test.written.count = count;
  if (test.prints) {
    printf("written ");
    for (i = 0U; i < count; i++) {
      printf("%02X", (unsigned)bytes[i]);
    }
    printf("\n");
  }
  return UP_BUS_DONE;
}

static void read_registers(uint32_t at, uint8_t *rx, size_t count) {
  size_t i, byte;

  for (i = 0U; i < test.entries_count; i++) {
    const entry_t *entry = &test.entries[i];
    if (entry->kind != REGISTER || !holds(entry) || (test.alone && entry->at != at)) {
      continue;
    }
    check(!test.alone || count <= entry->block.count, "read on behind a register that stands alone");
    for (byte = 0U; byte < entry->block.count; byte++) {
      const uint32_t place = entry->at + (uint32_t)byte;
      if (place >= at && place - at < count) {
        rx[place - at] = entry->block.bytes[byte];
      }
    }
  }
}

static void read_answer(uint8_t *rx, size_t count) {
  size_t i;

  for (i = 0U; i < test.entries_count; i++) {
    const entry_t *entry = &test.entries[i];
    if (entry->kind == ANSWER && holds(entry)) {
      memcpy(rx, entry->block.bytes, (count < entry->block.count) ? count : entry->block.count);
    }
  }
}

static up_bus_result_t bus_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                      size_t rx_count) {
  const up_bus_result_t result = fate("read", tx, tx_count);
  uint32_t at = 0U;
  size_t i;

  (void)context;
  check(address == test.unit->chip->address, "another address");
  check(rx_count > 0U, "nothing is read");
  if (result != UP_BUS_DONE) {
    return result;
  }
  memset(rx, (int)FILL, rx_count);
  if (tx_count == 0U) {
    read_answer(rx, rx_count);
    return UP_BUS_DONE;
  }
  check(tx_count == test.register_bytes, "the register has another size");
  check((tx[0] & test.read_mask) == test.read_mask, "the register is not for reading");
  for (i = 0U; i < tx_count; i++) {
    at = (at << 8) | ((i == 0U) ? (uint32_t)(tx[i] & (uint8_t)~test.read_mask) : tx[i]);
  }
  read_registers(at, rx, rx_count);
  return UP_BUS_DONE;
}

static up_bus_result_t bus_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count) {
  const up_bus_result_t result = fate("exchange", tx, count);
  size_t i;

  (void)context;
  check(address == test.unit->chip->address, "another address");
  if (result != UP_BUS_DONE) {
    return result;
  }
  memset(rx, (int)FILL, count);
  for (i = 0U; i < test.entries_count; i++) {
    const entry_t *entry = &test.entries[i];
    if (entry->kind == EXCHANGE && is_same(&entry->trigger, tx, count)) {
      memcpy(rx, entry->block.bytes, (count < entry->block.count) ? count : entry->block.count);
    }
  }
  return UP_BUS_DONE;
}

static const up_bus_t bus = {bus_write, bus_write_read, bus_exchange, NULL};

/* ---- values ---- */

/* A line of the trace: the result for a value, and its bits. */
static void trace_value(uint16_t index, up_result_t result, const uint8_t *value) {
  const up_field_t *field = &test.unit->schema->fields[index];
  size_t i;

  printf("told %u %u", (unsigned)index, (unsigned)result);
  for (i = 0U; i < field->count && result == UP_FRESH; i++) {
    printf(" %" PRIx64, up_element_load(field->type, &value[i * up_type_bytes(field->type)]));
  }
  printf("\n");
}

static void on_value(void *context, uint16_t index, up_result_t result, void *value) {
  const unit_field_t *field = &test.unit->fields[index];

  (void)context;
  if (test.traces) {
    trace_value(index, result, value);
  }
  if (result == UP_FRESH && field->filter != NULL) {
    result = up_filter_apply(field->filter, field->filter_state, &test.unit->schema->fields[index], test.now_ms, value);
    if (test.traces) {
      trace_value(index, result, value);
    }
  }
  if (result == UP_FRESH) {
    memcpy(test.values[index], value, up_field_bytes(&test.unit->schema->fields[index]));
  }
  if (result != UP_NOTHING) {
    test.results[index] = result;
  }
}

static const up_value_sink_t sink = {on_value, NULL};

static bool is_signed(uint8_t type) {
  return type == UP_TYPE_INT8 || type == UP_TYPE_INT16 || type == UP_TYPE_INT32 || type == UP_TYPE_INT64;
}

static void print_value(const up_field_t *field, const uint8_t *value) {
  const size_t size = up_type_bytes(field->type);
  size_t i;

  check(field->type != UP_TYPE_FLOAT64, "a float of 64 bits");
  for (i = 0U; i < field->count; i++) {
    uint64_t bits = up_element_load(field->type, &value[i * size]);
    if (field->type == UP_TYPE_FLOAT32) {
      float number;
      memcpy(&number, &value[i * size], sizeof number);
      check(number == (float)(int32_t)number, "a float with a fraction");
      printf(" %" PRId32, (int32_t)number);
    } else if (is_signed(field->type)) {
      const uint64_t sign = (uint64_t)1U << (8U * size - 1U);
      printf(" %" PRId64, (int64_t)((bits ^ sign) - sign));
    } else {
      printf(" %" PRIu64, bits);
    }
  }
}

static const up_field_t *ask_field(uint16_t *index) {
  *index = (uint16_t)ask();
  check(*index < test.unit->schema->fields_count, "no such field");
  return &test.unit->schema->fields[*index];
}

static void store(const up_field_t *field, size_t element, int64_t number, uint64_t *value) {
  uint8_t *memory = (uint8_t *)value;

  if (field->type == UP_TYPE_FLOAT32) {
    const float real = (float)number;
    memcpy(&memory[element * sizeof real], &real, sizeof real);
    return;
  }
  up_store_signed(field->type, number, &memory[element * up_type_bytes(field->type)]);
}

/* ---- requests ---- */

/* The initial values of registers that commands share, restored for each case. */
static void begin_kept(size_t unit, uint8_t *kept, size_t count) {
  static uint8_t first[sizeof units / sizeof units[0]][64];
  static bool is_known[sizeof units / sizeof units[0]];

  if (count == 0U) {
    return;
  }
  check(count <= sizeof first[unit], "too many bytes are kept");
  if (is_known[unit]) {
    memcpy(kept, first[unit], count);
  } else {
    memcpy(first[unit], kept, count);
    is_known[unit] = true;
  }
}

static void begin(void) {
  const uint32_t index = ask();
  const unit_t *unit;
  size_t i;

  check(index < sizeof units / sizeof units[0], "no such unit");
  memset(&test, 0, sizeof test);
  unit = &units[index];
  test.unit = unit;
  test.register_bytes = 1U;
  if (unit->chip != NULL) {
    up_chip_state_t state = {.transfers = unit->chip_state->transfers,
                             .calibration = unit->chip_state->calibration,
                             .work = unit->chip_state->work,
                             .scratch = unit->chip_state->scratch,
                             .kept = unit->chip_state->kept};
    begin_kept(index, state.kept, unit->kept_bytes);
    *unit->chip_state = state;
    for (i = 0U; i < unit->chip->transfers_count; i++) {
      memset(&state.transfers[i], 0, sizeof state.transfers[i]);
    }
    check(up_chip_work_bytes(unit->chip, unit->schema) == unit->work_bytes, "the work buffer has another size");
  }
  if (unit->message != NULL) {
    up_message_state_t state = {.buffer = unit->message_state->buffer, .scratch = unit->message_state->scratch};
    *unit->message_state = state;
    up_message_gap(unit->message_state);
  }
  for (i = 0U; i < unit->schema->fields_count; i++) {
    const up_filter_t *filter = unit->fields[i].filter;
    const up_field_t *field = &unit->schema->fields[i];
    if (filter != NULL) {
      up_filter_state_t state = {.memory = unit->fields[i].filter_state->memory};
      *unit->fields[i].filter_state = state;
      check(UP_FILTER_WORDS(field->count, up_type_bytes(field->type), filter->median, filter->smooth_ms > 0U,
                            filter->has_change) == unit->fields[i].filter_words,
            "the filter's memory has another size");
    }
  }
}

static bool is_finished(void) {
  const up_chip_t *chip = test.unit->chip;
  size_t i;

  for (i = 0U; i < chip->readings_count; i++) {
    if (test.results[chip->readings[i].field] == UP_NOTHING) {
      return false;
    }
  }
  return test.unit->chip_state->is_running || test.unit->chip_state->fault != UP_NOTHING;
}

static void run(void) {
  unsigned steps;

  check(test.unit->chip != NULL, "it is on no bus");
  for (steps = 0U; !is_finished(); steps++) {
    uint32_t idle_ms;
    check(steps < STEPS_MAX, "it gives no end of it");
    up_chip_step(test.unit->chip, test.unit->chip_state, &bus, test.unit->schema, now_ms, &sink);
    idle_ms = up_chip_idle_ms(test.unit->chip, test.unit->chip_state, test.now_ms);
    test.now_ms += (idle_ms > 0U) ? idle_ms : 1U;
  }
}

static void steps(void) {
  uint32_t count = ask();

  check(test.unit->chip != NULL, "it is on no bus");
  test.traces = true;
  for (; count > 0U; count--) {
    const up_chip_state_t *state = test.unit->chip_state;
    uint32_t idle_ms;
    up_chip_step(test.unit->chip, test.unit->chip_state, &bus, test.unit->schema, now_ms, &sink);
    idle_ms = up_chip_idle_ms(test.unit->chip, test.unit->chip_state, test.now_ms);
    printf("step %" PRIu32 " %" PRIu32 " %u %u\n", test.now_ms, idle_ms, (unsigned)state->fault,
           (unsigned)state->identity_seen);
    test.now_ms += (draw(3U) == 0U) ? draw(test.unit->chip->cycle_ms + 2U) : idle_ms;
  }
  test.traces = false;
}

static void feed(void) {
  block_t block;

  check(test.unit->message != NULL, "it is on no port");
  ask_bytes(&block);
  up_message_feed(test.unit->message, test.unit->message_state, test.unit->schema, block.bytes, block.count, &sink);
}

static void raw(void) {
  uint64_t value[VALUE_BYTES_MAX / 8U];
  uint16_t index;
  const up_field_t *field = ask_field(&index);
  const unit_field_t *how = &test.unit->fields[index];
  const int64_t number = ask_signed();
  up_result_t result = UP_FRESH;

  memset(value, 0, sizeof value);
  if (how->formula != NULL) {
    const uint8_t bytes[2] = {(uint8_t)((uint64_t)number >> 8), (uint8_t)number};
    int64_t outputs[UP_FORMULA_OUTPUTS_MAX] = {0};
    check(how->formula->raw_bytes == sizeof bytes, "the formula takes another block");
    result = how->formula->compute(NULL, how->parameters, bytes, outputs) ? UP_FRESH : UP_INVALID;
    store(field, 0U, outputs[how->output], value);
  } else {
    store(field, 0U, number, value);
  }
  on_value(NULL, index, result, value);
}

static void frame(void) {
  uint64_t value[VALUE_BYTES_MAX / 8U];
  uint16_t index;
  const up_field_t *field = ask_field(&index);
  const unit_field_t *how = &test.unit->fields[index];
  block_t block;

  ask_bytes(&block);
  check(how->can != NULL && block.count > how->can_byte, "no frame has it");
  memset(value, 0, sizeof value);
  on_value(NULL, index,
           up_value_decode(how->can, field, &block.bytes[how->can_byte], block.count - how->can_byte, value), value);
}

static void edges(void) {
  up_ppm_raw_t train;
  uint64_t value[VALUE_BYTES_MAX / 8U];
  const uint32_t count = ask();
  uint32_t time_us = 0U, seen = 0U, i;
  uint16_t index = 0U;

  while (test.unit->fields[index].train == NULL) {
    index++;
    check(index < test.unit->schema->fields_count, "it has no pulse train");
  }
  memset(&train, 0, sizeof train);
  for (i = 0U; i <= count; i++) {
    const up_ppm_config_t *config = test.unit->fields[index].train;
    up_ppm_on_edge(config, &train, (uint32_t)((uint64_t)time_us * config->tick_hz / 1000000U));
    time_us += (i < count) ? ask() : 0U;
  }
  on_value(NULL, index,
           up_ppm_read(test.unit->fields[index].train, &train, &seen, &test.unit->schema->fields[index], value), value);
}

static void asked(void) {
  static uint8_t buffer[BYTES_MAX];
  static uint64_t scratch[VALUE_BYTES_MAX / 8U];
  up_message_state_t state = {.buffer = buffer, .scratch = scratch};
  block_t request, answer;
  size_t i;

  ask_bytes(&request);
  ask_bytes(&answer);
  for (i = 0U; i < test.unit->exchanges_count; i++) {
    const up_exchange_t *how = &test.unit->exchanges[i];
    if (how->request_count == request.count && memcmp(how->request, request.bytes, request.count) == 0) {
      up_exchange_begin(how, &state, test.unit->schema);
      if (up_exchange_take(how, &state, test.unit->schema, answer.bytes, answer.count, &sink) == UP_HEARD_WAITING) {
        up_exchange_fail(how, UP_TIMED_OUT, &sink);
      }
      return;
    }
  }
  fail("nobody sends that request");
}

static void command(void) {
  uint64_t value[VALUE_BYTES_MAX / 8U];
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  uint16_t index;
  const up_field_t *field = ask_field(&index);
  const up_chip_t *chip = test.unit->chip;
  size_t i, count = ask();

  check(count == field->count, "a value has another number of elements");
  memset(value, 0, sizeof value);
  for (i = 0U; i < count; i++) {
    store(field, i, ask_signed(), value);
  }
  if (test.unit->fields[index].bridge != NULL) {
    count = up_drive(test.unit->fields[index].bridge, &test.bridges[index], field->type, value, writes);
    for (i = 0U; i < count; i++) {
      printf("output %u %" PRIu32 "\n", (unsigned)writes[i].output, writes[i].value);
    }
    printf("commanded\n");
    return;
  }
  if (test.unit->fields[index].can != NULL) {
    const unit_field_t *how = &test.unit->fields[index];
    uint8_t data[8] = {0};
    check(up_value_encode(how->can, field, value, &data[how->can_byte], sizeof data - how->can_byte) > 0U,
          "the value does not fit its frame");
    printf("frame ");
    for (i = 0U; i < sizeof data; i++) {
      printf("%02X", (unsigned)data[i]);
    }
    printf("\n");
    return;
  }
  if (test.unit->fields[index].compose != NULL) {
    static uint8_t message[BYTES_MAX];
    count = up_compose(test.unit->fields[index].compose, field, value, message, sizeof message);
    printf("written ");
    for (i = 0U; i < count; i++) {
      printf("%02X", (unsigned)message[i]);
    }
    printf("\n");
    return;
  }
  check(chip != NULL, "nothing takes the command");
  for (i = 0U; i < chip->commands_count; i++) {
    if (chip->commands[i].field == index) {
      test.prints = true;
      const up_result_t written =
          up_chip_write(chip, test.unit->chip_state, &bus, test.unit->schema, &chip->commands[i], value);
      if (test.seed != 0U) {
        printf("came to %u\n", (unsigned)written);
      }
      check(test.seed != 0U || written == UP_FRESH, "the command was not written");
      test.prints = false;
    }
  }
}

static void end(void) {
  uint16_t i;

  for (i = 0U; i < test.unit->schema->fields_count; i++) {
    const up_field_t *field = &test.unit->schema->fields[i];
    switch (test.results[i]) {
      case UP_FRESH:
        printf("value %u", (unsigned)i);
        print_value(field, (const uint8_t *)test.values[i]);
        printf("\n");
        break;
      case UP_INVALID:
      case UP_WRONG_CRC:
        printf("invalid %u\n", (unsigned)i);
        break;
      case UP_NOT_ACKNOWLEDGED:
      case UP_BUS_ERROR:
      case UP_ARBITRATION_LOST:
      case UP_TIMED_OUT:
      case UP_WRONG_IDENTITY:
        printf("error %u\n", (unsigned)i);
        break;
      case UP_NOTHING:
        break;
    }
  }
  if (test.unit->message != NULL && test.traces) {
    const up_message_state_t *state = test.unit->message_state;
    printf("stream %" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 " %" PRIu32 "\n", state->messages,
           state->dropped_bytes, state->wrong_checksum, state->values, state->invalid);
  }
  if (test.unit->chip != NULL) {
    if (test.seed != 0U) {
      const up_chip_counts_t *counts = &test.unit->chip_state->counts;
      printf("counts %" PRIu32 " %" PRIu32, counts->starts, counts->written);
      for (i = 0U; i < UP_RESULTS; i++) {
        printf(" %" PRIu32, counts->causes[i]);
      }
      printf("\n");
    }
    printf("identity %s\n", (test.unit->chip_state->counts.causes[UP_WRONG_IDENTITY] > 0U) ? "wrong" : "right");
  }
  printf("end\n");
}

int main(void) {
  char word[16];
  entry_t *entry;

  while (scanf("%15s", word) == 1) {
    if (strcmp(word, "unit") == 0) {
      begin();
    } else if (strcmp(word, "registers") == 0) {
      test.register_bytes = ask();
      test.read_mask = (uint8_t)ask();
      test.alone = ask() != 0U;
    } else if (strcmp(word, "register") == 0) {
      entry = add(REGISTER);
      entry->at = ask();
      ask_bytes(&entry->block);
    } else if (strcmp(word, "after") == 0) {
      entry = add(REGISTER);
      ask_bytes(&entry->trigger);
      entry->at = ask();
      ask_bytes(&entry->block);
    } else if (strcmp(word, "answer") == 0) {
      entry = add(ANSWER);
      ask_bytes(&entry->trigger);
      ask_bytes(&entry->block);
    } else if (strcmp(word, "exchange") == 0) {
      entry = add(EXCHANGE);
      ask_bytes(&entry->trigger);
      ask_bytes(&entry->block);
    } else if (strcmp(word, "run") == 0) {
      run();
    } else if (strcmp(word, "faults") == 0) {
      test.seed = ask();
    } else if (strcmp(word, "steps") == 0) {
      steps();
    } else if (strcmp(word, "trace") == 0) {
      test.traces = ask() != 0U;
    } else if (strcmp(word, "later") == 0) {
      test.now_ms += ask();
    } else if (strcmp(word, "feed") == 0) {
      feed();
    } else if (strcmp(word, "asked") == 0) {
      asked();
    } else if (strcmp(word, "raw") == 0) {
      raw();
    } else if (strcmp(word, "frame") == 0) {
      frame();
    } else if (strcmp(word, "edges") == 0) {
      edges();
    } else if (strcmp(word, "command") == 0) {
      command();
    } else if (strcmp(word, "end") == 0) {
      end();
    } else {
      fail("unknown request");
    }
  }
  return 0;
}
