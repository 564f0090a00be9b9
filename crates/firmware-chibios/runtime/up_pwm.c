/* PWM outputs, and motor bridges on them. Values change at the end of a period. */
#include "up_pwm.h"
#include "up_rt.h"

#if HAL_USE_PWM == TRUE

static void set_level(const up_pwm_output_t *output, uint32_t level) {
  pwmEnableChannelI(output->driver, output->channel, (pwmcnt_t)up_pulse_ticks(&output->width, level));
}

/* All outputs of an array change in the same period: until they are written, their timers update nothing. */
static void hold_updates(const up_pwm_t *pwm, bool is_held) {
  uint8_t i;

  for (i = 0U; i < pwm->outputs_count; i++) {
    stm32_tim_t *timer = pwm->outputs[i].driver->tim;

    if (is_held) {
      timer->CR1 |= STM32_TIM_CR1_UDIS;
    } else {
      timer->CR1 &= ~STM32_TIM_CR1_UDIS;
    }
  }
}

void up_pwm_set(const up_pwm_t *pwm, const void *value) {
  const uint8_t type = up_config.schema->fields[pwm->field].type;
  const size_t element_bytes = up_type_bytes(type);
  const uint8_t *elements = value;
  uint8_t i;

  chSysLock();
  hold_updates(pwm, true);
  for (i = 0U; i < pwm->outputs_count; i++) {
    set_level(&pwm->outputs[i], up_pulse_level(type, &elements[i * element_bytes]));
  }
  hold_updates(pwm, false);
  chSysUnlock();
}

void up_pwm_set_level(const up_pwm_t *pwm, uint32_t level) {
  uint8_t i;

  chSysLock();
  hold_updates(pwm, true);
  for (i = 0U; i < pwm->outputs_count; i++) {
    set_level(&pwm->outputs[i], level);
  }
  hold_updates(pwm, false);
  chSysUnlock();
}

/* Turns off within the period: the direction wires change next, and must not get the old strength. */
static void stop_now(const up_pwm_output_t *output) {
  stm32_tim_t *timer = output->driver->tim;
  volatile uint32_t *mode = (output->channel < 2U) ? &timer->CCMR1 : &timer->CCMR2;
  const uint32_t preload = ((output->channel & 1U) == 0U) ? STM32_TIM_CCMR1_OC1PE : STM32_TIM_CCMR1_OC2PE;

  *mode &= ~preload;
  set_level(output, 0U);
  *mode |= preload;
}

static void write_output(const up_bridge_output_t *output, uint32_t value) {
  if (output->pwm == NULL) {
    palWriteLine(output->line, ((value != 0U) != output->is_low_active) ? PAL_HIGH : PAL_LOW);
  } else if (value == 0U) {
    stop_now(output->pwm);
  } else {
    set_level(output->pwm, value);
  }
}

static void drive(const up_bridge_t *bridge, uint8_t type, const void *element) {
  up_drive_write_t writes[UP_DRIVE_WRITES_MAX];
  size_t count;
  size_t i;

  chSysLock();
  count = up_drive(bridge->drive, bridge->state, type, element, writes);
  for (i = 0U; i < count; i++) {
    write_output(&bridge->outputs[writes[i].output], writes[i].value);
  }
  chSysUnlock();
}

void up_bridge_set(const up_bridge_t *bridge, const void *value) {
  drive(bridge, up_config.schema->fields[bridge->field].type, value);
}

void up_bridge_set_level(const up_bridge_t *bridge, int32_t level) {
  drive(bridge, UP_TYPE_INT32, &level);
}

#endif
