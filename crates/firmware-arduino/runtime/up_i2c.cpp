#include "up_i2c.h"

#include <Arduino.h>
#include <Wire.h>

/* The longest transfer takes 3 ms at 100 kHz; parts may stretch the clock for as long again. */
#define TIMEOUT_US 6000U
/* The most clocks until a part that was cut off in the middle of a byte releases the bus. */
#define RECOVERY_CLOCKS 9U
#define HALF_CLOCK_US 5U
/* The time between attempts on a bus that something holds. */
#define BACKOFF_MS 50U

static uint32_t speed;
static uint32_t retry_ms;
static bool is_held;

static void release(uint8_t pin) {
  pinMode(pin, INPUT_PULLUP);
}

static void pull_low(uint8_t pin) {
  digitalWrite(pin, LOW);
  pinMode(pin, OUTPUT);
}

/* Clocks until the part that holds SDA releases it, and ends with a stop condition. True if both wires are free. */
static bool clock_out() {
  uint8_t clocks;

  release(SDA);
  release(SCL);
  for (clocks = 0; clocks < RECOVERY_CLOCKS && digitalRead(SDA) == LOW; clocks++) {
    pull_low(SCL);
    delayMicroseconds(HALF_CLOCK_US);
    release(SCL);
    delayMicroseconds(HALF_CLOCK_US);
  }
  pull_low(SDA);
  delayMicroseconds(HALF_CLOCK_US);
  release(SDA);
  delayMicroseconds(HALF_CLOCK_US);
  return digitalRead(SDA) == HIGH && digitalRead(SCL) == HIGH;
}

static void recover() {
  Wire.end();
  is_held = !clock_out();
  retry_ms = millis() + BACKOFF_MS;
  if (!is_held) {
    up_i2c_start(speed);
  }
}

/* Whether a transfer may be tried: not while something holds the wires. */
static bool is_ready() {
  if (is_held && (int32_t)(millis() - retry_ms) >= 0) {
    recover();
  }
  return !is_held;
}

static up_bus_result_t cause(uint8_t error) {
  switch (error) {
    case 0:
      return UP_BUS_DONE;
    case 2:
    case 3:
      return UP_BUS_NOT_ACKNOWLEDGED;
    case 5:
      recover();
      return is_held ? UP_BUS_ERROR : UP_BUS_TIMED_OUT;
    default:
      return UP_BUS_ERROR;
  }
}

static up_bus_result_t send(uint8_t address, const uint8_t *bytes, size_t count, bool has_stop) {
  Wire.beginTransmission(address);
  Wire.write(bytes, count);
  return cause(Wire.endTransmission(has_stop));
}

void up_i2c_start(uint32_t speed_hz) {
  speed = speed_hz;
  Wire.begin();
  Wire.setClock(speed_hz);
  Wire.setWireTimeout(TIMEOUT_US, true);
}

up_bus_result_t up_i2c_write(void *context, uint8_t address, const uint8_t *bytes, size_t count) {
  (void)context;
  return is_ready() ? send(address, bytes, count, true) : UP_BUS_ERROR;
}

up_bus_result_t up_i2c_write_read(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                                  size_t rx_count) {
  up_bus_result_t result;
  uint8_t count;

  (void)context;
  if (!is_ready()) {
    return UP_BUS_ERROR;
  }
  if (tx_count > 0) {
    result = send(address, tx, tx_count, false);
    if (result != UP_BUS_DONE) {
      return result;
    }
  }
  count = Wire.requestFrom(address, (uint8_t)rx_count);
  if (Wire.getWireTimeoutFlag()) {
    Wire.clearWireTimeoutFlag();
    return cause(5);
  }
  if (count != rx_count) {
    return UP_BUS_NOT_ACKNOWLEDGED;
  }
  for (count = 0; count < rx_count; count++) {
    rx[count] = (uint8_t)Wire.read();
  }
  return UP_BUS_DONE;
}
