/*
 * The core in C as a program: a question a line on stdin, an answer a line on stdout. `main.rs` asks the runtime in
 * Rust the same. Numbers are decimal, bits and bytes hexadecimal; `-` is no bytes. Elements are bits, one a word.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "up_capture.h"
#include "up_chip.h"
#include "up_compose.h"
#include "up_convert.h"
#include "up_count.h"
#include "up_debounce.h"
#include "up_drive.h"
#include "up_elements.h"
#include "up_filter.h"
#include "up_parse.h"
#include "up_pulse_width.h"
#include "up_reporter.h"
#include "up_stepper.h"

#define BYTES_MAX 512U
#define ELEMENTS_MAX 16U

typedef struct {
  uint8_t bytes[BYTES_MAX];
  size_t count;
} block_t;

static void check(bool holds, const char *what) {
  if (!holds) {
    fprintf(stderr, "%s\n", what);
    exit(2);
  }
}

static uint64_t ask(void) {
  uint64_t number = 0U;

  check(scanf("%" SCNu64, &number) == 1, "a number is missing");
  return number;
}

static uint64_t ask_bits(void) {
  uint64_t bits = 0U;

  check(scanf("%" SCNx64, &bits) == 1, "bits are missing");
  return bits;
}

static void ask_block(block_t *block) {
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

static void ask_value(const up_field_t *field, uint64_t *value) {
  const size_t size = up_type_bytes(field->type);
  uint8_t *memory = (uint8_t *)value;
  size_t i;

  for (i = 0U; i < field->count; i++) {
    up_element_store(field->type, ask_bits(), &memory[i * size]);
  }
}

static void say_value(const up_field_t *field, const void *value) {
  const size_t size = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t i;

  for (i = 0U; i < field->count; i++) {
    printf(" %" PRIx64, up_element_load(field->type, &memory[i * size]));
  }
}

static void say_bytes(const uint8_t *bytes, size_t count) {
  size_t i;

  for (i = 0U; i < count; i++) {
    printf("%02x", (unsigned)bytes[i]);
  }
}

static up_field_t ask_field(void) {
  up_field_t field = {.name = "", .id = 1U, .count = 1U};

  field.type = (uint8_t)ask();
  field.count = (uint16_t)ask();
  check(field.count <= ELEMENTS_MAX, "too many elements");
  return field;
}

/* ---- numbers ---- */

static void ratio(void) {
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  const bool is_negative = ask() != 0U;
  const uint64_t numerator = ask(), denominator = ask();
  uint64_t element = 0U;

  up_store_signed_ratio(field.type, is_negative, numerator, denominator, &element);
  say_value(&field, &element);
}

static void stored(void) {
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  const uint64_t bits = ask_bits();
  uint64_t element = 0U;
  int64_t number;

  memcpy(&number, &bits, sizeof number);
  up_store_unsigned(field.type, bits, &element);
  say_value(&field, &element);
  up_store_signed(field.type, number, &element);
  say_value(&field, &element);
  up_count_store(field.type, number, &element);
  say_value(&field, &element);
}

static void magnitude(void) {
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  const up_pulse_width_t width = {.least_ticks = (uint32_t)ask(), .greatest_ticks = (uint32_t)ask()};
  uint64_t element;
  bool is_negative;

  ask_value(&field, &element);
  printf(" %" PRIu64, up_load_magnitude(field.type, &element, &is_negative));
  printf(" %u %" PRIu32, (unsigned)is_negative, up_pulse_ticks(&width, up_pulse_level(field.type, &element)));
}

static uint8_t elements[ELEMENTS_MAX];

static up_value_t ask_coding(void) {
  up_value_t how = {.elements = NULL};
  block_t block;

  ask_block(&block);
  memcpy(elements, block.bytes, block.count);
  how.elements = (block.count > 0U) ? elements : NULL;
  how.words = (uint8_t)ask();
  how.code = (uint8_t)ask();
  how.crc = (uint8_t)ask();
  how.word_bytes = (uint8_t)ask();
  how.low = (uint8_t)ask();
  how.bits = (uint8_t)ask();
  how.is_signed = ask() != 0U;
  how.little_endian = ask() != 0U;
  return how;
}

