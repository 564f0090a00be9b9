/* The decoder of the firmware. */
#include "decoders.h"

#include <stdlib.h>
#include <string.h>

#include "up_decode.h"

typedef struct {
  decoders_out_t out;
  void *context;
  uint8_t report[5U + UP_PAYLOAD_BYTES_LIMIT];
  size_t size;
} log_t;

static void put_u32(uint8_t *bytes, uint32_t number) {
  bytes[0] = (uint8_t)(number >> 24);
  bytes[1] = (uint8_t)(number >> 16);
  bytes[2] = (uint8_t)(number >> 8);
  bytes[3] = (uint8_t)number;
}

static void on_value(void *context, const up_field_t *field, const uint8_t *wire) {
  log_t *log = context;

  if (log->out != NULL) {
    log->report[log->size] = field->id;
    memcpy(&log->report[log->size + 1U], wire, up_field_bytes(field));
    log->size += 1U + up_field_bytes(field);
  } else {
    log->report[0] ^= wire[0];
  }
}

static void on_frame(void *context) {
  log_t *log = context;

  if (log->out != NULL) {
    log->report[0] = (uint8_t)'R';
    put_u32(&log->report[1], (uint32_t)(log->size - 5U));
    log->out(log->context, log->report, log->size);
    log->size = 5U;
  }
}

static void on_hello(void *context, uint32_t hash, const char word) {
  const log_t *log = context;
  uint8_t said[5] = {(uint8_t)word, 0U, 0U, 0U, 0U};

  put_u32(&said[1], hash);
  if (log->out != NULL) {
    log->out(log->context, said, (word == 'H') ? sizeof said : 1U);
  }
}

static void on_hello_to_host(void *context, uint32_t hash) {
  on_hello(context, hash, 'H');
}

static void on_request(void *context, uint32_t hash) {
  (void)hash;
  on_hello(context, 0U, 'Q');
}

static void read_schema(const decoders_input_t *input, up_schema_t *schema, up_field_t *fields) {
  size_t at;

  memset(schema, 0, sizeof *schema);
  schema->fields = fields;
  schema->checksum_crc16 = (input->schema[0] & 1U) != 0U;
  for (at = 1U; at + 5U <= input->schema_bytes && schema->fields_count < UP_FIELDS_MAX; at += 5U) {
    up_field_t *field = &fields[schema->fields_count];
    field->name = "";
    field->id = input->schema[at];
    field->type = input->schema[at + 1U];
    field->direction = input->schema[at + 2U];
    field->count = (uint16_t)((input->schema[at + 3U] << 8) | input->schema[at + 4U]);
    field->offset = 0U;
    schema->fields_count++;
  }
}

void decoders_c(const decoders_input_t *input, decoders_out_t out, void *context) {
  const up_direction_t direction = ((input->schema[0] & 2U) != 0U) ? UP_TO_BOARD : UP_TO_HOST;
  static up_field_t fields[UP_FIELDS_MAX];
  static log_t log;
  up_sink_t sink = {on_value, on_frame, on_hello_to_host, &log};
  up_schema_t schema;
  up_decoder_t decoder;
  uint8_t *buffer;
  uint8_t end[9] = {(uint8_t)'E'};
  size_t at, buffer_bytes, piece = 0U;

  read_schema(input, &schema, fields);
  log.out = out;
  log.context = context;
  log.size = 5U;
  if (direction == UP_TO_BOARD) {
    sink.on_hello = on_request;
  }
  /* Exactly as much as it needs, so that a sanitizer sees each byte too far. */
  buffer_bytes = up_frame_bytes_max(&schema, direction);
  buffer_bytes = (DECODERS_C_FRAMES - 1U) * buffer_bytes + UP_DECODER_BYTES(buffer_bytes);
  buffer = malloc(buffer_bytes);
  if (buffer == NULL || !up_decoder_init(&decoder, &schema, direction, buffer, buffer_bytes, &sink)) {
    abort();
  }
  for (at = 0U; at < input->stream_bytes; piece++) {
    size_t size = (input->pieces_count == 0U) ? 0U : input->pieces[piece % input->pieces_count];
    if (size == 0U || size > input->stream_bytes - at) {
      size = input->stream_bytes - at;
    }
    up_decoder_feed(&decoder, &input->stream[at], size);
    at += size;
  }
  put_u32(&end[1], decoder.frames);
  put_u32(&end[5], decoder.dropped_bytes);
  if (out != NULL) {
    out(context, end, sizeof end);
  }
  free(buffer);
}
