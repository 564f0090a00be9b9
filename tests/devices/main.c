/*
 * The device code of the core as a program: each line on stdin is a request, each line on stdout an answer. Bytes are
 * in hexadecimal; `-` means none. Buffers have exactly the size that the headers require, so that a sanitizer detects
 * any access beyond them.
 *
 *   value CODE CRC WORD_BYTES LOW BITS SIGNED LITTLE WORDS TYPE COUNT ELEMENTS BYTES
 *     the result of decoding and the elements, then the bytes that encoding them gives
 *   crc8 POLYNOMIAL START BYTES
 *   median WINDOW TYPE BYTES         elements in sequence; the medians likewise
 *   number FORMAT DECIMALS TYPE TEXT HEMISPHERE
 *   formula NAME CALIBRATION RAW     validity and outputs
 *   stream START END LENGTH CHECKSUM FROM BYTES_MAX BYTES
 *     the body of each message followed by `;`, the number of bytes dropped, and `!` if feeding all at once differs
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "up_checksum.h"
#include "up_filter.h"
#include "up_formula.h"
#include "up_message.h"
#include "up_parse.h"

#define TEXT_MAX 20000

typedef struct {
  uint8_t *bytes;
  size_t size;
} block_t;

static void *room(size_t size) {
  void *memory = calloc((size == 0U) ? 1U : size, 1U);

  if (memory == NULL) {
    abort();
  }
  return memory;
}

static unsigned ask(void) {
  unsigned number = 0U;

  if (scanf("%u", &number) != 1) {
    abort();
  }
  return number;
}

static block_t ask_bytes(void) {
  static char text[TEXT_MAX];
  block_t block = {NULL, 0U};
  size_t i;
  unsigned byte;

  if (scanf("%19999s", text) != 1) {
    abort();
  }
  block.size = (text[0] == '-') ? 0U : strlen(text) / 2U;
  block.bytes = room(block.size);
  for (i = 0U; i < block.size; i++) {
    if (sscanf(&text[2U * i], "%2x", &byte) != 1) {
      abort();
    }
    block.bytes[i] = (uint8_t)byte;
  }
  return block;
}

static void print_elements(uint8_t type, const uint8_t *value, size_t count) {
  size_t i;

  for (i = 0U; i < count; i++) {
    printf(" %" PRIx64, up_element_load(type, &value[i * up_type_bytes(type)]));
  }
}

static void answer_value(void) {
  up_value_t how = {0};
  up_field_t field = {"f", 1U, 0U, UP_TO_HOST, true, 0U, 0U};
  block_t elements, bytes;
  uint8_t *value, *back;
  size_t count;
  up_result_t result;

  how.code = (uint8_t)ask();
  how.crc = (uint8_t)ask();
  how.word_bytes = (uint8_t)ask();
  how.low = (uint8_t)ask();
  how.bits = (uint8_t)ask();
  how.is_signed = ask() != 0U;
  how.little_endian = ask() != 0U;
  how.words = (uint8_t)ask();
  field.type = (uint8_t)ask();
  field.count = (uint16_t)ask();
  elements = ask_bytes();
  bytes = ask_bytes();
  how.elements = (elements.size > 0U) ? elements.bytes : NULL;
  value = room(up_field_bytes(&field));
  back = room(up_value_bytes(&how, field.count));
  result = up_value_decode(&how, &field, bytes.bytes, bytes.size, value);
  printf("%d", (int)result);
  if (result == UP_FRESH) {
    print_elements(field.type, value, field.count);
    count = up_value_encode(&how, &field, value, back, up_value_bytes(&how, field.count));
    printf(" :");
    print_elements(UP_TYPE_UINT8, back, count);
  }
  free(back);
  free(value);
  free(bytes.bytes);
  free(elements.bytes);
}

static void answer_crc8(void) {
  const uint8_t polynomial = (uint8_t)ask(), start = (uint8_t)ask();
  block_t bytes = ask_bytes();

  printf("%x", (unsigned)up_crc8(polynomial, start, bytes.bytes, bytes.size));
  free(bytes.bytes);
}

static void answer_median(void) {
  up_filter_t filter = {0};
  up_filter_state_t state = {0};
  up_field_t field = {"f", 1U, 0U, UP_TO_HOST, false, 1U, 0U};
  block_t bytes;
  size_t at;

  filter.median = (uint8_t)ask();
  field.type = (uint8_t)ask();
  bytes = ask_bytes();
  state.memory = room(8U * UP_FILTER_WORDS(1U, up_type_bytes(field.type), filter.median, false, false));
  for (at = 0U; at < bytes.size; at += up_type_bytes(field.type)) {
    if (up_filter_apply(&filter, &state, &field, (uint32_t)at, &bytes.bytes[at]) != UP_FRESH) {
      abort();
    }
  }
  printf("0");
  print_elements(field.type, bytes.bytes, bytes.size / up_type_bytes(field.type));
  free(state.memory);
  free(bytes.bytes);
}

static void answer_number(void) {
  const unsigned format = ask();
  const uint8_t decimals = (uint8_t)ask(), type = (uint8_t)ask();
  block_t text = ask_bytes(), hemisphere = ask_bytes();
  const up_piece_t piece = {(const char *)text.bytes, text.size};
  const up_piece_t letter = {(const char *)hemisphere.bytes, hemisphere.size};
  uint8_t value[8];
  up_result_t result;

  if (format == UP_FORMAT_HEX) {
    result = up_parse_hex(piece, type, value);
  } else if (format == UP_FORMAT_DEGREES) {
    result = up_parse_degrees(piece, letter, type, value);
  } else {
    result = up_parse_decimal(piece, decimals, type, value);
  }
  printf("%d", (int)result);
  if (result == UP_FRESH) {
    print_elements(type, value, 1U);
  }
  free(text.bytes);
  free(hemisphere.bytes);
}

static void answer_formula(void) {
  char name[16];
  const up_formula_t *formula;
  block_t calibration, raw;
  int64_t outputs[UP_FORMULA_OUTPUTS_MAX];
  bool is_valid;
  size_t i;

  if (scanf("%15s", name) != 1) {
    abort();
  }
  formula = (strcmp(name, "bme280") == 0) ? &up_formula_bme280 : &up_formula_bmp280;
  calibration = ask_bytes();
  raw = ask_bytes();
  if (calibration.size != formula->calibration_bytes || raw.size != formula->raw_bytes) {
    abort();
  }
  is_valid = formula->compute(calibration.bytes, NULL, raw.bytes, outputs);
  printf("%d", is_valid ? 1 : 0);
  for (i = 0U; is_valid && i < formula->outputs_count; i++) {
    printf(" %" PRId64, outputs[i]);
  }
  free(calibration.bytes);
  free(raw.bytes);
}

/* ---- streams ---- */

