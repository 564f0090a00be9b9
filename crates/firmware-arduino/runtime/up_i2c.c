#include "up_i2c.h"

#include <Arduino.h>

/* A byte takes a tenth of a millisecond at 100 kHz; parts may stretch the clock for some time. */
#define BYTE_US_MAX 5000U
/* The most clocks until a part that was cut off in the middle of a byte releases the bus. */
#define RECOVERY_CLOCKS 9U
#define HALF_CLOCK_US 5U
/* The time between attempts on a bus that something holds. */
#define BACKOFF_MS 50U

/* The wires, as the framework's functions take a hundred bytes each. */
#if defined(__AVR_ATmega328P__)
#define WIRES_OUT PORTC
#define WIRES_DRIVEN DDRC
#define WIRES_IN PINC
#define SDA_BIT _BV(4)
#define SCL_BIT _BV(5)
#elif defined(__AVR_ATmega2560__) || defined(__AVR_ATmega32U4__)
#define WIRES_OUT PORTD
#define WIRES_DRIVEN DDRD
#define WIRES_IN PIND
#define SDA_BIT _BV(1)
#define SCL_BIT _BV(0)
#else
#error "the pins of the I2C unit of this MCU are unknown"
#endif

/* What the unit says after each step: TWSR without the prescaler. */
#define STATUS (TWSR & 0xF8U)
#define STARTED 0x08U
#define STARTED_AGAIN 0x10U
#define ADDRESS_TAKEN 0x18U
#define ADDRESS_REFUSED 0x20U
#define BYTE_TAKEN 0x28U
#define BYTE_REFUSED 0x30U
#define ARBITRATION_LOST 0x38U
#define READ_TAKEN 0x40U
#define READ_REFUSED 0x48U
#define BYTE_READ 0x50U
#define LAST_READ 0x58U

static uint8_t divider;
static uint16_t retry_ms;
static bool is_held;

static void set_up(void) {
  WIRES_OUT |= SDA_BIT;
  WIRES_OUT |= SCL_BIT;
  TWSR = 0U;
  TWBR = divider;
  TWCR = _BV(TWEN);
}

void up_i2c_start(uint32_t speed_hz) {
  const uint32_t clocks = (uint32_t)F_CPU / speed_hz;

  divider = (clocks > 16U + 2U * 255U) ? 255U : (uint8_t)((clocks - 16U + 1U) / 2U);
  set_up();
}

/* ---- freeing ---- */

/* Single bits, which change in one instruction each: handlers of interrupts may set other pins of the port. */
static void release_scl(void) {
  WIRES_DRIVEN &= (uint8_t)~SCL_BIT;
  WIRES_OUT |= SCL_BIT;
  delayMicroseconds(HALF_CLOCK_US);
}

static void release_sda(void) {
  WIRES_DRIVEN &= (uint8_t)~SDA_BIT;
  WIRES_OUT |= SDA_BIT;
  delayMicroseconds(HALF_CLOCK_US);
}

static void pull_scl_low(void) {
  WIRES_OUT &= (uint8_t)~SCL_BIT;
  WIRES_DRIVEN |= SCL_BIT;
  delayMicroseconds(HALF_CLOCK_US);
}

static void pull_sda_low(void) {
  WIRES_OUT &= (uint8_t)~SDA_BIT;
  WIRES_DRIVEN |= SDA_BIT;
  delayMicroseconds(HALF_CLOCK_US);
}

/* Clocks until the part that holds SDA releases it, and ends with a stop condition. */
static void recover(void) {
  uint8_t clocks;

  TWCR = 0U;
  release_sda();
  release_scl();
  for (clocks = 0U; clocks < RECOVERY_CLOCKS && (WIRES_IN & SDA_BIT) == 0U; clocks++) {
    pull_scl_low();
    release_scl();
  }
  pull_sda_low();
  release_sda();
  is_held = (WIRES_IN & (SDA_BIT | SCL_BIT)) != (SDA_BIT | SCL_BIT);
  retry_ms = (uint16_t)(millis() + BACKOFF_MS);
  if (!is_held) {
    set_up();
  }
}

