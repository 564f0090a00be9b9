#include "up_uart.h"

#include "sense_model.h"
#include "up_ports.h"

#define CHUNK_BYTES 16U

/* After this silence a device may have lost its supply, and its settings with it. */
#define FORGOTTEN_MS 5000U

/* ---- receiving ---- */

/* The first value of a cycle is stored, because it is due then; all faults are counted. */
static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  UP_ROM up_uart_t *port = *(UP_ROM up_uart_t **)context;
  uint8_t i;

  for (i = 0U; i < port->message->fields_count; i++) {
    if (port->message->fields[i].field == field && result == UP_FRESH) {
      if (port->is_reported[i]) {
        return;
      }
      port->is_reported[i] = true;
    }
  }
  up_result(field, result, value);
}

static void note_silence(UP_ROM up_uart_t *port) {
  if (port->gap_ms > 0U && !port->state->is_silent && up_now_ms() - port->state->heard_ms >= port->gap_ms) {
    up_message_gap(port->message_state);
    port->state->is_silent = true;
  }
}

void up_uart_drain(UP_ROM up_uart_t *port) {
  const up_value_sink_t sink = {.on_value = on_value, .context = &port};
  uint8_t bytes[CHUNK_BYTES];
  uint8_t count = (uint8_t)sense_port_read(port->port, bytes, sizeof bytes);

  if (count == 0U) {
    note_silence(port);
    return;
  }
  /* Two messages that come in one piece are still told apart by the silence before them. */
  note_silence(port);
  while (count > 0U) {
    port->state->heard_ms = up_now_ms();
    port->state->is_silent = false;
    up_message_feed(port->message, port->message_state, &sense_schema, bytes, count, &sink);
    count = (uint8_t)sense_port_read(port->port, bytes, sizeof bytes);
  }
}

/* ---- sending ---- */

/* A text of program memory has no pointer that the port could take: it is sent in pieces. */
static void send_rom(UP_ROM up_uart_t *port, UP_ROM uint8_t *bytes, uint8_t count) {
  uint8_t piece[CHUNK_BYTES];

  while (count > 0U) {
    const uint8_t size = (count < CHUNK_BYTES) ? count : CHUNK_BYTES;

    up_rom_copy(piece, bytes, size);
    (void)sense_port_write(port->port, piece, size);
    bytes += size;
    count = (uint8_t)(count - size);
  }
}

/* Sends what is due of the steps that start the device. */
static void set_up(UP_ROM up_uart_t *port) {
  UP_ROM up_message_init_t *step;

  if (port->message != UP_ROM_NULL && up_now_ms() - port->state->heard_ms >= FORGOTTEN_MS + port->cycle_ms) {
    port->state->heard_ms = up_now_ms();
    port->state->start = (up_message_start_t){.at = 0U};
  }
  while ((step = up_message_start(port->init, port->init_count, &port->state->start, up_now_ms())) != UP_ROM_NULL) {
    send_rom(port, step->bytes, step->count);
  }
}

void up_uart_send(UP_ROM up_uart_t *port, UP_ROM up_compose_t *how, size_t field, const void *value) {
  uint8_t sent[UP_UART_SEND_BYTES_MAX];
  const size_t count = up_compose(how, &sense_schema.fields[field], value, sent, sizeof sent);

  if (count > 0U && sense_port_write(port->port, sent, count)) {
    up_result(field, UP_NOTHING, NULL);
  } else {
    up_result(field, UP_BUS_ERROR, NULL);
  }
}

uint32_t up_uart_cycle(UP_ROM void *work) {
  UP_ROM up_uart_t *port = work;
  uint8_t i;

  set_up(port);
  for (i = 0U; port->message != UP_ROM_NULL && i < port->message->fields_count; i++) {
    port->is_reported[i] = false;
  }
  return 0U;
}
