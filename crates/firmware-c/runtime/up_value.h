/*
 * From the bytes of a device to the value of a field, and back: words, bit fields, byte order, packed bits, BCD,
 * checksums.
 *
 * Integers saturate to the field's type instead of wrapping; bool is "not zero". The destination is in machine
 * representation and need not be aligned.
 */
#ifndef UP_VALUE_H
#define UP_VALUE_H

#include "up_result.h"
#include "up_schema.h"

/* The receiver of values. `value` has up_field_bytes() bytes and is NULL unless the result is UP_FRESH; it is only
 * valid during the call, and may be changed in place (a filter does). `field` is an index into the schema's fields. */
typedef struct {
  void (*on_value)(void *context, uint16_t field, up_result_t result, void *value);
  void *context;
} up_value_sink_t;

typedef enum {
  UP_CODE_INTEGER, /* words that are binary numbers */
  UP_CODE_FLOAT,   /* words that are IEEE 754 numbers: word_bytes is 4 for a float32, 8 for a float64 */
  UP_CODE_BCD,     /* words with two decimal digits per byte */
  UP_CODE_PACKED,  /* words of `bits` bits, one after the other without gaps, least significant bit first */
  UP_CODE_MAGNITUDE, /* words that are binary numbers, whose highest bit is a sign */
  UP_CODE_PULSES, /* commands only: colours of a strip with one wire (up_lamps.h) */
  UP_CODE_LEDS,   /* commands only: colours of a strip with a clock (up_lamps.h) */
  UP_CODE_TEXT    /* commands only: letters as dots (up_letters.h) */
} up_code_t;

typedef enum {
  UP_CRC_NONE,
  UP_CRC_SENSIRION /* a CRC-8 after every two bytes: polynomial 0x31, start value 0xFF */
} up_crc_t;

/* How the words of a value are coded; one word is one element. All zero except `word_bytes` is a big-endian unsigned
 * number in whole words. Strips use some members in their own way (up_lamps.h). */
typedef struct {
  UP_ROM uint8_t *elements; /* the word number of each element of the field; NULL: in order */
  uint8_t words;            /* number of words with `elements` (its greatest entry + 1); 0: as many as elements */
  uint8_t code;             /* up_code_t */
  uint8_t crc;              /* up_crc_t; not for UP_CODE_PACKED, and word_bytes * words must be even */
  uint8_t word_bytes;       /* 1 to 8, without UP_USES_WIDE to 4; ignored for UP_CODE_PACKED */
  uint8_t low;              /* lowest significant bit of the word, 0 for its least significant; PACKED: 0 */
  uint8_t bits;             /* number of significant bits from there, 1 to 64; 0: up to the word's highest. PACKED: 1
                             * to 32, without UP_USES_WIDE to 25 */
  bool is_signed;           /* the highest of the bits is a sign (two's complement); ignored for FLOAT, BCD and
                             * MAGNITUDE */
  bool little_endian;       /* the word's first byte is its least significant */
} up_value_t;

/* The size of a value with `count` elements on the wire, checksums included. */
size_t up_value_bytes(UP_ROM up_value_t *how, uint16_t count);

/* Stores the value of `field` from the first up_value_bytes() of `bytes`. UP_FRESH; UP_WRONG_CRC if a checksum is
 * wrong; UP_INVALID if a BCD digit is greater than 9, a float is infinite or NaN, or bytes are missing. Unless it is
 * fresh, `value` may be partly written. */
up_result_t up_value_decode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const uint8_t *bytes, size_t bytes_count,
                            void *value);

/* True if each checksum in the value's bytes is right (also without checksums). */
bool up_value_crc_is_right(UP_ROM up_value_t *how, uint16_t count, const uint8_t *bytes);

/* The reverse, for a device that is written to: writes up_value_bytes() bytes. Numbers saturate to the bits
 * available; other bits of a word are 0. Float fields are rounded to integers unless the code is UP_CODE_FLOAT.
 * Returns the number of bytes written, 0 if they do not fit. */
size_t up_value_encode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes,
                       size_t bytes_room);

#endif
