/*
 * From values to Netstring frames.
 *
 * A frame is written into a buffer of the caller, whole or not at all: a function that finds the buffer smaller than
 * UP_WIRE_FRAME_BYTES() writes nothing and returns 0.
 */
#ifndef UP_ENCODE_H
#define UP_ENCODE_H

#include "up_health.h"
#include "up_wire.h"

/* CRC-16/CCITT-FALSE over `bytes`, continuing from `crc`; start with UP_CRC16_INIT. */
#define UP_CRC16_INIT 0xFFFFU
uint16_t up_crc16(uint16_t crc, const uint8_t *bytes, size_t size);

/* What a report begins with where the link has stamps. */
typedef struct {
  uint32_t time_us; /* since the start; wraps */
  uint8_t counter;  /* of the reports that were put together; wraps */
} up_stamp_t;

/* Packs the values whose bit is set in `due`. `stamp` is of no meaning where the wire has none. Returns the bytes of the
 * frame; 0 when there is nothing to say. */
size_t up_encode_values(const up_wire_t *wire, const up_stamp_t *stamp, const uint8_t *due, const void *values,
                        uint8_t *frame, size_t frame_bytes);

/* The hello of the board, with the hash of its schema. */
size_t up_encode_hello(const up_wire_t *wire, uint8_t *frame, size_t frame_bytes);

/* Health: of the board, and of each device as `row_of` says it. */
size_t up_encode_health(const up_wire_t *wire, const up_health_board_t *board,
                        void (*row_of)(void *context, size_t field, up_health_row_t *row), void *context,
                        uint8_t *frame, size_t frame_bytes);

/* The host's requests. */
size_t up_encode_hello_request(const up_wire_t *wire, uint8_t *frame, size_t frame_bytes);
size_t up_encode_health_request(const up_wire_t *wire, uint8_t *frame, size_t frame_bytes);

/* One bit a field. */
bool up_bit_get(const uint8_t *bitmap, size_t index);
void up_bit_set(uint8_t *bitmap, size_t index);

#endif
