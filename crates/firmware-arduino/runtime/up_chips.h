/*
 * Parts on a register bus, I2C or SPI: the work of one task in its cycle.
 *
 * A single device is a chip with one reading or one command. What is set is written once for each value, again until it
 * succeeds, and again after each restart of the chip.
 */
#ifndef UP_CHIPS_H
#define UP_CHIPS_H

#include "up_rt.h"

/* A command that is owed to its chip. All zero at the start. */
typedef struct {
  uint32_t starts; /* of the chip when it was written */
  bool is_set;
  bool is_owed;
} up_order_t;

typedef struct {
  UP_ROM up_chip_t *chip;
  up_chip_state_t *state;
  up_order_t *orders; /* one for each command; NULL for none */
} up_served_t;

/* The chips of one bus and one cycle. */
typedef struct {
  UP_ROM up_bus_t *bus;
  UP_ROM up_served_t *chips;
  uint8_t chips_count;
} up_chips_t;

uint32_t up_chips_cycle(UP_ROM void *work);

/* A value was set: it is written in the next cycle. */
void up_chips_owe(UP_ROM up_served_t *served, uint8_t command);

#endif
