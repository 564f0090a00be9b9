/*
 * When to report an array whose elements are measured one by one.
 *
 * It is first reported when every element has been measured. After that it is reported with the first new element, or
 * only when all are new, so that the distance from a ranger that no longer answers does not look current.
 */
#ifndef UP_ELEMENTS_H
#define UP_ELEMENTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Notes that element `index` has a new value. `flags` has one for each element, all zero at the start. */
void up_elements_note(uint8_t *flags, size_t index);

/* True if the array must be reported; its elements then no longer count as new. `is_complete`: only when all are
 * new. */
bool up_elements_are_due(uint8_t *flags, size_t count, bool is_complete);

#endif
