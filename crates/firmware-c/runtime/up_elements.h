/*
 * When an array is told whose elements are measured one by one.
 *
 * It is told once each element has been measured, and then with the first new one, or only when all are new: so that
 * a distance of one ranger that answers no more does not look like a measurement of now.
 */
#ifndef UP_ELEMENTS_H
#define UP_ELEMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Element `index` has a new value. `flags` has one for each element, all zero at the start. */
void up_elements_note(uint8_t *flags, size_t index);

/* True when the array is to be told; what was new is then old. `is_complete`: only when all are new. */
bool up_elements_are_due(uint8_t *flags, size_t count, bool is_complete);

#endif
