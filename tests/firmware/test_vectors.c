/*
 * The shared wire vectors: the same text files that every encoder and decoder of the project must pass.
 *
 * Each decode case is fed byte by byte, all at once, and cut at every single place; each must say the same.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "up_decode.h"
#include "up_encode.h"

#define LINE_MAX_BYTES 4096U
#define TEXT_MAX_BYTES 16384U
#define STREAM_MAX_BYTES 4096U
#define VALUES_MAX_BYTES 4096U

typedef struct {
  up_schema_t schema;
  up_field_t fields[UP_FIELDS_MAX];
  char names[UP_FIELDS_MAX][64];
  char canonical[TEXT_MAX_BYTES];
  size_t values_bytes;
} vector_schema_t;

typedef enum { CASE_NONE, CASE_ENCODE, CASE_DECODE } case_kind_t;

typedef struct {
  case_kind_t kind;
  up_direction_t direction;
  uint8_t chosen[UP_FIELD_BITMAP_BYTES];
  uint8_t stream[STREAM_MAX_BYTES];
  size_t stream_bytes;
  char expected[TEXT_MAX_BYTES];
  char name[128];
} vector_case_t;

static vector_schema_t vector;
static vector_case_t current;
static uint64_t values_aligned[VALUES_MAX_BYTES / 8U];
static uint8_t *const values = (uint8_t *)values_aligned;
static char delivered[TEXT_MAX_BYTES];
static unsigned encode_cases, decode_cases, schemas;

static const char *const type_names[] = {"bool",  "uint8",  "int8",  "uint16",  "int16",  "uint32",
                                         "int32", "uint64", "int64", "float32", "float64"};

/* ---- the schema ---- */

