/*
 * Wires with 1-Wire parts or one of the DHT22's sort, on plain pins with a pull-up resistor.
 */
#ifndef UP_ONEWIRE_BUS_H
#define UP_ONEWIRE_BUS_H

#include "ch.h"
#include "hal.h"

#include "up_chips.h"
#include "up_onewire.h"

/* A part on a wire. */
typedef struct {
  const uint8_t *rom; /* 1-Wire: the address; NULL if it is alone on its wire */
  uint16_t pulse_us;  /* the pulse that a part of the DHT22's sort answers; 0: it is a 1-Wire part */
  uint8_t trigger;    /* 1-Wire: the first byte of what starts a measurement, after which it says that it is busy; 0:
                       * nothing does */
} up_onewire_part_t;

/* The state of a wire; all zero before its start. */
typedef struct {
  mutex_t mutex;
  volatile uint8_t falls_count;
  uint32_t falls[UP_BURST_FALLS]; /* in ticks, then in microseconds */
} up_onewire_state_t;

/* A wire: the context of its bus. The address of a part is its place in `parts`. */
typedef struct {
  ioline_t line;
  const up_onewire_part_t *parts;
  up_onewire_state_t *state;
} up_onewire_port_t;

void up_onewire_start(const up_onewire_port_t *port);

up_bus_result_t up_onewire_write(void *context, uint8_t address, const uint8_t *bytes, size_t count);
up_bus_result_t up_onewire_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                      size_t rx_count);

#endif
