/*
 * The messages: bytes of the world's side in, calls of the board's units out, and back.
 *
 * A message is a letter and fields of fixed sizes, the lowest byte first. The world's side speaks first; while the
 * board runs, it asks and tells, and says when it is done.
 */
#include "talk.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define ROOM 65536U
#define REASON_ROOM 200U
#define FLOATING_CODE 2U

static int in_fd;
static int out_fd;
static uint8_t in_bytes[ROOM];
static size_t in_at;
static size_t in_end;
static uint8_t out_bytes[ROOM];
static size_t out_count;

void talk_on(int in, int out) {
  in_fd = in;
  out_fd = out;
}

static void send_all(void) {
  size_t at = 0;

  while (at < out_count) {
    const ssize_t sent = write(out_fd, out_bytes + at, out_count - at);

    if (sent < 0 && errno != EINTR) {
      exit(EXIT_FAILURE);
    }
    at += sent > 0 ? (size_t)sent : 0;
  }
  out_count = 0;
}

static void put_bytes(const void *bytes, size_t count) {
  if (out_count + count > ROOM) {
    send_all();
  }
  memcpy(out_bytes + out_count, bytes, count);
  out_count += count;
}

static void put_number(uint64_t value, size_t size) {
  uint8_t bytes[8];

  for (size_t at = 0; at < size; at++) {
    bytes[at] = (uint8_t)(value >> (8 * at));
  }
  put_bytes(bytes, size);
}

static void put_letter(char letter) {
  put_number((uint8_t)letter, 1);
}

static void put_pad(pad_t pad) {
  put_number((uint64_t)(pad.port - 'A'), 1);
  put_number(pad.pin, 1);
}

/* The next byte; the end of the world is the end of the board. */
static uint8_t get(void) {
  while (in_at == in_end) {
    const ssize_t count = read(in_fd, in_bytes, ROOM);

    if (count == 0 || (count < 0 && errno != EINTR)) {
      exit(EXIT_SUCCESS);
    }
    in_at = 0;
    in_end = count > 0 ? (size_t)count : 0;
  }
  return in_bytes[in_at++];
}

static uint64_t get_number(size_t size) {
  uint64_t value = 0;

  for (size_t at = 0; at < size; at++) {
    value |= (uint64_t)get() << (8 * at);
  }
  return value;
}

static level_t get_level(void) {
  const uint8_t code = get();

  return code == FLOATING_CODE ? FLOATING : code == 0 ? LOW : HIGH;
}

/* Pads whose levels, or the next edges of them, have changed. */
static void get_levels(void) {
  const unsigned count = (unsigned)get_number(2);

  for (unsigned at = 0; at < count; at++) {
    pad_t pad = {.port = (char)('A' + get())};
    level_t level;
    uint64_t next_ns;

    pad.pin = get();
    level = get_level();
    next_ns = get_number(8);
    pin_set_outside(pad, level, next_ns, get_level());
  }
}

uint32_t ask_microvolts(pad_t pad, unsigned input, uint64_t cycle) {
  put_letter('a');
  if (pad.port == 0) {
    put_number(UINT8_MAX, 1);
    put_number(input, 1);
  } else {
    put_pad(pad);
  }
  put_number(ns_of(cycle), 8);
  send_all();
  return (uint32_t)get_number(4);
}

void ask_edge(pad_t pad, uint64_t after_ns) {
  put_letter('e');
  put_pad(pad);
  put_number(after_ns, 8);
  send_all();
  get_levels();
}

void ask_driven(pad_t pad, level_t level, uint64_t cycle) {
  put_letter('d');
  put_pad(pad);
  put_number(level == FLOATING ? FLOATING_CODE : (uint8_t)level, 1);
  put_number(ns_of(cycle), 8);
  send_all();
  get_levels();
}

