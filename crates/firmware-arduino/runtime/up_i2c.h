/*
 * The I2C bus, by the framework's Wire: transfers end, whatever holds the wires.
 */
#ifndef UP_I2C_H
#define UP_I2C_H

#include "up_bus.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* Wire sends and reads no more in one transfer. */
#define UP_I2C_BYTES_MAX 32U

void up_i2c_start(uint32_t speed_hz);

/* As in up_bus_t; the context is not used. */
up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count);

#if defined(__cplusplus)
}
#endif

#endif
