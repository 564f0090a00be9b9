/*
 * Timers that count the edges of two tracks, set up by their registers, because no driver of ChibiOS supports the mode.
 */
#ifndef UP_ENCODER_H
#define UP_ENCODER_H

#include "ch.h"
#include "hal.h"

#include "stm32_tim.h"
#include "up_count.h"
#include "up_elements.h"

/* The state of a timer that counts; all zero at the start. */
typedef struct {
  virtual_timer_t timer; /* of a 16-bit counter: reads it in time */
  up_count_t count;
  int32_t reported;
} up_encoder_state_t;

/* A timer that counts the edges of two tracks. No driver of ChibiOS supports it. */
typedef struct {
  stm32_tim_t *timer;
  up_encoder_state_t *state;
  uint8_t filter; /* for both inputs: IC1F and IC2F */
  bool is_wide;   /* the counter has 32 bits */
} up_encoder_counter_t;

/* A sensor of such timers: the argument of up_encoder_poll(). */
typedef struct {
  const up_encoder_counter_t *counters; /* one per element */
  up_repeat_t *repeat;
  uint64_t *value; /* as large as the value */
  uint16_t field;
  uint8_t counters_count;
} up_encoder_t;

void up_encoder_start(const up_encoder_counter_t *counter);
void up_encoder_poll(const up_encoder_t *encoder);

#endif
