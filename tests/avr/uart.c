/*
 * Serial ports: bytes of the program out and others in, in the time of their frames.
 *
 * simavr's frames have a bit too many, and it hands a byte on before it is sent. A frame that is not set up as the
 * other end's is garbled here.
 */
#include "talk.h"

#include <string.h>

#define STATUS 0U
#define CONTROL 1U
#define FORMAT 2U
#define RATE 4U
#define DATA 6U
/* UCSRnA */
#define RECEIVED 7U
#define SENT 6U
#define EMPTY 5U
#define FRAME_ERROR 4U
#define OVERRUN 3U
#define DOUBLED 1U
#define MULTI 0U
/* UCSRnB */
#define ON_RECEIVED 7U
#define ON_SENT 6U
#define ON_EMPTY 5U
#define RECEIVES 4U
#define SENDS 3U
#define NINTH_SIZE 2U
/* UCSRnC */
#define STOP_BITS 3U
/* The receiver's own two bytes, and the one in its shift register. */
#define ROOM 3U
#define RATE_MASK 0xFFFU
/* A receiver loses its place in a frame where the clocks differ by more, in per mille. ATmega328P, table 20-3. */
#define FAR_PERMILLE 45U
#define QUEUE 65536U

typedef struct {
  uint8_t byte;
  bool is_framed;
} frame_t;

typedef struct {
  bool is_there;
  bool is_link;
  unsigned unit;
  uint16_t base;
  serial_t other;
  serial_t told;
  frame_t frames[ROOM];
  unsigned frame_count;
  bool is_sending;
  bool has_next;
  uint8_t sending;
  uint8_t next;
  bool is_listening;
} uart_t;

static uart_t uarts[UARTS];
static uint8_t queue[QUEUE];
static size_t queue_start;
static size_t queue_count;

static uint32_t bit_cycles(const uart_t *uart) {
  const unsigned rate = (avr->data[uart->base + RATE] | (unsigned)avr->data[uart->base + RATE + 1] << 8) & RATE_MASK;

  return (rate + 1) * (is_set(uart->base + STATUS, DOUBLED) ? 8 : 16);
}

static serial_t setting_of(const uart_t *uart) {
  const uint8_t format = avr->data[uart->base + FORMAT];
  const unsigned size = (format >> 1 & 3U) | (is_set(uart->base + CONTROL, NINTH_SIZE) ? 4U : 0);
  const unsigned parity = format >> 4 & 3U;

  return (serial_t){.is_known = true,
                    .baud = avr->frequency / bit_cycles(uart),
                    .data_bits = (uint8_t)(size == 7 ? 9 : 5 + (size & 3U)),
                    .parity = (uint8_t)(parity < 2 ? 0 : parity - 1),
                    .stop_bits = is_set(uart->base + FORMAT, STOP_BITS) ? 2 : 1};
}

static uint64_t frame_cycles(const uart_t *uart) {
  const serial_t own = setting_of(uart);

  return (uint64_t)bit_cycles(uart) * (1U + own.data_bits + (own.parity != 0 ? 1U : 0U) + own.stop_bits);
}

/* Whether both ends understand each other. More stop bits than wanted are a pause. */
static bool agrees(const uart_t *uart) {
  const serial_t own = setting_of(uart);
  const serial_t *const other = &uart->other;
  const uint32_t apart = own.baud > other->baud ? own.baud - other->baud : other->baud - own.baud;

  return !other->is_known || ((uint64_t)apart * 1000 <= (uint64_t)other->baud * FAR_PERMILLE &&
                              own.data_bits == other->data_bits && own.parity == other->parity);
}

/* Not on the way to a setting. */
static void tell_own(uart_t *uart) {
  const serial_t own = setting_of(uart);

  if (!is_set(uart->base + CONTROL, SENDS) && !is_set(uart->base + CONTROL, RECEIVES)) {
    return;
  }
  if (own.baud != uart->told.baud || own.data_bits != uart->told.data_bits || own.parity != uart->told.parity ||
      own.stop_bits != uart->told.stop_bits) {
    uart->told = own;
    tell_setting('u', uart->unit, own.baud, own.data_bits, own.parity, own.stop_bits);
  }
}

static avr_cycle_count_t on_sent(avr_t *of, avr_cycle_count_t when, void *subject);

static void send(uart_t *uart, uint8_t byte, uint64_t cycle) {
  uart->is_sending = true;
  uart->sending = byte;
  tell_own(uart);
  put(uart->base + STATUS, EMPTY, true);
  alarm_at(cycle + frame_cycles(uart), on_sent, uart);
}

static avr_cycle_count_t on_sent(avr_t *of, avr_cycle_count_t when, void *subject) {
  uart_t *const uart = subject;
  const uint8_t byte = agrees(uart) ? uart->sending : (uint8_t)~uart->sending;

  (void)of;
  uart->is_sending = false;
  if (uart->is_link) {
    tell_link(byte, when);
  } else {
    tell_uart(uart->unit, byte, when);
  }
  if (uart->has_next) {
    uart->has_next = false;
    send(uart, uart->next, when);
  } else {
    put(uart->base + STATUS, SENT, true);
  }
  requests_look();
  return 0;
}

static void write_data(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  uart_t *const uart = subject;

  (void)address;
  if (!is_set(uart->base + CONTROL, SENDS)) {
    return;
  }
  if (!uart->is_sending) {
    send(uart, value, of->cycle);
  } else if (!uart->has_next) {
    uart->has_next = true;
    uart->next = value;
    put(uart->base + STATUS, EMPTY, false);
  }
}

