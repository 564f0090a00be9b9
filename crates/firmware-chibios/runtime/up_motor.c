/* Stepper motors: intervals of a timer, with a pulse at the end of those that end with a step. */
#include "up_motor.h"
#include "up_rt.h"

#if HAL_USE_PWM == TRUE

/* How often a motor that stands is reported. */
#define REPEAT_MS 1000U
/* The microseconds from the level of the direction to the pulse that it is for, and from one pulse to the next. */
#define SETUP_US 1U
/* A period of the counter, and a compare value that it does not reach: it counts, and there is no pulse. */
#define LONG_PERIOD 0xFFFEU
#define NO_PULSE 0xFFFFU

/* The modes of an output: held low, and low until the counter is at the compare value. */
#define HELD_LOW 4U
#define LATE_PULSE 7U

static void set_mode(const up_motor_t *motor, uint32_t mode) {
  stm32_tim_t *timer = motor->driver->tim;
  volatile uint32_t *modes = (motor->channel < 2U) ? &timer->CCMR1 : &timer->CCMR2;
  const uint32_t shift = ((motor->channel & 1U) == 0U) ? 4U : 12U;

  *modes = mode << shift; /* the timer has no other output, and takes compare values at once */
}

void up_motor_start(const up_motor_t *motor) {
  stm32_tim_t *timer = motor->driver->tim;

  timer->CR1 = STM32_TIM_CR1_URS | STM32_TIM_CR1_OPM;
  set_mode(motor, HELD_LOW);
  timer->CNT = 0U;
  timer->CCR[motor->channel] = NO_PULSE;
  timer->ARR = LONG_PERIOD;
  set_mode(motor, LATE_PULSE);
  pwmEnablePeriodicNotification(motor->driver);
}

/* Begins the next interval. The counter runs meanwhile, so that the time that this takes is part of the interval. */
static void advance(const up_motor_t *motor) {
  stm32_tim_t *timer = motor->driver->tim;
  up_stepper_state_t *stepper = &motor->state->stepper;
  const uint32_t setup = (SETUP_US * motor->stepper.tick_hz) / 1000000U + 1U;
  uint32_t ticks, least;

  timer->CCR[motor->channel] = NO_PULSE;
  timer->ARR = LONG_PERIOD;
  timer->CR1 = STM32_TIM_CR1_URS | STM32_TIM_CR1_OPM | STM32_TIM_CR1_CEN;
  ticks = up_stepper_advance(&motor->stepper, stepper);
  if (ticks == 0U) {
    timer->CR1 = STM32_TIM_CR1_URS | STM32_TIM_CR1_OPM;
    timer->CNT = 0U;
    return;
  }
  palWriteLine(motor->dir, (stepper->is_backward != motor->is_forward_high) ? PAL_HIGH : PAL_LOW);
  least = timer->CNT + setup + motor->pulse_ticks;
  ticks = (ticks < least) ? least : ticks;
  if (stepper->is_step) {
    timer->CCR[motor->channel] = ticks - motor->pulse_ticks;
  }
  timer->ARR = ticks - 1U;
}

void up_motor_on_step(const up_motor_t *motor) {
  chSysLockFromISR();
  advance(motor);
  chSysUnlockFromISR();
}

void up_motors_set(const up_motors_t *motors, const void *value) {
  const uint8_t type = up_config.schema->fields[motors->field].type;
  const size_t element_bytes = up_type_bytes(type);
  const uint8_t *elements = value;
  uint8_t i;

  for (i = 0U; i < motors->motors_count; i++) {
    const up_motor_t *motor = motors->motors[i];
    up_stepper_state_t *stepper = &motor->state->stepper;

    if (motor->enable != PAL_NOLINE) {
      palWriteLine(motor->enable, motor->is_enabled_high ? PAL_HIGH : PAL_LOW);
    }
    chSysLock();
    up_stepper_command(&motor->stepper, stepper, type, &elements[i * element_bytes]);
    if (stepper->lap_ticks == 0U) {
      advance(motor);
    }
    chSysUnlock();
  }
}

void up_motors_stop(const up_motors_t *motors) {
  uint8_t i;

  for (i = 0U; i < motors->motors_count; i++) {
    chSysLock();
    up_stepper_stop(&motors->motors[i]->state->stepper);
    chSysUnlock();
  }
}

void up_position_poll(const up_position_t *position) {
  const uint8_t type = up_config.schema->fields[position->field].type;
  const size_t element_bytes = up_type_bytes(type);
  uint8_t *value = (uint8_t *)position->value;
  bool has_changed = false;
  size_t i;

  for (i = 0U; i < position->motors_count; i++) {
    int32_t now;

    chSysLock();
    now = position->motors[i]->state->stepper.position;
    chSysUnlock();
    has_changed = has_changed || now != position->reported[i];
    position->reported[i] = now;
    up_count_store(type, now, &value[i * element_bytes]);
  }
  if (up_repeat_is_due(position->repeat, has_changed, REPEAT_MS, up_now_ms())) {
    up_result(position->field, UP_FRESH, value);
  }
}

#endif
