/*
 * Devices on a register bus, I2C or SPI: the work of one thread in its cycle.
 *
 * A single device is a chip with one reading or one command. Readings are passed to up_values. What the host sets is
 * written once for each value received, repeated until it succeeds, and written again after each restart of the chip.
 */
#ifndef UP_CHIPS_H
#define UP_CHIPS_H

#include "up_chip.h"

/* The last write of a command. All zero at the start. */
typedef struct {
  uint32_t sequence; /* of the value, as in up_sequence() */
  uint32_t starts;   /* of the chip at that time */
} up_written_t;

typedef struct {
  const up_chip_t *chip;
  up_chip_state_t *state;
  up_written_t *written; /* one for each command; NULL if there is none */
} up_served_t;

/* The chips of one bus and one cycle, in the order in which they are served: the argument of up_chips_cycle(). */
typedef struct {
  const up_bus_t *bus;
  const up_served_t *chips;
  uint32_t cycle_ms;
  uint8_t chips_count;
} up_chips_t;

/* Runs one cycle. What a chip needs before the next one begins (the pauses of its start, a measurement that takes a
 * while) is done within it, so that its values are as recent as possible. */
void up_chips_cycle(const void *work);

#endif
