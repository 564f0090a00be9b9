/*
 * Devices on an I2C bus, described by a table: start a measurement, wait, read registers.
 *
 * up_i2c_step() is called once a cycle and never waits itself. A device that needs time between trigger and
 * result says so with `wait_ms`; asked sooner, a step does nothing and the last value stands. After each reading
 * the next measurement is started at once, so that it is ready as early as can be.
 */
#ifndef UP_I2C_H
#define UP_I2C_H

#include "up_schema.h"

/* The bus as a script sees it; both return true when the device acknowledged every byte. What is written comes
 * from the table's trigger, the work buffer or the stack, never from elsewhere: a DMA must reach it. */
typedef struct {
  bool (*write)(void *context, uint8_t address, const uint8_t *bytes, size_t count);
  bool (*write_read)(void *context, uint8_t address, const uint8_t *tx, size_t tx_count, uint8_t *rx,
                     size_t rx_count);
  void *context;
} up_i2c_bus_t;

typedef struct {
  const uint8_t *trigger; /* bytes that start a measurement, or NULL */
  uint32_t wait_ms;       /* from the trigger (or the last reading) to the next reading */
  uint8_t trigger_count;
  uint8_t address;        /* 7 bits */
  uint8_t reg;            /* first register to read */
  bool has_register;      /* false: the device is read without selecting one */
  bool little_endian;
  uint16_t length;        /* bytes to read or to write, at least 1 */
} up_i2c_script_t;

typedef struct {
  bool is_waiting;
  uint32_t ready_ms; /* when the reading may be fetched; the clock may wrap */
  uint32_t readings;
  uint32_t errors;   /* steps in which the device did not answer */
} up_i2c_state_t;

typedef enum {
  UP_I2C_NOTHING, /* not ready yet: the last value stands */
  UP_I2C_FRESH,   /* `value` was written */
  UP_I2C_ERROR    /* the device did not answer; the next step starts again */
} up_i2c_result_t;

/* Bytes of work buffer that a script needs. */
size_t up_i2c_work_bytes(const up_i2c_script_t *script);

/* One cycle of one sensor: `value` receives up_field_bytes(field) bytes when the result is fresh. `work` has at
 * least up_i2c_work_bytes(script) bytes. */
up_i2c_result_t up_i2c_step(const up_i2c_script_t *script, up_i2c_state_t *state, const up_i2c_bus_t *bus,
                            const up_field_t *field, uint32_t now_ms, uint8_t *work, void *value);

/* Writes an actuator's value: the register, if there is one, then `length` bytes. */
up_i2c_result_t up_i2c_write_value(const up_i2c_script_t *script, up_i2c_state_t *state,
                                   const up_i2c_bus_t *bus, const up_field_t *field, uint8_t *work,
                                   const void *value);

#endif
