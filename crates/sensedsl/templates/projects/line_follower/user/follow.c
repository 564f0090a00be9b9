/*
 * A PID line follower. Where the line is comes from the sensors that see it, weighted by how dark they are; where none
 * sees it, it is where it was last, at the end of the row.
 */
#include "follow.h"

#define SENSORS 8
#define PITCH_MM 9.5f
#define BRIGHT 300.0f
#define DARK 3200.0f

static float last_mm;
static float sum;

static float clamped(float value, float least, float most) {
  return value < least ? least : value > most ? most : value;
}

void follow_init(void) {
  last_mm = 0.0f;
  sum = 0.0f;
}

/* Where the line is: millimetres to the right of the middle. */
static float offset_mm(const struct follow_in *in) {
  float weight = 0.0f;
  float moment = 0.0f;
  for (int i = 0; i < SENSORS; i++) {
    const float dark = clamped(((float)in->line.value[i] - BRIGHT) / (DARK - BRIGHT), 0.0f, 1.0f);
    weight += dark;
    moment += dark * ((float)i - (SENSORS - 1) / 2.0f) * PITCH_MM;
  }
  if (weight < 0.3f) {
    return last_mm > 0.0f ? 40.0f : -40.0f;
  }
  return moment / weight;
}

void follow_step(const struct follow_in *in, struct follow_out *out, uint32_t dt_us) {
  if (!in->line.is_valid) {
    follow_set_left(out, 0.0f);
    follow_set_right(out, 0.0f);
    return;
  }
  const float dt = (float)dt_us * 1e-6f;
  const float now_mm = offset_mm(in);
  const float rate = dt > 0.0f ? (now_mm - last_mm) / dt : 0.0f;
  last_mm = now_mm;
  sum = clamped(sum + now_mm * dt, -10.0f, 10.0f);

  const float cruise = (float)in->cruise.value;
  const float turn = 1.5f * now_mm + 0.8f * sum + 0.08f * rate;
  follow_set_left(out, clamped(cruise + turn, -100.0f, 100.0f));
  follow_set_right(out, clamped(cruise - turn, -100.0f, 100.0f));
  follow_put_offset(out, now_mm);
}
