/*
 * A PID line follower. Where the line is comes from the sensors that see it, weighted by how dark they are; where none
 * sees it, it is where it was last, at the end of the row.
 */
#include "follow.h"

#define SENSORS 8
#define PITCH_MM 9.5f
#define BRIGHT 300.0f
#define DARK 3200.0f
/* Where the line is taken to be when no sensor sees it. */
#define LOST_MM 40.0f
#define SUM_MAX 10.0f

static float last_mm;
static float sum;

void follow_init(void) {
  last_mm = 0.0f;
  sum = 0.0f;
}

/* 0 on the bright floor, 1 on the line. */
static float darkness(uint16_t value) {
  const float share = ((float)value - BRIGHT) / (DARK - BRIGHT);
  return share > 0.0f ? share : 0.0f;
}

/* Where the line is: millimetres to the right of the middle. */
static float offset_mm(const struct follow_in *in) {
  float weight = 0.0f;
  float moment = 0.0f;
  for (int i = 0; i < SENSORS; i++) {
    const float dark = darkness(in->line.value[i]);
    weight += dark;
    moment += dark * ((float)i - (SENSORS - 1) / 2.0f) * PITCH_MM;
  }
  if (weight < 0.3f) {
    return last_mm > 0.0f ? LOST_MM : -LOST_MM;
  }
  return moment / weight;
}

/* Forwards, and to the right: percent of full speed, which the setters keep to. */
static void drive(struct follow_out *out, float speed, float turn) {
  follow_set_left(out, speed + turn);
  follow_set_right(out, speed - turn);
}

void follow_step(const struct follow_in *in, struct follow_out *out, uint32_t dt_us) {
  if (!in->line.is_valid) {
    drive(out, 0.0f, 0.0f);
    return;
  }
  const float dt = (float)dt_us * 1e-6f;
  const float now_mm = offset_mm(in);
  const float rate = dt > 0.0f ? (now_mm - last_mm) / dt : 0.0f;
  last_mm = now_mm;
  sum += now_mm * dt;
  sum = sum > SUM_MAX ? SUM_MAX : sum < -SUM_MAX ? -SUM_MAX : sum;
  drive(out, (float)in->cruise.value, 1.5f * now_mm + 0.8f * sum + 0.08f * rate);
  follow_put_offset(out, now_mm);
}
