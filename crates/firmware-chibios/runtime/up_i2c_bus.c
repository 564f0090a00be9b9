#include "up_rt.h"

#include <string.h>

#if HAL_USE_I2C == TRUE

#include "up_i2c_bus.h"

/* The most clocks until a device that was cut off in the middle of a byte releases the bus. */
#define RECOVERY_CLOCKS 9U
#define RECOVERY_HALF_CLOCK_US 100U
/* The time between attempts to free a stuck bus: at first, and at most. */
#define BACKOFF_FIRST_MS 50U
#define BACKOFF_MAX_MS 1000U

/* The mode of a pad that is driven by hand, with the MCU's own pull-up if outputs can have one. */
#if defined(PAL_STM32_PUPDR_PULLUP)
#define BY_HAND (PAL_MODE_OUTPUT_OPENDRAIN | PAL_STM32_PUPDR_PULLUP)
#else
#define BY_HAND PAL_MODE_OUTPUT_OPENDRAIN
#endif

static bool is_busy(const up_i2c_port_t *port) {
#if defined(I2C_ISR_BUSY)
  return (port->driver->i2c->ISR & I2C_ISR_BUSY) != 0U;
#else
  return (port->driver->i2c->SR2 & I2C_SR2_BUSY) != 0U;
#endif
}

/* ---- freeing ---- */

static void half_clock(ioline_t line, uint8_t level) {
  palWriteLine(line, level);
  chThdSleepMicroseconds(RECOVERY_HALF_CLOCK_US);
}

static void set_pads(const up_i2c_port_t *port) {
  palSetLineMode(port->scl, port->scl_mode);
  palSetLineMode(port->sda, port->sda_mode);
}

/* Clocks until the device that holds SDA releases it, and ends with a stop condition. True if both wires are free
 * after that. */
static bool clock_out(const up_i2c_port_t *port) {
  unsigned clock;

  palSetLine(port->scl);
  palSetLine(port->sda);
  palSetLineMode(port->scl, BY_HAND);
  palSetLineMode(port->sda, BY_HAND);
  half_clock(port->scl, PAL_HIGH);
  for (clock = 0U; clock < RECOVERY_CLOCKS && palReadLine(port->sda) == PAL_LOW; clock++) {
    half_clock(port->scl, PAL_LOW);
    half_clock(port->scl, PAL_HIGH);
  }
  half_clock(port->scl, PAL_LOW);
  half_clock(port->sda, PAL_LOW);
  half_clock(port->scl, PAL_HIGH);
  half_clock(port->sda, PAL_HIGH);
  return palReadLine(port->scl) == PAL_HIGH && palReadLine(port->sda) == PAL_HIGH;
}

/* After a time-out the driver is locked, and its unit may consider the bus busy for good: both are restarted. */
static bool recover(const up_i2c_port_t *port) {
  up_i2c_state_t *state = port->state;
  bool is_free;

  i2cStop(port->driver);
  is_free = clock_out(port);
  set_pads(port);
  (void)i2cStart(port->driver, port->config);
  if (is_free) {
    state->freed++;
    state->backoff_ms = 0U;
    return true;
  }
  state->kept++;
  state->backoff_ms = (state->backoff_ms == 0U) ? BACKOFF_FIRST_MS : 2U * state->backoff_ms;
  if (state->backoff_ms > BACKOFF_MAX_MS) {
    state->backoff_ms = BACKOFF_MAX_MS;
  }
  state->retry_ms = up_now_ms() + state->backoff_ms;
  return false;
}

/* ---- transfers ---- */

/* Checks the bus before the driver does, which would block the processor while it is busy. Right after a transfer it
 * is busy with the stop condition, and the driver waits for no more than that (STM32_I2C_BUSY_TIMEOUT). */
static bool is_ready(const up_i2c_port_t *port) {
  const up_i2c_state_t *state = port->state;

  if (state->backoff_ms > 0U) {
    /* Half the range of the clock is ahead, half is in the past, so the comparison holds across its wrap. */
    return (uint32_t)(up_now_ms() - state->retry_ms) < 0x80000000U && recover(port);
  }
  if (is_busy(port) && chTimeDiffX(state->ended, chVTGetSystemTimeX()) > TIME_MS2I(1)) {
    return recover(port);
  }
  return true;
}

static msg_t run(const up_i2c_port_t *port, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                 size_t rx_count) {
  const sysinterval_t timeout = UP_MS2I(port->timeout_ms);

  if (tx_count == 0U) {
    return i2cMasterReceiveTimeout(port->driver, address, rx, rx_count, timeout);
  }
  return i2cMasterTransmitTimeout(port->driver, address, tx, tx_count, rx, rx_count, timeout);
}

static up_bus_result_t cause(const up_i2c_port_t *port, msg_t message) {
  const i2cflags_t errors = i2cGetErrors(port->driver);

  if (message == MSG_OK) {
    return UP_BUS_DONE;
  }
  if (message == MSG_TIMEOUT) {
    return recover(port) ? UP_BUS_TIMED_OUT : UP_BUS_ERROR;
  }
  /* A master that loses arbitration may also see a refused byte. */
  if ((errors & I2C_ARBITRATION_LOST) != 0U) {
    return UP_BUS_ARBITRATION_LOST;
  }
  if ((errors & I2C_ACK_FAILURE) != 0U) {
    return UP_BUS_NOT_ACKNOWLEDGED;
  }
  return ((errors & I2C_TIMEOUT) != 0U) ? UP_BUS_TIMED_OUT : UP_BUS_ERROR;
}

static up_bus_result_t transfer(const up_i2c_port_t *port, uint8_t address, const uint8_t *tx, size_t tx_count,
                                uint8_t *rx, size_t rx_count) {
  up_bus_result_t result = UP_BUS_ERROR;

  i2cAcquireBus(port->driver);
  if (is_ready(port)) {
    result = cause(port, run(port, address, tx, tx_count, rx, rx_count));
    port->state->ended = chVTGetSystemTime();
  }
  i2cReleaseBus(port->driver);
  return result;
}

void up_i2c_start(const up_i2c_port_t *port) {
  (void)i2cStart(port->driver, port->config);
  port->state->ended = chVTGetSystemTime();
}

bool up_i2c_answers(const void *bus, uint8_t address) {
  /* Every DMA controller reaches the memory that the basic one does. */
  static UP_BDMA_BUFFER uint8_t unread[UP_I2C_READ_BYTES_MIN];

  return transfer(bus, address, NULL, 0U, unread, sizeof unread) == UP_BUS_DONE;
}

up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  return transfer(context, address, bytes, count, NULL, 0U);
}

up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
#if UP_I2C_READ_BYTES_MIN > 1
  /* The unit of an STM32F1 cannot end a read after one byte: two are read and the second is dropped. */
  uint8_t enough[UP_I2C_READ_BYTES_MIN];

  if (rx_count < sizeof enough) {
    const up_bus_result_t result = transfer(context, address, tx, tx_count, enough, sizeof enough);

    memcpy(rx, enough, rx_count);
    return result;
  }
#endif
  return transfer(context, address, tx, tx_count, rx, rx_count);
}

#endif