static void decode(void) {
  const up_field_t field = ask_field();
  const up_value_t how = ask_coding();
  uint64_t value[ELEMENTS_MAX] = {0};
  up_result_t result;
  block_t block;

  ask_block(&block);
  result = up_value_decode(&how, &field, block.bytes, block.count, value);
  printf(" %u", (unsigned)result);
  if (result == UP_FRESH) {
    say_value(&field, value);
  }
}

static void encode(void) {
  const up_field_t field = ask_field();
  const up_value_t how = ask_coding();
  uint64_t value[ELEMENTS_MAX] = {0};
  uint8_t bytes[BYTES_MAX];

  ask_value(&field, value);
  printf(" ");
  say_bytes(bytes, up_value_encode(&how, &field, value, bytes, sizeof bytes));
}

static void compose(void) {
  const up_field_t field = ask_field();
  up_compose_t how = {.value = ask_coding()};
  uint64_t value[ELEMENTS_MAX] = {0};
  uint8_t bytes[BYTES_MAX];
  block_t start, behind, end;

  ask_block(&start);
  ask_block(&behind);
  ask_block(&end);
  how.behind = behind.bytes;
  how.behind_count = (uint8_t)behind.count;
  how.format = (uint8_t)ask();
  how.separator = (char)ask();
  how.decimals = (uint8_t)ask();
  how.start = start.bytes;
  how.start_count = (uint8_t)start.count;
  how.end = end.bytes;
  how.end_count = (uint8_t)end.count;
  how.checksum = (uint8_t)ask();
  how.checksum_from = (uint8_t)ask();
  ask_value(&field, value);
  printf(" ");
  say_bytes(bytes, up_compose(&how, &field, value, bytes, sizeof bytes));
}

static void parse(void) {
  const uint64_t how = ask();
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  const uint8_t decimals = (uint8_t)ask();
  uint64_t element = 0U;
  up_piece_t text, hemisphere;
  up_result_t result;
  block_t first, second;

  ask_block(&first);
  ask_block(&second);
  text.start = (const char *)first.bytes;
  text.size = first.count;
  hemisphere.start = (const char *)second.bytes;
  hemisphere.size = second.count;
  if (how == 0U) {
    result = up_parse_decimal(text, decimals, field.type, &element);
  } else if (how == 1U) {
    result = up_parse_degrees(text, hemisphere, field.type, &element);
  } else {
    result = up_parse_hex(text, field.type, &element);
  }
  printf(" %u", (unsigned)result);
  say_value(&field, &element);
}

static void formula(void) {
  const up_formula_t *all[] = {&up_formula_bmp280, &up_formula_bme280, &up_formula_ntc, &up_formula_tsl2561,
                                  &up_formula_hx711};
  const up_formula_t *one = all[ask() % 5U];
  int32_t parameters[3];
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX] = {0};
  block_t calibration, raw;
  size_t i;

  for (i = 0U; i < 3U; i++) {
    parameters[i] = (int32_t)(uint32_t)ask();
  }
  ask_block(&calibration);
  ask_block(&raw);
  if (!one->compute(calibration.bytes, parameters, raw.bytes, outputs)) {
    printf(" none");
    return;
  }
  for (i = 0U; i < one->outputs_count; i++) {
    printf(" %" PRId64, outputs[i]);
  }
}

/* ---- filters ---- */

static struct {
  up_filter_t table;
  up_range_t invalid[4];
  up_filter_state_t state;
  up_field_t field;
  uint64_t memory[512];
} filter;

static up_number_t number_of(uint8_t type, uint64_t bits) {
  up_number_t number = {.u = bits};
  const uint32_t word = (uint32_t)bits;

  if (type == UP_TYPE_FLOAT32) {
    memcpy(&number.f, &word, sizeof number.f);
  }
  return number;
}

/* An end of a range: a number with its sign, as tables have it. */
static up_number_t end_of(uint8_t type, uint64_t bits) {
  up_number_t number = number_of(type, bits);

  if (type == UP_TYPE_INT8) {
    number.i = (int8_t)bits;
  } else if (type == UP_TYPE_INT16) {
    number.i = (int16_t)bits;
  } else if (type == UP_TYPE_INT32) {
    number.i = (int32_t)bits;
  }
  return number;
}

