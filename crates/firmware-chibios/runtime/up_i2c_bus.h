/*
 * An I2C bus on ChibiOS as the core sees it (up_bus.h), with finite time-outs. A bus that hangs is freed by hand; one
 * that stays stuck is left alone for a while, so that it delays nothing else.
 */
#ifndef UP_I2C_BUS_H
#define UP_I2C_BUS_H

#include "hal.h"

#include "up_bus.h"
#include "up_chips.h"

/* The state of one bus; all zero at the start. */
typedef struct {
  uint32_t freed;      /* how often it hung and was freed */
  uint32_t kept;       /* how often freeing failed: a wire is held low */
  uint32_t retry_ms;   /* when freeing is tried again */
  uint32_t backoff_ms; /* time between failed attempts; 0 while the bus works */
  systime_t ended;     /* end of the last transfer */
} up_i2c_state_t;

/* One bus, shared by all threads with devices on it. */
typedef struct {
  I2CDriver *driver;
  const I2CConfig *config;
  up_i2c_state_t *state;
  ioline_t scl, sda;
  iomode_t scl_mode, sda_mode; /* restored after the pads were driven by hand */
  uint32_t timeout_ms; /* of a transfer */
} up_i2c_port_t;

/* Starts the driver, after the pads are set up. */
void up_i2c_start(const up_i2c_port_t *port);

/* Whether any device has the address, for an up_probe_t whose bus is an up_i2c_port_t: reads as little as possible. */
bool up_i2c_answers(const void *bus, uint8_t address);

/* For an up_bus_t whose context is an up_i2c_port_t. */
up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count);

#endif
