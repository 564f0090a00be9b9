#include "up_decode.h"

#include <string.h>

#include "up_memo.h"

#define HELLO_BYTES 5U
#define HELLO_REQUEST_BYTES 1U
#define HEALTH_REQUEST_BYTES 2U
#define STAMP_BYTES 6U

/* Where a program has one decoder, the compiler may know its wire. */
#if defined(UP_DECODER_WIRE)
extern UP_ROM up_wire_t UP_DECODER_WIRE;

static UP_ROM up_wire_t *wire_of(const up_decoder_t *decoder) {
  (void)decoder;
  return &UP_DECODER_WIRE;
}
#else
static UP_ROM up_wire_t *wire_of(const up_decoder_t *decoder) {
  return decoder->wire;
}
#endif

static void restart(up_decoder_t *decoder) {
  decoder->payload_start = 0U;
  decoder->frame_bytes = 0U;
  decoder->looked_at = 0U;
  decoder->checksum_right = false;
}

bool up_decoder_init(up_decoder_t *decoder, UP_ROM up_wire_t *wire, uint8_t *buffer, size_t buffer_bytes,
                     const up_sink_t *sink) {
  const size_t frame_bytes = UP_WIRE_FRAME_BYTES(wire);
  const size_t wanted_bytes = (!UP_WIRE_HAS_MEMO(wire)) ? frame_bytes : UP_DECODER_BYTES(frame_bytes);

  memset(decoder, 0, sizeof *decoder);
  decoder->wire = wire;
  decoder->sink = sink;
  decoder->buffer = buffer;
    if (buffer_bytes < wanted_bytes) {
    return false;
  }
  decoder->payload_bytes_max = wire->payload_bytes_max;
  decoder->buffer_bytes = buffer_bytes - (wanted_bytes - frame_bytes);
  if (UP_WIRE_HAS_MEMO(wire)) {
    wire->memo->init(decoder, frame_bytes);
  }
  return true;
}

static bool is_digit(uint8_t byte) {
  return byte >= (uint8_t)'0' && byte <= (uint8_t)'9';
}

bool up_decoder_is_idle(const up_decoder_t *decoder) {
  size_t i;

  for (i = 0U; i < decoder->size && is_digit(decoder->buffer[decoder->start + i]); i++) {
  }
  return i == decoder->size;
}

/* The size of the longest payload except health, without a checksum. */
static size_t short_bytes_max(UP_ROM up_wire_t *wire) {
  const size_t asked_bytes = (wire->direction == (uint8_t)UP_TO_HOST) ? HELLO_BYTES : HEALTH_REQUEST_BYTES;

  return (wire->values_bytes_max > asked_bytes) ? wire->values_bytes_max : asked_bytes;
}

static up_verdict_t read_length(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  size_t length = 0U;
  size_t i;

  for (i = 0U; i < size; i++) {
    if (bytes[i] == (uint8_t)':' && length > UP_WIRE_CHECKSUM_BYTES(wire_of(decoder))) {
      const size_t values_bytes = length - UP_WIRE_CHECKSUM_BYTES(wire_of(decoder));
      decoder->payload_start = i + 1U;
      decoder->items_start = i + 1U;
      decoder->at = i + 1U;
      decoder->values_end = i + 1U + values_bytes;
      decoder->frame_bytes = i + 1U + length + 1U;
      memset(decoder->seen, 0, sizeof decoder->seen);
      decoder->steps = 0U;
      decoder->joined = false;
      decoder->alone = false;
      return (values_bytes <= short_bytes_max(wire_of(decoder)) || values_bytes == wire_of(decoder)->health_bytes)
                 ? UP_VERDICT_COMPLETE
                 : UP_VERDICT_INVALID;
    }
    length = length * 10U + (size_t)(bytes[i] - (uint8_t)'0');
    if (!is_digit(bytes[i]) || length == 0U || length > decoder->payload_bytes_max) {
      return UP_VERDICT_INVALID;
    }
  }
  return UP_VERDICT_INCOMPLETE;
}

/* A payload that begins with 0: a hello or a stamp to the host, a request to the board. */
static up_verdict_t begin_with_0(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  UP_ROM up_wire_t *wire = wire_of(decoder);
  const size_t values_bytes = decoder->values_end - decoder->payload_start;

  if (wire->direction == (uint8_t)UP_TO_HOST) {
    if (values_bytes == HELLO_BYTES) {
      decoder->at = decoder->values_end;
      return UP_VERDICT_COMPLETE;
    }
    if (!UP_WIRE_HAS_STAMP(wire) || values_bytes <= STAMP_BYTES || values_bytes > wire->values_bytes_max) {
      return UP_VERDICT_INVALID;
    }
    decoder->at += STAMP_BYTES;
    decoder->items_start = decoder->at;
    return UP_VERDICT_COMPLETE;
  }
  if (values_bytes > HEALTH_REQUEST_BYTES) {
    return UP_VERDICT_INVALID;
  }
  if (values_bytes == HEALTH_REQUEST_BYTES) {
    if (size < decoder->at + HEALTH_REQUEST_BYTES) {
      return UP_VERDICT_INCOMPLETE;
    }
    if (bytes[decoder->at + 1U] != UP_HEALTH_REQUEST) {
      return UP_VERDICT_INVALID;
    }
  }
  decoder->at = decoder->values_end;
  return UP_VERDICT_COMPLETE;
}

