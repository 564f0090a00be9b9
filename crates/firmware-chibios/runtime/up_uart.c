/* Serial devices: from a port's queue to values, and back. */
#include "up_uart.h"

#if HAL_USE_SERIAL == TRUE

/* The number of bytes that are taken out of the queue at a time. */
#define CHUNK_BYTES 16U

/* After this silence a device may have lost its supply, and its settings with it. */
#define FORGOTTEN_MS 5000U

#define FAULTS (SD_PARITY_ERROR | SD_FRAMING_ERROR | SD_OVERRUN_ERROR | SD_QUEUE_FULL_ERROR)

/* The message that is put together. Only the reporter sends, so one buffer serves all ports. */
static uint8_t sent[UP_UART_SEND_BYTES_MAX];

void up_uart_start(const up_uart_t *port) {
  (void)sdStart(port->driver, port->config);
}

/* ---- receiving ---- */

/* The first value of a cycle is stored, because it is due then; all faults are counted. */
static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  const up_uart_t *port = context;
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

/* Damaged characters and lost ones are faults of all values of the port. */
static void count_faults(const up_uart_t *port) {
  uint8_t i;

  if (!port->state->is_listening) {
    /* What came before the thread listened is not a fault. */
    chEvtRegisterMaskWithFlags(chnGetEventSource(port->driver), &port->state->listener, EVENT_MASK(0), FAULTS);
    port->state->is_listening = true;
  } else if (chEvtGetAndClearFlags(&port->state->listener) != 0U) {
    for (i = 0U; i < port->message->fields_count; i++) {
      up_result(port->message->fields[i].field, UP_BUS_ERROR, NULL);
    }
  }
}

static void take(const up_uart_t *port, const uint8_t *bytes, size_t count) {
  const up_value_sink_t sink = {.on_value = on_value, .context = (void *)(uintptr_t)port};

  port->state->heard_ms = up_now_ms();
  port->state->is_silent = false;
  up_message_feed(port->message, port->message_state, up_config.schema, bytes, count, &sink);
}

/* Waits for a byte for at most `wait_ms`, and takes everything that is there. */
static void listen(const up_uart_t *port, uint32_t wait_ms) {
  uint8_t bytes[CHUNK_BYTES];
  size_t count = sdReadTimeout(port->driver, bytes, 1U, UP_MS2I(wait_ms));

  if (count == 0U) {
    if (port->gap_ms > 0U && !port->state->is_silent && wait_ms >= port->gap_ms) {
      up_message_gap(port->message_state);
      port->state->is_silent = true;
    }
    return;
  }
  while (count > 0U) {
    take(port, bytes, count);
    count = sdReadTimeout(port->driver, bytes, sizeof bytes, TIME_IMMEDIATE);
  }
}

/* ---- sending ---- */

/* Sends the bytes that are due from the steps that start the device. */
static void set_up(const up_uart_t *port) {
  const up_message_init_t *step;

  if (port->message != NULL && up_now_ms() - port->state->heard_ms >= FORGOTTEN_MS + port->cycle_ms) {
    port->state->heard_ms = up_now_ms();
    port->state->start = (up_message_start_t){.at = 0U};
  }
  while ((step = up_message_start(port->init, port->init_count, &port->state->start, up_now_ms())) != NULL) {
    if (step->count > 0U) {
      (void)sdWrite(port->driver, step->bytes, step->count);
    }
  }
}

void up_uart_send(const up_uart_t *port, const up_compose_t *how, size_t field, const void *value) {
  const size_t count = up_compose(how, &up_config.schema->fields[field], value, sent, sizeof sent);
  bool has_room;

  chSysLock();
  has_room = oqGetEmptyI(&port->driver->oqueue) >= count;
  chSysUnlock();
  if (count > 0U && has_room) {
    (void)sdWriteTimeout(port->driver, sent, count, TIME_IMMEDIATE);
    up_result(field, UP_NOTHING, NULL);
  } else {
    up_result(field, UP_BUS_ERROR, NULL);
  }
}

/* ---- the thread ---- */

void up_uart_cycle(const void *work) {
  const up_uart_t *port = work;
  const uint32_t begin_ms = up_now_ms();
  uint32_t passed_ms = 0U;
  uint8_t i;

  set_up(port);
  if (port->message == NULL) {
    return;
  }
  for (i = 0U; i < port->message->fields_count; i++) {
    port->is_reported[i] = false;
  }
  count_faults(port);
  /* The last millisecond is left for the code that keeps the cycles apart. */
  while (passed_ms + 1U < port->cycle_ms) {
    const uint32_t left_ms = port->cycle_ms - 1U - passed_ms;

    listen(port, (port->gap_ms > 0U && port->gap_ms < left_ms) ? port->gap_ms : left_ms);
    passed_ms = up_now_ms() - begin_ms;
  }
}

#endif
