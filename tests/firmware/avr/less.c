/*
 * What the core makes of values of at most 32 bits. Built with all of it and with less of it, for the computer and for
 * AVR, the texts must be the same. Each line is the checksum of many results, of numbers that look random.
 *
 * LEAST: only what the least core has: counts, whole words, chips with one triggered transfer, a host that only asks.
 */
#include "less.h"

#include "up_capture.h"
#include "up_compose.h"
#include "up_convert.h"
#include "up_count.h"
#include "up_drive.h"
#include "up_filter.h"
#include "up_parse.h"
#include "up_ppm.h"
#include "up_pulse_width.h"
#include "up_text.h"

uint32_t seed = 1U, sum;
UP_ROM uint32_t ends[ENDS] = {0U, 0x7FU, 0xFFU, 0x7FFFU, 0xFFFFU, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU};

/* An element in memory that was not zero before. */
static uint32_t element;

static void clear(void) {
  element = 0xA5A5A5A5U;
}

static void note_element(uint8_t type) {
  note(&element, up_type_bytes(type));
}

/* ---- fields of all types, as scalars and as arrays ---- */

#define FIELD(kind, many) {.id = 1U + 2U * (kind) + ((many) > 1U), .type = (kind), .count = (many)}
#define FIELD_PAIR(kind) FIELD(kind, 1U), FIELD(kind, 3U)

UP_ROM up_field_t fields[2U * TYPES] = {
    FIELD_PAIR(UP_TYPE_BOOL),  FIELD_PAIR(UP_TYPE_UINT8),  FIELD_PAIR(UP_TYPE_INT8),  FIELD_PAIR(UP_TYPE_UINT16),
    FIELD_PAIR(UP_TYPE_INT16), FIELD_PAIR(UP_TYPE_UINT32), FIELD_PAIR(UP_TYPE_INT32),
};

/* ---- conversions ---- */

static void run_stores(uint8_t type) {
  const uint32_t one = number();
  const uint32_t other = number();
  const uint32_t divisor = number();
  const int32_t factor = 1 + (int32_t)below(1000U);
  bool is_negative = false;

  clear();
  up_store_unsigned(type, number(), &element);
  note_element(type);
  up_store_signed(type, signed_number(), &element);
  note_element(type);
  note_word((uint32_t)up_load_magnitude(type, &element, &is_negative));
  note_word(is_negative ? 1U : 0U);
  up_store_signed_ratio(type, (other & 1U) != 0U, one, divisor, &element);
  note_element(type);
  up_store_scaled(type, one, other, divisor, &element);
  note_element(type);
  note_word(up_scale(one, other % 10000U, 10000U));
  up_store_output(type, (int64_t)signed_number() * factor, &element);
  note_element(type);
  up_count_store(type, signed_number(), &element);
  note_element(type);
}

static void run_bytes(UP_ROM up_field_t *field) {
  const size_t size = 1U + below(4U);
  const bool is_little = below(2U) != 0U;
  uint8_t bytes[4], back[4] = {0U};

  (void)up_put_32(bytes, number());
  note_word(up_store_bytes(field, bytes, size, is_little, &element) ? 1U : 0U);
  note_element(field->type);
  note_word(up_load_bytes(field, &element, back, size, is_little) ? 1U : 0U);
  note(back, sizeof back);
}

static void run_text(uint8_t type) {
  static UP_ROM up_compose_t decimal = {.format = UP_FORMAT_DECIMAL, .decimals = 3U, .separator = ' '};
  static UP_ROM up_compose_t hex = {.format = UP_FORMAT_HEX, .decimals = 3U};
  const uint32_t digits = number();
  char text[UP_TEXT_BYTES];
  uint8_t bytes[32];
  up_piece_t piece = {text, 0U};

  note(text, up_text_element(type, &element, text));
  note(bytes, up_compose(&decimal, &fields[2U * type], &element, bytes, sizeof bytes));
  note(bytes, up_compose(&hex, &fields[2U * type], &element, bytes, sizeof bytes));
  for (; piece.size < 12U; piece.size++) {
    text[piece.size] = (char)"0123456789abcdefABCDEF  "[(digits >> piece.size) % 24U];
  }
  piece.size = below(13U);
  note_word((uint32_t)up_parse_hex(piece, type, &element));
  note_element(type);
}

