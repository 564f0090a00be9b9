#include "up_decode.h"

#include <string.h>

#include "up_encode.h"

typedef enum { VERDICT_INVALID, VERDICT_INCOMPLETE, VERDICT_COMPLETE } verdict_t;

#define HELLO_BYTES 5U
#define HELLO_REQUEST_BYTES 1U
#define CHECKSUM_BYTES 3U

static const uint8_t *frame_of(const up_decoder_t *decoder) {
  return &decoder->buffer[decoder->start];
}

static void restart(up_decoder_t *decoder) {
  decoder->at = 0U;
  decoder->length = 0U;
  decoder->phase = UP_PHASE_LENGTH;
}

bool up_decoder_init(up_decoder_t *decoder, const up_schema_t *schema, up_direction_t direction,
                     uint8_t *buffer, size_t buffer_bytes, const up_sink_t *sink) {
  memset(decoder, 0, sizeof *decoder);
  decoder->schema = schema;
  decoder->sink = sink;
  decoder->direction = (uint8_t)direction;
  decoder->buffer = buffer;
  decoder->buffer_bytes = buffer_bytes;
  decoder->payload_bytes_max = up_payload_bytes_max(schema, direction);
  restart(decoder);
  return buffer_bytes >= up_frame_bytes_max(schema, direction);
}

bool up_decoder_is_idle(const up_decoder_t *decoder) {
  return decoder->size == 0U;
}

static verdict_t step_length(up_decoder_t *decoder, uint8_t byte) {
  const size_t checksum_bytes = decoder->schema->checksum_crc16 ? CHECKSUM_BYTES : 0U;
  const bool is_first = decoder->at == 0U;

  if (byte >= (uint8_t)'0' && byte <= (uint8_t)'9' && !(is_first && byte == (uint8_t)'0')) {
    decoder->length = decoder->length * 10U + (size_t)(byte - (uint8_t)'0');
    return (decoder->length > decoder->payload_bytes_max) ? VERDICT_INVALID : VERDICT_INCOMPLETE;
  }
  if (byte != (uint8_t)':' || is_first || decoder->length <= checksum_bytes) {
    return VERDICT_INVALID;
  }
  decoder->payload_start = decoder->at + 1U;
  decoder->values_end = decoder->payload_start + decoder->length - checksum_bytes;
  memset(decoder->seen, 0, sizeof decoder->seen);
  decoder->phase = UP_PHASE_ID;
  return VERDICT_INCOMPLETE;
}

/* What follows the item that ends before `end`. */
static void after_item(up_decoder_t *decoder, size_t end) {
  if (end < decoder->values_end) {
    decoder->phase = UP_PHASE_ID;
  } else {
    decoder->phase = decoder->schema->checksum_crc16 ? UP_PHASE_CHECKSUM : UP_PHASE_COMMA;
  }
}

/* The hello stands alone: at the payload's start, and exactly as long as its direction wants it. */
static verdict_t step_hello_id(up_decoder_t *decoder) {
  const size_t wanted_bytes = (decoder->direction == (uint8_t)UP_TO_HOST) ? HELLO_BYTES : HELLO_REQUEST_BYTES;

  if (decoder->at != decoder->payload_start || decoder->values_end - decoder->payload_start != wanted_bytes) {
    return VERDICT_INVALID;
  }
  decoder->item_end = decoder->values_end;
  decoder->phase = UP_PHASE_HELLO;
  if (wanted_bytes == 1U) {
    after_item(decoder, decoder->item_end);
  }
  return VERDICT_INCOMPLETE;
}

static verdict_t step_id(up_decoder_t *decoder, uint8_t id) {
  const up_field_t *field;

  if (id == UP_ID_HELLO) {
    return step_hello_id(decoder);
  }
  field = up_schema_find(decoder->schema, id, (up_direction_t)decoder->direction);
  if (field == NULL || up_bit_get(decoder->seen, id)) {
    return VERDICT_INVALID;
  }
  up_bit_set(decoder->seen, id);
  decoder->item_type = field->type;
  decoder->item_end = decoder->at + 1U + up_field_bytes(field);
  decoder->phase = UP_PHASE_VALUE;
  return (decoder->item_end > decoder->values_end) ? VERDICT_INVALID : VERDICT_INCOMPLETE;
}

static verdict_t step_value(up_decoder_t *decoder, uint8_t byte) {
  if (decoder->phase == UP_PHASE_VALUE && decoder->item_type == UP_TYPE_BOOL && byte > 1U) {
    return VERDICT_INVALID;
  }
  if (decoder->at + 1U == decoder->item_end) {
    after_item(decoder, decoder->item_end);
  }
  return VERDICT_INCOMPLETE;
}

