/*
 * The steps of a motor: from a target to when the next step is due, one step after the other.
 *
 * In: the host's targets, and word that an interval is over. Out: intervals of a timer, each with a step at its end or
 * without one. A step is counted when its interval is over, so the position is the number of steps that were made,
 * whatever the targets were in between. Along a ramp the square of the speed changes by twice the acceleration with
 * each step, which is exact, and the time of a step is that of its mean speed; so nothing adds up over a ramp.
 */
#ifndef UP_STEPPER_H
#define UP_STEPPER_H

#include "up_schema.h"

/* The highest tick_hz: the dividend of an interval then has 32 bits. */
#define UP_STEPPER_TICK_HZ_MAX 4000000U
/* The longest interval: a counter of 16 bits has it, and some ticks to spare. */
#define UP_STEPPER_LONGEST 0xC000U

typedef struct {
  uint32_t tick_hz;      /* of the timer; at most UP_STEPPER_TICK_HZ_MAX */
  uint32_t speed;        /* the greatest, in steps per second; 1 to 500000 */
  uint32_t acceleration; /* in steps per second squared; 1 to 10000000 */
  bool is_velocity;      /* targets are speeds; otherwise they are positions */
} up_stepper_t;

/* All zero at the start: at rest, at position 0. */
typedef struct {
  uint64_t square;      /* of the speed at the last step, in (steps/s)^2; 0: at rest */
  uint64_t next_square; /* and at the next one */
  uint32_t speed;       /* the roots of these, in 1/256 step/s */
  uint32_t next_speed;
  uint32_t lap_ticks; /* the interval under way; 0: none */
  uint32_t elapsed;   /* ticks since the last step that are over, or since the start from rest */
  uint8_t fraction;   /* of a tick, in 1/256, that the last step was early */
  uint8_t next_fraction;
  bool is_step;     /* there is a step at the end of the interval under way */
  bool is_backward; /* the direction of the next step; it changes at rest alone */
  bool is_stopped;  /* no target counts until the next one comes */
  int32_t position; /* the steps that were made; wraps */
  int32_t target;
} up_stepper_state_t;

/* The host's value. A speed greater than the greatest becomes that one. It counts from the next interval on. */
void up_stepper_command(UP_ROM up_stepper_t *motor, up_stepper_state_t *state, uint8_t type, const void *element);

/* Decelerates to a stop, and stays there until the next command. It counts from the next interval on. */
void up_stepper_stop(up_stepper_state_t *state);

/* The interval under way is over, or there is none: counts its step, and begins the next one. Returns its ticks, at
 * most UP_STEPPER_LONGEST, or 0 at rest; `is_step` and `is_backward` say what is at its end. */
uint32_t up_stepper_advance(UP_ROM up_stepper_t *motor, up_stepper_state_t *state);

#endif