static uint32_t crc32_of(const char *text) {
  uint32_t crc = 0xFFFFFFFFU;
  int bit;

  for (; *text != '\0'; text++) {
    crc ^= (uint8_t)*text;
    for (bit = 0; bit < 8; bit++) {
      crc = (crc >> 1) ^ ((crc & 1U) != 0U ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

static void append(char *text, size_t size, const char *more) {
  const size_t used = strlen(text);

  if (used + strlen(more) + 1U > size) {
    check_that(false, "text fits", __FILE__, __LINE__);
    return;
  }
  memcpy(&text[used], more, strlen(more) + 1U);
}

static uint8_t parse_type(const char *word, uint16_t *count) {
  char base[32];
  size_t i;
  const char *bracket = strchr(word, '[');
  const size_t length = (bracket == NULL) ? strlen(word) : (size_t)(bracket - word);

  *count = (bracket == NULL) ? 1U : (uint16_t)strtoul(bracket + 1, NULL, 10);
  if (length >= sizeof base) {
    return UINT8_MAX;
  }
  memcpy(base, word, length);
  base[length] = '\0';
  for (i = 0U; i < sizeof type_names / sizeof type_names[0]; i++) {
    if (strcmp(base, type_names[i]) == 0) {
      return (uint8_t)i;
    }
  }
  return UINT8_MAX;
}

static void begin_schema(void) {
  memset(&vector, 0, sizeof vector);
  vector.schema.fields = vector.fields;
  schemas++;
}

static void add_item(const char *line) {
  char direction[16], name[64], type[32], text[160];
  unsigned id;
  up_field_t *field = &vector.fields[vector.schema.fields_count];

  if (sscanf(line, "item %u %15s %63s %31s", &id, direction, name, type) != 4) {
    check_that(false, "item line has four parts", __FILE__, __LINE__);
    return;
  }
  strcpy(vector.names[vector.schema.fields_count], name);
  field->name = vector.names[vector.schema.fields_count];
  field->id = (uint8_t)id;
  field->direction = (strcmp(direction, "actuator") == 0) ? UP_TO_BOARD : UP_TO_HOST;
  field->type = parse_type(type, &field->count);
  CHECK(field->type != UINT8_MAX);
  vector.values_bytes = (vector.values_bytes + 7U) / 8U * 8U;
  field->offset = (uint16_t)vector.values_bytes;
  vector.values_bytes += up_field_bytes(field);
  CHECK(vector.values_bytes <= VALUES_MAX_BYTES);
  vector.schema.fields_count++;
  sprintf(text, "%u %s %s %s\n", id, direction, name, type);
  append(vector.canonical, sizeof vector.canonical, text);
}

static void set_checksum(const char *line) {
  vector.schema.checksum_crc16 = strstr(line, "crc16") != NULL;
  append(vector.canonical, sizeof vector.canonical,
         vector.schema.checksum_crc16 ? "checksum crc16\n" : "checksum none\n");
}

static void check_hash(const char *line) {
  vector.schema.hash = (uint32_t)strtoul(line + strlen("hash "), NULL, 16);
  CHECK(crc32_of(vector.canonical) == vector.schema.hash);
}

/* ---- values as text ---- */

static const char *parse_element(const up_field_t *field, const char *at, uint8_t *element) {
  char *end;
  float single;
  double real;

  if (field->type == UP_TYPE_BOOL) {
    const bool is_true = strncmp(at, "true", 4U) == 0;
    up_element_store(field->type, is_true ? 1U : 0U, element);
    return at + (is_true ? 4 : 5);
  }
  if (field->type == UP_TYPE_FLOAT32) {
    single = strtof(at, &end);
    memcpy(element, &single, sizeof single);
  } else if (field->type == UP_TYPE_FLOAT64) {
    real = strtod(at, &end);
    memcpy(element, &real, sizeof real);
  } else if (*at == '-') {
    up_element_store(field->type, (uint64_t)strtoll(at, &end, 10), element);
  } else {
    up_element_store(field->type, strtoull(at, &end, 10), element);
  }
  return end;
}

/* Reads "1 -2 3" or "1,-2,3" into the value's bytes; returns where it stopped. */
static const char *parse_value(const up_field_t *field, const char *at, uint8_t *value) {
  size_t i;

  for (i = 0U; i < field->count; i++) {
    while (*at == ' ' || *at == ',') {
      at++;
    }
    at = parse_element(field, at, &value[i * up_type_bytes(field->type)]);
  }
  return at;
}

static void set_value(const char *line) {
  char *end;
  const unsigned long id = strtoul(line + strlen("value "), &end, 10);
  const up_field_t *field = up_schema_find(&vector.schema, (uint8_t)id, current.direction);

  CHECK(field != NULL);
  if (field != NULL) {
    (void)parse_value(field, end, &values[field->offset]);
    up_bit_set(current.chosen, (size_t)(field - vector.fields));
  }
}

/* One delivered or expected value in the form the two sides are compared in: identifier and bytes. */
static void append_value(char *text, const up_field_t *field, const uint8_t *wire) {
  char part[8];
  size_t i;

  sprintf(part, "%u=", (unsigned)field->id);
  append(text, TEXT_MAX_BYTES, part);
  for (i = 0U; i < up_field_bytes(field); i++) {
    sprintf(part, "%02x", (unsigned)wire[i]);
    append(text, TEXT_MAX_BYTES, part);
  }
  append(text, TEXT_MAX_BYTES, " ");
}

/* ---- encode cases ---- */

static size_t parse_hex(const char *text, uint8_t *bytes, size_t size) {
  size_t count = 0U;
  unsigned byte;

  while (sscanf(text, "%2x", &byte) == 1) {
    CHECK(count < size);
    if (count >= size) {
      break;
    }
    bytes[count] = (uint8_t)byte;
    count++;
    text += 2;
  }
  return count;
}

static void check_frame(const char *line) {
  uint8_t wanted[STREAM_MAX_BYTES], frame[STREAM_MAX_BYTES];
  const size_t wanted_bytes = parse_hex(line + strlen("frame "), wanted, sizeof wanted);
  const size_t bytes = up_encode_values(&vector.schema, current.direction, current.chosen, values, frame,
                                        up_frame_bytes_max(&vector.schema, current.direction));

  encode_cases++;
  CHECK(bytes == wanted_bytes && memcmp(frame, wanted, bytes) == 0);
  /* A buffer one byte too small takes nothing. */
  CHECK(up_encode_values(&vector.schema, current.direction, current.chosen, values, frame, bytes - 1U) == 0U);
}

/* ---- decode cases ---- */

static void on_value(void *context, const up_field_t *field, const uint8_t *wire) {
  uint64_t aligned[VALUES_MAX_BYTES / 8U];
  uint8_t again[VALUES_MAX_BYTES];

  (void)context;
  /* Through memory and back, as an actuator's value goes. */
  up_value_from_wire(field, wire, aligned);
  up_value_to_wire(field, aligned, again);
  CHECK(memcmp(wire, again, up_field_bytes(field)) == 0);
  append_value(delivered, field, wire);
}

static void on_frame(void *context) {
  (void)context;
  append(delivered, sizeof delivered, "\n");
}

static void on_hello(void *context, uint32_t hash) {
  char text[40];

  (void)context;
  if (current.direction == UP_TO_HOST) {
    sprintf(text, "hello 0x%08lx\n", (unsigned long)hash);
    append(delivered, sizeof delivered, text);
  } else {
    append(delivered, sizeof delivered, "hello-request\n");
  }
}

static void expect_got(const char *line) {
  const char *at = line + strlen("got ");
  uint64_t value[VALUES_MAX_BYTES / 8U];
  uint8_t wire[VALUES_MAX_BYTES];

  if (strncmp(at, "hello", 5U) == 0) {
    append(current.expected, sizeof current.expected, at);
  }
  while (*at >= '0' && *at <= '9') {
    char *end;
    const unsigned long id = strtoul(at, &end, 10);
    const up_field_t *field = up_schema_find(&vector.schema, (uint8_t)id, current.direction);
    CHECK(field != NULL && *end == '=');
    if (field == NULL) {
      return;
    }
    at = parse_value(field, end + 1, (uint8_t *)value);
    up_value_to_wire(field, value, wire);
    append_value(current.expected, field, wire);
    while (*at == ' ') {
      at++;
    }
  }
  append(current.expected, sizeof current.expected, "\n");
}

static void run_split(size_t first_bytes, size_t step_bytes, uint32_t wanted_dropped) {
  static uint8_t buffer[UP_DECODER_BYTES(STREAM_MAX_BYTES)];
  const up_sink_t sink = {on_value, on_frame, on_hello, NULL};
  up_decoder_t decoder;
  size_t at = 0U;

  delivered[0] = '\0';
  CHECK(up_decoder_init(&decoder, &vector.schema, current.direction, buffer,
                        UP_DECODER_BYTES(up_frame_bytes_max(&vector.schema, current.direction)), &sink));
  while (at < current.stream_bytes) {
    size_t bytes = (at == 0U) ? first_bytes : step_bytes;
    if (bytes > current.stream_bytes - at) {
      bytes = current.stream_bytes - at;
    }
    up_decoder_feed(&decoder, &current.stream[at], bytes);
    at += bytes;
  }
  CHECK(decoder.dropped_bytes == wanted_dropped);
  CHECK(strcmp(delivered, current.expected) == 0);
}

static void check_dropped(const char *line) {
  const uint32_t wanted = (uint32_t)strtoul(line + strlen("dropped "), NULL, 10);
  const unsigned failures_before = check_failures();
  size_t cut;

  decode_cases++;
  run_split(1U, 1U, wanted);
  run_split(current.stream_bytes, current.stream_bytes, wanted);
  for (cut = 1U; cut < current.stream_bytes; cut++) {
    run_split(cut, current.stream_bytes, wanted);
  }
  if (check_failures() != failures_before) {
    printf("in decode case %s: wanted %s got %s\n", current.name, current.expected, delivered);
  }
}

/* ---- the file ---- */

static bool starts_with(const char *line, const char *word) {
  const size_t length = strlen(word);
  return strncmp(line, word, length) == 0 && (line[length] == ' ' || line[length] == '\0');
}

static void begin_case(case_kind_t kind, up_direction_t direction, const char *line) {
  memset(&current, 0, sizeof current);
  current.kind = kind;
  current.direction = direction;
  (void)snprintf(current.name, sizeof current.name, "%.100s", line);
}

static void take_line(const char *line) {
  if (line[0] == '\0' || line[0] == '#') {
    return;
  } else if (starts_with(line, "schema")) {
    begin_schema();
  } else if (starts_with(line, "checksum")) {
    set_checksum(line);
  } else if (starts_with(line, "item")) {
    add_item(line);
  } else if (starts_with(line, "hash")) {
    check_hash(line);
  } else if (starts_with(line, "encode")) {
    begin_case(CASE_ENCODE, UP_TO_HOST, line);
  } else if (starts_with(line, "encode-actuators")) {
    begin_case(CASE_ENCODE, UP_TO_BOARD, line);
  } else if (starts_with(line, "decode")) {
    begin_case(CASE_DECODE, UP_TO_HOST, line);
  } else if (starts_with(line, "decode-actuators")) {
    begin_case(CASE_DECODE, UP_TO_BOARD, line);
  } else if (starts_with(line, "value")) {
    set_value(line);
  } else if (starts_with(line, "frame")) {
    check_frame(line);
  } else if (starts_with(line, "in")) {
    current.stream_bytes += parse_hex(line + strlen("in "), &current.stream[current.stream_bytes],
                                      sizeof current.stream - current.stream_bytes);
  } else if (starts_with(line, "got")) {
    expect_got(line);
  } else if (starts_with(line, "dropped")) {
    check_dropped(line);
  } else {
    printf("unknown line: %s\n", line);
    check_that(false, "every line is understood", __FILE__, __LINE__);
  }
}

void test_vectors(const char *path) {
  static char line[LINE_MAX_BYTES];
  FILE *file = fopen(path, "r");

  encode_cases = decode_cases = schemas = 0U;
  CHECK(file != NULL);
  if (file == NULL) {
    return;
  }
  while (fgets(line, (int)sizeof line, file) != NULL) {
    char *hash = strstr(line, "  #");
    if (hash != NULL) {
      *hash = '\0';
    }
    line[strcspn(line, "\r\n")] = '\0';
    take_line(line);
  }
  CHECK(fclose(file) == 0);
  CHECK(schemas > 0U && encode_cases + decode_cases > 0U);
  printf("%s: %u encode cases, %u decode cases\n", path, encode_cases, decode_cases);
}
