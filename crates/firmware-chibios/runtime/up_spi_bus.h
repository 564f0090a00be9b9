/*
 * An SPI bus on ChibiOS as the core sees it (up_bus.h): a chip select for each device, with its own mode and clock. The
 * address of a transfer is the number of the chip select.
 *
 * The bytes to send may be overwritten by those received: both directions share the work buffer, because a DMA may be
 * unable to reach anything else.
 */
#ifndef UP_SPI_BUS_H
#define UP_SPI_BUS_H

#include "hal.h"

#include "up_bus.h"
#include "up_chips.h"

/* One bus, shared by all threads with devices on it. */
typedef struct {
  SPIDriver *driver;
  const SPIConfig *selects; /* line, mode and clock of each chip select */
  uint32_t timeout_ms;      /* of a transfer */
} up_spi_port_t;

/* Starts the driver, after the pads are set up. */
void up_spi_start(const up_spi_port_t *port);

/* For an up_bus_t whose context is an up_spi_port_t. */
up_bus_result_t up_spi_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_spi_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count);
up_bus_result_t up_spi_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count);

#endif