static void begin_filter(void) {
  uint8_t i;

  memset(&filter, 0, sizeof filter);
  filter.field = ask_field();
  filter.state.memory = filter.memory;
  filter.table.invalid = filter.invalid;
  filter.table.wide = (ask() != 0U) ? &up_filter_double : NULL;
  filter.table.median = (uint8_t)ask();
  filter.table.smooth_ms = (uint32_t)ask();
  filter.table.has_change = ask() != 0U;
  filter.table.change = number_of(filter.field.type, ask_bits());
  filter.table.heartbeat_ms = (uint32_t)ask();
  filter.table.invalid_count = (uint8_t)ask();
  for (i = 0U; i < filter.table.invalid_count; i++) {
    filter.invalid[i].low = end_of(filter.field.type, ask_bits());
    filter.invalid[i].high = end_of(filter.field.type, ask_bits());
  }
}

static void apply_filter(void) {
  const uint32_t now_ms = (uint32_t)ask();
  uint64_t value[ELEMENTS_MAX] = {0};

  ask_value(&filter.field, value);
  printf(" %u", (unsigned)up_filter_apply(&filter.table, &filter.state, &filter.field, now_ms, value));
  say_value(&filter.field, value);
}

/* ---- what pins say ---- */

static up_capture_config_t capture;
static up_capture_raw_t raw;
static up_capture_state_t capture_state;

static void begin_capture(void) {
  memset(&raw, 0, sizeof raw);
  memset(&capture_state, 0, sizeof capture_state);
  capture.mode = (uint8_t)ask();
  capture.tick_hz = (uint32_t)ask();
  capture.silent_ms = (uint32_t)ask();
}

static void read_capture(void) {
  const uint64_t what = ask();
  const uint32_t ticks = (uint32_t)ask(), now_ms = (uint32_t)ask();
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  const bool first = ask() != 0U;
  uint64_t element = 0U;

  if (what < 2U) {
    up_capture_on_width(&raw, ticks, what == 1U);
  } else if (what == 2U) {
    up_capture_on_period(&raw, ticks);
  }
  printf(" %u", (unsigned)up_capture_read(&capture, &capture_state, &raw, first, now_ms, field.type, &element));
  say_value(&field, &element);
}

static up_contact_config_t contact_config;
static up_contact_t contact;
static up_contact_report_t contact_reported;

static void begin_contact(void) {
  memset(&contact, 0, sizeof contact);
  memset(&contact_reported, 0, sizeof contact_reported);
  contact_config.lasting = (uint32_t)ask();
  contact_config.edge = (uint8_t)ask();
}

static void see_contact(void) {
  const uint64_t what = ask();
  const bool level = ask() != 0U;
  const uint32_t now = (uint32_t)ask();

  if (what == 0U) {
    up_contact_on_edge(&contact_config, &contact, level, now);
  } else if (what == 1U) {
    up_contact_look(&contact_config, &contact, level, now);
  } else if (what == 2U) {
    up_contact_sample(&contact_config, &contact, level, now);
  } else if (up_contact_report(&contact_config, &contact, &contact_reported)) {
    printf(" %u", (unsigned)contact_reported.level);
  }
  printf(" %" PRIu32, contact.edges);
}

static up_drive_t bridge;
static up_drive_state_t bridge_state;
static up_count_t counter;
static up_turn_t turn;
static uint8_t flags[8];

static void drive(void) {
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  uint64_t element;
  size_t i, count;

  ask_value(&field, &element);
  count = up_drive(&bridge, &bridge_state, field.type, &element, writes);
  for (i = 0U; i < count; i++) {
    printf(" %u=%" PRIu32, (unsigned)writes[i].output, writes[i].value);
  }
}

/* ---- the reporter; in a file of its own ---- */

void begin_reporter(const uint64_t *how);
void put_value(size_t field, const uint8_t *bytes);
void note_outcome(size_t field, unsigned outcome, uint32_t now_ms);
void cycle(uint64_t now_us, const uint64_t *how, const uint8_t *bytes, size_t size);

