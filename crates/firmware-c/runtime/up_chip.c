#include "up_chip.h"

#include <string.h>

#include "up_convert.h"

/* Nothing was read or written in this step so far. */
#define UNTOUCHED 0xFFU
/* Whole milliseconds make a cycle look shorter than it is, so transfers may be this fraction of a cycle early. */
#define EARLY_PARTS 8U
/* After this many attempts a chip with a wrong identity is started anyway: some identify themselves only once set
 * up. */
#define IDENTITY_ATTEMPTS 16U

typedef struct {
  UP_ROM up_chip_t *chip;
  up_chip_state_t *state;
  UP_ROM up_bus_t *bus;
  UP_ROM up_schema_t *schema;
  const up_value_sink_t *sink;
  up_clock_t clock;
  uint32_t now_ms; /* the start of the step */
} step_t;

/* Half the range of the clock is ahead, half is in the past, so the comparison holds across its wrap. */
static bool is_reached(uint32_t now_ms, uint32_t when_ms) {
  return (uint32_t)(now_ms - when_ms) < 0x80000000U;
}

static uint32_t left_ms(uint32_t now_ms, uint32_t when_ms) {
  return is_reached(now_ms, when_ms) ? 0U : (uint32_t)(when_ms - now_ms);
}

/* The time `wait_ms` from now, plus one, because the first millisecond is cut short. */
static uint32_t after(const step_t *step, uint32_t wait_ms) {
  return step->clock() + ((wait_ms == 0U) ? 0U : wait_ms + 1U);
}

/* Most chips have one transfer; a program that has only such knows that. */
static size_t transfers_of(UP_ROM up_chip_t *chip) {
  return UP_USES_CHIP_TURNS ? chip->transfers_count : 1U;
}

/* ---- the bus ---- */

static void restart(up_chip_state_t *state) {
  state->init_at = 0U;
  state->in_flight = 0U;
  state->is_pausing = false;
  state->is_running = false;
}

static void count_fault(up_chip_state_t *state, up_result_t cause) {
  state->counts.causes[cause]++;
  state->fault = (uint8_t)cause;
}

/* Counts the outcome of a transfer; after a failure the chip must be started again. */
static bool went_through(up_chip_state_t *state, up_bus_result_t result) {
  if (result != UP_BUS_DONE) {
    count_fault(state, result);
    restart(state);
    return false;
  }
  /* A start proves nothing until it is complete. */
  if (state->fault == UNTOUCHED && state->is_running) {
    state->fault = UP_NOTHING;
  }
  return true;
}

static bool write_bytes(const step_t *step, UP_ROM uint8_t *bytes, size_t count) {
  up_rom_copy(step->state->work, bytes, count);
  return went_through(step->state, step->bus->write(step->bus->context, step->chip->address, step->state->work, count));
}

/* The bytes read, in the work buffer; NULL if it failed. */
static const uint8_t *read_bytes(const step_t *step, UP_ROM uint8_t *select, size_t select_count, size_t count) {
  uint8_t *work = step->state->work;
  up_bus_result_t result;

  if (select_count > 0U) {
    up_rom_copy(work, select, select_count);
  }
  result = step->bus->write_read(step->bus->context, step->chip->address, work, select_count, &work[select_count],
                                 count);
  return went_through(step->state, result) ? &work[select_count] : NULL;
}

static const uint8_t *exchange_bytes(const step_t *step, UP_ROM uint8_t *bytes, size_t count) {
  uint8_t *work = step->state->work;
  up_bus_result_t result = UP_BUS_ERROR;

  up_rom_copy(work, bytes, count);
  if (step->bus->exchange != NULL) {
    result = step->bus->exchange(step->bus->context, step->chip->address, work, &work[count], count);
  }
  return went_through(step->state, result) ? &work[count] : NULL;
}

/* ---- starting ---- */

/* True when all steps are complete; false during a pause or after a failure. */
static bool initialise(const step_t *step) {
  up_chip_state_t *state = step->state;

  if (!UP_USES_CHIP_INIT) {
    return true;
  }
  if (state->is_pausing && !is_reached(step->now_ms, state->pause_until_ms)) {
    return false;
  }
  state->is_pausing = false;
  while (state->init_at < step->chip->init_count) {
    UP_ROM up_chip_init_t *init = &step->chip->init[state->init_at];
    if (init->count > 0U && !write_bytes(step, init->bytes, init->count)) {
      return false;
    }
    state->init_at++;
    if (init->pause_ms > 0U) {
      state->pause_until_ms = after(step, init->pause_ms);
      state->is_pausing = true;
      return false;
    }
  }
  return true;
}

