/*
 * What the controller `Follow` of Follower gets and gives. A step runs every 5 ms.
 * Generated; changes here are lost. The code is yours: user/follow.c
 */
#ifndef SENSE_FOLLOW_H
#define SENSE_FOLLOW_H

#include <stdbool.h>
#include <stdint.h>

/* What a step gets. `is_valid` tells whether the newest reading came through; `age_us` is the age of the value. */
struct follow_in {
  struct {
    uint16_t value[8];
    uint32_t age_us;
    bool is_valid;
  } line;
  struct {
    int16_t value;
    uint32_t age_us;
    bool is_valid;
  } cruise;
};

/* What a step gives. What it does not set stays as it is. */
struct follow_out {
  struct {
    int16_t value;
    bool is_set;
  } left;
  struct {
    int16_t value;
    bool is_set;
  } right;
  struct {
    float value;
    bool is_set;
  } offset;
};

/* Yours: called once, before the first step. */
void follow_init(void);

/* Yours: called every 5 ms. `dt_us` is the time since the step before, 0 for the first one. */
void follow_step(const struct follow_in *in, struct follow_out *out, uint32_t dt_us);

/* Sets Left. */
static inline void follow_put_left(struct follow_out *out, int16_t value) {
  out->left.value = value;
  out->left.is_set = true;
}

/* Sets Left to a value in %; what the type cannot hold becomes the nearest that it can. */
static inline void follow_set_left(struct follow_out *out, float shown) {
  double code = ((double)shown - 0.0) / 0.01;
  code += code < 0.0 ? -0.5 : 0.5;
  if (!(code > -32768.0)) {
    code = -32768.0;
  }
  if (code > 32767.0) {
    code = 32767.0;
  }
  follow_put_left(out, (int16_t)code);
}

/* Sets Right. */
static inline void follow_put_right(struct follow_out *out, int16_t value) {
  out->right.value = value;
  out->right.is_set = true;
}

/* Sets Right to a value in %; what the type cannot hold becomes the nearest that it can. */
static inline void follow_set_right(struct follow_out *out, float shown) {
  double code = ((double)shown - 0.0) / 0.01;
  code += code < 0.0 ? -0.5 : 0.5;
  if (!(code > -32768.0)) {
    code = -32768.0;
  }
  if (code > 32767.0) {
    code = 32767.0;
  }
  follow_put_right(out, (int16_t)code);
}

/* Sets Offset. */
static inline void follow_put_offset(struct follow_out *out, float value) {
  out->offset.value = value;
  out->offset.is_set = true;
}

#endif
