/*
 * Lines that get a pulse each cycle, so that a device measures.
 */
#ifndef UP_PULSE_H
#define UP_PULSE_H

#include "ch.h"
#include "hal.h"

/* A line that gets a pulse. */
typedef struct {
  ioline_t line;
  uint32_t apart_ms; /* from it to the next line's, which would hear its answer; 0: that follows at once */
} up_pulse_line_t;

/* Lines that get a pulse each cycle: what up_pulse_cycle() works on. */
typedef struct {
  const up_pulse_line_t *lines;
  uint32_t pulse_us;
  uint8_t lines_count;
} up_pulse_t;

void up_pulse_cycle(const void *work);

#endif
