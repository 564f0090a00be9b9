/*
 * Devices on serial ports. Each has its own port; interrupts fill its queue, and a thread takes messages out of it as
 * they come.
 */
#ifndef UP_UART_H
#define UP_UART_H

#include "up_rt.h"

#if HAL_USE_SERIAL == TRUE

#include "up_compose.h"
#include "up_message.h"

/* M (or M0) of USART_CR1: with a parity bit, eight bits remain for data. */
#define UP_UART_NINE_BITS 0x1000U

/* All zero at the start. */
typedef struct {
  up_message_start_t start;
  event_listener_t listener;
  uint32_t heard_ms; /* when the last byte was received */
  bool is_listening;
  bool is_silent; /* for longer than within a message */
} up_uart_state_t;

/* A port with a device: the argument of up_uart_cycle(). */
typedef struct {
  SerialDriver *driver;
  const SerialConfig *config;
  up_uart_state_t *state;
  /* The bytes that start the device. */
  const up_message_init_t *init;
  /* The messages from the device; NULL for none. */
  const up_message_t *message;
  up_message_state_t *message_state;
  bool *is_reported; /* one per value of the message: it was stored in this cycle */
  uint32_t cycle_ms;
  uint16_t gap_ms; /* the silence that ends an unfinished message; 0: messages show where they begin */
  uint8_t init_count;
} up_uart_t;

void up_uart_start(const up_uart_t *port);

/* Takes what is received during a cycle, and stores the first value of each kind. */
void up_uart_cycle(const void *work);

/* Sends the value of an actuator, whole or not at all. From the reporter. */
void up_uart_send(const up_uart_t *port, const up_compose_t *how, size_t field, const void *value);

#endif
#endif