static bool identify(const step_t *step) {
  UP_ROM up_chip_identity_t *identity = step->chip->identity;
  up_chip_state_t *state = step->state;
  const uint8_t *found;
  size_t i;

  if (!UP_USES_CHIP_IDENTITY || identity == UP_ROM_NULL) {
    return true;
  }
  found = read_bytes(step, identity->select, identity->select_count, identity->count);
  if (found == NULL) {
    return false;
  }
  for (i = 0U; i < identity->count; i++) {
    const unsigned mask = (identity->mask != UP_ROM_NULL) ? identity->mask[i] : 0xFFU;
    if ((((unsigned)found[i] ^ identity->expected[i]) & mask) != 0U) {
      state->identity_seen = found[i];
      count_fault(state, UP_WRONG_IDENTITY);
      state->has_wrong_identity = state->counts.causes[UP_WRONG_IDENTITY] % IDENTITY_ATTEMPTS != 0U;
      restart(state);
      return false;
    }
  }
  return true;
}

static bool calibrate(const step_t *step) {
  uint8_t *to = step->state->calibration;
  size_t i;

  for (i = 0U; UP_USES_CHIP_FORMULAS && i < step->chip->calibration_count; i++) {
    UP_ROM up_chip_calibration_t *block = &step->chip->calibration[i];
    const uint8_t *bytes = read_bytes(step, block->select, block->select_count, block->count);
    if (bytes == NULL) {
      return false;
    }
    memcpy(to, bytes, block->count);
    to += block->count;
  }
  return true;
}

static void begin_transfers(const step_t *step) {
  size_t i;

  for (i = 0U; i < transfers_of(step->chip); i++) {
    step->state->transfers[i].due_ms = step->now_ms;
    step->state->transfers[i].ready_ms = step->clock() + step->chip->transfers[i].wait_ms;
  }
  step->state->is_running = true;
  step->state->fault = UP_NOTHING;
  step->state->counts.starts++;
}

/* Nothing is written to a chip with a wrong identity. */
static void start(const step_t *step) {
  if (UP_USES_CHIP_IDENTITY && step->state->has_wrong_identity) {
    if (!identify(step)) {
      return;
    }
    step->state->has_wrong_identity = false;
  }
  if (initialise(step) && identify(step) && calibrate(step)) {
    begin_transfers(step);
  }
}

/* ---- readings ---- */

static void say(const step_t *step, UP_ROM up_chip_reading_t *reading, up_result_t result) {
  up_chip_state_t *state = step->state;

  if (result == UP_FRESH) {
    state->counts.causes[UP_FRESH]++;
  }
  step->sink->on_value(step->sink->context, reading->field, result, (result == UP_FRESH) ? state->scratch : NULL);
}

/* Reports the fault for all readings of one transfer; with `transfer` equal to transfers_count, for all readings. */
static void say_fault(const step_t *step, size_t transfer) {
  size_t i;

  for (i = 0U; i < step->chip->readings_count; i++) {
    UP_ROM up_chip_reading_t *reading = &step->chip->readings[i];
    if (reading->transfer == transfer || transfer == transfers_of(step->chip)) {
      say(step, reading, (up_result_t)step->state->fault);
    }
  }
}

/* The formula's outputs for one raw block, computed once for all readings in it. */
typedef struct {
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX];
  uint16_t offset;
  bool is_known;
  bool is_valid;
} computed_t;

static up_result_t compute(const step_t *step, UP_ROM up_chip_reading_t *reading, UP_ROM up_field_t *field,
                           const uint8_t *bytes, size_t length, computed_t *computed) {
  UP_ROM up_formula_t *formula = step->chip->formula;

  if (formula == UP_ROM_NULL || reading->output >= formula->outputs_count ||
      (size_t)reading->offset + formula->raw_bytes > length) {
    return UP_INVALID;
  }
  if (!computed->is_known || computed->offset != reading->offset) {
    computed->is_valid = formula->compute(step->state->calibration, step->chip->parameters, &bytes[reading->offset],
                                          computed->outputs);
    computed->offset = reading->offset;
    computed->is_known = true;
  }
  if (!computed->is_valid) {
    return UP_INVALID;
  }
  up_store_output(field->type, computed->outputs[reading->output], step->state->scratch);
  return UP_FRESH;
}

static up_result_t decode(const step_t *step, UP_ROM up_chip_reading_t *reading, UP_ROM up_field_t *field,
                          const uint8_t *bytes, size_t length) {
  if (reading->offset >= length) {
    return UP_INVALID;
  }
  return up_value_decode(&reading->value, field, &bytes[reading->offset], length - reading->offset,
                         step->state->scratch);
}

