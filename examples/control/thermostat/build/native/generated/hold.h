/*
 * What the controller `Hold` of Oven gets and gives. A step runs every 200 ms.
 * Generated; changes here are lost. The code is yours: user/hold.c
 */
#ifndef SENSE_HOLD_H
#define SENSE_HOLD_H

#include <stdbool.h>
#include <stdint.h>

/* What a step gets. `is_valid` tells whether the newest reading came through; `age_us` is the age of the value. */
struct hold_in {
  struct {
    int16_t value;
    uint32_t age_us;
    bool is_valid;
  } temperature;
  struct {
    float value;
    uint32_t age_us;
    bool is_valid;
  } setpoint;
};

/* What a step gives. What it does not set stays as it is. */
struct hold_out {
  struct {
    uint16_t value;
    bool is_set;
  } heater;
};

/* Yours: called once, before the first step. */
void hold_init(void);

/* Yours: called every 200 ms. `dt_us` is the time since the step before, 0 for the first one. */
void hold_step(const struct hold_in *in, struct hold_out *out, uint32_t dt_us);

/* Temperature in degC. */
static inline float hold_get_temperature(const struct hold_in *in) {
  const double x = 0.0078125 * (double)in->temperature.value + 0.0;
  return (float)x;
}

/* Sets Heater. */
static inline void hold_put_heater(struct hold_out *out, uint16_t value) {
  out->heater.value = value;
  out->heater.is_set = true;
}

/* Sets Heater to a value in %; what the type cannot hold becomes the nearest that it can. */
static inline void hold_set_heater(struct hold_out *out, float shown) {
  double code = ((double)shown - 0.0) / 0.01;
  code += code < 0.0 ? -0.5 : 0.5;
  if (!(code > 0.0)) {
    code = 0.0;
  }
  if (code > 65535.0) {
    code = 65535.0;
  }
  hold_put_heater(out, (uint16_t)code);
}

#endif