i2c_reply_t ask_i2c(i2c_event_t event, uint8_t value, bool flag, uint64_t cycle, uint8_t *byte) {
  i2c_reply_t reply;

  put_letter('i');
  put_number((uint64_t)event, 1);
  put_number(value, 1);
  put_number(flag, 1);
  put_number(ns_of(cycle), 8);
  send_all();
  reply = (i2c_reply_t)get();
  *byte = get();
  return reply;
}

uint8_t ask_spi(uint8_t out, uint64_t cycle) {
  put_letter('s');
  put_number(out, 1);
  put_number(ns_of(cycle), 8);
  send_all();
  return get();
}

bool ask_uart(unsigned unit, uint64_t cycle, uint8_t *byte) {
  bool is_there;

  put_letter('u');
  put_number(unit, 1);
  put_number(ns_of(cycle), 8);
  send_all();
  is_there = get() != 0;
  *byte = get();
  return is_there;
}

void tell_uart(unsigned unit, uint8_t byte, uint64_t cycle) {
  put_letter('o');
  put_number(unit, 1);
  put_number(byte, 1);
  put_number(ns_of(cycle), 8);
}

void tell_link(uint8_t byte, uint64_t cycle) {
  put_letter('k');
  put_number(byte, 1);
  put_number(ns_of(cycle), 8);
}

void tell_levels(uint8_t byte, uint64_t from, uint32_t bit_cycles) {
  const uint64_t hz = avr->frequency;
  const uint64_t ps = 1000000000000ULL;

  put_letter('v');
  put_number(byte, 1);
  put_number(from / hz * ps + from % hz * (ps / 1000) / hz * 1000, 8);
  put_number(bit_cycles * ps / hz, 8);
}

void tell_wave(unsigned timer, unsigned channel, bool is_complement, uint64_t period, uint64_t width, uint64_t cycle) {
  put_letter('p');
  put_number(timer, 1);
  put_number(channel, 1);
  put_number(is_complement, 1);
  put_number(ns_of(period), 8);
  put_number(ns_of(width), 8);
  put_number(ns_of(cycle), 8);
}

void tell_reset(uint8_t cause, uint64_t cycle) {
  put_letter('r');
  put_number(cause, 1);
  put_number(ns_of(cycle), 8);
}

void tell_setting(char kind, unsigned unit, uint32_t hz, uint8_t data_bits, uint8_t parity, uint8_t stop_bits) {
  put_letter('b');
  put_letter(kind);
  put_number(unit, 1);
  put_number(hz, 4);
  put_number(data_bits, 1);
  put_number(parity, 1);
  put_number(stop_bits, 1);
}

void tell_crash(uint32_t pc) {
  put_letter('x');
  put_number(pc, 4);
}

static void be_done(void) {
  put_letter('D');
  put_number(ns_of(avr->cycle), 8);
  put_number(ns_of(cycles_asleep()), 8);
  put_number(watchdog_ns(), 8);
  send_all();
}

static void run(void) {
  const uint64_t until_ns = get_number(8);

  get_levels();
  run_until_ns(until_ns);
  be_done();
}

static void switch_power(void) {
  power(get() != 0);
  be_done();
}

static void show_ports(void) {
  for (unsigned port = 0; port < PORTS; port++) {
    uint8_t direction;
    uint8_t latch;

    pins_registers(port, &direction, &latch);
    put_number(direction, 1);
    put_number(latch, 1);
  }
  send_all();
}

static void receive(void) {
  static uint8_t bytes[UINT16_MAX];
  const size_t count = (size_t)get_number(2);

  for (size_t at = 0; at < count; at++) {
    bytes[at] = get();
  }
  link_received(bytes, count);
}

void talk(void) {
  for (;;) {
    switch (get()) {
    case 'R':
      run();
      break;
    case 'L':
      receive();
      break;
    case 'O':
      link_opened(get() != 0);
      break;
    case 'P':
      switch_power();
      break;
    case 'S':
      show_ports();
      break;
    default:
      fputs("an order that nobody knows\n", stderr);
      exit(EXIT_FAILURE);
    }
  }
}
