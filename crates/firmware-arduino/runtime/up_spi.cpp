#include "up_spi.h"

#include <Arduino.h>
#include <SPI.h>

/* Sent when there is nothing to send: the wire stays high. */
#define FILLER 0xFF

static void take(uint8_t address, up_spi_select_t *select) {
  static const uint8_t modes[] = {SPI_MODE0, SPI_MODE1, SPI_MODE2, SPI_MODE3};

  sense_spi_select(address, select);
  SPI.beginTransaction(SPISettings(select->clock_hz, MSBFIRST, modes[select->mode & 3U]));
  if (select->pin != UP_NO_PIN) {
    digitalWrite(select->pin, LOW);
  }
}

static void give(const up_spi_select_t *select) {
  if (select->pin != UP_NO_PIN) {
    digitalWrite(select->pin, HIGH);
  }
  SPI.endTransaction();
}

void up_spi_start(void) {
  SPI.begin();
}

up_bus_result_t up_spi_exchange(void *context, uint8_t address, const uint8_t *tx, uint8_t *rx, size_t count) {
  up_spi_select_t select;
  size_t i;

  (void)context;
  take(address, &select);
  for (i = 0; i < count; i++) {
    rx[i] = SPI.transfer(tx[i]);
  }
  give(&select);
  return UP_BUS_DONE;
}

up_bus_result_t up_spi_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  up_spi_select_t select;
  size_t i;

  (void)context;
  take(address, &select);
  for (i = 0; i < count; i++) {
    (void)SPI.transfer(bytes[i]);
  }
  give(&select);
  return UP_BUS_DONE;
}

up_bus_result_t up_spi_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
  up_spi_select_t select;
  size_t i;

  (void)context;
  take(address, &select);
  for (i = 0; i < tx_count; i++) {
    (void)SPI.transfer(tx[i]);
  }
  for (i = 0; i < rx_count; i++) {
    rx[i] = SPI.transfer(FILLER);
  }
  give(&select);
  return UP_BUS_DONE;
}
