/*
 * From the value of a PWM output to its pulse width.
 *
 * A value goes from 0 (the shortest pulse) to 10000 (the longest); values beyond saturate.
 */
#ifndef UP_PULSE_WIDTH_H
#define UP_PULSE_WIDTH_H

#include "up_schema.h"

#define UP_LEVEL_FULL 10000U

/* Both are at most 65535, so that nothing overflows. */
typedef struct {
  uint32_t least_ticks;    /* the pulse at 0 */
  uint32_t greatest_ticks; /* the pulse at 10000 */
} up_pulse_width_t;

/* The value of one element, rounded. Negative numbers and NaN are 0. */
uint32_t up_pulse_level(uint8_t type, const void *element);

/* The width of a pulse, rounded. */
uint32_t up_pulse_ticks(UP_ROM up_pulse_width_t *width, uint32_t level);

#endif
