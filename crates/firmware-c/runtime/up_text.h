/*
 * Values as text for people, without printf: the shell shows them, tests compare them.
 */
#ifndef UP_TEXT_H
#define UP_TEXT_H

#include "up_schema.h"

/* Enough for one element of any type and the closing zero. */
#define UP_TEXT_BYTES 32U

/* Writes one element: integers exactly, floating point with six decimals (beyond 2^53 as "large"). Returns the
 * number of characters written, without the closing zero. */
size_t up_text_element(uint8_t type, const void *element, char text[UP_TEXT_BYTES]);

#endif
