#include "up_decode.h"

#include <string.h>

#include "up_encode.h"

typedef enum { VERDICT_INVALID, VERDICT_INCOMPLETE, VERDICT_COMPLETE } verdict_t;

#define HELLO_BYTES 5U
#define HELLO_REQUEST_BYTES 1U
#define CHECKSUM_BYTES 3U

static void restart(up_decoder_t *decoder) {
  decoder->payload_start = 0U;
  decoder->frame_bytes = 0U;
  decoder->looked_at = 0U;
  decoder->checksum_right = false;
}

bool up_decoder_init(up_decoder_t *decoder, const up_schema_t *schema, up_direction_t direction,
                     uint8_t *buffer, size_t buffer_bytes, const up_sink_t *sink) {
  const bool fits = buffer_bytes >= up_frame_bytes_max(schema, direction);
  uint8_t i;

  memset(decoder, 0, sizeof *decoder);
  decoder->schema = schema;
  decoder->sink = sink;
  decoder->direction = (uint8_t)direction;
  decoder->buffer = buffer;
  decoder->buffer_bytes = buffer_bytes;
  decoder->checksum_bytes = schema->checksum_crc16 ? CHECKSUM_BYTES : 0U;
  decoder->payload_bytes_max = fits ? up_payload_bytes_max(schema, direction) : 0U;
  for (i = 0U; i < schema->fields_count; i++) {
    if (schema->fields[i].direction == (uint8_t)direction) {
      decoder->field_of[schema->fields[i].id] = (uint8_t)(i + 1U);
    }
  }
  return fits;
}

bool up_decoder_is_idle(const up_decoder_t *decoder) {
  return decoder->size == 0U;
}

static bool is_digit(uint8_t byte) {
  return byte >= (uint8_t)'0' && byte <= (uint8_t)'9';
}

static verdict_t read_length(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  size_t length = 0U;
  size_t i;

  for (i = 0U; i < size; i++) {
    if (bytes[i] == (uint8_t)':' && length > decoder->checksum_bytes) {
      decoder->payload_start = i + 1U;
      decoder->at = i + 1U;
      decoder->values_end = i + 1U + length - decoder->checksum_bytes;
      decoder->frame_bytes = i + 1U + length + 1U;
      memset(decoder->seen, 0, sizeof decoder->seen);
      return VERDICT_COMPLETE;
    }
    length = length * 10U + (size_t)(bytes[i] - (uint8_t)'0');
    if (!is_digit(bytes[i]) || length == 0U || length > decoder->payload_bytes_max) {
      return VERDICT_INVALID;
    }
  }
  return VERDICT_INCOMPLETE;
}

/* The hello stands alone, and exactly as long as its direction wants it. */
static bool is_hello(const up_decoder_t *decoder) {
  const size_t wanted_bytes = (decoder->direction == (uint8_t)UP_TO_HOST) ? HELLO_BYTES : HELLO_REQUEST_BYTES;

  return decoder->at == decoder->payload_start && decoder->values_end - decoder->at == wanted_bytes;
}

static const up_field_t *field_of(const up_decoder_t *decoder, uint8_t id) {
  return (decoder->field_of[id] == 0U) ? NULL : &decoder->schema->fields[decoder->field_of[id] - 1U];
}

/* Here and not in another file, so that the compiler makes no calls of them. */
static bool is_seen(const up_decoder_t *decoder, uint8_t id) {
  return (decoder->seen[id / 8U] & (1U << (id % 8U))) != 0U;
}

static void see(up_decoder_t *decoder, uint8_t id) {
  decoder->seen[id / 8U] = (uint8_t)(decoder->seen[id / 8U] | (1U << (id % 8U)));
}

/* The elements of the value before `end`, as many as are there. */
static verdict_t look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t end) {
  size_t i = decoder->at + 1U;

  if (i < decoder->looked_at) {
    i = decoder->looked_at;
  }
  for (; i < end && i < size; i++) {
    if (bytes[i] > 1U) {
      return VERDICT_INVALID;
    }
  }
  decoder->looked_at = i;
  return (i < end) ? VERDICT_INCOMPLETE : VERDICT_COMPLETE;
}

/* From identifier to identifier up to the end of the values. */
static verdict_t walk(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  while (decoder->at < decoder->values_end) {
    const up_field_t *field;
    size_t end;
    uint8_t id;

    if (decoder->at >= size) {
      return VERDICT_INCOMPLETE;
    }
    id = bytes[decoder->at];
    if (id == UP_ID_HELLO) {
      if (!is_hello(decoder)) {
        return VERDICT_INVALID;
      }
      decoder->at = decoder->values_end;
      break;
    }
    field = field_of(decoder, id);
    if (field == NULL || is_seen(decoder, id)) {
      return VERDICT_INVALID;
    }
    end = decoder->at + 1U + up_field_bytes(field);
    if (end > decoder->values_end) {
      return VERDICT_INVALID;
    }
    if (field->type == UP_TYPE_BOOL) {
      const verdict_t verdict = look_at_bools(decoder, bytes, size, end);
      if (verdict != VERDICT_COMPLETE) {
        return verdict;
      }
    }
    see(decoder, id);
    decoder->at = end;
  }
  return VERDICT_COMPLETE;
}

