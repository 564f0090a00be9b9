/*
 * Numbers that look random, and the checksum of the results of what the core makes of them.
 */
#ifndef LESS_H
#define LESS_H

#include <string.h>

#include "say.h"
#include "up_encode.h"

#define TURNS 300U
/* The types of at most 32 bits. Each has two fields: a scalar, and behind it an array of three. */
#define TYPES 7U
extern UP_ROM up_field_t fields[2U * TYPES];

/* A chip on a bus, and a host that only asks. */
void run_board(void);

/* ---- numbers, and the checksum of results ---- */

extern uint32_t seed, sum;
#define ENDS 8U
extern UP_ROM uint32_t ends[ENDS];

static inline uint32_t random_bits(void) {
  seed ^= seed << 13;
  seed ^= seed >> 17;
  seed ^= seed << 5;
  return seed;
}

static inline uint32_t below(uint32_t limit) {
  return random_bits() % limit;
}

/* Small, large, and near the ends of types. */
static inline uint32_t number(void) {
  switch (below(3U)) {
  case 0U:
    return random_bits() >> below(32U);
  case 1U:
    return ends[below(ENDS)] + below(3U) - 1U;
  default:
    return 0U - (random_bits() >> below(32U));
  }
}

static inline int32_t signed_number(void) {
  const uint32_t bits = number();
  int32_t result;

  memcpy(&result, &bits, sizeof result);
  return result;
}

static inline void note(const void *bytes, size_t count) {
  sum = (count == 0U) ? sum : up_crc32(sum, bytes, count);
}

static inline void note_word(uint32_t word) {
  uint8_t bytes[4];

  (void)up_put_32(bytes, word);
  note(bytes, sizeof bytes);
}

static inline void tell(const char *what) {
  uint8_t bytes[4];

  (void)up_put_32(bytes, sum);
  say(what);
  say_byte(' ');
  say_bytes(bytes, sizeof bytes);
  sum = 0U;
}

#endif
