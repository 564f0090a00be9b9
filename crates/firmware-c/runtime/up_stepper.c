#include "up_stepper.h"

#include "up_convert.h"

/* A longer interval is cut into pieces of this length, so that a new target counts soon. */
#define PIECE 0x8000U

/* The root of a square, rounded down, in 1/256: 16 digits of it at least. */
static uint32_t root(uint64_t square) {
  uint64_t wide = square << 16;
  uint32_t number, bit = UINT32_C(1) << 30, found = 0U;
  uint8_t shift = 0U;

  while ((wide >> 32) != 0U) {
    wide >>= 2;
    shift++;
  }
  number = (uint32_t)wide;
  for (; bit != 0U; bit >>= 2) {
    if (number >= found + bit) {
      number -= found + bit;
      found = (found >> 1) + bit;
    } else {
      found >>= 1;
    }
  }
  return found << shift;
}

static uint64_t square_of(uint32_t speed) {
  return (uint64_t)speed * speed;
}

void up_stepper_command(UP_ROM up_stepper_t *motor, up_stepper_state_t *state, uint8_t type, const void *element) {
  const uint32_t least = motor->is_velocity ? motor->speed : (uint32_t)INT32_MAX + 1U;
  const uint32_t greatest = motor->is_velocity ? motor->speed : (uint32_t)INT32_MAX;
  bool is_negative;
  const up_unsigned_t wanted = up_load_magnitude(type, element, &is_negative);

  if (is_negative) {
    state->target = (int32_t)-(int64_t)((wanted > least) ? least : wanted);
  } else {
    state->target = (int32_t)((wanted > greatest) ? greatest : wanted);
  }
  state->is_stopped = false;
}

void up_stepper_stop(up_stepper_state_t *state) {
  state->is_stopped = true;
}

/* How far the target lies ahead in the direction of the motion, and whether the speed may grow and stay: the steps that
 * are needed to stop are no more than those that are left. */
static uint64_t toward(UP_ROM up_stepper_t *motor, const up_stepper_state_t *state, int64_t ahead, uint64_t change) {
  const uint64_t most = square_of(motor->speed);
  const uint64_t room = (ahead > 0) ? (uint64_t)(ahead - 1) * change : 0U;
  const uint64_t faster = (state->square + change < most) ? state->square + change : most;

  if (faster <= room) {
    return faster;
  }
  if (state->square <= room) {
    return state->square;
  }
  return (state->square > change) ? state->square - change : 0U;
}

static uint64_t approach(uint64_t square, uint64_t wanted, uint64_t change) {
  if (square < wanted) {
    return (wanted - square > change) ? square + change : wanted;
  }
  return (square - wanted > change) ? square - change : wanted;
}

/* What the target asks for: steps ahead, or a speed; negative against the direction of the motion. */
static int64_t wanted(UP_ROM up_stepper_t *motor, const up_stepper_state_t *state) {
  int64_t ahead = 0;

  if (!state->is_stopped) {
    ahead = motor->is_velocity ? state->target : (int64_t)state->target - state->position;
  }
  return state->is_backward ? -ahead : ahead;
}

/* Decides direction and speed of the next step; false at rest. */
static bool choose(UP_ROM up_stepper_t *motor, up_stepper_state_t *state) {
  const uint64_t change = 2U * (uint64_t)motor->acceleration;
  int64_t ahead = wanted(motor, state);

  /* A motor that is as slow as after its first step, or slower, may stand at once. */
  if (ahead <= 0 && state->square < change) {
    state->square = 0U;
    state->speed = 0U;
    if (ahead == 0) {
      return false;
    }
    state->is_backward = !state->is_backward;
    ahead = -ahead;
  }
  if (!motor->is_velocity) {
    state->next_square = toward(motor, state, ahead, change);
  } else {
    state->next_square = approach(state->square, (ahead > 0) ? square_of((uint32_t)ahead) : 0U, change);
  }
  return true;
}

/* The ticks of the next step: one step over the mean of the speeds at its ends. */
static uint32_t interval(UP_ROM up_stepper_t *motor, up_stepper_state_t *state) {
  const uint32_t dividend = motor->tick_hz * 512U;
  uint32_t sum, ticks, rest;

  state->next_speed = (state->next_square == state->square) ? state->speed : root(state->next_square);
  sum = state->speed + state->next_speed;
  if (sum == 0U) {
    sum = root(motor->acceleration); /* from rest to rest: it is fastest in the middle */
  }
  ticks = dividend / sum;
  rest = (dividend % sum) / ((sum >> 8) + 1U) + state->fraction;
  state->next_fraction = (uint8_t)rest;
  return ticks + (rest >> 8);
}

uint32_t up_stepper_advance(UP_ROM up_stepper_t *motor, up_stepper_state_t *state) {
  uint32_t left;

  state->elapsed += state->lap_ticks;
  if (state->lap_ticks != 0U && state->is_step) {
    state->position = (int32_t)((uint32_t)state->position + (state->is_backward ? UINT32_MAX : 1U));
    state->square = state->next_square;
    state->speed = state->next_speed;
    state->fraction = state->next_fraction;
    state->elapsed = 0U;
  }
  state->lap_ticks = 0U;
  state->is_step = false;
  if (!choose(motor, state)) {
    state->elapsed = 0U;
    state->fraction = 0U;
    return 0U;
  }
  left = interval(motor, state);
  /* A new target may ask for a step that is due already. */
  left = (left > state->elapsed) ? left - state->elapsed : 1U;
  state->is_step = left <= UP_STEPPER_LONGEST;
  state->lap_ticks = state->is_step ? left : PIECE;
  return state->lap_ticks;
}