/* The status of the byte that is read next. */
static void show_frame(uart_t *uart) {
  put(uart->base + STATUS, RECEIVED, uart->frame_count > 0);
  put(uart->base + STATUS, FRAME_ERROR, uart->frame_count > 0 && !uart->frames[0].is_framed);
}

static uint8_t read_data(avr_t *of, avr_io_addr_t address, void *subject) {
  uart_t *const uart = subject;
  uint8_t byte = of->data[address];

  if (uart->frame_count > 0) {
    byte = uart->frames[0].byte;
    uart->frame_count--;
    memmove(uart->frames, uart->frames + 1, uart->frame_count * sizeof uart->frames[0]);
    put(uart->base + STATUS, OVERRUN, false);
  }
  show_frame(uart);
  return byte;
}

static bool next_of_link(uint8_t *byte) {
  if (queue_count == 0) {
    return false;
  }
  *byte = queue[queue_start];
  queue_start = (queue_start + 1) % QUEUE;
  queue_count--;
  return true;
}

static avr_cycle_count_t on_frame(avr_t *of, avr_cycle_count_t when, void *subject) {
  uart_t *const uart = subject;
  uint8_t byte = 0;
  const bool is_there = uart->is_link ? next_of_link(&byte) : ask_uart(uart->unit, when, &byte);
  const bool is_framed = agrees(uart);

  (void)of;
  if (is_there && uart->frame_count == ROOM) {
    put(uart->base + STATUS, OVERRUN, true);
  } else if (is_there) {
    uart->frames[uart->frame_count++] = (frame_t){.byte = is_framed ? byte : (uint8_t)~byte, .is_framed = is_framed};
    show_frame(uart);
    requests_look();
  }
  /* A link without bytes is asked again when there are some. */
  if (uart->is_link && queue_count == 0) {
    uart->is_listening = false;
  } else {
    alarm_at(when + frame_cycles(uart), on_frame, uart);
  }
  return 0;
}

static void listen(uart_t *uart) {
  const bool has_other = uart->is_link ? queue_count > 0 : uart->other.is_known;

  if (!is_set(uart->base + CONTROL, RECEIVES)) {
    uart->is_listening = false;
    uart->frame_count = 0;
    show_frame(uart);
    /* What comes while nobody listens is gone. */
    queue_count = uart->is_link ? 0 : queue_count;
    alarm_off(on_frame, uart);
  } else if (has_other && !uart->is_listening) {
    uart->is_listening = true;
    alarm_at(avr->cycle + frame_cycles(uart), on_frame, uart);
  }
}

static void write_status(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const uint8_t settings = bit(DOUBLED) | bit(MULTI);
  uint8_t kept = of->data[address] & (uint8_t)~settings;

  if ((written_bits(value) & bit(SENT)) != 0) {
    kept &= (uint8_t)~bit(SENT);
  }
  of->data[address] = (uint8_t)(kept | (value & settings));
  tell_own(subject);
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  of->data[address] = value;
  listen(subject);
  tell_own(subject);
  requests_look();
}

static void write_setting(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  of->data[address] = value;
  tell_own(subject);
}

void link_received(const uint8_t *bytes, size_t count) {
  for (size_t at = 0; at < count && queue_count < QUEUE; at++) {
    queue[(queue_start + queue_count++) % QUEUE] = bytes[at];
  }
  for (unsigned unit = 0; unit < UARTS; unit++) {
    if (uarts[unit].is_there && uarts[unit].is_link) {
      listen(&uarts[unit]);
      return;
    }
  }
  usb_take(bytes, count);
}

void uart_connect(unsigned unit, serial_t setting, bool is_link) {
  uarts[unit].other = setting;
  uarts[unit].is_link = is_link;
}

void uarts_reset(void) {
  for (unsigned unit = 0; unit < UARTS; unit++) {
    uart_t *const uart = &uarts[unit];

    if (uart->is_there) {
      uart->frame_count = 0;
      uart->is_sending = false;
      uart->has_next = false;
      uart->is_listening = false;
      uart->told = (serial_t){.is_known = false};
      avr->data[uart->base + STATUS] = bit(EMPTY);
      avr->data[uart->base + FORMAT] = 6; /* 8 bits */
    }
  }
  queue_count = 0;
}

static void init_uart(uart_t *uart, unsigned unit) {
  const uint8_t vector = part->uarts[unit].vector;

  uart->is_there = true;
  uart->unit = unit;
  uart->base = part->uarts[unit].base;
  request_new(vector, uart->base + STATUS, RECEIVED, uart->base + CONTROL, ON_RECEIVED, true);
  request_new((uint8_t)(vector + 1), uart->base + STATUS, EMPTY, uart->base + CONTROL, ON_EMPTY, true);
  request_new((uint8_t)(vector + 2), uart->base + STATUS, SENT, uart->base + CONTROL, ON_SENT, false);
  avr_register_io_write(avr, uart->base + STATUS, write_status, uart);
  avr_register_io_write(avr, uart->base + CONTROL, write_control, uart);
  avr_register_io_write(avr, uart->base + FORMAT, write_setting, uart);
  avr_register_io_write(avr, uart->base + RATE, write_setting, uart);
  avr_register_io_write(avr, uart->base + RATE + 1, write_setting, uart);
  avr_register_io_write(avr, uart->base + DATA, write_data, uart);
  avr_register_io_read(avr, uart->base + DATA, read_data, uart);
}

void uarts_init(void) {
  for (unsigned unit = 0; unit < UARTS; unit++) {
    if (part->uarts[unit].base != 0) {
      init_uart(&uarts[unit], unit);
    }
  }
}
