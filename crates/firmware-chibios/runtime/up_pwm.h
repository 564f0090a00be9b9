/*
 * Outputs of timers, and motor bridges on them.
 */
#ifndef UP_PWM_H
#define UP_PWM_H

#include "ch.h"
#include "hal.h"

#include "up_drive.h"
#include "up_pulse_width.h"

#if HAL_USE_PWM == TRUE
typedef struct {
  PWMDriver *driver;
  pwmchannel_t channel; /* from 0 */
  up_pulse_width_t width;
} up_pwm_output_t;

/* An actuator of such outputs. */
typedef struct {
  const up_pwm_output_t *outputs; /* one per element */
  uint16_t field;
  uint8_t outputs_count;
} up_pwm_t;

/* One input of an H-bridge: an output of a timer, or a pin. */
typedef struct {
  const up_pwm_output_t *pwm; /* NULL for a pin */
  ioline_t line;
  bool is_low_active;
} up_bridge_output_t;

typedef struct {
  const up_drive_t *drive;
  up_drive_state_t *state;
  const up_bridge_output_t *outputs; /* in the order of up_drive_mode_t */
  uint16_t field;
} up_bridge_t;

/* Sets the host's value, or 0 to 10000 for all outputs, from the next period on. */
void up_pwm_set(const up_pwm_t *pwm, const void *value);
void up_pwm_set_level(const up_pwm_t *pwm, uint32_t level);

/* Sets the host's value, or -10000 to 10000. */
void up_bridge_set(const up_bridge_t *bridge, const void *value);
void up_bridge_set_level(const up_bridge_t *bridge, int32_t level);
#endif

#endif
