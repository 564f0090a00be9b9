/*
 * A bus with register devices, I2C or SPI, as the core sees it.
 *
 * A system provides one of these for each bus (for SPI, with its chip selects). The functions return when the transfer
 * is over, with a time-out of their own; their arguments stay valid for that long. Both buffers are in the caller's
 * work buffer, never in constant tables or on a stack, because a DMA must reach them.
 */
#ifndef UP_BUS_H
#define UP_BUS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "up_result.h"

/* The outcome of a transfer: UP_BUS_DONE, or the cause that is reported for all values in it. */
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
  /* Sends `tx_count` bytes (0: none), then reads `rx_count`, at least 1, without releasing the device in between: a
   * repeated start, or one chip select around both. */
  up_bus_result_t (*write_read)(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                size_t rx_count);
  /* SPI only (NULL on I2C): sends `count` bytes and receives as many at the same time. */
  up_bus_result_t (*exchange)(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count);
  void *context;
} up_bus_t;

#endif
