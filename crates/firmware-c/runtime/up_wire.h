/*
 * What a generator prints for one direction of a board's link: sizes, what follows each identifier, and straight-line
 * code from values to a payload and back. Framing, checksums and recovery in a damaged stream are the same for all
 * boards: up_encode and up_decode.
 */
#ifndef UP_WIRE_H
#define UP_WIRE_H

#include <string.h>

#include "up_schema.h"

/* A part that no wire of the program needs can be left out: set its macro to 0 for the compiler. */
#ifndef UP_WIRE_CHECKSUMS
#define UP_WIRE_CHECKSUMS 1
#endif
#ifndef UP_WIRE_STAMPS
#define UP_WIRE_STAMPS 1
#endif
#ifndef UP_WIRE_BOOLS
#define UP_WIRE_BOOLS 1 /* in received values */
#endif
#ifndef UP_WIRE_MEMO
#define UP_WIRE_MEMO 1
#endif

struct up_memo;

/* The checksum at the end of payloads, by its size in bytes. */
typedef enum { UP_LINK_NONE = 0, UP_LINK_CRC16 = 2, UP_LINK_CRC32 = 4 } up_link_checksum_t;

/* Whether an identifier travels in this direction, and what follows it. */
typedef uint16_t up_item_t;
#define UP_ITEM(bytes, is_bool) ((up_item_t)(((bytes) << 1) | ((is_bool) ? 1U : 0U)))
#define UP_ITEM_NONE ((up_item_t)0U)
#define UP_ITEM_BYTES(item) ((size_t)(item) >> 1)
#define UP_ITEM_IS_BOOL(item) ((UP_WIRE_BOOLS) != 0 && ((item) & 1U) != 0U)

/* One direction. Sizes are those of payloads in bytes; what one end of a link does not use is left out. */
typedef struct {
  uint32_t hash;              /* of the schema, for the hello */
  uint16_t values_bytes_max;  /* of the longest payload of values, with its stamp, without a checksum */
  uint16_t health_bytes;      /* of health, without a checksum; 0 in the direction to the board */
  uint16_t payload_bytes_max; /* of the longest payload of any kind, with its checksum */
  uint8_t head_bytes;         /* of the longest length field and its colon */
  uint8_t direction;          /* up_direction_t */
  uint8_t checksum;           /* up_link_checksum_t */
  bool has_stamp;             /* payloads of values begin with a stamp; never to the board */
  /* Packs the values whose bit is set in `due` (bit i of byte i/8 is fields[i]); returns the size. */
  size_t (*put)(const uint8_t *due, const void *values, uint8_t *payload);
  /* What follows an identifier. */
  up_item_t (*item)(uint8_t id);
  /* Unpacks the items of a valid payload, and sets the bit of each in `taken`. */
  void (*take)(const uint8_t *items, const uint8_t *end, void *values, uint8_t *taken);
  /* &up_memo if frames are so long, or have so many items, that overlapping candidates must not process the same
   * bytes again; NULL for others, which can be checked again in no more time. */
  UP_ROM struct up_memo *memo;
} up_wire_t;

/* Frames without &up_memo are at most this long if they have a checksum or bools, and have at most this many items. */
#define UP_WIRE_PLAIN_BYTES 96U
#define UP_WIRE_PLAIN_ITEMS 16U

#define UP_WIRE_HAS_CHECKSUM(wire) ((UP_WIRE_CHECKSUMS) != 0 && (wire)->checksum != (uint8_t)UP_LINK_NONE)
#define UP_WIRE_HAS_CRC32(wire) \
  ((UP_WIRE_CHECKSUMS) != 0 && (UP_USES_CRC32) != 0 && (wire)->checksum == (uint8_t)UP_LINK_CRC32)
/* The size of the checksum with its identifier. */
#define UP_WIRE_CHECKSUM_BYTES(wire) \
  (UP_WIRE_HAS_CRC32(wire) ? (size_t)5U : UP_WIRE_HAS_CHECKSUM(wire) ? (size_t)3U : (size_t)0U)
#define UP_WIRE_HAS_STAMP(wire) ((UP_WIRE_STAMPS) != 0 && (wire)->has_stamp)
#define UP_WIRE_HAS_MEMO(wire) ((UP_WIRE_MEMO) != 0 && (wire)->memo != UP_ROM_NULL)

/* The size of the longest frame. */
#define UP_WIRE_FRAME_BYTES(wire) ((size_t)(wire)->head_bytes + (wire)->payload_bytes_max + 1U)

/* ---- the building blocks of printed code: numbers in network byte order, from and to memory of any alignment ---- */

static inline uint32_t up_bits_of(float value) {
  uint32_t bits;

  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static inline float up_float_of(uint32_t bits) {
  float value;

  memcpy(&value, &bits, sizeof value);
  return value;
}

#if UP_USES_DOUBLES
static inline uint64_t up_bits_of_double(double value) {
  uint64_t bits;

  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static inline double up_double_of(uint64_t bits) {
  double value;

  memcpy(&value, &bits, sizeof value);
  return value;
}
#endif

/* Each writes a number and returns the position after it. */
static inline uint8_t *up_put_8(uint8_t *at, uint8_t value) {
  at[0] = value;
  return &at[1];
}

static inline uint8_t *up_put_16(uint8_t *at, uint16_t value) {
  at[0] = (uint8_t)(value >> 8);
  at[1] = (uint8_t)value;
  return &at[2];
}

static inline uint8_t *up_put_32(uint8_t *at, uint32_t value) {
  at[0] = (uint8_t)(value >> 24);
  at[1] = (uint8_t)(value >> 16);
  at[2] = (uint8_t)(value >> 8);
  at[3] = (uint8_t)value;
  return &at[4];
}

static inline uint8_t *up_put_64(uint8_t *at, uint64_t value) {
  return up_put_32(up_put_32(at, (uint32_t)(value >> 32)), (uint32_t)value);
}

static inline uint16_t up_get_16(const uint8_t *at) {
  return (uint16_t)(((unsigned)at[0] << 8) | at[1]);
}

static inline uint32_t up_get_32(const uint8_t *at) {
  return ((uint32_t)at[0] << 24) | ((uint32_t)at[1] << 16) | ((uint32_t)at[2] << 8) | at[3];
}

static inline uint64_t up_get_64(const uint8_t *at) {
  return ((uint64_t)up_get_32(at) << 32) | up_get_32(&at[4]);
}

/* Arrays of elements of this size; bytes and bools are copied as they are. */
uint8_t *up_put_array(uint8_t *at, const void *values, size_t element_bytes, size_t count);
void up_get_array(const uint8_t *at, void *values, size_t element_bytes, size_t count);

#endif