static void ask_reporter(const char *word) {
  uint64_t how[5];
  uint64_t now_us;
  block_t block;
  size_t i;

  if (strcmp(word, "reporter") == 0) {
    for (i = 0U; i < 4U; i++) {
      how[i] = ask();
    }
    begin_reporter(how);
  } else if (strcmp(word, "put") == 0) {
    const size_t field = (size_t)ask();
    ask_block(&block);
    put_value(field, block.bytes);
  } else if (strcmp(word, "note") == 0) {
    const size_t field = (size_t)ask();
    const unsigned outcome = (unsigned)ask();
    note_outcome(field, outcome, (uint32_t)ask());
  } else {
    now_us = ask();
    for (i = 0U; i < 5U; i++) {
      how[i] = ask();
    }
    ask_block(&block);
    cycle(now_us, how, block.bytes, block.count);
  }
}

typedef struct {
  const char *word;
  void (*run)(void);
} question_t;

static void ask_decay(void) {
  const uint32_t elapsed_ms = (uint32_t)ask();

  printf(" %" PRIu32, up_filter_decay(elapsed_ms, (uint32_t)ask()));
}

static void begin_bridge(void) {
  memset(&bridge_state, 0, sizeof bridge_state);
  bridge.mode = (uint8_t)ask();
  bridge.full = (uint32_t)ask();
}

static void count(void) {
  up_count_step(&counter, (uint16_t)ask());
  printf(" %" PRId32, up_count_total(&counter));
}

static void take_turn(void) {
  const uint32_t cycle_ms = (uint32_t)ask();

  printf(" %u", (unsigned)up_turn_is_next(&turn, cycle_ms, (uint32_t)ask()));
}

static void note_element(void) {
  const size_t index = (size_t)ask();
  const bool is_complete = ask() != 0U;

  up_elements_note(flags, index);
  printf(" %u", (unsigned)up_elements_are_due(flags, sizeof flags, is_complete));
}

static up_stepper_t motor;
static up_stepper_state_t motor_state;

static void begin_motor(void) {
  memset(&motor_state, 0, sizeof motor_state);
  motor.tick_hz = (uint32_t)ask();
  motor.speed = (uint32_t)ask();
  motor.acceleration = (uint32_t)ask();
  motor.is_velocity = ask() != 0U;
}

static void command_motor(void) {
  const up_field_t field = {.type = (uint8_t)ask(), .count = 1U};
  uint64_t element;

  ask_value(&field, &element);
  up_stepper_command(&motor, &motor_state, field.type, &element);
}

static void stop_motor(void) {
  up_stepper_stop(&motor_state);
}

static void advance_motor(void) {
  const uint32_t ticks = up_stepper_advance(&motor, &motor_state);

  printf(" %" PRIu32 " %u %u %" PRId32, ticks, (unsigned)motor_state.is_step, (unsigned)motor_state.is_backward,
         motor_state.position);
}

int main(void) {
  static const question_t all[] = {
      {"ratio", ratio},          {"store", stored},       {"magnitude", magnitude}, {"decode", decode},
      {"encode", encode},        {"compose", compose},    {"parse", parse},         {"formula", formula},
      {"filter", begin_filter},  {"apply", apply_filter}, {"decay", ask_decay},     {"capture", begin_capture},
      {"captured", read_capture}, {"contact", begin_contact}, {"see", see_contact}, {"bridge", begin_bridge},
      {"drive", drive},          {"count", count},        {"element", note_element}, {"turn", take_turn},
      {"motor", begin_motor},    {"target", command_motor}, {"halt", stop_motor},   {"advance", advance_motor},
  };
  char word[16];
  size_t i;

  while (scanf("%15s", word) == 1) {
    printf("%s", word);
    for (i = 0U; i < sizeof all / sizeof all[0] && strcmp(word, all[i].word) != 0; i++) {
    }
    if (i < sizeof all / sizeof all[0]) {
      all[i].run();
    } else {
      ask_reporter(word);
    }
    printf("\n");
    fflush(stdout); /* who asks may wait for the answer */
  }
  return 0;
}
