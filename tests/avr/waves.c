/*
 * The outputs of a timer: its mode and compare values in; waves as period and width, or single levels, out.
 */
#include "timers.h"

#include "talk.h"

/* ATmega328P, tables 15-2 to 15-7 and 16-1 to 16-3, compare output modes. */
enum { APART, TOGGLES, CLEARS, SETS };

static unsigned action_of(const timer_unit_t *timer, unsigned channel) {
  return avr->data[timer->facts->base] >> (6 - 2 * channel) & 3U;
}

/* Where the top of a wave is a match of its own channel, an output may turn over at each of them. */
static bool turns_over(const timer_unit_t *timer, unsigned channel) {
  return action_of(timer, channel) == TOGGLES && channel == 0 &&
         (timer->mode.from == OF_COMPARE || (timer->mode.from == OF_CAPTURE && timer->mode.kind == FAST));
}

static bool is_connected(const timer_unit_t *timer, unsigned channel) {
  const unsigned action = action_of(timer, channel);

  if (timer->facts->outputs[channel].port == 0 || action == APART) {
    return false;
  }
  return action != TOGGLES || !has_waves(timer) || turns_over(timer, channel);
}

/* In ticks. */
static uint32_t width_of(const timer_unit_t *timer, unsigned channel) {
  const uint32_t top = timer_top(timer);
  const uint32_t length = goes_down(timer) ? 2 * top : top + 1;
  const uint32_t value = timer->used[channel];
  uint32_t high = goes_down(timer) ? 2 * value : value + 1;

  high = value >= top ? length : high;
  return action_of(timer, channel) == SETS ? length - high : high;
}

static void tell(timer_unit_t *timer, unsigned channel, uint64_t period, uint64_t width) {
  output_t *const output = &timer->outputs[channel];

  if (output->period == period && output->width == width) {
    return;
  }
  output->period = period;
  output->width = width;
  tell_wave(timer->number, channel + 1, false, period, width, avr->cycle);
}

static void look_at_wave(timer_unit_t *timer, unsigned channel) {
  const pad_t pad = timer->facts->outputs[channel];
  const uint32_t top = timer_top(timer);
  const uint64_t length = goes_down(timer) ? 2ULL * top : top + 1ULL;
  const bool is_turned = turns_over(timer, channel);

  if (!pin_is_output(pad) || timer->cycles == 0) {
    tell(timer, channel, 0, 0);
  } else if (is_turned) {
    tell(timer, channel, 2 * length * timer->cycles, length * timer->cycles);
  } else {
    tell(timer, channel, length * timer->cycles, (uint64_t)width_of(timer, channel) * timer->cycles);
  }
}

void waves_look(timer_unit_t *timer) {
  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    const pad_t pad = timer->facts->outputs[channel];
    output_t *const output = &timer->outputs[channel];
    const bool is_there = is_connected(timer, channel);

    if (is_there && has_waves(timer)) {
      look_at_wave(timer, channel);
      pin_take(pad, LOW, true);
    } else {
      tell(timer, channel, 0, 0);
      if (is_there) {
        pin_take(pad, output->is_high ? HIGH : LOW, false);
      } else if (output->is_there) {
        pin_give(pad);
      }
    }
    output->is_there = is_there;
  }
}

void waves_match(timer_unit_t *timer, unsigned channel) {
  output_t *const output = &timer->outputs[channel];
  const unsigned action = action_of(timer, channel);

  if (has_waves(timer) || !is_connected(timer, channel)) {
    return;
  }
  output->is_high = action == SETS || (action == TOGGLES && !output->is_high);
  pin_take(timer->facts->outputs[channel], output->is_high ? HIGH : LOW, false);
}

int waves_level(const timer_unit_t *timer, unsigned channel) {
  const uint16_t count = timer_count(timer, avr->cycle);
  const uint16_t value = timer->used[channel];
  const bool is_before = count < value || (count == value && !goes_down(timer)) || value >= timer_top(timer);

  if (!is_connected(timer, channel) || !has_waves(timer)) {
    return -1;
  }
  return is_before != (action_of(timer, channel) == SETS);
}
