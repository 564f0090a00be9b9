/* The decoder of the board (`runtime/core`), as the fuzzer calls it. */
#include "decode.h"

#include <stdlib.h>
#include <string.h>

#include "up_decode.h"

static void put(sense_decoded_t *decoded, const void *bytes, size_t size) {
  if (size > decoded->log_bytes_max - decoded->log_size) {
    abort();
  }
  memcpy(&decoded->log[decoded->log_size], bytes, size);
  decoded->log_size += size;
}

static int is_open; /* a report has begun */

static void on_value(void *context, const up_field_t *field, const uint8_t *wire) {
  if (!is_open) {
    put(context, "R", 1U);
    is_open = 1;
  }
  put(context, &field->id, 1U);
  put(context, wire, up_field_bytes(field));
}

static void on_frame(void *context) {
  put(context, ".", 1U);
  is_open = 0;
}

static up_direction_t direction; /* of this stream */

static void on_hello(void *context, uint32_t hash) {
  const uint8_t bytes[4] = {(uint8_t)(hash >> 24), (uint8_t)(hash >> 16), (uint8_t)(hash >> 8), (uint8_t)hash};

  put(context, (direction == UP_TO_BOARD) ? "Q" : "H", 1U);
  if (direction == UP_TO_HOST) {
    put(context, bytes, sizeof bytes);
  }
}

void sense_decode_c(const sense_stream_t *stream, sense_decoded_t *decoded) {
  up_field_t fields[16];
  up_schema_t schema;
  up_sink_t sink;
  up_decoder_t decoder;
  uint8_t *buffer;
  size_t buffer_bytes, i, from = 0U;
  uint16_t offset = 0U;

  if (stream->items_count > 16U) {
    abort();
  }
  memset(&schema, 0, sizeof schema);
  for (i = 0U; i < stream->items_count; i++) {
    const sense_item_t *item = &stream->items[i];
    fields[i].name = "";
    fields[i].id = item->id;
    fields[i].type = item->type;
    fields[i].direction = (uint8_t)(item->to_board ? UP_TO_BOARD : UP_TO_HOST);
    fields[i].count = item->count;
    fields[i].offset = offset;
    offset = (uint16_t)(offset + up_field_bytes(&fields[i]));
  }
  schema.fields = fields;
  schema.fields_count = (uint8_t)stream->items_count;
  schema.checksum_crc16 = stream->crc16 != 0U;
  direction = stream->to_board ? UP_TO_BOARD : UP_TO_HOST;
  sink.on_value = on_value;
  sink.on_frame = on_frame;
  sink.on_hello = on_hello;
  sink.context = decoded;
  is_open = 0;
  /* Exactly as large as promised, for one frame or for two, so that one byte beyond it is noticed. */
  buffer_bytes = up_frame_bytes_max(&schema, direction);
  buffer_bytes = (stream->size & 1U) * buffer_bytes + UP_DECODER_BYTES(buffer_bytes);
  buffer = malloc(buffer_bytes);
  if (buffer == NULL || !up_decoder_init(&decoder, &schema, direction, buffer, buffer_bytes, &sink)) {
    abort();
  }
  for (i = 0U; i <= stream->cuts_count; i++) {
    const size_t to = (i < stream->cuts_count) ? stream->cuts[i] : stream->size;
    up_decoder_feed(&decoder, &stream->bytes[from], to - from);
    from = to;
  }
  decoded->frames = decoder.frames;
  decoded->dropped_bytes = decoder.dropped_bytes;
  free(buffer);
}