static verdict_t step_checksum(up_decoder_t *decoder, uint8_t byte) {
  const size_t position = decoder->at - decoder->values_end;
  uint16_t crc, sent;

  if (position == 0U) {
    return (byte == UP_ID_CHECKSUM) ? VERDICT_INCOMPLETE : VERDICT_INVALID;
  }
  if (position == 1U) {
    return VERDICT_INCOMPLETE;
  }
  crc = up_crc16(UP_CRC16_INIT, &frame_of(decoder)[decoder->payload_start],
                 decoder->values_end - decoder->payload_start);
  sent = (uint16_t)(((unsigned)frame_of(decoder)[decoder->at - 1U] << 8) | byte);
  decoder->phase = UP_PHASE_COMMA;
  return (crc == sent) ? VERDICT_INCOMPLETE : VERDICT_INVALID;
}

/* Takes the byte at `at` into account; the verdict is about all bytes up to it. */
static verdict_t step(up_decoder_t *decoder) {
  const uint8_t byte = frame_of(decoder)[decoder->at];

  switch ((up_phase_t)decoder->phase) {
  case UP_PHASE_LENGTH:
    return step_length(decoder, byte);
  case UP_PHASE_ID:
    return step_id(decoder, byte);
  case UP_PHASE_VALUE:
  case UP_PHASE_HELLO:
    return step_value(decoder, byte);
  case UP_PHASE_CHECKSUM:
    return step_checksum(decoder, byte);
  case UP_PHASE_COMMA:
  default:
    return (byte == (uint8_t)',') ? VERDICT_COMPLETE : VERDICT_INVALID;
  }
}

static void deliver_hello(const up_decoder_t *decoder) {
  const uint8_t *payload = &frame_of(decoder)[decoder->payload_start];
  uint32_t hash = 0U;
  size_t i;

  if (decoder->direction == (uint8_t)UP_TO_HOST) {
    for (i = 1U; i < HELLO_BYTES; i++) {
      hash = (hash << 8) | payload[i];
    }
  }
  if (decoder->sink->on_hello != NULL) {
    decoder->sink->on_hello(decoder->sink->context, hash);
  }
}

/* The frame is valid to its last byte: every identifier is known and every value is whole. */
static void deliver(const up_decoder_t *decoder) {
  const up_sink_t *sink = decoder->sink;
  const uint8_t *frame = frame_of(decoder);
  size_t at = decoder->payload_start;

  if (frame[at] == UP_ID_HELLO) {
    deliver_hello(decoder);
    return;
  }
  while (at < decoder->values_end) {
    const up_field_t *field =
        up_schema_find(decoder->schema, frame[at], (up_direction_t)decoder->direction);
    if (sink->on_value != NULL) {
      sink->on_value(sink->context, field, &frame[at + 1U]);
    }
    at += 1U + up_field_bytes(field);
  }
  if (sink->on_frame != NULL) {
    sink->on_frame(sink->context);
  }
}

static void drop_front(up_decoder_t *decoder, size_t bytes) {
  decoder->start += bytes;
  decoder->size -= bytes;
  restart(decoder);
}

/* Looks at all bytes that are there; afterwards the buffer starts with a possible frame start. */
static void drain(up_decoder_t *decoder) {
  while (decoder->at < decoder->size) {
    switch (step(decoder)) {
    case VERDICT_INCOMPLETE:
      decoder->at++;
      break;
    case VERDICT_INVALID:
      decoder->dropped_bytes++;
      drop_front(decoder, 1U);
      break;
    case VERDICT_COMPLETE:
    default:
      deliver(decoder);
      decoder->frames++;
      drop_front(decoder, decoder->at + 1U);
      break;
    }
  }
  if (decoder->start > 0U) {
    memmove(decoder->buffer, frame_of(decoder), decoder->size);
    decoder->start = 0U;
  }
}

void up_decoder_feed(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  size_t i;

  for (i = 0U; i < size; i++) {
    /* A frame never outgrows its bound, so there is always room; the guard is for a buffer that
     * up_decoder_init() has called too small. */
    if (decoder->size >= decoder->buffer_bytes) {
      decoder->dropped_bytes += (uint32_t)decoder->size;
      decoder->size = 0U;
      restart(decoder);
    }
    decoder->buffer[decoder->size] = bytes[i];
    decoder->size++;
    drain(decoder);
  }
}
