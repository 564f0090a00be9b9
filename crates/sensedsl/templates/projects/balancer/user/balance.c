/*
 * Balances: a complementary filter tells the lean from the gyroscope and the accelerometer, and the speed of the wheels
 * follows lean and rate. Its speed, and the way that it has gone, lean it back to where it began.
 */
#include "balance.h"

#define DEGREES 57.29578f
/* The wheels' greatest speed, metres a second: 300 rpm at 80 mm. */
#define FASTEST 1.26f
/* A count of 840 a turn. */
#define METRE (840.0f / (0.08f * 3.1415927f))

static float lean;
static float speed;
static bool is_begun;

void balance_init(void) {
  lean = 0.0f;
  speed = 0.0f;
  is_begun = false;
}

static void drive(struct balance_out *out, float metres_a_second) {
  balance_set_left(out, metres_a_second / FASTEST * 100.0f);
  balance_set_right(out, metres_a_second / FASTEST * 100.0f);
}

void balance_step(const struct balance_in *in, struct balance_out *out, uint32_t dt_us) {
  if (!in->imu_acceleration.is_valid || !in->imu_rate.is_valid) {
    drive(out, 0.0f);
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
  lean = 0.998f * (lean + rate * dt) + 0.002f * from_gravity;

  /* The push that holds it, summed to a speed. */
  const float way = (float)in->wheels.value[0] / METRE;
  const float push = 60.0f * lean + 7.0f * rate + 3.0f * speed + 1.0f * way;
  speed += push * dt;
  speed = speed > FASTEST ? FASTEST : speed < -FASTEST ? -FASTEST : speed;
  drive(out, speed);
  balance_put_lean(out, lean * DEGREES);
}
