#include "up_memo.h"

#include <string.h>

#define BLOCK_BYTES UP_DECODER_BLOCK_BYTES
#define BLOCKS_MAX 0xFFFFU
/* The walk of a candidate with fewer steps is not kept. */
#define STEPS_MIN 16U

/* Sums over the stream up to the start of a block. */
typedef struct {
  up_register_t crc; /* register, starting from 0 somewhere before */
  uint16_t bools;    /* number of whole blocks before it that contain only bools, without a gap */
} sums_t;

/* The register that multiplies by 1: CRC-32 has its highest power in the lowest bit. */
static up_register_t one(UP_ROM up_wire_t *wire) {
  return (up_register_t)(UP_WIRE_HAS_CRC32(wire) ? 0x80000000U : 1U);
}

/* The product of two registers as polynomials over GF(2), modulo the polynomial of the CRC. */
static up_register_t product(UP_ROM up_wire_t *wire, up_register_t left, up_register_t right) {
  const bool is_32 = UP_WIRE_HAS_CRC32(wire);
  const unsigned bits = is_32 ? 32U : 16U;
  uint32_t result = 0U;
  unsigned i;

  for (i = 0U; i < bits; i++) {
    const unsigned bit = is_32 ? i : bits - 1U - i;
    result = is_32 ? (result >> 1) ^ (0xEDB88320U & (0U - (result & 1U)))
                   : (result << 1) ^ (0x11021U & (0U - ((result >> 15) & 1U)));
    result ^= left & (0U - (((uint32_t)right >> bit) & 1U));
  }
  return (up_register_t)result;
}

/* The factor by which `blocks` blocks of zeros multiply a register. */
static uint8_t *power_of(const up_decoder_t *decoder, size_t blocks) {
  return &decoder->sums[decoder->ring_bytes / BLOCK_BYTES * sizeof(sums_t) + blocks * sizeof(up_register_t)];
}

static void init(up_decoder_t *decoder, size_t frame_bytes) {
  const uint8_t zero = 0U;
  const size_t blocks = UP_DECODER_BLOCKS(frame_bytes);
  up_register_t power = one(decoder->wire);
  size_t i, byte;

  decoder->sums = &decoder->buffer[decoder->buffer_bytes];
  decoder->ring_bytes = blocks * BLOCK_BYTES;
  for (i = 0U; i < blocks; i++) {
    memcpy(power_of(decoder, i), &power, sizeof power);
    for (byte = 0U; byte < BLOCK_BYTES; byte++) {
      power = up_register_add(decoder->wire, power, &zero, 1U);
    }
  }
#if UP_DECODER_WALKS > 0U
  for (i = 0U; i < UP_DECODER_WALKS; i++) {
    decoder->walks[i].places = power_of(decoder, blocks) + i * (decoder->ring_bytes / 8U);
  }
#endif
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

/* Divides the overlap with a failed candidate into blocks: the start of the first whole block in the window and the
 * end of the last. False if there is none; otherwise there are sums up to the last. */
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
    const bool is_whole = count_bools(block, BLOCK_BYTES) == BLOCK_BYTES;
    sums.crc = up_register_add(decoder->wire, sums.crc, block, BLOCK_BYTES);
    sums.bools = is_whole ? (uint16_t)(sums.bools + (sums.bools < BLOCKS_MAX)) : 0U;
    decoder->summed += BLOCK_BYTES;
    memcpy(sums_at(decoder, decoder->summed), &sums, sizeof sums);
  }
  return true;
}

/* A CRC is linear: the register before a block is shifted through it. */
static up_register_t crc_of(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to) {
  up_register_t crc = up_register_init(decoder->wire);
  size_t first, last;

  if (in_blocks(decoder, bytes, from, to, &first, &last)) {
    sums_t before, sums;
    up_register_t power;
    memcpy(&before, sums_at(decoder, first), sizeof before);
    memcpy(&sums, sums_at(decoder, last), sizeof sums);
    memcpy(&power, power_of(decoder, (last - first) / BLOCK_BYTES), sizeof power);
    crc = up_register_add(decoder->wire, crc, &bytes[from], first - from);
    crc = (up_register_t)(sums.crc ^ product(decoder->wire, (up_register_t)(crc ^ before.crc), power));
    from = last;
  }
  return up_register_add(decoder->wire, crc, &bytes[from], to - from);
}

