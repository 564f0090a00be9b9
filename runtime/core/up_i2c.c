#include "up_i2c.h"

#include "up_convert.h"

static up_i2c_result_t failed(up_i2c_state_t *state) {
  state->is_waiting = false;
  state->errors++;
  return UP_I2C_ERROR;
}

static bool start(const up_i2c_script_t *script, up_i2c_state_t *state, const up_i2c_bus_t *bus,
                  uint32_t now_ms) {
  if (script->trigger_count > 0U &&
      !bus->write(bus->context, script->address, script->trigger, script->trigger_count)) {
    return false;
  }
  state->is_waiting = true;
  state->ready_ms = now_ms + script->wait_ms;
  return true;
}

static bool fetch(const up_i2c_script_t *script, const up_i2c_bus_t *bus, uint8_t *work) {
  const size_t tx_count = script->has_register ? 1U : 0U;
  const uint8_t reg = script->reg;

  return bus->write_read(bus->context, script->address, &reg, tx_count, work, script->length);
}

size_t up_i2c_work_bytes(const up_i2c_script_t *script) {
  return 1U + (size_t)script->length;
}

/* Half the range of the clock lies ahead, half behind: right across its wrap. */
static bool is_reached(uint32_t now_ms, uint32_t when_ms) {
  return (uint32_t)(now_ms - when_ms) < 0x80000000U;
}

up_i2c_result_t up_i2c_step(const up_i2c_script_t *script, up_i2c_state_t *state, const up_i2c_bus_t *bus,
                            const up_field_t *field, uint32_t now_ms, uint8_t *work, void *value) {
  /* Without a trigger the very first reading need not wait for anything. */
  if (!state->is_waiting && script->trigger_count > 0U) {
    if (!start(script, state, bus, now_ms)) {
      return failed(state);
    }
  }
  if (state->is_waiting && !is_reached(now_ms, state->ready_ms)) {
    return UP_I2C_NOTHING;
  }
  if (!fetch(script, bus, work) ||
      !up_store_bytes(field, work, script->length, script->little_endian, value)) {
    return failed(state);
  }
  state->readings++;
  if (!start(script, state, bus, now_ms)) {
    /* The reading is good all the same; the next step triggers again. */
    (void)failed(state);
  }
  return UP_I2C_FRESH;
}

up_i2c_result_t up_i2c_write_value(const up_i2c_script_t *script, up_i2c_state_t *state,
                                   const up_i2c_bus_t *bus, const up_field_t *field, uint8_t *work,
                                   const void *value) {
  const size_t register_count = script->has_register ? 1U : 0U;

  work[0] = script->reg;
  if (!up_load_bytes(field, value, &work[register_count], script->length, script->little_endian) ||
      !bus->write(bus->context, script->address, work, register_count + script->length)) {
    return failed(state);
  }
  return UP_I2C_FRESH;
}
