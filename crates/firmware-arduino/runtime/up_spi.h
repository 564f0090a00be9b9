/*
 * The SPI bus, by the framework's SPI.
 */
#ifndef UP_SPI_H
#define UP_SPI_H

#include "up_bus.h"
#include "up_rom.h"

#if defined(__cplusplus)
extern "C" {
#endif

/* How a part is selected and spoken to. */
typedef struct {
  uint32_t clock_hz; /* at most */
  uint8_t mode;      /* 0 to 3 */
  uint8_t pin;       /* of its chip select; UP_NO_PIN for none */
} up_spi_select_t;
#define UP_NO_PIN 255U

void up_spi_start(void);

/* Reads one of the generated table. */
void sense_spi_select(uint8_t number, up_spi_select_t *select);

/* As in up_bus_t; the address is the number of the part. */
up_bus_result_t up_spi_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_spi_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count);
up_bus_result_t up_spi_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count);

#if defined(__cplusplus)
}
#endif

#endif