static void run_outputs(uint8_t type) {
  static UP_ROM up_drive_t bridge = {.mode = UP_DRIVE_DIRECTION_PINS, .full = 10000U};
  up_drive_state_t state = {0};
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  size_t count = up_drive(&bridge, &state, type, &element, writes);

  while (count > 0U) {
    count--;
    note_word(writes[count].output * 100000U + writes[count].value);
  }
  note_word(up_pulse_level(type, &element));
}

static void run_conversions(void) {
  uint8_t type;
  unsigned turn;

  for (type = 0U; type < TYPES; type++) {
    for (turn = 0U; turn < TURNS; turn++) {
      run_stores(type);
      run_bytes(&fields[2U * type]);
      run_text(type);
      run_outputs(type);
    }
    say_rom(up_type_name(type));
    tell("");
  }
}

/* ---- words of devices ---- */

static UP_ROM up_value_t words[] = {
    {.word_bytes = 1U},
    {.word_bytes = 2U},
    {.word_bytes = 2U, .little_endian = true, .is_signed = true},
    {.word_bytes = 3U, .is_signed = true},
    {.word_bytes = 4U, .little_endian = true},
    {.word_bytes = 4U, .is_signed = true},
#if !defined(LEAST)
    {.word_bytes = 2U, .low = 4U, .bits = 12U, .is_signed = true},
    {.word_bytes = 4U, .low = 1U, .bits = 30U, .little_endian = true},
    {.word_bytes = 4U, .low = 31U},
    {.word_bytes = 4U, .code = UP_CODE_BCD},
    {.word_bytes = 2U, .code = UP_CODE_BCD, .bits = 11U},
    {.word_bytes = 4U, .code = UP_CODE_MAGNITUDE},
    {.word_bytes = 2U, .code = UP_CODE_MAGNITUDE, .little_endian = true},
    {.code = UP_CODE_PACKED, .bits = 11U},
    {.code = UP_CODE_PACKED, .bits = 25U, .is_signed = true},
    {.word_bytes = 2U, .crc = UP_CRC_SENSIRION},
    {.code = UP_CODE_PULSES, .word_bytes = 6U, .low = 3U, .bits = 8U},
#endif
};

static void run_word(UP_ROM up_value_t *how, UP_ROM up_field_t *field) {
  uint32_t value[3] = {0U, 0U, 0U};
  uint8_t bytes[32];
  size_t i;

  for (i = 0U; i < sizeof bytes; i += 4U) {
    (void)up_put_32(&bytes[i], number());
  }
  if (below(2U) == 0U) {
    for (i = 0U; i < sizeof bytes; i++) {
      bytes[i] = (uint8_t)(bytes[i] & 0x77U);
    }
  }
  if (up_value_bytes(how, field->count) > sizeof bytes) {
    return;
  }
  if (how->code != UP_CODE_PULSES) {
    note_word((uint32_t)up_value_decode(how, field, bytes, sizeof bytes, value));
    note(value, up_field_bytes(field));
  }
  value[0] = number();
  value[1] = number();
  value[2] = number();
  note(bytes, up_value_encode(how, field, value, bytes, sizeof bytes));
}

static void run_words(void) {
  size_t how, field;
  unsigned turn;

  for (how = 0U; how < sizeof words / sizeof words[0]; how++) {
    for (turn = 0U; turn < TURNS / 10U; turn++) {
      for (field = 0U; field < 2U * TYPES; field++) {
        run_word(&words[how], &fields[field]);
      }
    }
    tell("word");
  }
}

/* ---- filters ---- */

