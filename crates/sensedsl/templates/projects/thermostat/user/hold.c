/*
 * A PI controller with a limited sum: it does not run away while the heater is fully on.
 */
#include "hold.h"

static float sum;

void hold_init(void) {
  sum = 0.0f;
}

void hold_step(const struct hold_in *in, struct hold_out *out, uint32_t dt_us) {
  if (!in->temperature.is_valid) {
    hold_set_heater(out, 0.0f);
    return;
  }
  const float off = in->setpoint.value - hold_get_temperature(in);
  const float dt = (float)dt_us * 1e-6f;
  const float share = 25.0f * off + sum;
  /* The sum stands still while the heater is at one of its ends. */
  if (share > 0.0f && share < 100.0f) {
    sum += 0.8f * off * dt;
  }
  /* Kept within 0 and 100 %, as the file says of the heater. */
  hold_set_heater(out, share);
}