/* Whether a transfer may be tried: not while something holds the wires. */
static bool is_ready(void) {
  if (is_held && (uint16_t)((uint16_t)millis() - retry_ms) < 0x8000U) {
    recover();
  }
  return !is_held;
}

/* ---- transfers ---- */

/* Waits until a bit of TWCR has this value. */
static bool waits_for(uint8_t bit, bool is_set) {
  const uint16_t began_us = (uint16_t)micros();

  while (((TWCR & bit) != 0U) != is_set) {
    if ((uint16_t)((uint16_t)micros() - began_us) > BYTE_US_MAX) {
      return false;
    }
  }
  return true;
}

/* The unit goes on, and has come to one of two states. */
static up_bus_result_t step(uint8_t control, uint8_t wanted, uint8_t other) {
  TWCR = (uint8_t)(_BV(TWINT) | _BV(TWEN) | control);
  if (!waits_for(_BV(TWINT), true)) {
    return UP_BUS_TIMED_OUT;
  }
  if (STATUS == wanted || STATUS == other) {
    return UP_BUS_DONE;
  }
  switch (STATUS) {
    case ADDRESS_REFUSED:
    case BYTE_REFUSED:
    case READ_REFUSED:
      return UP_BUS_NOT_ACKNOWLEDGED;
    case ARBITRATION_LOST:
      return UP_BUS_ARBITRATION_LOST;
    default:
      return UP_BUS_ERROR;
  }
}

static up_bus_result_t address_to(uint8_t address, bool reads) {
  up_bus_result_t result = step(_BV(TWSTA), STARTED, STARTED_AGAIN);

  if (result == UP_BUS_DONE) {
    TWDR = (uint8_t)((address << 1) | (reads ? 1U : 0U));
    result = step(0U, reads ? READ_TAKEN : ADDRESS_TAKEN, reads ? READ_TAKEN : ADDRESS_TAKEN);
  }
  return result;
}

static up_bus_result_t send(uint8_t address, const uint8_t *bytes, size_t count) {
  up_bus_result_t result = address_to(address, false);
  size_t i;

  for (i = 0U; i < count && result == UP_BUS_DONE; i++) {
    TWDR = bytes[i];
    result = step(0U, BYTE_TAKEN, BYTE_TAKEN);
  }
  return result;
}

static up_bus_result_t take(uint8_t address, uint8_t *bytes, size_t count) {
  up_bus_result_t result = address_to(address, true);
  size_t i;

  for (i = 0U; i < count && result == UP_BUS_DONE; i++) {
    result = step((i + 1U < count) ? _BV(TWEA) : 0U, BYTE_READ, LAST_READ);
    bytes[i] = TWDR;
  }
  return result;
}

/* Releases the bus. What did not come to an end holds it: it is freed by hand. */
static up_bus_result_t finish(up_bus_result_t result) {
  bool is_free = false;

  if (result != UP_BUS_TIMED_OUT && result != UP_BUS_ARBITRATION_LOST) {
    TWCR = _BV(TWINT) | _BV(TWEN) | _BV(TWSTO);
    is_free = waits_for(_BV(TWSTO), false);
  }
  if (!is_free) {
    recover();
    if (result != UP_BUS_ARBITRATION_LOST) {
      return is_held ? UP_BUS_ERROR : UP_BUS_TIMED_OUT;
    }
  }
  return result;
}

up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  (void)context;
  return is_ready() ? finish(send(address, bytes, count)) : UP_BUS_ERROR;
}

up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
  up_bus_result_t result = UP_BUS_DONE;

  (void)context;
  if (!is_ready()) {
    return UP_BUS_ERROR;
  }
  if (tx_count > 0U) {
    result = send(address, tx, tx_count);
  }
  if (result == UP_BUS_DONE) {
    result = take(address, rx, rx_count);
  }
  return finish(result);
}