static void say_values(const step_t *step, size_t transfer, const uint8_t *bytes) {
  const size_t length = step->chip->transfers[transfer].length;
  computed_t computed;
  size_t i;

  computed.is_known = false;
  for (i = 0U; i < step->chip->readings_count; i++) {
    UP_ROM up_chip_reading_t *reading = &step->chip->readings[i];
    UP_ROM up_field_t *field = &step->schema->fields[reading->field];
    up_result_t result;
    if (reading->transfer != transfer) {
      continue;
    }
    result = (UP_USES_CHIP_FORMULAS && reading->computed) ? compute(step, reading, field, bytes, length, &computed)
                               : decode(step, reading, field, bytes, length);
    if (result != UP_FRESH) {
      count_fault(step->state, result);
    }
    say(step, reading, result);
  }
}

/* ---- transfers ---- */

/* A program whose transfers are all of one sort knows that of each. */
static bool has_trigger(UP_ROM up_chip_transfer_t *transfer) {
  return UP_USES_CHIP_TRIGGERS && (!UP_USES_CHIP_READS || transfer->trigger_count > 0U);
}

static uint32_t early_ms(const step_t *step) {
  return (step->chip->cycle_ms + EARLY_PARTS - 1U) / EARLY_PARTS;
}

static bool is_due(const step_t *step, size_t transfer) {
  return is_reached(step->now_ms + early_ms(step), step->state->transfers[transfer].due_ms);
}

/* Moves a transfer to the next time on its own grid; missed times are skipped. */
static void set_next(const step_t *step, size_t transfer) {
  up_chip_transfer_state_t *state = &step->state->transfers[transfer];
  const uint32_t own_ms = step->chip->transfers[transfer].cycle_ms;
  const uint32_t cycle_ms = (own_ms > step->chip->cycle_ms) ? own_ms : step->chip->cycle_ms;

  if (cycle_ms == 0U) {
    state->due_ms = step->now_ms;
    return;
  }
  do {
    state->due_ms += cycle_ms;
  } while (is_reached(step->now_ms, state->due_ms));
}

static bool fetch(const step_t *step, size_t transfer) {
  UP_ROM up_chip_transfer_t *table = &step->chip->transfers[transfer];
  const uint8_t *bytes = (UP_USES_CHIP_EXCHANGES && table->exchange) ? exchange_bytes(step, table->select, table->length)
                                         : read_bytes(step, table->select, table->select_count, table->length);

  if (bytes == NULL) {
    say_fault(step, transfer);
    return false;
  }
  say_values(step, transfer, bytes);
  return true;
}

/* Reads all transfers without a trigger that are due. */
static bool fetch_free(const step_t *step) {
  size_t i;

  for (i = 0U; i < transfers_of(step->chip); i++) {
    up_chip_transfer_state_t *state = &step->state->transfers[i];
    if (has_trigger(&step->chip->transfers[i]) || !is_due(step, i) || !is_reached(step->clock(), state->ready_ms)) {
      continue;
    }
    if (!fetch(step, i)) {
      return false;
    }
    set_next(step, i);
    state->ready_ms = step->now_ms + step->chip->transfers[i].wait_ms - early_ms(step);
  }
  return true;
}

/* The triggered transfer that has been due for longest; transfers_count if there is none. */
static size_t next_triggered(const step_t *step) {
  size_t found = transfers_of(step->chip);
  size_t i;

  for (i = 0U; i < transfers_of(step->chip); i++) {
    if (has_trigger(&step->chip->transfers[i]) && is_due(step, i) &&
        (found == transfers_of(step->chip) ||
         !is_reached(step->state->transfers[i].due_ms, step->state->transfers[found].due_ms))) {
      found = i;
    }
  }
  return found;
}

/* Fetches what is ready and triggers the next, repeatedly, so that a conversion that takes no time is fetched at
 * once. */
static void run_triggered(const step_t *step) {
  up_chip_state_t *state = step->state;
  size_t turns;

  for (turns = 0U; turns <= transfers_of(step->chip); turns++) {
    size_t transfer;
    if (state->in_flight > 0U) {
      transfer = (size_t)state->in_flight - 1U;
      if (!is_reached(step->clock(), state->transfers[transfer].ready_ms)) {
        return;
      }
      state->in_flight = 0U;
      if (!fetch(step, transfer)) {
        return;
      }
    }
    transfer = next_triggered(step);
    if (transfer == transfers_of(step->chip)) {
      return;
    }
    if (!write_bytes(step, step->chip->transfers[transfer].trigger, step->chip->transfers[transfer].trigger_count)) {
      say_fault(step, transfer);
      return;
    }
    set_next(step, transfer);
    state->transfers[transfer].ready_ms = after(step, step->chip->transfers[transfer].wait_ms);
    state->in_flight = (uint8_t)(transfer + 1U);
  }
}

