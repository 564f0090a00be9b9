/*
 * Devices on a register bus, I2C or SPI: what one thread does in its cycle.
 *
 * A device by itself is a chip with one reading or one command. What was read goes to up_values; what the host set is
 * written once for each value that came, again until it is through, and again after the chip had to be started anew.
 */
#ifndef UP_CHIPS_H
#define UP_CHIPS_H

#include "up_chip.h"

/* Of a command: what was written last. All zero at the start. */
typedef struct {
  uint32_t sequence; /* of the value, as up_sequence() counts */
  uint32_t starts;   /* of the chip at that time, as it counts them */
} up_written_t;

typedef struct {
  const up_chip_t *chip;
  up_chip_state_t *state;
  up_written_t *written; /* one for each command; NULL where there is none */
} up_served_t;

/* The chips of one bus with one cycle, in the order in which they are served: what up_chips_cycle() works on. */
typedef struct {
  const up_bus_t *bus;
  const up_served_t *chips;
  uint32_t cycle_ms;
  uint8_t chips_count;
} up_chips_t;

/* One cycle. What a chip wants before the next one begins (the pauses of its start, a measurement that takes a while)
 * is done within it, so that its values are as young as they can be. */
void up_chips_cycle(const void *work);

#endif
