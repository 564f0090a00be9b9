/*
 * The bytes that LED strips take for the colours of their LEDs.
 *
 * A colour is an unsigned number, such as 0xRRGGBB. `elements` of the coding are the places of its bytes in the order
 * in which they are sent (0 for the lowest), `words` is how many there are.
 *
 * UP_CODE_PULSES is for strips with one wire. Each bit of a colour becomes `bits` bits of the bus, of which the first
 * `low` are high for a 0, and the first `word_bytes` for a 1. A byte before them, and a rest of more than 300 us behind
 * them, are low.
 *
 * UP_CODE_LEDS is for strips with a clock: four bytes of zeros; for each LED its brightness and its colours; and enough
 * zeros for the last LED. The brightness is that of the colour's highest byte, 1 to 31; 0 stands for 31, so that a
 * number without it is as bright as can be.
 */
#ifndef UP_LAMPS_H
#define UP_LAMPS_H

#include "up_value.h"

/* The size of what is sent for `count` colours. */
size_t up_lamps_bytes(UP_ROM up_value_t *how, uint16_t count);

/* Writes up_lamps_bytes() bytes. */
void up_lamps_encode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes);

#endif
