/*
 * Outputs of timers, and motor bridges on them.
 */
#ifndef UP_PWM_H
#define UP_PWM_H

#include "up_drive.h"
#include "up_pulse_width.h"
#include "up_rt.h"

typedef struct {
  volatile uint16_t *compare; /* the end of the pulse; of timer 2, its low byte alone */
  volatile uint8_t *control;  /* TCCRnA */
  up_pulse_width_t width;
  uint8_t mask; /* of `control`: connects the pin */
  uint8_t pin;
  bool is_wide; /* 16 bits */
} up_pwm_output_t;

/* An actuator of such outputs. */
typedef struct {
  UP_ROM up_pwm_output_t *outputs; /* one for each element */
  uint16_t field;
  uint8_t outputs_count;
} up_pwm_t;

/* One input of an H-bridge: an output of a timer, or a pin. */
typedef struct {
  UP_ROM up_pwm_output_t *pwm; /* NULL for a pin */
  uint8_t pin;
  bool is_low_active;
} up_bridge_output_t;

typedef struct {
  UP_ROM up_drive_t *drive;
  up_drive_state_t *state;
  UP_ROM up_bridge_output_t *outputs; /* in the order of up_drive_mode_t */
  uint16_t field;
} up_bridge_t;

/* Sets a value, or 0 to 10000 for all outputs. */
void up_pwm_set(UP_ROM up_pwm_t *pwm, const void *value);
void up_pwm_set_level(UP_ROM up_pwm_t *pwm, uint16_t level);

/* Sets a value, or -10000 to 10000. */
void up_bridge_set(UP_ROM up_bridge_t *bridge, const void *value);
void up_bridge_set_level(UP_ROM up_bridge_t *bridge, int32_t level);

#endif