#define BODY_MAX 64U

static void on_byte(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  (void)field;
  if (result == UP_WRONG_CRC && value == NULL) {
    return;
  }
  if (result != UP_FRESH) {
    abort();
  }
  printf("%02x", (unsigned)*(const uint8_t *)value);
}

static void on_nothing(void *context, uint16_t field, up_result_t result, void *value) {
  (void)context;
  (void)field;
  (void)result;
  (void)value;
}

/* Each byte of the body is a separate field; for a message without a body, only its end is printed. */
static void answer_stream(void) {
  static up_field_t fields[BODY_MAX];
  static up_message_field_t places[BODY_MAX];
  const up_schema_t schema = {fields, BODY_MAX, false, 0U};
  const up_value_sink_t sink = {on_byte, NULL};
  up_message_t message = {0};
  const up_value_sink_t nobody = {on_nothing, NULL};
  up_message_state_t state = {0}, once = {0};
  block_t start = ask_bytes(), end = ask_bytes(), bytes;
  size_t at;
  uint16_t i;

  for (i = 0U; i < BODY_MAX; i++) {
    const up_field_t field = {"b", (uint8_t)(i + 1U), UP_TYPE_UINT8, UP_TO_HOST, false, 1U, i};
    const up_message_field_t place = {.field = i, .byte = i, .value = {.word_bytes = 1U}};
    fields[i] = field;
    places[i] = place;
  }
  message.start = start.bytes;
  message.start_count = (uint8_t)start.size;
  message.end = end.bytes;
  message.end_count = (uint8_t)end.size;
  message.length = (uint16_t)ask();
  message.checksum = (uint8_t)ask();
  message.checksum_from = (uint8_t)ask();
  message.bytes_max = (uint16_t)ask();
  message.fields = places;
  message.fields_count = BODY_MAX;
  bytes = ask_bytes();
  state.buffer = room(message.bytes_max);
  state.scratch = room(8U);
  for (at = 0U; at < bytes.size; at++) {
    const uint32_t before = state.messages;
    up_message_feed(&message, &state, &schema, &bytes.bytes[at], 1U, &sink);
    if (state.messages != before) {
      printf(";");
    }
  }
  printf(" %u", (unsigned)state.dropped_bytes);
  once.buffer = room(message.bytes_max);
  once.scratch = state.scratch;
  up_message_feed(&message, &once, &schema, bytes.bytes, bytes.size, &nobody);
  if (once.messages != state.messages || once.values != state.values || once.dropped_bytes != state.dropped_bytes) {
    printf("!");
  }
  free(once.buffer);
  free(state.scratch);
  free(state.buffer);
  free(bytes.bytes);
  free(start.bytes);
  free(end.bytes);
}

int main(void) {
  char what[16];

  while (scanf("%15s", what) == 1) {
    if (strcmp(what, "value") == 0) {
      answer_value();
    } else if (strcmp(what, "crc8") == 0) {
      answer_crc8();
    } else if (strcmp(what, "median") == 0) {
      answer_median();
    } else if (strcmp(what, "number") == 0) {
      answer_number();
    } else if (strcmp(what, "formula") == 0) {
      answer_formula();
    } else {
      answer_stream();
    }
    printf("\n");
  }
  return 0;
}
