/* The decoder of the board (`crates/firmware-c/runtime`), as the fuzzer calls it. */
#include "decode.h"

#include <stdlib.h>
#include <string.h>

#include "up_decode.h"
#include "up_health.h"
#include "up_memo.h"

static void put(sense_decoded_t *decoded, const void *bytes, size_t size) {
  if (size > decoded->log_bytes_max - decoded->log_size) {
    abort();
  }
  memcpy(&decoded->log[decoded->log_size], bytes, size);
  decoded->log_size += size;
}

static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  if (stamp != NULL) {
    const uint8_t bytes[6] = {(uint8_t)'S', (uint8_t)(stamp->time_us >> 24), (uint8_t)(stamp->time_us >> 16),
                              (uint8_t)(stamp->time_us >> 8), (uint8_t)stamp->time_us, stamp->counter};
    put(context, bytes, sizeof bytes);
  }
  put(context, "R", 1U);
  put(context, items, size);
  put(context, ".", 1U);
}

static up_direction_t direction; /* of this stream */

static void on_hello(void *context, uint32_t hash) {
  const uint8_t bytes[4] = {(uint8_t)(hash >> 24), (uint8_t)(hash >> 16), (uint8_t)(hash >> 8), (uint8_t)hash};

  put(context, (direction == UP_TO_BOARD) ? "Q" : "H", 1U);
  if (direction == UP_TO_HOST) {
    put(context, bytes, sizeof bytes);
  }
}

static void on_health(void *context, const uint8_t *payload, size_t size) {
  up_health_board_t board;

  if (size == 0U) {
    put(context, "A", 1U);
  } else if (up_health_read_board(payload, size, &board)) {
    put(context, "D", 1U);
    put(context, payload, size);
  } else {
    put(context, "V", 1U);
    put(context, &payload[1], 1U);
  }
}

/* What a generator prints as a switch, from a table: any schema comes at run time. */
static up_item_t item_of[256];

static up_item_t item(uint8_t id) {
  return item_of[id];
}

static void read_schema(const sense_stream_t *stream, up_wire_t *wire) {
  size_t i, number, values_bytes = 0U, payload_bytes;

  memset(wire, 0, sizeof *wire);
  memset(item_of, 0, sizeof item_of);
  wire->direction = (uint8_t)direction;
  wire->checksum = stream->checksum;
  wire->has_stamp = stream->stamp != 0U && direction == UP_TO_HOST;
  for (i = 0U; i < stream->items_count; i++) {
    const sense_item_t *one = &stream->items[i];
    if ((one->to_board != 0) == (direction == UP_TO_BOARD)) {
      item_of[one->id] = UP_ITEM(up_type_bytes(one->type) * one->count, one->type == UP_TYPE_BOOL);
      values_bytes += 1U + up_type_bytes(one->type) * one->count;
    }
  }
  values_bytes += (wire->has_stamp && values_bytes > 0U) ? 6U : 0U;
  wire->values_bytes_max = (uint16_t)values_bytes;
  payload_bytes = (direction == UP_TO_BOARD) ? 2U : UP_HEALTH_BOARD_BYTES + UP_HEALTH_DEVICE_BYTES * stream->items_count;
  wire->health_bytes = (uint16_t)((direction == UP_TO_BOARD) ? 0U : payload_bytes);
  payload_bytes = (values_bytes > payload_bytes) ? values_bytes : payload_bytes;
  payload_bytes += UP_WIRE_CHECKSUM_BYTES(wire);
  wire->payload_bytes_max = (uint16_t)payload_bytes;
  wire->head_bytes = 2U;
  for (number = payload_bytes; number >= 10U; number /= 10U) {
    wire->head_bytes++;
  }
  wire->item = item;
  wire->memo = ((stream->size & 2U) != 0U) ? &up_memo : NULL;
}

void sense_decode_c(const sense_stream_t *stream, sense_decoded_t *decoded) {
  const up_sink_t sink = {on_values, on_hello, on_health, decoded};
  up_wire_t wire;
  up_decoder_t decoder;
  uint8_t *buffer;
  size_t frame_bytes, buffer_bytes, i, from = 0U;

  if (stream->items_count > 16U) {
    abort();
  }
  direction = stream->to_board ? UP_TO_BOARD : UP_TO_HOST;
  read_schema(stream, &wire);
  /* Exactly as large as promised, for one frame or for two, so that one byte beyond it is noticed. */
  frame_bytes = UP_WIRE_FRAME_BYTES(&wire);
  buffer_bytes = (stream->size & 1U) * frame_bytes;
  buffer_bytes += (wire.memo != NULL) ? UP_DECODER_BYTES(frame_bytes) : frame_bytes;
  buffer = malloc(buffer_bytes);
  if (buffer == NULL || !up_decoder_init(&decoder, &wire, buffer, buffer_bytes, &sink)) {
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
