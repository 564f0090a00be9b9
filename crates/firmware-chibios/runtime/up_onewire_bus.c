/*
 * Wires with 1-Wire parts or one of the DHT22's sort.
 *
 * The thread makes the slots of 1-Wire itself. Interrupts are off only while a slot must be short: a one that is
 * written, and a bit that is read, about 13 us. A zero may last for twice as long as it must; one that something made
 * longer is noticed, and the transfer begins again. Between slots the wire may rest for any time. The burst of a DHT22
 * is timed by the interrupt of the pin, while the thread sleeps.
 */
#include "up_onewire_bus.h"

#include <string.h>

#include "up_conf.h"
#include "up_rt.h"
#include "up_ticks.h"
#include "up_wait.h"

/* Times of 1-Wire in microseconds. */
#define RESET_US 500U    /* low, at least 480 */
#define PRESENCE_US 300U /* within which a part answers a reset: 15 to 60, for 60 to 240 */
#define AFTER_US 500U    /* from the end of a reset to the first slot, at least 480 */
#define SHORT_US 2U      /* low, at least 1, at most 15 */
#define SAMPLE_US 8U     /* from there to the moment at which a bit is read, at most 15 after the slot's begin */
#define LONG_US 62U      /* low, 60 to 120 */
#define LONG_MOST_US 110U
#define REST_US 62U    /* the rest of a slot of 60, and its recovery */
#define RECOVERY_US 5U /* at least 1 */

/* A burst lasts 5 ms at most, and begins within 50 us. */
#define BURST_MS 7U

/* How often a transfer is begun that something has disturbed. */
#define ATTEMPTS 3U

static void rest_us(uint32_t us) {
  /* One more, because the first tick may be nearly over. */
  chThdSleep((us + UP_STEP_US - 1U) / UP_STEP_US + 1U);
}

static void pull(const up_onewire_port_t *port) {
  palClearLine(port->line);
}

static void release(const up_onewire_port_t *port) {
  palSetLine(port->line);
}

static bool is_high(const up_onewire_port_t *port) {
  return palReadLine(port->line) == PAL_HIGH;
}

/* ---- 1-Wire ---- */

/* Calls all parts to attention. */
static up_bus_result_t reset(const up_onewire_port_t *port) {
  uint32_t begin;
  bool is_answered = false;

  if (!is_high(port)) {
    return UP_BUS_TIMED_OUT;
  }
  pull(port);
  rest_us(RESET_US);
  release(port);
  begin = up_ticks();
  while (!is_answered && up_ticks_since(begin) < UP_TICKS_OF_US(PRESENCE_US)) {
    /* Its slope takes a few microseconds where the cable is long. */
    is_answered = up_ticks_since(begin) > UP_TICKS_OF_US(SAMPLE_US) && !is_high(port);
  }
  rest_us(AFTER_US);
  if (!is_high(port)) {
    return UP_BUS_TIMED_OUT;
  }
  return is_answered ? UP_BUS_DONE : UP_BUS_NOT_ACKNOWLEDGED;
}

static void write_one(const up_onewire_port_t *port) {
  chSysLock();
  pull(port);
  up_wait_us(SHORT_US);
  release(port);
  chSysUnlock();
  up_wait_us(REST_US);
}

/* False if it may have been a reset. */
static bool write_zero(const up_onewire_port_t *port) {
  const bool is_short = !up_ticks_are_long();
  uint32_t begin;
  uint32_t ticks;

  /* What lasts longer than the counter would not be noticed. */
  if (is_short) {
    chSysLock();
  }
  begin = up_ticks();
  pull(port);
  up_wait_us(LONG_US);
  release(port);
  ticks = up_ticks_since(begin);
  if (is_short) {
    chSysUnlock();
  }
  up_wait_us(RECOVERY_US);
  return ticks < UP_TICKS_OF_US(LONG_MOST_US);
}

static bool read_bit(const up_onewire_port_t *port) {
  bool bit;

  chSysLock();
  pull(port);
  up_wait_us(SHORT_US);
  release(port);
  up_wait_us(SAMPLE_US);
  bit = is_high(port);
  chSysUnlock();
  up_wait_us(REST_US);
  return bit;
}

static bool write_byte(const up_onewire_port_t *port, unsigned byte) {
  unsigned bit;

  for (bit = 0U; bit < 8U; bit++) {
    if (((byte >> bit) & 1U) != 0U) {
      write_one(port);
    } else if (!write_zero(port)) {
      return false;
    }
  }
  /* The wire may rest: others of the same priority go on. */
  chThdYield();
  return true;
}

static bool write_all(const up_onewire_port_t *port, const uint8_t *bytes, size_t count) {
  size_t i = 0U;

  while (i < count && write_byte(port, bytes[i])) {
    i++;
  }
  return i == count;
}

