/*
 * Numbers in the text of a device, into the type of a field. Integers are rounded half away from zero and saturate.
 *
 * Spaces around a number are ignored. An empty text gives UP_NOTHING; a text that is not a number gives UP_INVALID.
 * Neither stores anything.
 */
#ifndef UP_PARSE_H
#define UP_PARSE_H

#include "up_value.h"

/* A piece of text; it does not end with a zero. */
typedef struct {
  const char *start;
  size_t size;
} up_piece_t;

/* Field `index` of a text; false when there are fewer. With separator 0 the whole text is field 0. */
bool up_parse_field(up_piece_t text, char separator, size_t index, up_piece_t *field);

/* The number times 10^decimals (0 to 18): sign, digits, a point, digits. Also `.5` and `5.`. Of the digits behind the
 * point those count that are among the first 19 in all. */
up_result_t up_parse_decimal(up_piece_t text, uint8_t decimals, uint8_t type, void *element);

/* [d]ddmm.mmmm and its hemisphere, in 1e-7 degrees; minutes below 60, at most 90 degrees of latitude and 180 of
 * longitude. */
up_result_t up_parse_degrees(up_piece_t text, up_piece_t hemisphere, uint8_t type, void *element);

/* Hexadecimal digits, upper or lower case. */
up_result_t up_parse_hex(up_piece_t text, uint8_t type, void *element);

#endif