void up_chip_step(UP_ROM up_chip_t *chip, up_chip_state_t *state, UP_ROM up_bus_t *bus, UP_ROM up_schema_t *schema,
                  up_clock_t clock, const up_value_sink_t *sink) {
  const step_t step = {chip, state, bus, schema, sink, clock, clock()};
  const uint8_t fault = state->fault;

  state->fault = UNTOUCHED;
  if (!state->is_running) {
    start(&step);
    if (!state->is_running && state->fault != UNTOUCHED) {
      say_fault(&step, transfers_of(chip));
    }
  }
  if (state->is_running && (!UP_USES_CHIP_READS || fetch_free(&step)) && UP_USES_CHIP_TRIGGERS) {
    run_triggered(&step);
  }
  if (state->fault == UNTOUCHED) {
    state->fault = fault;
  }
}

uint32_t up_chip_idle_ms(UP_ROM up_chip_t *chip, const up_chip_state_t *state, uint32_t now_ms) {
  uint32_t idle_ms = UINT32_MAX;
  size_t i;

  if (!state->is_running) {
    return state->is_pausing ? left_ms(now_ms, state->pause_until_ms) : chip->cycle_ms;
  }
  if (UP_USES_CHIP_TRIGGERS && state->in_flight > 0U) {
    idle_ms = left_ms(now_ms, state->transfers[state->in_flight - 1U].ready_ms);
  }
  for (i = 0U; i < transfers_of(chip); i++) {
    const bool is_free = !has_trigger(&chip->transfers[i]);
    uint32_t wait_ms = left_ms(now_ms, state->transfers[i].due_ms);
    if (is_free && left_ms(now_ms, state->transfers[i].ready_ms) > wait_ms) {
      wait_ms = left_ms(now_ms, state->transfers[i].ready_ms);
    }
    if ((is_free || state->in_flight == 0U) && wait_ms < idle_ms) {
      idle_ms = wait_ms;
    }
  }
  return (idle_ms == UINT32_MAX) ? chip->cycle_ms : idle_ms;
}

/* Merges the bits that other commands have last written to a register into the bytes of this one, and keeps the
 * result. */
static void join(UP_ROM up_chip_command_t *command, up_chip_state_t *state, uint8_t *bytes, size_t count) {
  uint8_t *kept = &state->kept[command->kept];
  size_t i;

  for (i = 0U; i < count; i++) {
    const unsigned own = command->own[i];
    kept[i] = (uint8_t)((kept[i] & ~own) | (bytes[i] & own));
    bytes[i] = kept[i];
  }
}

up_result_t up_chip_write(UP_ROM up_chip_t *chip, up_chip_state_t *state, UP_ROM up_bus_t *bus,
                          UP_ROM up_schema_t *schema, UP_ROM up_chip_command_t *command, const void *value) {
  UP_ROM up_field_t *field = &schema->fields[command->field];
  uint8_t *bytes = &state->work[command->prefix_count];
  size_t count;

  if (!state->is_running) {
    return UP_NOTHING;
  }
  if (command->prefix_count > 0U) {
    up_rom_copy(state->work, command->prefix, command->prefix_count);
  }
  count = up_value_encode(&command->value, field, value, bytes, up_value_bytes(&command->value, field->count));
  if (count == 0U) {
    return UP_INVALID;
  }
  if (command->own != UP_ROM_NULL) {
    join(command, state, bytes, count);
  }
  if (!went_through(state, bus->write(bus->context, chip->address, state->work, command->prefix_count + count))) {
    return (up_result_t)state->fault;
  }
  state->counts.written++;
  return UP_FRESH;
}

/* ---- sizes ---- */

static size_t greater(size_t left, size_t right) {
  return (left > right) ? left : right;
}

size_t up_chip_work_bytes(UP_ROM up_chip_t *chip, UP_ROM up_schema_t *schema) {
  size_t bytes = 1U;
  size_t i;

  for (i = 0U; i < chip->init_count; i++) {
    bytes = greater(bytes, chip->init[i].count);
  }
  if (chip->identity != UP_ROM_NULL) {
    bytes = greater(bytes, (size_t)chip->identity->select_count + chip->identity->count);
  }
  for (i = 0U; i < chip->calibration_count; i++) {
    bytes = greater(bytes, (size_t)chip->calibration[i].select_count + chip->calibration[i].count);
  }
  for (i = 0U; i < transfers_of(chip); i++) {
    UP_ROM up_chip_transfer_t *transfer = &chip->transfers[i];
    const size_t select = transfer->exchange ? transfer->length : transfer->select_count;
    bytes = greater(bytes, greater(transfer->trigger_count, select + transfer->length));
  }
  for (i = 0U; i < chip->commands_count; i++) {
    UP_ROM up_chip_command_t *command = &chip->commands[i];
    bytes = greater(bytes, command->prefix_count +
                               up_value_bytes(&command->value, schema->fields[command->field].count));
  }
  return bytes;
}