static verdict_t compare_checksum(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  const size_t end = decoder->values_end;
  uint16_t crc;

  if (size < end + CHECKSUM_BYTES) {
    return VERDICT_INCOMPLETE;
  }
  crc = up_crc16(UP_CRC16_INIT, &bytes[decoder->payload_start], end - decoder->payload_start);
  decoder->checksum_right = bytes[end + 1U] == (uint8_t)(crc >> 8) && bytes[end + 2U] == (uint8_t)crc;
  return decoder->checksum_right ? VERDICT_COMPLETE : VERDICT_INVALID;
}

/* Looks at the bytes from the candidate's first on; what was found out before is not looked at again. */
static verdict_t look(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  verdict_t verdict = VERDICT_COMPLETE;
  bool has_comma;

  if (decoder->payload_start == 0U) {
    verdict = read_length(decoder, bytes, size);
    if (verdict != VERDICT_COMPLETE) {
      return verdict;
    }
  }
  /* The cheapest first: most of what only looks like a frame ends wrong. */
  has_comma = size >= decoder->frame_bytes;
  if (has_comma && bytes[decoder->frame_bytes - 1U] != (uint8_t)',') {
    return VERDICT_INVALID;
  }
  if (decoder->checksum_bytes != 0U && size > decoder->values_end &&
      bytes[decoder->values_end] != UP_ID_CHECKSUM) {
    return VERDICT_INVALID;
  }
  verdict = walk(decoder, bytes, size);
  if (verdict == VERDICT_COMPLETE && decoder->checksum_bytes != 0U && !decoder->checksum_right) {
    verdict = compare_checksum(decoder, bytes, size);
  }
  return (verdict == VERDICT_COMPLETE && !has_comma) ? VERDICT_INCOMPLETE : verdict;
}

static void deliver_hello(const up_decoder_t *decoder, const uint8_t *payload) {
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
static void deliver(const up_decoder_t *decoder, const uint8_t *frame) {
  const up_sink_t *sink = decoder->sink;
  size_t at = decoder->payload_start;

  if (frame[at] == UP_ID_HELLO) {
    deliver_hello(decoder, &frame[at]);
    return;
  }
  while (at < decoder->values_end) {
    const up_field_t *field = field_of(decoder, frame[at]);
    if (sink->on_value != NULL) {
      sink->on_value(sink->context, field, &frame[at + 1U]);
    }
    at += 1U + up_field_bytes(field);
  }
  if (sink->on_frame != NULL) {
    sink->on_frame(sink->context);
  }
}

/* Looks for frames that start at `at` or behind it and before `limit`. Returns where the candidate starts that
 * lacks bytes, or where to go on. */
static size_t run(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t at, size_t limit) {
  while (at < limit) {
    const verdict_t verdict = look(decoder, &bytes[at], size - at);

    if (verdict == VERDICT_INCOMPLETE) {
      return at;
    }
    if (verdict == VERDICT_COMPLETE) {
      deliver(decoder, &bytes[at]);
      decoder->frames++;
      at += decoder->frame_bytes;
    } else {
      do {
        decoder->dropped_bytes++;
        at++;
      } while (at < limit && !is_digit(bytes[at]));
    }
    restart(decoder);
  }
  return at;
}

/* Holds some more bytes, as many as the candidate lacks at most; returns how many. While its length is read,
 * that is one at a time. */
static size_t hold(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  size_t more = (decoder->frame_bytes == 0U) ? 1U : decoder->frame_bytes - decoder->size;

  if (more > size) {
    more = size;
  }
  if (decoder->start + decoder->size + more > decoder->buffer_bytes) {
    memmove(decoder->buffer, &decoder->buffer[decoder->start], decoder->size);
    decoder->start = 0U;
  }
  memcpy(&decoder->buffer[decoder->start + decoder->size], bytes, more);
  decoder->size += more;
  return more;
}

void up_decoder_feed(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  size_t taken = 0U; /* bytes of this call that are in the buffer, too */

  while (decoder->size > 0U && taken < size) {
    size_t old_bytes, gone;

    taken += hold(decoder, &bytes[taken], size - taken);
    /* What starts in the bytes of this call is looked for there. */
    old_bytes = (decoder->size > taken) ? decoder->size - taken : 0U;
    gone = run(decoder, &decoder->buffer[decoder->start], decoder->size, 0U, old_bytes);
    if (gone >= old_bytes) {
      taken = gone - old_bytes;
      decoder->size = 0U;
      decoder->start = 0U;
      break;
    }
    decoder->start += gone;
    decoder->size -= gone;
  }
  if (decoder->size == 0U && taken < size) {
    taken += run(decoder, &bytes[taken], size - taken, 0U, size - taken);
    decoder->size = size - taken;
    memcpy(decoder->buffer, &bytes[taken], decoder->size);
  }
}
