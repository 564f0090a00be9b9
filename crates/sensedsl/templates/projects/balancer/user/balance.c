/*
 * Balances: a complementary filter tells the lean from the gyroscope and the accelerometer, and the speed of the wheels
 * follows lean and rate. What the wheels have gone away pulls it back.
 */
#include "balance.h"

#define DEGREES 57.29578f

static float lean;
static float speed;
static bool is_begun;

void balance_init(void) {
  lean = 0.0f;
  speed = 0.0f;
  is_begun = false;
}

static float clamped(float value, float most) {
  return value < -most ? -most : value > most ? most : value;
}

void balance_step(const struct balance_in *in, struct balance_out *out, uint32_t dt_us) {
  if (!in->imu_acceleration.is_valid || !in->imu_rate.is_valid) {
    return;
  }
  const float dt = (float)dt_us * 1e-6f;
  /* Gravity along the robot, in g: for small angles the sine is the angle. */
  const float from_gravity = -balance_get_imu_acceleration(in, 0);
  const float rate = balance_get_imu_rate(in, 1) / DEGREES;
  if (!is_begun) {
    lean = from_gravity;
    is_begun = true;
  }
  lean = 0.999f * (lean + rate * dt) + 0.001f * from_gravity;

  /* The push that holds it, summed to a speed; and speed leans it back, so that it comes to rest. */
  const float push = 60.0f * lean + 7.0f * rate + 1.2f * speed;
  speed = clamped(speed + push * dt, 1.2f);
  const float share = clamped(speed / 1.26f * 100.0f, 100.0f);
  balance_set_left(out, share);
  balance_set_right(out, share);
  balance_put_lean(out, lean * DEGREES);
}
