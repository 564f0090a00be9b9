#include "up_decode.h"

#include <string.h>

#include "up_memo.h"

typedef enum { VERDICT_INVALID, VERDICT_INCOMPLETE, VERDICT_COMPLETE } verdict_t;

#define HELLO_BYTES 5U
#define HELLO_REQUEST_BYTES 1U
#define CHECKSUM_BYTES 3U
/* The way of a candidate that takes fewer is not kept. */
#define STEPS_MIN 16U

static void restart(up_decoder_t *decoder) {
  decoder->payload_start = 0U;
  decoder->frame_bytes = 0U;
  decoder->looked_at = 0U;
  decoder->checksum_right = false;
}

bool up_decoder_init(up_decoder_t *decoder, const up_schema_t *schema, up_direction_t direction,
                     uint8_t *buffer, size_t buffer_bytes, const up_sink_t *sink) {
  const size_t frame_bytes = up_frame_bytes_max(schema, direction);
  const bool fits = buffer_bytes >= UP_DECODER_BYTES(frame_bytes);
  uint8_t i;

  memset(decoder, 0, sizeof *decoder);
  decoder->schema = schema;
  decoder->sink = sink;
  decoder->direction = (uint8_t)direction;
  decoder->buffer = buffer;
  decoder->checksum_bytes = schema->checksum_crc16 ? CHECKSUM_BYTES : 0U;
  if (fits) {
    decoder->payload_bytes_max = up_payload_bytes_max(schema, direction);
    decoder->buffer_bytes = buffer_bytes - (UP_DECODER_BYTES(frame_bytes) - frame_bytes);
    up_memo_init(decoder, frame_bytes);
  }
  for (i = 0U; i < schema->fields_count; i++) {
    if (schema->fields[i].direction == (uint8_t)direction) {
      decoder->field_of[schema->fields[i].id] = (uint8_t)(i + 1U);
#if UP_DECODER_SIZES
      decoder->bytes_of[schema->fields[i].id] = (uint16_t)up_field_bytes(&schema->fields[i]);
#endif
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
#if UP_DECODER_WALKS > 0U
      decoder->steps = 0U;
      decoder->joined = false;
      decoder->alone = false;
#endif
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

size_t up_decoder_value_bytes(const up_decoder_t *decoder, uint8_t id) {
#if UP_DECODER_SIZES
  return decoder->bytes_of[id];
#else
  return (decoder->field_of[id] == 0U) ? 0U : up_field_bytes(field_of(decoder, id));
#endif
}

/* The elements of the value [value, end), as many as are there. */
static verdict_t look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t value, size_t end) {
  const size_t from = (decoder->looked_at > value) ? decoder->looked_at : value;
  const size_t to = (end < size) ? end : size;

  if (from < to) {
    decoder->looked_at = to;
    if (!up_memo_bools(decoder, bytes, from, to)) {
      return VERDICT_INVALID;
    }
  }
  return (to < end) ? VERDICT_INCOMPLETE : VERDICT_COMPLETE;
}

#if UP_DECODER_WALKS > 0U
/* To the end of the values by a walk of others, which goes on where it has not come so far. */
static verdict_t join(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes, size_t size) {
  up_step_t leap;

  decoder->joined = true;
  while (walk->head < decoder->values_end) {
    const up_field_t *field;
    size_t end;

    if (walk->head >= size) {
      return VERDICT_INCOMPLETE;
    }
    field = field_of(decoder, bytes[walk->head]);
    end = walk->head + 1U + up_decoder_value_bytes(decoder, bytes[walk->head]);
    if (field == NULL || end > decoder->values_end) {
      return VERDICT_INVALID;
    }
    if (field->type == UP_TYPE_BOOL) {
      const verdict_t verdict = look_at_bools(decoder, bytes, size, walk->head + 1U, end);
      if (verdict != VERDICT_COMPLETE) {
        return verdict;
      }
    }
    if (up_memo_step(decoder, walk, bytes, end) != UP_STEP_TAKEN) {
      return VERDICT_INVALID;
    }
  }
  leap = up_memo_leap(decoder, walk, bytes);
  if (leap == UP_STEP_TAKEN) {
    decoder->at = decoder->values_end;
  }
  decoder->alone = leap == UP_STEP_UNKNOWN;
  return (leap == UP_STEP_TAKEN || decoder->alone) ? VERDICT_COMPLETE : VERDICT_INVALID;
}
#endif

/* From identifier to identifier up to the end of the values. */
static verdict_t walk(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  while (decoder->at < decoder->values_end) {
    const up_field_t *field;
    uint32_t *seen, bit;
    size_t end;
    uint8_t id;

#if UP_DECODER_WALKS > 0U
    if (decoder->has_walks && !decoder->alone) {
      up_walk_t *known = up_memo_walk(decoder, decoder->at);
      if (known != NULL) {
        const verdict_t verdict = join(decoder, known, bytes, size);
        if (verdict != VERDICT_COMPLETE) {
          return verdict;
        }
        continue;
      }
    }
#endif
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
    seen = &decoder->seen[id / 32U];
    bit = (uint32_t)1U << (id % 32U);
    if (field == NULL || (*seen & bit) != 0U) {
      return VERDICT_INVALID;
    }
    end = decoder->at + 1U + up_decoder_value_bytes(decoder, id);
    if (end > decoder->values_end) {
      return VERDICT_INVALID;
    }
    if (field->type == UP_TYPE_BOOL) {
      const verdict_t verdict = look_at_bools(decoder, bytes, size, decoder->at + 1U, end);
      if (verdict != VERDICT_COMPLETE) {
        return verdict;
      }
    }
    *seen |= bit;
    decoder->at = end;
#if UP_DECODER_WALKS > 0U
    decoder->steps++;
#endif
  }
  return VERDICT_COMPLETE;
}

static verdict_t compare_checksum(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  const size_t end = decoder->values_end;
  uint16_t crc;

  if (decoder->checksum_bytes == 0U || decoder->checksum_right) {
    return VERDICT_COMPLETE;
  }
  if (size < end + CHECKSUM_BYTES) {
    return VERDICT_INCOMPLETE;
  }
  crc = up_memo_crc(decoder, bytes, decoder->payload_start, end);
  decoder->checksum_right = bytes[end + 1U] == (uint8_t)(crc >> 8) && bytes[end + 2U] == (uint8_t)crc;
  /* Values that have not been walked through may still hold what is not a bool. */
  if (!decoder->checksum_right || decoder->at == end) {
    decoder->looked_at = end;
  }
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
  /* By sums the checksum costs less than a walk. */
  if (has_comma && decoder->spent > 0U && compare_checksum(decoder, bytes, size) != VERDICT_COMPLETE) {
    return VERDICT_INVALID;
  }
  verdict = walk(decoder, bytes, size);
  if (verdict == VERDICT_COMPLETE) {
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

/* Anything of candidates that failed. */
static bool has_memory(const up_decoder_t *decoder) {
#if UP_DECODER_WALKS > 0U
  return decoder->spent != 0U || decoder->has_walks;
#else
  return decoder->spent != 0U;
#endif
}

/* Looks for frames that start at `at` or behind it and before `limit`. Returns where the candidate starts that
 * lacks bytes, or where to go on. */
static size_t run(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t at, size_t limit) {
  while (at < limit) {
    const size_t from = at;
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
        at++;
      } while (at < limit && !is_digit(bytes[at]));
      decoder->dropped_bytes += (uint32_t)(at - from);
      if (decoder->looked_at > decoder->spent) {
        decoder->spent = decoder->looked_at;
      }
#if UP_DECODER_WALKS > 0U
      if (decoder->payload_start != 0U && decoder->steps >= STEPS_MIN) {
        up_memo_keep(decoder, &bytes[from]);
      }
#endif
    }
    if (has_memory(decoder)) {
      up_memo_advance(decoder, &bytes[from], at - from);
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
