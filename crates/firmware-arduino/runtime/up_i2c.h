/*
 * The I2C bus, by the registers of the unit: transfers end, whatever holds the wires, and take no buffers and no
 * interrupts. The framework's Wire must not be used beside it.
 */
#ifndef UP_I2C_H
#define UP_I2C_H

#include "up_bus.h"

void up_i2c_start(uint32_t speed_hz);

/* As in up_bus_t; the context is not used. */
up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count);

#endif
