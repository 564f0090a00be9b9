/*
 * Lines that get a pulse in each cycle to make a device measure.
 */
#ifndef UP_PULSE_H
#define UP_PULSE_H

#include "ch.h"
#include "hal.h"

/* A line that gets a pulse. */
typedef struct {
  ioline_t line;
  uint32_t apart_ms; /* from it to the next line's, which would hear its answer; 0: the next follows at once */
} up_pulse_line_t;

/* Lines that get a pulse in each cycle: the argument of up_pulse_cycle(). */
typedef struct {
  const up_pulse_line_t *lines;
  uint32_t pulse_us;
  uint8_t lines_count;
} up_pulse_t;

void up_pulse_cycle(const void *work);

#endif
