/*
 * The shared wire vectors: the same text files that every encoder and decoder of the project must pass; here, they are
 * run on the printed codec of each schema.
 *
 * Each decode case is fed byte by byte, all at once, and cut at every single place; both with and without the memory of
 * failed candidates. All runs must give the same result.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "codecs.h"
#include "up_decode.h"
#include "up_encode.h"
#include "up_memo.h"

#define LINE_MAX_BYTES 4096U
#define TEXT_MAX_BYTES 16384U
#define STREAM_MAX_BYTES 4096U
#define VALUES_MAX_BYTES 4096U

typedef struct {
  const test_codec_t *codec;
  char canonical[TEXT_MAX_BYTES];
  size_t fields_count; /* that the file has named so far */
} vector_schema_t;

typedef enum { CASE_NONE, CASE_ENCODE, CASE_HEALTH, CASE_DECODE } case_kind_t;

typedef struct {
  case_kind_t kind;
  up_direction_t direction;
  uint8_t chosen[UP_FIELD_BITMAP_BYTES];
  up_stamp_t stamp;
  up_health_board_t board;
  up_health_row_t rows[UP_FIELDS_MAX];
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

static const up_wire_t *wire(void) {
  return (current.direction == UP_TO_HOST) ? vector.codec->reports : vector.codec->commands;
}

static void begin_schema(const char *name) {
  size_t i;

  memset(&vector, 0, sizeof vector);
  for (i = 0U; i < test_codecs_count; i++) {
    if (strcmp(test_codecs[i].name, name) == 0) {
      vector.codec = &test_codecs[i];
      CHECK(vector.codec->values_bytes <= VALUES_MAX_BYTES);
      schemas++;
      return;
    }
  }
  printf("no codec of %s\n", name);
  abort();
}

/* The printed table must agree with the file. */
static void add_item(const char *line) {
  char direction[16], name[64], type[32], text[160];
  const up_field_t *field = &vector.codec->schema->fields[vector.fields_count];
  uint16_t count = 0U;
  unsigned id;

  if (sscanf(line, "item %u %15s %63s %31s", &id, direction, name, type) != 4) {
    check_that(false, "item line has four parts", __FILE__, __LINE__);
    return;
  }
  CHECK(strcmp(field->name, name) == 0 && field->id == (uint8_t)id && field->type == parse_type(type, &count));
  CHECK(field->count == count && field->is_array == (strchr(type, '[') != NULL));
  CHECK(field->direction == (uint8_t)((strcmp(direction, "actuator") == 0) ? UP_TO_BOARD : UP_TO_HOST));
  vector.fields_count++;
  sprintf(text, "%u %s %s %s\n", id, direction, name, type);
  append(vector.canonical, sizeof vector.canonical, text);
}

static void set_checksum(const char *line) {
  const up_link_checksum_t checksum = (strstr(line, "crc16") != NULL)   ? UP_LINK_CRC16
                                      : (strstr(line, "crc32") != NULL) ? UP_LINK_CRC32
                                                                        : UP_LINK_NONE;
  char text[32];

  CHECK(vector.codec->reports->checksum == (uint8_t)checksum && vector.codec->commands->checksum == (uint8_t)checksum);
  sprintf(text, "%.20s\n", line);
  append(vector.canonical, sizeof vector.canonical, text);
}

static void set_stamp(void) {
  CHECK(vector.codec->reports->has_stamp && !vector.codec->commands->has_stamp);
  append(vector.canonical, sizeof vector.canonical, "stamp\n");
}

static void check_hash(const char *line) {
  const uint32_t hash = (uint32_t)strtoul(line + strlen("hash "), NULL, 16);

  CHECK(crc32_of(vector.canonical) == hash && vector.codec->reports->hash == hash);
  CHECK(vector.codec->schema->fields_count == vector.fields_count && vector.codec->schema->hash == hash);
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
  const up_field_t *field = up_schema_find(vector.codec->schema, (uint8_t)id, current.direction);

  CHECK(field != NULL);
  if (field != NULL) {
    (void)parse_value(field, end, &values[field->offset]);
    up_bit_set(current.chosen, (size_t)(field - vector.codec->schema->fields));
  }
}

static void set_stamp_of(const char *line) {
  unsigned long time_us;
  unsigned counter;

  CHECK(sscanf(line, "stamp %lu %u", &time_us, &counter) == 2);
  current.stamp.time_us = (uint32_t)time_us;
  current.stamp.counter = (uint8_t)counter;
}

/* The definition, element by element, of what the printed code does in straight lines. */
static void value_to_wire(const up_field_t *field, const void *value, uint8_t *bytes) {
  const size_t size = up_type_bytes(field->type);
  size_t element, byte;

  for (element = 0U; element < field->count; element++) {
    const uint64_t bits = up_element_load(field->type, (const uint8_t *)value + element * size);
    for (byte = 0U; byte < size; byte++) {
      bytes[element * size + byte] = (uint8_t)(bits >> (8U * (size - 1U - byte)));
    }
  }
}

/* One delivered or expected value in the form in which both sides are compared: identifier and bytes. */
static void append_value(char *text, const up_field_t *field, const uint8_t *bytes) {
  char part[8];
  size_t i;

  sprintf(part, "%u=", (unsigned)field->id);
  append(text, TEXT_MAX_BYTES, part);
  for (i = 0U; i < up_field_bytes(field); i++) {
    sprintf(part, "%02x", (unsigned)bytes[i]);
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

static void row_of(void *context, size_t field, up_health_row_t *row) {
  (void)context;
  *row = current.rows[field];
}

static size_t encode(uint8_t *frame, size_t frame_bytes) {
  if (current.kind == CASE_HEALTH) {
    return up_encode_health(wire(), &current.board, row_of, NULL, frame, frame_bytes);
  }
  return up_encode_values(wire(), &current.stamp, current.chosen, values, frame, frame_bytes);
}

static void check_frame(const char *line) {
  uint8_t wanted[STREAM_MAX_BYTES], frame[STREAM_MAX_BYTES];
  const size_t wanted_bytes = parse_hex(line + strlen("frame "), wanted, sizeof wanted);
  const size_t bytes = encode(frame, UP_WIRE_FRAME_BYTES(wire()));

  encode_cases++;
  CHECK(bytes == wanted_bytes && memcmp(frame, wanted, bytes) == 0);
  /* A buffer that is one byte too small takes nothing. */
  CHECK(encode(frame, UP_WIRE_FRAME_BYTES(wire()) - 1U) == 0U);
}

static void set_board(const char *line) {
  unsigned long uptime, sent, refused;
  unsigned cause, device, load, stack;

  CHECK(sscanf(line, "board %lu %u %u %lu %lu %u %u", &uptime, &cause, &device, &sent, &refused, &load, &stack) == 7);
  current.board.uptime_ms = (uint32_t)uptime;
  current.board.reset_cause = (uint8_t)cause;
  current.board.reset_device = (uint8_t)device;
  current.board.reports_sent = (uint32_t)sent;
  current.board.reports_refused = (uint32_t)refused;
  current.board.load_percent = (uint8_t)load;
  current.board.stack_left_bytes = (uint16_t)stack;
}

static void set_device(const char *line) {
  unsigned long age;
  unsigned id, status, counts[UP_FAULTS];
  size_t i, field;

  CHECK(sscanf(line, "device %u %u %lu %u %u %u %u %u %u", &id, &status, &age, &counts[0], &counts[1], &counts[2],
               &counts[3], &counts[4], &counts[5]) == 9);
  for (field = 0U; field < vector.codec->schema->fields_count; field++) {
    if (vector.codec->schema->fields[field].id == (uint8_t)id) {
      current.rows[field].status = (uint8_t)status;
      current.rows[field].age_ms = (uint32_t)age;
      for (i = 0U; i < UP_FAULTS; i++) {
        current.rows[field].counts[i] = (uint16_t)counts[i];
      }
    }
  }
}

/* ---- decode cases ---- */

/* Decodes the delivered items twice: by identifier, and with the printed code; both must agree. */
static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  static uint64_t memory_aligned[VALUES_MAX_BYTES / 8U];
  uint8_t *const memory = (uint8_t *)memory_aligned;
  uint8_t taken[UP_FIELD_BITMAP_BYTES], wanted[UP_FIELD_BITMAP_BYTES], again[VALUES_MAX_BYTES];
  char text[48];
  size_t at = 0U;

  (void)context;
  memset(taken, 0, sizeof taken);
  memset(wanted, 0, sizeof wanted);
  memset(memory, 0xAA, VALUES_MAX_BYTES);
  wire()->take(items, &items[size], memory, taken);
  CHECK((stamp != NULL) == wire()->has_stamp);
  if (stamp != NULL) {
    sprintf(text, "stamp=%lu/%u ", (unsigned long)stamp->time_us, (unsigned)stamp->counter);
    append(delivered, sizeof delivered, text);
  }
  while (at < size) {
    const up_field_t *field = up_schema_find(vector.codec->schema, items[at], current.direction);
    CHECK(field != NULL && UP_ITEM_BYTES(wire()->item(items[at])) == up_field_bytes(field));
    if (field == NULL) {
      return;
    }
    up_bit_set(wanted, (size_t)(field - vector.codec->schema->fields));
    value_to_wire(field, &memory[field->offset], again);
    CHECK(memcmp(&items[at + 1U], again, up_field_bytes(field)) == 0);
    append_value(delivered, field, &items[at + 1U]);
    at += 1U + up_field_bytes(field);
  }
  CHECK(memcmp(taken, wanted, sizeof taken) == 0);
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

static void on_health(void *context, const uint8_t *payload, size_t size) {
  up_health_board_t board;
  up_health_row_t row;
  char text[128];
  size_t i;

  (void)context;
  if (current.direction == UP_TO_BOARD) {
    append(delivered, sizeof delivered, "health-request\n");
    return;
  }
  if (!up_health_read_board(payload, size, &board)) {
    sprintf(text, "health-version %u\n", (unsigned)payload[1]);
    append(delivered, sizeof delivered, text);
    return;
  }
  sprintf(text, "health %lu %u %u %lu %lu %u %u", (unsigned long)board.uptime_ms, (unsigned)board.reset_cause,
          (unsigned)board.reset_device, (unsigned long)board.reports_sent, (unsigned long)board.reports_refused,
          (unsigned)board.load_percent, (unsigned)board.stack_left_bytes);
  append(delivered, sizeof delivered, text);
  for (i = 0U; up_health_read_row(payload, size, i, &row); i++) {
    sprintf(text, " %u=%u/%lu/%u/%u/%u/%u/%u/%u", (unsigned)vector.codec->schema->fields[i].id, (unsigned)row.status,
            (unsigned long)row.age_ms, (unsigned)row.counts[0], (unsigned)row.counts[1], (unsigned)row.counts[2],
            (unsigned)row.counts[3], (unsigned)row.counts[4], (unsigned)row.counts[5]);
    append(delivered, sizeof delivered, text);
  }
  append(delivered, sizeof delivered, "\n");
}

static void expect_got(const char *line) {
  const char *at = line + strlen("got ");
  const char *first = at;
  uint64_t value[VALUES_MAX_BYTES / 8U];
  uint8_t bytes[VALUES_MAX_BYTES];

  if (strncmp(at, "stamp=", 6U) == 0) {
    char stamp[48];
    at += strcspn(at, " ");
    (void)snprintf(stamp, sizeof stamp, "%.*s ", (int)(at - first), first);
    append(current.expected, sizeof current.expected, stamp);
    at += strspn(at, " ");
  } else if (*at == 'h') {
    append(current.expected, sizeof current.expected, at);
  }
  while (*at >= '0' && *at <= '9') {
    char *end;
    const unsigned long id = strtoul(at, &end, 10);
    const up_field_t *field = up_schema_find(vector.codec->schema, (uint8_t)id, current.direction);
    CHECK(field != NULL && *end == '=');
    if (field == NULL) {
      return;
    }
    at = parse_value(field, end + 1, (uint8_t *)value);
    value_to_wire(field, value, bytes);
    append_value(current.expected, field, bytes);
    while (*at == ' ') {
      at++;
    }
  }
  append(current.expected, sizeof current.expected, "\n");
}

static void run_split(const up_wire_t *one, size_t first_bytes, size_t step_bytes, uint32_t wanted_dropped) {
  static uint8_t room[UP_DECODER_BYTES(STREAM_MAX_BYTES)];
  const size_t frame_bytes = UP_WIRE_FRAME_BYTES(one);
  const size_t buffer_bytes = (one->memo != NULL) ? UP_DECODER_BYTES(frame_bytes) : frame_bytes;
  /* At the end of the room, so that a sanitizer detects any access beyond it. */
  uint8_t *const buffer = &room[sizeof room - buffer_bytes];
  const up_sink_t sink = {on_values, on_hello, on_health, NULL};
  up_decoder_t decoder;
  size_t at = 0U;

  delivered[0] = '\0';
  CHECK(up_decoder_init(&decoder, one, buffer, buffer_bytes, &sink));
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

static void run_splits(const up_wire_t *one, uint32_t wanted_dropped) {
  size_t cut;

  run_split(one, 1U, 1U, wanted_dropped);
  run_split(one, current.stream_bytes, current.stream_bytes, wanted_dropped);
  for (cut = 1U; cut < current.stream_bytes; cut++) {
    run_split(one, cut, current.stream_bytes, wanted_dropped);
  }
}

static void check_dropped(const char *line) {
  const uint32_t wanted = (uint32_t)strtoul(line + strlen("dropped "), NULL, 10);
  const unsigned failures_before = check_failures();
  up_wire_t with_memo = *wire();
#if !defined(__arm__)
  up_wire_t plain = *wire();

  plain.memo = NULL;
#endif

  decode_cases++;
  with_memo.memo = &up_memo;
  run_splits(&with_memo, wanted);
#if !defined(__arm__)
  /* An emulator is slow, and the other half runs the same code. */
  run_splits(&plain, wanted);
#endif
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
    begin_schema(line + strlen("schema "));
  } else if (starts_with(line, "checksum")) {
    set_checksum(line);
  } else if (strcmp(line, "stamp on") == 0) {
    set_stamp();
  } else if (starts_with(line, "stamp")) {
    set_stamp_of(line);
  } else if (starts_with(line, "item")) {
    add_item(line);
  } else if (starts_with(line, "hash")) {
    check_hash(line);
  } else if (starts_with(line, "encode")) {
    begin_case(CASE_ENCODE, UP_TO_HOST, line);
  } else if (starts_with(line, "encode-health")) {
    begin_case(CASE_HEALTH, UP_TO_HOST, line);
  } else if (starts_with(line, "board")) {
    set_board(line);
  } else if (starts_with(line, "device")) {
    set_device(line);
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
