/*
 * Drives at full speed, slows down from 60 cm on, and stands at 20 cm. Without a distance it stands as well.
 */
#include "stop.h"

void stop_init(void) {
}

void stop_step(const struct stop_in *in, struct stop_out *out, uint32_t dt_us) {
  (void)dt_us;
  float speed = 0.0f;
  if (in->front.is_valid && in->front.age_us < 200000u && !in->bumper.value) {
    const float cm = stop_get_front(in);
    speed = (cm - 20.0f) * 2.0f;
    if (speed > 80.0f) {
      speed = 80.0f;
    }
    /* Less than this does not turn the motors. */
    if (speed < 8.0f) {
      speed = 0.0f;
    }
  }
  stop_set_left_speed(out, speed);
  stop_set_right_speed(out, speed);
}
