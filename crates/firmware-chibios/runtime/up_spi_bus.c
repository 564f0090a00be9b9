#include "up_rt.h"

#include <string.h>

#if HAL_USE_SPI == TRUE

#include "up_spi_bus.h"

/* Sent when there is nothing to send: the wire stays high. */
#define FILLER 0xFF

static up_bus_result_t run(const up_spi_port_t *port, const uint8_t *tx, uint8_t *rx, size_t count) {
  msg_t message = spiStartExchange(port->driver, count, tx, rx);

  if (message == MSG_OK) {
    message = spiSynchronize(port->driver, UP_MS2I(port->timeout_ms));
  }
  if (message == MSG_TIMEOUT) {
    (void)spiStopTransfer(port->driver, NULL);
    return UP_BUS_TIMED_OUT;
  }
  return (message == MSG_OK) ? UP_BUS_DONE : UP_BUS_ERROR;
}

/* The bytes sent are overwritten by those received, which is safe: each byte is sent before the one at its place
 * arrives. */
static up_bus_result_t run_in_place(const up_spi_port_t *port, const uint8_t *bytes, size_t count) {
  return run(port, bytes, (uint8_t *)(uintptr_t)bytes, count);
}

static void take(const up_spi_port_t *port, uint8_t address) {
  const SPIConfig *config = &port->selects[address];

  spiAcquireBus(port->driver);
  if (port->driver->config != config) {
    (void)spiStart(port->driver, config);
  }
  if (config->ssline != PAL_NOLINE) {
    spiSelect(port->driver);
  }
}

static void give(const up_spi_port_t *port) {
  if (port->driver->config->ssline != PAL_NOLINE) {
    spiUnselect(port->driver);
  }
  spiReleaseBus(port->driver);
}

void up_spi_start(const up_spi_port_t *port) {
  (void)spiStart(port->driver, &port->selects[0]);
}

up_bus_result_t up_spi_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  up_bus_result_t result;

  take(context, address);
  result = run_in_place(context, bytes, count);
  give(context);
  return result;
}

up_bus_result_t up_spi_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
  up_bus_result_t result = UP_BUS_DONE;

  memset(rx, FILLER, rx_count);
  take(context, address);
  if (tx_count > 0U) {
    result = run_in_place(context, tx, tx_count);
  }
  if (result == UP_BUS_DONE) {
    result = run_in_place(context, rx, rx_count);
  }
  give(context);
  return result;
}

up_bus_result_t up_spi_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count) {
  up_bus_result_t result;

  take(context, address);
  result = run(context, tx, rx, count);
  give(context);
  return result;
}

#endif