/* Determines the type of the payload from its first byte and its length; skips a stamp, or a whole payload that has
 * no items. */
static up_verdict_t begin(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  UP_ROM up_wire_t *wire = wire_of(decoder);
  const size_t values_bytes = decoder->values_end - decoder->payload_start;
  uint8_t first;

  if (decoder->at != decoder->payload_start) {
    return UP_VERDICT_COMPLETE;
  }
  if (decoder->at >= size) {
    return UP_VERDICT_INCOMPLETE;
  }
  first = bytes[decoder->at];
  if (first == UP_ID_HELLO) {
    return begin_with_0(decoder, bytes, size);
  }
  if (first == UP_ID_HEALTH) {
    decoder->at = decoder->values_end;
    return (values_bytes == wire->health_bytes) ? UP_VERDICT_COMPLETE : UP_VERDICT_INVALID;
  }
  return (UP_WIRE_HAS_STAMP(wire) || values_bytes > short_bytes_max(wire)) ? UP_VERDICT_INVALID : UP_VERDICT_COMPLETE;
}

static bool are_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to) {
  if (UP_WIRE_HAS_MEMO(wire_of(decoder))) {
    return wire_of(decoder)->memo->bools(decoder, bytes, from, to);
  }
  while (from < to && bytes[from] <= 1U) {
    from++;
  }
  return from == to;
}

/* Checks the elements of a bool value [value, end), as many as are there. */
up_verdict_t up_decoder_look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t value, size_t end) {
  const size_t from = (decoder->looked_at > value) ? decoder->looked_at : value;
  const size_t to = (end < size) ? end : size;

  if (from < to) {
    decoder->looked_at = to;
    if (!are_bools(decoder, bytes, from, to)) {
      return UP_VERDICT_INVALID;
    }
  }
  return (to < end) ? UP_VERDICT_INCOMPLETE : UP_VERDICT_COMPLETE;
}

/* Walks from identifier to identifier up to the end of the values. */
static up_verdict_t walk(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  const up_verdict_t verdict = begin(decoder, bytes, size);

  if (verdict != UP_VERDICT_COMPLETE) {
    return verdict;
  }
  while (decoder->at < decoder->values_end) {
    up_item_t item;
    up_ids_t *seen, bit;
    size_t end;
    uint8_t id;

    if (UP_WIRE_HAS_MEMO(wire_of(decoder)) && decoder->has_walks && !decoder->alone) {
      bool is_known;
      const up_verdict_t joined = wire_of(decoder)->memo->join(decoder, bytes, size, &is_known);
      if (joined != UP_VERDICT_COMPLETE) {
        return joined;
      }
      if (is_known) {
        continue;
      }
    }
    if (decoder->at >= size) {
      return UP_VERDICT_INCOMPLETE;
    }
    id = bytes[decoder->at];
    item = wire_of(decoder)->item(id);
    seen = &decoder->seen[id / UP_IDS_BITS];
    bit = UP_IDS_BIT(id);
    end = decoder->at + 1U + UP_ITEM_BYTES(item);
    if (item == UP_ITEM_NONE || (*seen & bit) != 0U || end > decoder->values_end) {
      return UP_VERDICT_INVALID;
    }
    if (UP_ITEM_IS_BOOL(item)) {
      const up_verdict_t bools = up_decoder_look_at_bools(decoder, bytes, size, decoder->at + 1U, end);
      if (bools != UP_VERDICT_COMPLETE) {
        return bools;
      }
    }
    *seen = (up_ids_t)(*seen | bit);
    decoder->at = end;
    decoder->steps++;
  }
  return UP_VERDICT_COMPLETE;
}

static up_verdict_t compare_checksum(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  const size_t end = decoder->values_end;
  up_register_t crc;
  uint8_t number[4];
  size_t number_bytes;

  if (!UP_WIRE_HAS_CHECKSUM(wire_of(decoder)) || decoder->checksum_right) {
    return UP_VERDICT_COMPLETE;
  }
  if (size < end + UP_WIRE_CHECKSUM_BYTES(wire_of(decoder))) {
    return UP_VERDICT_INCOMPLETE;
  }
  if (UP_WIRE_HAS_MEMO(wire_of(decoder))) {
    crc = wire_of(decoder)->memo->crc(decoder, bytes, decoder->payload_start, end);
  } else {
    crc = up_register_add(wire_of(decoder), up_register_init(wire_of(decoder)), &bytes[decoder->payload_start],
                          end - decoder->payload_start);
  }
  number_bytes = (size_t)(up_register_put(wire_of(decoder), crc, number) - number);
  decoder->checksum_right = memcmp(&bytes[end + 1U], number, number_bytes) == 0;
  /* Values that have not been walked through may still contain invalid bools. */
  if (!decoder->checksum_right || decoder->at == end) {
    decoder->looked_at = end;
  }
  return decoder->checksum_right ? UP_VERDICT_COMPLETE : UP_VERDICT_INVALID;
}

