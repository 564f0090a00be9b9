/*
 * From values to Netstring frames.
 *
 * A frame is written into a buffer of the caller, whole or not at all: a function that finds the buffer too
 * small writes nothing and returns 0.
 */
#ifndef UP_ENCODE_H
#define UP_ENCODE_H

#include "up_schema.h"

/* CRC-16/CCITT-FALSE over `bytes`, continuing from `crc`; start with UP_CRC16_INIT. */
#define UP_CRC16_INIT 0xFFFFU
uint16_t up_crc16(uint16_t crc, const uint8_t *bytes, size_t size);

/* Copy one value between memory (machine representation) and wire (network byte order). Both hold
 * up_field_bytes(field) bytes. */
void up_value_to_wire(const up_field_t *field, const void *value, uint8_t *wire);
void up_value_from_wire(const up_field_t *field, const uint8_t *wire, void *value);

/* Packs the fields whose bit is set in `chosen` (bit i of byte i/8 is fields[i]) and that travel in
 * `direction`, in the order of the table. Returns the bytes of the frame; 0 when there is nothing to say or
 * the frame does not fit. */
size_t up_encode_values(const up_schema_t *schema, up_direction_t direction, const uint8_t *chosen,
                        const void *values, uint8_t *frame, size_t frame_bytes);

/* The hello of the board (with the hash of its schema) and the host's request for it. */
size_t up_encode_hello(const up_schema_t *schema, uint8_t *frame, size_t frame_bytes);
size_t up_encode_hello_request(const up_schema_t *schema, uint8_t *frame, size_t frame_bytes);

/* One bit a field. */
bool up_bit_get(const uint8_t *bitmap, size_t index);
void up_bit_set(uint8_t *bitmap, size_t index);

#endif
