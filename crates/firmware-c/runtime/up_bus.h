/*
 * A bus with register devices on it, as the core sees it: I2C or SPI.
 *
 * A system fills one of these for each bus (for SPI, with the chip selects behind it). The functions wait until the
 * transfer is over, with a time-out of their own; what they are given stays valid for so long. Both buffers lie in the
 * work buffer of whoever calls, never in constant tables or on a stack: a DMA must reach them.
 */
#ifndef UP_BUS_H
#define UP_BUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "up_result.h"

/* What a transfer came to: UP_BUS_DONE, or the cause that is told of all values in it. */
typedef up_result_t up_bus_result_t;
#define UP_BUS_DONE UP_FRESH
#define UP_BUS_NOT_ACKNOWLEDGED UP_NOT_ACKNOWLEDGED /* I2C only */
#define UP_BUS_ARBITRATION_LOST UP_ARBITRATION_LOST /* I2C only */
#define UP_BUS_TIMED_OUT UP_TIMED_OUT
/* and UP_BUS_ERROR */

/* `address` is the 7-bit address on I2C, and the number of the chip select on SPI as the system counts them. */
typedef struct {
  /* Sends `count` bytes, at least 1. */
  up_bus_result_t (*write)(void *context, uint8_t address, const uint8_t *bytes, size_t count);
  /* Sends `tx_count` bytes (0: none), then reads `rx_count`, at least 1, without letting go of the device between
   * them: a repeated start, or one chip select around both. */
  up_bus_result_t (*write_read)(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                size_t rx_count);
  /* SPI only (NULL on I2C): sends `count` bytes while as many are received. */
  up_bus_result_t (*exchange)(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count);
  void *context;
} up_bus_t;

#endif