static UP_ROM up_range_t natural[] = {{.low.u = 0U, .high.u = 0U}, {.low.u = 200U, .high.u = 210U}};
static UP_ROM up_range_t integer[] = {{.low.i = -128, .high.i = -120}, {.low.i = -1, .high.i = 1}};
#if defined(LEAST)
#define CHANGES .median = 0U
#else
#define CHANGES .median = 3U, .smooth_ms = 50U, .has_change = true, .change.u = 20U, .heartbeat_ms = 400U
#endif
static UP_ROM up_filter_t filters[2] = {
    {.invalid = natural, .invalid_count = 2U, CHANGES},
    {.invalid = integer, .invalid_count = 2U, CHANGES},
};

static void run_filters(void) {
  size_t field;
  unsigned turn;

  for (field = 0U; field < 2U * TYPES; field++) {
    const uint8_t type = fields[field].type;
    const bool has_sign = type == UP_TYPE_INT8 || type == UP_TYPE_INT16 || type == UP_TYPE_INT32;
    uint64_t memory[UP_FILTER_WORDS(3U, 4U, 3U, true, true)] = {0U};
    up_filter_state_t state = {.memory = memory};
    uint32_t now_ms = 0xFFFFFF00U;

    for (turn = 0U; turn < TURNS; turn++) {
      uint32_t value[3];

      value[0] = number();
      value[1] = (below(4U) == 0U) ? number() : value[0];
      value[2] = value[0];
      now_ms += below(300U);
      note_word((uint32_t)up_filter_apply(&filters[has_sign ? 1 : 0], &state, &fields[field], now_ms, value));
      note(value, up_field_bytes(&fields[field]));
    }
    tell("filter");
  }
}

/* ---- captures ---- */

static UP_ROM up_capture_config_t captures[] = {
    {.mode = UP_CAPTURE_COUNT, .tick_hz = 10000U},
#if !defined(LEAST)
    {.mode = UP_CAPTURE_WIDTH, .tick_hz = 1000000U},
    {.mode = UP_CAPTURE_PERIOD, .tick_hz = 1000000U},
    {.mode = UP_CAPTURE_FREQUENCY, .tick_hz = 1000000U, .silent_ms = 900U},
    {.mode = UP_CAPTURE_DUTY, .tick_hz = 1000000U, .silent_ms = 900U},
#endif
};

static void run_capture(UP_ROM up_capture_config_t *config, uint8_t type) {
  up_capture_state_t state = {.has_reported = false};
  up_capture_raw_t raw;
  uint32_t now_ms = 0U;
  unsigned turn;

  memset(&raw, 0, sizeof raw);
  for (turn = 0U; turn < TURNS / 10U; turn++) {
    const uint32_t edges = below(3U);

    if (edges > 0U) {
      up_capture_on_width(&raw, number(), edges > 1U);
      up_capture_on_period(&raw, number());
    }
    now_ms += below(700U);
    note_word(up_capture_read(config, &state, &raw, turn > 2U, now_ms, type, &element) ? 1U : 0U);
    note_element(type);
  }
}

static void run_train(UP_ROM up_field_t *field) {
  static UP_ROM up_ppm_config_t config = {.tick_hz = 2000000U, .gap_ticks = 6000U, .min_ticks = 1000U};
  up_ppm_raw_t raw;
  uint32_t trains = 0U, value[3] = {0U, 0U, 0U};
  unsigned turn;

  memset(&raw, 0, sizeof raw);
  for (turn = 0U; turn < TURNS / 10U; turn++) {
    up_ppm_on_interval(&config, &raw, 900U + below(6000U));
    note_word((uint32_t)up_ppm_read(&config, &raw, &trains, field, value));
    note(value, up_field_bytes(field));
  }
}

static void run_captures(void) {
  size_t config;
  uint8_t type;

  clear();
  for (config = 0U; config < sizeof captures / sizeof captures[0]; config++) {
    for (type = 0U; type < TYPES; type++) {
      run_capture(&captures[config], type);
    }
    tell("capture");
  }
  for (type = 0U; type < TYPES; type++) {
    run_train(&fields[2U * type + 1U]);
  }
  tell("train");
}

int main(void) {
  begin();
  run_conversions();
  run_words();
  run_filters();
  run_captures();
  run_board();
  end();
  return 0;
}
