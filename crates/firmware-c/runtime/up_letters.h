/*
 * Letters as dots: six columns of eight dots for each, the dot at the top in the lowest bit. The last column is empty.
 *
 * ASCII codes from 0x20 to 0x7E have a letter; all others are blank, so that a short text ends with zeros.
 */
#ifndef UP_LETTERS_H
#define UP_LETTERS_H

#include "up_value.h"

#define UP_LETTER_COLUMNS 6U

/* Writes UP_LETTER_COLUMNS bytes for each element of the value. */
void up_letters_encode(UP_ROM up_field_t *field, const void *value, uint8_t *bytes);

#endif
