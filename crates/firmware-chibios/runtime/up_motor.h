/*
 * Stepper motors: a timer makes one pulse and stops, and its interrupt counts the step and begins the next interval.
 * However late the interrupt is, there is one pulse for each step that is counted: a late one makes the motor slower.
 */
#ifndef UP_MOTOR_H
#define UP_MOTOR_H

#include "ch.h"
#include "hal.h"

#include "up_count.h"
#include "up_stepper.h"

#if HAL_USE_PWM == TRUE

/* The period that the driver of PWM starts with; the timer is stopped before it is over. */
#define UP_MOTOR_PERIOD 0xFFFFU

/* All zero at the start. */
typedef struct {
  up_stepper_state_t stepper;
} up_motor_state_t;

typedef struct {
  up_stepper_t stepper;
  up_motor_state_t *state;
  PWMDriver *driver;
  uint8_t channel; /* from 0 */
  uint16_t pulse_ticks;
  ioline_t dir;
  bool is_forward_high;
  ioline_t enable; /* PAL_NOLINE without such a wire */
  bool is_enabled_high;
} up_motor_t;

/* An actuator of motors. */
typedef struct {
  const up_motor_t *const *motors; /* one per element */
  uint16_t field;
  uint8_t motors_count;
} up_motors_t;

/* A sensor of their positions: the argument of up_position_poll(). */
typedef struct {
  const up_motor_t *const *motors; /* one per element */
  up_repeat_t *repeat;
  int32_t *reported;
  uint64_t *value; /* as large as the value */
  uint16_t field;
  uint8_t motors_count;
} up_position_t;

/* After the driver was started with a callback that calls up_motor_on_step(). */
void up_motor_start(const up_motor_t *motor);

/* The timer's period is over. From its interrupt. */
void up_motor_on_step(const up_motor_t *motor);

/* Sets the host's value; the first one lets current into the motors. */
void up_motors_set(const up_motors_t *motors, const void *value);

/* Decelerates to a stop. */
void up_motors_stop(const up_motors_t *motors);

void up_position_poll(const up_position_t *position);
#endif

#endif
