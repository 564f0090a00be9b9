/*
 * Devices on serial ports, each with its own: from bytes to values, and back.
 */
#ifndef UP_UART_H
#define UP_UART_H

#include "up_compose.h"
#include "up_message.h"
#include "up_rt.h"

/* All zero at the start. */
typedef struct {
  up_message_start_t start;
  uint32_t heard_ms; /* when the last byte came */
  bool is_silent;    /* for longer than within a message */
} up_uart_state_t;

typedef struct {
  up_uart_state_t *state;
  UP_ROM up_message_init_t *init; /* the bytes that start the device */
  UP_ROM up_message_t *message;   /* from the device; NULL for none */
  up_message_state_t *message_state;
  bool *is_reported; /* one for each value of the message: it was stored in this cycle */
  uint32_t cycle_ms;
  uint16_t gap_ms; /* the silence that ends an unfinished message; 0: messages show where they begin */
  uint8_t init_count;
  uint8_t port;
} up_uart_t;

/* Begins a cycle: the first value of each kind that comes in it is stored. */
uint32_t up_uart_cycle(UP_ROM void *work);

/* Takes what has come: in each turn of the loop, so that the framework's 64 bytes are enough. */
void up_uart_drain(UP_ROM up_uart_t *port);

/* Sends the value of an actuator, whole or not at all. */
void up_uart_send(UP_ROM up_uart_t *port, UP_ROM up_compose_t *how, size_t field, const void *value);

#endif
