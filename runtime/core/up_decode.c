#include "up_decode.h"

#include <string.h>

#include "up_encode.h"

typedef enum { VERDICT_INVALID, VERDICT_INCOMPLETE, VERDICT_COMPLETE } verdict_t;

#define HELLO_BYTES 5U
#define HELLO_REQUEST_BYTES 1U
#define CHECKSUM_BYTES 3U
#define BLOCK_BYTES UP_DECODER_BLOCK_BYTES
#define BLOCKS_MAX 0xFFFFU

/* Of the stream up to where a block begins. */
typedef struct {
  uint16_t crc;   /* register, from a start of 0 somewhere before */
  uint16_t bools; /* how many whole blocks before are bools without a gap */
} sums_t;

/* Of two registers as polynomials over GF(2), modulo the one of the CRC. */
static uint16_t product(uint16_t left, uint16_t right) {
  uint32_t result = 0U;
  unsigned bit;

  for (bit = 16U; bit > 0U; bit--) {
    result = (result << 1) ^ (0x11021U & (0U - ((result >> 15) & 1U)));
    result ^= left & (0U - (((uint32_t)right >> (bit - 1U)) & 1U));
  }
  return (uint16_t)result;
}

/* What `blocks` blocks of zeros multiply a register by. */
static uint8_t *power_of(const up_decoder_t *decoder, size_t blocks) {
  return &decoder->sums[decoder->ring_bytes / BLOCK_BYTES * sizeof(sums_t) + blocks * sizeof(uint16_t)];
}

static void init_sums(up_decoder_t *decoder, size_t frame_bytes) {
  static const uint8_t zeros[BLOCK_BYTES];
  const size_t blocks = UP_DECODER_BLOCKS(frame_bytes);
  uint16_t power = 1U;
  size_t i;

  decoder->sums = &decoder->buffer[decoder->buffer_bytes];
  decoder->ring_bytes = blocks * BLOCK_BYTES;
  for (i = 0U; i < blocks; i++) {
    memcpy(power_of(decoder, i), &power, sizeof power);
    power = up_crc16(power, zeros, sizeof zeros);
  }
}

static uint8_t *sums_at(const up_decoder_t *decoder, size_t place) {
  size_t at = decoder->ring_at + place;

  if (at >= decoder->ring_bytes) {
    at -= decoder->ring_bytes;
  }
  return &decoder->sums[at / BLOCK_BYTES * sizeof(sums_t)];
}

static size_t count_bools(const uint8_t *bytes, size_t size) {
  size_t i = 0U;

  while (i < size && bytes[i] <= 1U) {
    i++;
  }
  return i;
}

/* What overlaps with a candidate that failed is in blocks: where the first whole one of the window starts and the
 * last one ends. False when there is none; otherwise there are sums up to the last. */
static bool in_blocks(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to, size_t *first,
                      size_t *last) {
  sums_t sums = {0U, 0U};

  *first = from + (0U - (decoder->ring_at + from)) % BLOCK_BYTES;
  *last = to - (decoder->ring_at + to) % BLOCK_BYTES;
  if (decoder->spent == 0U || to < *first + BLOCK_BYTES) {
    return false;
  }
  if (decoder->summed == 0U) {
    decoder->summed = BLOCK_BYTES - decoder->ring_at % BLOCK_BYTES;
    memcpy(sums_at(decoder, decoder->summed), &sums, sizeof sums);
  }
  memcpy(&sums, sums_at(decoder, decoder->summed), sizeof sums);
  while (decoder->summed < *last) {
    const uint8_t *block = &bytes[decoder->summed];
    const bool are_bools = count_bools(block, BLOCK_BYTES) == BLOCK_BYTES;
    sums.crc = up_crc16(sums.crc, block, BLOCK_BYTES);
    sums.bools = are_bools ? (uint16_t)(sums.bools + (sums.bools < BLOCKS_MAX)) : 0U;
    decoder->summed += BLOCK_BYTES;
    memcpy(sums_at(decoder, decoder->summed), &sums, sizeof sums);
  }
  return true;
}

/* A CRC is linear: what stood before a block shifts through it. */
static uint16_t crc_of(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to) {
  uint16_t crc = UP_CRC16_INIT;
  size_t first, last;

  if (in_blocks(decoder, bytes, from, to, &first, &last)) {
    sums_t before, sums;
    uint16_t power;
    memcpy(&before, sums_at(decoder, first), sizeof before);
    memcpy(&sums, sums_at(decoder, last), sizeof sums);
    memcpy(&power, power_of(decoder, (last - first) / BLOCK_BYTES), sizeof power);
    crc = up_crc16(crc, &bytes[from], first - from);
    crc = (uint16_t)(sums.crc ^ product((uint16_t)(crc ^ before.crc), power));
    from = last;
  }
  return up_crc16(crc, &bytes[from], to - from);
}

static bool all_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to) {
  size_t first, last;

  if (in_blocks(decoder, bytes, from, to, &first, &last)) {
    sums_t sums;
    memcpy(&sums, sums_at(decoder, last), sizeof sums);
    if (sums.bools < (last - first) / BLOCK_BYTES ||
        count_bools(&bytes[from], first - from) < first - from) {
      return false;
    }
    from = last;
  }
  return count_bools(&bytes[from], to - from) == to - from;
}

/* The candidate starts so many bytes further on in the stream. */
static void advance(up_decoder_t *decoder, size_t bytes) {
  if (decoder->spent <= bytes) {
    decoder->spent = 0U;
    decoder->summed = 0U;
    return;
  }
  decoder->spent -= bytes;
  decoder->summed = (decoder->summed > bytes) ? decoder->summed - bytes : 0U;
  decoder->ring_at += bytes;
  if (decoder->ring_at >= decoder->ring_bytes) {
    decoder->ring_at %= decoder->ring_bytes;
  }
}

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
    init_sums(decoder, frame_bytes);
  }
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

/* The elements of the value before `end`, as many as are there. */
static verdict_t look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t end) {
  const size_t value = decoder->at + 1U;
  const size_t from = (decoder->looked_at > value) ? decoder->looked_at : value;
  const size_t to = (end < size) ? end : size;

  if (from < to) {
    decoder->looked_at = to;
    if (!all_bools(decoder, bytes, from, to)) {
      return VERDICT_INVALID;
    }
  }
  return (to < end) ? VERDICT_INCOMPLETE : VERDICT_COMPLETE;
}

/* From identifier to identifier up to the end of the values. */
static verdict_t walk(up_decoder_t *decoder, const uint8_t *bytes, size_t size) {
  while (decoder->at < decoder->values_end) {
    const up_field_t *field;
    uint32_t *seen, bit;
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
    seen = &decoder->seen[id / 32U];
    bit = (uint32_t)1U << (id % 32U);
    if (field == NULL || (*seen & bit) != 0U) {
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
    *seen |= bit;
    decoder->at = end;
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
  crc = crc_of(decoder, bytes, decoder->payload_start, end);
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
    }
    advance(decoder, at - from);
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
