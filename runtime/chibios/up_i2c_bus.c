/* I2C devices: the core's scripts over a bus with finite time-outs that frees itself when it hangs. */
#include "up_rt.h"

#include <string.h>

#if HAL_USE_I2C == TRUE

/* A device that was cut off in the middle of a byte lets go after at most so many clocks. */
#define RECOVERY_CLOCKS 9U
#define RECOVERY_HALF_CLOCK_US 100U

static void half_clock(ioline_t line, uint8_t level) {
  palWriteLine(line, level);
  chThdSleepMicroseconds(RECOVERY_HALF_CLOCK_US);
}

static void set_pads(const up_i2c_port_t *port) {
  palSetLineMode(port->scl, port->scl_mode);
  palSetLineMode(port->sda, port->sda_mode);
}

/* Clocks a stuck device out by hand, ends with a stop condition and starts the driver anew. The driver is
 * locked after a time-out, so nothing short of a restart helps. */
static void recover(const up_i2c_port_t *port) {
  unsigned clock;

  i2cStop(port->driver);
  palSetLine(port->scl);
  palSetLine(port->sda);
  palSetLineMode(port->scl, PAL_MODE_OUTPUT_OPENDRAIN);
  palSetLineMode(port->sda, PAL_MODE_OUTPUT_OPENDRAIN);
  for (clock = 0U; clock < RECOVERY_CLOCKS; clock++) {
    half_clock(port->scl, PAL_LOW);
    half_clock(port->scl, PAL_HIGH);
  }
  half_clock(port->scl, PAL_LOW);
  half_clock(port->sda, PAL_LOW);
  half_clock(port->scl, PAL_HIGH);
  half_clock(port->sda, PAL_HIGH);
  set_pads(port);
  (void)i2cStart(port->driver, port->config);
  (*port->recoveries)++;
}

static msg_t transfer(const up_i2c_port_t *port, uint8_t address, const uint8_t *tx, size_t tx_count,
                      uint8_t *rx, size_t rx_count) {
  const sysinterval_t timeout = TIME_MS2I(port->timeout_ms);

  if (tx_count == 0U) {
    return i2cMasterReceiveTimeout(port->driver, address, rx, rx_count, timeout);
  }
  return i2cMasterTransmitTimeout(port->driver, address, tx, tx_count, rx, rx_count, timeout);
}

static bool exchange(const up_i2c_port_t *port, uint8_t address, const uint8_t *tx, size_t tx_count,
                     uint8_t *rx, size_t rx_count) {
  msg_t result;

  i2cAcquireBus(port->driver);
  result = transfer(port, address, tx, tx_count, rx, rx_count);
  if (result == MSG_TIMEOUT) {
    recover(port);
  }
  i2cReleaseBus(port->driver);
  return result == MSG_OK;
}

static bool bus_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  return exchange(context, address, bytes, count, NULL, 0U);
}

/* The I2C unit of an STM32F1 cannot end a reading after one byte: two are read and the second is left. */
static bool bus_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                           size_t rx_count) {
#if UP_I2C_READ_BYTES_MIN > 1
  uint8_t enough[UP_I2C_READ_BYTES_MIN];

  if (rx_count < sizeof enough) {
    if (!exchange(context, address, tx, tx_count, enough, sizeof enough)) {
      return false;
    }
    memcpy(rx, enough, rx_count);
    return true;
  }
#endif
  return exchange(context, address, tx, tx_count, rx, rx_count);
}

void up_i2c_start(const up_i2c_port_t *port) {
  set_pads(port);
  (void)i2cStart(port->driver, port->config);
}

static up_i2c_result_t step_sensor(const up_i2c_t *work, const up_i2c_bus_t *bus, size_t i) {
  const up_i2c_device_t *device = &work->devices[i];
  const up_field_t *field = &up_config.schema->fields[device->field];
  const up_i2c_result_t result =
      up_i2c_step(&device->script, &work->states[i], bus, field, up_now_ms(), work->work, work->scratch);

  if (result == UP_I2C_FRESH) {
    up_put(device->field, work->scratch);
  }
  return result;
}

/* An actuator is written once for each value that came; one that did not get through is tried again. */
static up_i2c_result_t step_actuator(const up_i2c_t *work, const up_i2c_bus_t *bus, size_t i) {
  const up_i2c_device_t *device = &work->devices[i];
  const up_field_t *field = &up_config.schema->fields[device->field];
  const uint32_t sequence = up_sequence(device->field);
  up_i2c_result_t result;

  if (sequence == work->states[i].readings || !up_get(device->field, work->scratch)) {
    return UP_I2C_NOTHING;
  }
  result = up_i2c_write_value(&device->script, &work->states[i], bus, field, work->work, work->scratch);
  if (result == UP_I2C_FRESH) {
    work->states[i].readings = sequence;
  }
  return result;
}

void up_i2c_cycle(const void *work) {
  const up_i2c_t *devices = work;
  const up_i2c_bus_t bus = {bus_write, bus_write_read, (void *)(uintptr_t)devices->port};
  uint8_t i;

  for (i = 0U; i < devices->devices_count; i++) {
    const uint16_t field = devices->devices[i].field;
    const bool is_sensor = up_config.schema->fields[field].direction == (uint8_t)UP_TO_HOST;
    const up_i2c_result_t result =
        is_sensor ? step_sensor(devices, &bus, i) : step_actuator(devices, &bus, i);
    if (result == UP_I2C_ERROR) {
      up_fail(field);
    }
  }
}

#endif
