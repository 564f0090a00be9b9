/*
 * Numbers in the text of a device, converted to the type of a field. Integers are rounded half away from zero and
 * saturate.
 *
 * Spaces around a number are ignored. Empty text gives UP_NOTHING; text that is not a number gives UP_INVALID. Neither
 * stores anything.
 */
#ifndef UP_PARSE_H
#define UP_PARSE_H

#include "up_value.h"

/* A piece of text, not terminated by a zero. */
typedef struct {
  const char *start;
  size_t size;
} up_piece_t;

/* Field `index` of a text; false if there are fewer. With separator 0 the whole text is field 0. */
bool up_parse_field(up_piece_t text, char separator, size_t index, up_piece_t *field);

/* Digits have no limit that 32 bits would keep: only with UP_USES_WIDE. */
#if UP_USES_WIDE

/* The number times 10^decimals (0 to 18): sign, digits, a point, digits; also `.5` and `5.`. Digits after the point
 * count only if they are among the first 19 digits in all. */
up_result_t up_parse_decimal(up_piece_t text, uint8_t decimals, uint8_t type, void *element);

/* [d]ddmm.mmmm and its hemisphere, in 1e-7 degrees; minutes are below 60, latitude is at most 90 degrees, longitude
 * at most 180. */
up_result_t up_parse_degrees(up_piece_t text, up_piece_t hemisphere, uint8_t type, void *element);

#endif

/* Hexadecimal digits, upper or lower case. */
up_result_t up_parse_hex(up_piece_t text, uint8_t type, void *element);

#endif
