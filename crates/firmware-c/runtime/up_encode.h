/*
 * From values to Netstring frames.
 *
 * A frame is written into a buffer of the caller, whole or not at all: if the buffer is smaller than
 * UP_WIRE_FRAME_BYTES(), nothing is written and 0 is returned.
 */
#ifndef UP_ENCODE_H
#define UP_ENCODE_H

#include "up_health.h"
#include "up_wire.h"

/* CRC-16/CCITT-FALSE of `bytes`, continuing from `crc`; start with UP_CRC16_INIT. */
#define UP_CRC16_INIT 0xFFFFU
uint16_t up_crc16(uint16_t crc, const uint8_t *bytes, size_t size);

/* CRC-32/ISO-HDLC, as in Ethernet and zlib, as a register: start with UP_CRC32_INIT, and invert it at the end. */
#define UP_CRC32_INIT 0xFFFFFFFFU
uint32_t up_crc32(uint32_t crc, const uint8_t *bytes, size_t size);

/* The register for any checksum that a link of the program has. */
#if UP_USES_CRC32
typedef uint32_t up_register_t;
#else
typedef uint16_t up_register_t;
#endif

static inline up_register_t up_register_init(UP_ROM up_wire_t *wire) {
  return (up_register_t)(UP_WIRE_HAS_CRC32(wire) ? UP_CRC32_INIT : UP_CRC16_INIT);
}

static inline up_register_t up_register_add(UP_ROM up_wire_t *wire, up_register_t crc, const uint8_t *bytes,
                                            size_t size) {
  return (up_register_t)(UP_WIRE_HAS_CRC32(wire) ? up_crc32(crc, bytes, size) : up_crc16((uint16_t)crc, bytes, size));
}

/* Writes the checksum for a register and returns the position after it. */
static inline uint8_t *up_register_put(UP_ROM up_wire_t *wire, up_register_t crc, uint8_t *at) {
  return UP_WIRE_HAS_CRC32(wire) ? up_put_32(at, ~(uint32_t)crc) : up_put_16(at, (uint16_t)crc);
}

/* The start of a report on links with stamps. */
typedef struct {
  uint32_t time_us; /* since the start of the board; wraps */
  uint8_t counter;  /* the count of reports put together; wraps */
} up_stamp_t;

/* Packs the values whose bit is set in `due`. `stamp` is ignored if the wire has none. Returns the size of the
 * frame, 0 if there is nothing to send. */
size_t up_encode_values(UP_ROM up_wire_t *wire, const up_stamp_t *stamp, const uint8_t *due, const void *values,
                        uint8_t *frame, size_t frame_bytes);

/* The hello of the board, with the hash of its schema. */
size_t up_encode_hello(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes);

/* The health of the board, and of each device as given by `row_of`. */
size_t up_encode_health(UP_ROM up_wire_t *wire, const up_health_board_t *board,
                        void (*row_of)(void *context, size_t field, up_health_row_t *row), void *context,
                        uint8_t *frame, size_t frame_bytes);

/* The host's requests. */
size_t up_encode_hello_request(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes);
size_t up_encode_health_request(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes);

/* Bitmaps with one bit per field. */
bool up_bit_get(const uint8_t *bitmap, size_t index);
void up_bit_set(uint8_t *bitmap, size_t index);

#endif
