#include "up_pwm.h"

#include <Arduino.h>

/* A pulse of no length has no register value: the pin is taken from the timer and is low. */
static void set_ticks(UP_ROM up_pwm_output_t *output, uint32_t ticks) {
  const uint8_t sreg = SREG;

  cli();
  if (ticks == 0U) {
    *output->control = (uint8_t)(*output->control & ~output->mask);
  } else if (output->is_wide) {
    *output->compare = (uint16_t)(ticks - 1U);
    *output->control = (uint8_t)(*output->control | output->mask);
  } else {
    *(volatile uint8_t *)output->compare = (uint8_t)(ticks - 1U);
    *output->control = (uint8_t)(*output->control | output->mask);
  }
  SREG = sreg;
}

static void set_level(UP_ROM up_pwm_output_t *output, uint32_t level) {
  set_ticks(output, up_pulse_ticks(&output->width, level));
}

void up_pwm_set(UP_ROM up_pwm_t *pwm, const void *value) {
  const uint8_t type = up_type_of(pwm->field);
  const uint8_t element_bytes = (uint8_t)up_type_bytes(type);
  const uint8_t *elements = value;
  uint8_t i;

  for (i = 0U; i < pwm->outputs_count; i++) {
    set_level(&pwm->outputs[i], up_pulse_level(type, &elements[i * element_bytes]));
  }
}

void up_pwm_set_level(UP_ROM up_pwm_t *pwm, uint16_t level) {
  uint8_t i;

  for (i = 0U; i < pwm->outputs_count; i++) {
    set_level(&pwm->outputs[i], level);
  }
}

static void write_output(UP_ROM up_bridge_output_t *output, uint32_t value) {
  if (output->pwm != UP_ROM_NULL) {
    set_level(output->pwm, value);
  } else {
    digitalWrite(output->pin, ((value != 0U) != output->is_low_active) ? HIGH : LOW);
  }
}

static void drive(UP_ROM up_bridge_t *bridge, uint8_t type, const void *element) {
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  const uint8_t count = (uint8_t)up_drive(bridge->drive, bridge->state, type, element, writes);
  uint8_t i;

  for (i = 0U; i < count; i++) {
    write_output(&bridge->outputs[writes[i].output], writes[i].value);
  }
}

void up_bridge_set(UP_ROM up_bridge_t *bridge, const void *value) {
  drive(bridge, up_type_of(bridge->field), value);
}

void up_bridge_set_level(UP_ROM up_bridge_t *bridge, int32_t level) {
  drive(bridge, (uint8_t)UP_TYPE_INT32, &level);
}