static bool are_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to) {
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

#if UP_DECODER_WALKS > 0U

typedef enum {
  STEP_TAKEN,
  STEP_REPEATS, /* the candidate has an identifier twice */
  STEP_MISSES,  /* none of its items ends at the end of its values */
  STEP_UNKNOWN  /* the walk cannot tell */
} step_t;

static bool has_id(const up_ids_t *ids, uint8_t id) {
  return (ids[id / UP_IDS_BITS] & UP_IDS_BIT(id)) != 0U;
}

static bool have_common(const up_ids_t *ids, const up_ids_t *others) {
  up_ids_t common = 0U;
  size_t i;

  for (i = 0U; i < UP_IDS_PARTS; i++) {
    common = (up_ids_t)(common | (ids[i] & others[i]));
  }
  return common != 0U;
}

/* The returned byte contains the bit for a place. */
static uint8_t *place_at(const up_decoder_t *decoder, const up_walk_t *walk, size_t place, uint8_t *bit) {
  size_t at = decoder->ring_at + place;

  if (at >= decoder->ring_bytes) {
    at -= decoder->ring_bytes;
  }
  *bit = (uint8_t)(1U << (at % 8U));
  return &walk->places[at / 8U];
}

static bool has_place(const up_decoder_t *decoder, const up_walk_t *walk, size_t place) {
  uint8_t bit;
  const uint8_t *byte = place_at(decoder, walk, place, &bit);

  return (*byte & bit) != 0U;
}

/* Appends an identifier to the walk, with the place of the next one. */
static void lengthen(const up_decoder_t *decoder, up_walk_t *walk, uint8_t id, size_t next) {
  uint8_t bit;
  uint8_t *byte = place_at(decoder, walk, walk->head, &bit);

  *byte = (uint8_t)(*byte | bit);
  walk->ids[id / UP_IDS_BITS] = (up_ids_t)(walk->ids[id / UP_IDS_BITS] | UP_IDS_BIT(id));
  walk->head = next;
}

/* Removes the walk's first identifier. */
static void shorten(const up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes) {
  const uint8_t id = bytes[walk->tail];
  uint8_t bit, *byte = place_at(decoder, walk, walk->tail, &bit);

  *byte = (uint8_t)(*byte & ~bit);
  walk->ids[id / UP_IDS_BITS] = (up_ids_t)(walk->ids[id / UP_IDS_BITS] & ~UP_IDS_BIT(id));
  walk->tail += 1U + UP_ITEM_BYTES(decoder->wire->item(id));
}

/* A walk with an identifier at this place; NULL if there is none. */
static up_walk_t *find_walk(up_decoder_t *decoder, size_t place) {
  size_t i;

  for (i = 0U; i < UP_DECODER_WALKS; i++) {
    if (decoder->walks[i].head != 0U && has_place(decoder, &decoder->walks[i], place)) {
      return &decoder->walks[i];
    }
  }
  return NULL;
}

/* The candidate is at an identifier of the walk: extends the walk by one step at its head, to `next`. */
static step_t take_step(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes, size_t next) {
  const uint8_t id = bytes[walk->head];

  while (has_id(walk->ids, id)) {
    if (walk->tail == decoder->at) {
      return STEP_REPEATS;
    }
    shorten(decoder, walk, bytes);
  }
  lengthen(decoder, walk, id, next);
  return STEP_TAKEN;
}

/* Whether the candidate reaches the end of its values along the walk, which extends that far. */
static step_t leap(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes) {
  const size_t end = decoder->values_end;

  if (end != walk->head && !has_place(decoder, walk, end)) {
    return STEP_MISSES;
  }
  if (have_common(decoder->seen, walk->ids)) {
    /* Some may be before the place where the candidate meets the walk, or after the candidate's end. */
    while (walk->tail < decoder->at) {
      shorten(decoder, walk, bytes);
    }
    if (have_common(decoder->seen, walk->ids)) {
      return (end == walk->head) ? STEP_REPEATS : STEP_UNKNOWN;
    }
  }
  return STEP_TAKEN;
}

/* Follows another candidate's walk to the end of the values, and extends the walk if it does not reach that far. */
static up_verdict_t follow(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes, size_t size) {
  step_t found;

  decoder->joined = true;
  while (walk->head < decoder->values_end) {
    up_item_t item;
    size_t end;

    if (walk->head >= size) {
      return UP_VERDICT_INCOMPLETE;
    }
    item = decoder->wire->item(bytes[walk->head]);
    end = walk->head + 1U + UP_ITEM_BYTES(item);
    if (item == UP_ITEM_NONE || end > decoder->values_end) {
      return UP_VERDICT_INVALID;
    }
    if (UP_ITEM_IS_BOOL(item)) {
      const up_verdict_t verdict = up_decoder_look_at_bools(decoder, bytes, size, walk->head + 1U, end);
      if (verdict != UP_VERDICT_COMPLETE) {
        return verdict;
      }
    }
    if (take_step(decoder, walk, bytes, end) != STEP_TAKEN) {
      return UP_VERDICT_INVALID;
    }
  }
  found = leap(decoder, walk, bytes);
  if (found == STEP_TAKEN) {
    decoder->at = decoder->values_end;
  }
  decoder->alone = found == STEP_UNKNOWN;
  return (found == STEP_TAKEN || decoder->alone) ? UP_VERDICT_COMPLETE : UP_VERDICT_INVALID;
}

static up_verdict_t join(up_decoder_t *decoder, const uint8_t *bytes, size_t size, bool *is_known) {
  up_walk_t *known = find_walk(decoder, decoder->at);

  *is_known = known != NULL;
  return *is_known ? follow(decoder, known, bytes, size) : UP_VERDICT_COMPLETE;
}

/* Keeps the walk of a failed candidate, unless it used another's. */
static void keep(up_decoder_t *decoder, const uint8_t *bytes) {
  up_walk_t *walk = &decoder->walks[decoder->walks_put];

  if (decoder->joined) {
    return;
  }
  decoder->has_walks = true;
  decoder->walks_put = (uint8_t)((decoder->walks_put + 1U < UP_DECODER_WALKS) ? decoder->walks_put + 1U : 0U);
  memset(walk->places, 0, decoder->ring_bytes / 8U);
  memset(walk->ids, 0, sizeof walk->ids);
  walk->tail = decoder->items_start;
  walk->head = walk->tail;
  while (walk->head < decoder->at) {
    const uint8_t id = bytes[walk->head];
    lengthen(decoder, walk, id, walk->head + 1U + UP_ITEM_BYTES(decoder->wire->item(id)));
  }
}

/* Removes what is before the new candidate from the walks. True if one of them is left. */
static bool advance_walks(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped) {
  bool any = false;
  size_t i;

  for (i = 0U; i < UP_DECODER_WALKS; i++) {
    up_walk_t *walk = &decoder->walks[i];
    if (walk->head == 0U) {
      continue;
    }
    while (walk->tail < skipped && walk->tail < walk->head) {
      shorten(decoder, walk, bytes);
    }
    if (walk->tail >= walk->head) {
      walk->head = 0U;
      continue;
    }
    walk->tail -= skipped;
    walk->head -= skipped;
    any = true;
  }
  return any;
}

#endif

/* Gives up the candidate for one that starts this many bytes further on. */
static void advance(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped) {
  bool moves = decoder->spent > skipped;

  decoder->spent = moves ? decoder->spent - skipped : 0U;
  decoder->summed = (moves && decoder->summed > skipped) ? decoder->summed - skipped : 0U;
#if UP_DECODER_WALKS > 0U
  if (decoder->has_walks) {
    decoder->has_walks = advance_walks(decoder, bytes, skipped);
    moves = moves || decoder->has_walks;
  }
#else
  (void)bytes;
#endif
  if (moves) {
    decoder->ring_at += skipped;
    if (decoder->ring_at >= decoder->ring_bytes) {
      decoder->ring_at %= decoder->ring_bytes;
    }
  }
}

static void leave(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped, bool has_failed) {
  if (has_failed) {
    if (decoder->looked_at > decoder->spent) {
      decoder->spent = decoder->looked_at;
    }
#if UP_DECODER_WALKS > 0U
    if (decoder->payload_start != 0U && decoder->steps >= STEPS_MIN) {
      keep(decoder, bytes);
    }
#endif
  }
  if (decoder->spent != 0U || decoder->has_walks) {
    advance(decoder, bytes, skipped);
  }
}

UP_ROM up_memo_t up_memo = {
    .init = init,
    .crc = crc_of,
    .bools = are_bools,
    .leave = leave,
#if UP_DECODER_WALKS > 0U
    .join = join,
#endif
};