/* Checks the bytes from the candidate's first on; what has been checked before is not checked again. */
static up_verdict_t look(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  up_verdict_t verdict = UP_VERDICT_COMPLETE;
  bool has_comma;

  if (decoder->payload_start == 0U) {
    verdict = read_length(decoder, bytes, size);
    if (verdict != UP_VERDICT_COMPLETE) {
      return verdict;
    }
  }
  /* The cheapest check first: most false candidates end wrong. */
  has_comma = size >= decoder->frame_bytes;
  if (has_comma && bytes[decoder->frame_bytes - 1U] != (uint8_t)',') {
    return UP_VERDICT_INVALID;
  }
  if (UP_WIRE_HAS_CHECKSUM(wire_of(decoder)) && size > decoder->values_end &&
      bytes[decoder->values_end] != UP_ID_CHECKSUM) {
    return UP_VERDICT_INVALID;
  }
  /* With sums, the checksum costs less than a walk. */
  if (has_comma && decoder->spent > 0U && compare_checksum(decoder, bytes, size) != UP_VERDICT_COMPLETE) {
    return UP_VERDICT_INVALID;
  }
  verdict = walk(decoder, bytes, size);
  if (verdict == UP_VERDICT_COMPLETE) {
    verdict = compare_checksum(decoder, bytes, size);
  }
  return (verdict == UP_VERDICT_COMPLETE && !has_comma) ? UP_VERDICT_INCOMPLETE : verdict;
}

/* The frame is valid to its last byte: every identifier is known and every value is whole. */
static void deliver(const up_decoder_t *decoder, const uint8_t *frame) {
  const up_sink_t *sink = decoder->sink;
  const bool is_to_host = wire_of(decoder)->direction == (uint8_t)UP_TO_HOST;
  const uint8_t *payload = &frame[decoder->payload_start];
  const size_t size = decoder->values_end - decoder->payload_start;

  if (payload[0] == UP_ID_HEALTH || (payload[0] == UP_ID_HELLO && size == HEALTH_REQUEST_BYTES)) {
    if (sink->on_health != NULL) {
      sink->on_health(sink->context, payload, is_to_host ? size : 0U);
    }
  } else if (payload[0] == UP_ID_HELLO && size <= HELLO_BYTES) {
    if (sink->on_hello != NULL) {
      sink->on_hello(sink->context, is_to_host ? up_get_32(&payload[1]) : 0U);
    }
  } else if (sink->on_values != NULL) {
    const uint8_t *items = &frame[decoder->items_start];
    up_stamp_t stamp = {0U, 0U};
    if (UP_WIRE_HAS_STAMP(wire_of(decoder))) {
      stamp.time_us = up_get_32(&payload[1]);
      stamp.counter = payload[5];
    }
    sink->on_values(sink->context, UP_WIRE_HAS_STAMP(wire_of(decoder)) ? &stamp : NULL, items,
                    (size_t)(&frame[decoder->values_end] - items));
  }
}

/* Looks for frames that start at or after `at` and before `limit`. Returns the start of the candidate that lacks
 * bytes, or the place to continue from. */
static size_t run(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t at, size_t limit) {
  while (at < limit) {
    const size_t from = at;
    const up_verdict_t verdict = look(decoder, &bytes[at], size - at);

    if (verdict == UP_VERDICT_INCOMPLETE) {
      return at;
    }
    if (verdict == UP_VERDICT_COMPLETE) {
      deliver(decoder, &bytes[at]);
      decoder->frames++;
      at += decoder->frame_bytes;
    } else {
      do {
        at++;
      } while (at < limit && !is_digit(bytes[at]));
      decoder->dropped_bytes = (up_events_t)(decoder->dropped_bytes + (at - from));
    }
    if (UP_WIRE_HAS_MEMO(wire_of(decoder))) {
      wire_of(decoder)->memo->leave(decoder, &bytes[from], at - from, verdict == UP_VERDICT_INVALID);
    }
    restart(decoder);
  }
  return at;
}

/* Buffers more bytes, at most as many as the candidate lacks; returns how many. While its length is being read, one
 * at a time. */
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
  size_t taken = 0U; /* bytes of this call that are also in the buffer */

  while (decoder->size > 0U && taken < size) {
    size_t old_bytes, gone;

    taken += hold(decoder, &bytes[taken], size - taken);
    /* Frames that start in the bytes of this call are looked for there. */
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
