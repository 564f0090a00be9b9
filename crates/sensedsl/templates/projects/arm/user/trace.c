/*
 * Goes round a square in the space of the two joints, straight from corner to corner in two seconds each.
 */
#include "trace.h"

#define CORNERS 4
#define EACH_US 2000000u

static const float corner[CORNERS][2] = {{60.0f, 60.0f}, {120.0f, 60.0f}, {120.0f, 120.0f}, {60.0f, 120.0f}};
static uint32_t since_us;

void trace_init(void) {
  since_us = 0;
}

void trace_step(const struct trace_in *in, struct trace_out *out, uint32_t dt_us) {
  since_us += dt_us;
  const uint32_t piece = since_us / EACH_US % CORNERS;
  const float share = (float)(since_us % EACH_US) / (float)EACH_US;
  const float *from = corner[piece];
  const float *to = corner[(piece + 1) % CORNERS];
  const float shoulder = from[0] + (to[0] - from[0]) * share;
  const float elbow = from[1] + (to[1] - from[1]) * share;
  trace_set_shoulder(out, shoulder);
  trace_set_elbow(out, elbow);
  if (in->joints.is_valid) {
    trace_put_behind(out, 0, shoulder - trace_get_joints(in, 0));
    trace_put_behind(out, 1, elbow - trace_get_joints(in, 1));
  }
}