static uint8_t read_byte(const up_onewire_port_t *port) {
  unsigned byte = 0U;
  unsigned bit;

  for (bit = 0U; bit < 8U; bit++) {
    byte |= read_bit(port) ? 1U << bit : 0U;
  }
  chThdYield();
  return (uint8_t)byte;
}

/* Calls the part; false if that was disturbed. */
static bool call(const up_onewire_port_t *port, const up_onewire_part_t *part, const uint8_t *bytes, size_t count) {
  /* The one command that takes the place of the call. */
  if (count > 0U && bytes[0] == UP_ONEWIRE_READ_ROM) {
    return true;
  }
  if (part->rom == NULL) {
    return write_byte(port, UP_ONEWIRE_SKIP_ROM);
  }
  return write_byte(port, UP_ONEWIRE_MATCH_ROM) && write_all(port, part->rom, 8U);
}

/* Sends bytes to a part, and receives bytes from it. */
static up_bus_result_t attempt(const up_onewire_port_t *port, const up_onewire_part_t *part, const uint8_t *tx,
                               size_t tx_count, uint8_t *rx, size_t rx_count) {
  up_bus_result_t result = reset(port);
  size_t i;

  if (result != UP_BUS_DONE) {
    return result;
  }
  if (!call(port, part, tx, tx_count) || !write_all(port, tx, tx_count)) {
    return UP_BUS_ERROR;
  }
  if (rx_count == 0U) {
    /* A part that measures says so: one that has not heard it would give its last value as a new one. */
    const bool is_trigger = part->trigger != 0U && tx[0] == part->trigger;

    return (is_trigger && read_bit(port)) ? UP_BUS_ERROR : UP_BUS_DONE;
  }
  for (i = 0U; i < rx_count; i++) {
    rx[i] = read_byte(port);
  }
  return up_onewire_check(rx, rx_count);
}

/* ---- a burst ---- */

#if PAL_USE_CALLBACKS == TRUE

static void on_fall(void *argument) {
  up_onewire_state_t *state = argument;
  const uint8_t count = state->falls_count;

  if (count < UP_BURST_FALLS) {
    state->falls[count] = up_ticks();
    state->falls_count = (uint8_t)(count + 1U);
  }
}

static up_bus_result_t burst(const up_onewire_port_t *port, const up_onewire_part_t *part, uint8_t *bytes) {
  up_onewire_state_t *state = port->state;
  uint32_t begin;
  size_t i;

  if (!is_high(port)) {
    return UP_BUS_TIMED_OUT;
  }
  pull(port);
  rest_us(part->pulse_us);
  state->falls_count = 0U;
  /* The driver forgets the function when the event is disabled. */
  palSetLineCallback(port->line, on_fall, state);
  palEnableLineEvent(port->line, PAL_EVENT_MODE_FALLING_EDGE);
  release(port);
  chThdSleep(UP_MS2I(BURST_MS) + 1U);
  palDisableLineEvent(port->line);
  begin = state->falls[0];
  for (i = 0U; i < state->falls_count; i++) {
    state->falls[i] = up_ticks_between(begin, state->falls[i]) / UP_TICKS_OF_US(1U);
  }
  return up_burst_decode(state->falls, state->falls_count, bytes);
}

#else

static up_bus_result_t burst(const up_onewire_port_t *port, const up_onewire_part_t *part, uint8_t *bytes) {
  (void)port;
  (void)part;
  (void)bytes;
  return UP_BUS_ERROR;
}

#endif

/* ---- the bus ---- */

void up_onewire_start(const up_onewire_port_t *port) {
  chMtxObjectInit(&port->state->mutex);
  up_ticks_start();
}

static up_bus_result_t transfer(const up_onewire_port_t *port, uint8_t address, const uint8_t *tx, size_t tx_count,
                                uint8_t *rx, size_t rx_count) {
  const up_onewire_part_t *part = &port->parts[address];
  up_bus_result_t result = UP_BUS_ERROR;
  unsigned i;

  chMtxLock(&port->state->mutex);
  if (part->pulse_us > 0U) {
    uint8_t bytes[UP_BURST_BYTES] = {0U};

    /* It must be left alone after each reading, also after one that failed. */
    result = burst(port, part, bytes);
    memcpy(rx, bytes, (result != UP_BUS_DONE) ? 0U : (rx_count < sizeof bytes) ? rx_count : sizeof bytes);
  } else {
    for (i = 0U; i < ATTEMPTS && (result == UP_BUS_ERROR || result == UP_BUS_NOT_ACKNOWLEDGED); i++) {
      result = attempt(port, part, tx, tx_count, rx, rx_count);
    }
  }
  chMtxUnlock(&port->state->mutex);
  return result;
}

up_bus_result_t up_onewire_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  return transfer(context, address, bytes, count, NULL, 0U);
}

up_bus_result_t up_onewire_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                      size_t rx_count) {
  return transfer(context, address, tx, tx_count, rx, rx_count);
}
