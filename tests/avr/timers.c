/*
 * The timers 0 to 5: their registers and edges of pads in; counts, requests and captures out.
 *
 * A timer is a tick at which its round began; what happens in a round are places in it, of which the next one is an
 * alarm. simavr's timers know no way down, take a new top at once, and miss modes and registers of these MCUs.
 */
#include "timers.h"

#define TCCRB 1U
#define TIMSK 0x6E
#define TIFR 0x35
#define CAPTURE_FLAG 5U
#define RISING_CAPTURE 6U
#define CLOCK_MASK 7U
#define EDGES_FALLING 6U
#define EDGES_RISING 7U
#define ASYNCHRONOUS 2U

/* The places of registers behind the first one. */
typedef struct {
  uint8_t count;
  uint8_t compare;
} layout_t;

static const layout_t NARROW = {.count = 2, .compare = 3};
static const layout_t WIDE = {.count = 4, .compare = 8};
#define CAPTURE_AT 6U

static timer_unit_t timers[TIMERS];

static uint16_t most(const timer_unit_t *timer) {
  return timer->facts->is_wide ? UINT16_MAX : UINT8_MAX;
}

static const layout_t *layout(const timer_unit_t *timer) {
  return timer->facts->is_wide ? &WIDE : &NARROW;
}

uint16_t timer_top(const timer_unit_t *timer) {
  switch (timer->mode.from) {
  case OF_COMPARE:
    return timer->used[0];
  case OF_CAPTURE:
    return timer->captured;
  default:
    return timer->mode.top;
  }
}

uint32_t timer_length(const timer_unit_t *timer) {
  const uint32_t top = timer_top(timer);

  if (goes_down(timer)) {
    return top == 0 ? 1 : 2 * top;
  }
  /* A count that is beyond its top goes on to the greatest one. */
  return (timer->seen > top ? most(timer) : top) + 1U;
}

static uint64_t ticks_at(const timer_unit_t *timer, uint64_t cycle) {
  if (timer->counts_edges) {
    return timer->edges;
  }
  return timer->cycles == 0 ? timer->held : cycle / timer->cycles;
}

/* The place in the round at a time, which may be a little before its beginning. */
static int64_t place_at(const timer_unit_t *timer, uint64_t cycle) {
  return (int64_t)(ticks_at(timer, cycle) - timer->origin);
}

uint16_t timer_count(const timer_unit_t *timer, uint64_t cycle) {
  const int64_t length = timer_length(timer);
  const int64_t top = timer_top(timer);
  int64_t place = place_at(timer, cycle) % length;

  place += place < 0 ? length : 0;
  return (uint16_t)(goes_down(timer) && place > top ? length - place : place);
}

/* The place of a count, on the way up or down; what is beyond the top of a wave begins to go down. */
static uint32_t place_of(const timer_unit_t *timer, uint16_t count, bool is_down) {
  const uint32_t top = timer_top(timer);

  if (!goes_down(timer)) {
    return count;
  }
  return count >= top ? top : is_down && count > 0 ? 2 * top - count : count;
}

static void load(timer_unit_t *timer) {
  const uint32_t top = timer_top(timer);
  bool has_changed = false;

  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    has_changed |= timer->used[channel] != timer->written[channel];
    timer->used[channel] = timer->written[channel];
  }
  if (timer->mode.kind == PHASE && timer_top(timer) != top) {
    timer->origin += (uint64_t)top - timer_top(timer);
    timer->seen = timer_top(timer);
  }
  if (has_changed) {
    waves_look(timer);
  }
}

/* Whether a channel's value is met at a place: the flag comes a tick after the count. */
static bool matches(const timer_unit_t *timer, unsigned channel, uint32_t place) {
  const uint32_t value = timer->used[channel];
  const uint32_t top = timer_top(timer);

  if (place == value + 1) {
    return value <= top || !goes_down(timer);
  }
  return goes_down(timer) && value > 0 && value < top && place == 2 * top - value + 1;
}

static uint32_t sooner(uint32_t best, uint32_t place, uint32_t seen) {
  return place > seen && place < best ? place : best;
}

static uint32_t next_place(const timer_unit_t *timer) {
  const uint32_t seen = timer->seen;
  const uint32_t top = timer_top(timer);
  uint32_t best = timer_length(timer);

  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    const uint32_t value = timer->used[channel];

    best = sooner(best, value + 1, seen);
    if (goes_down(timer) && value > 0 && value < top) {
      best = sooner(best, 2 * top - value + 1, seen);
    }
  }
  return goes_down(timer) ? sooner(best, top, seen) : best;
}

static void end_round(timer_unit_t *timer, uint32_t length) {
  const bool has_run_over = length == most(timer) + 1U;

  timer->origin += length;
  timer->seen = 0;
  if (goes_down(timer) || timer->mode.kind == FAST || has_run_over) {
    request_raise(timer->overflow);
  }
  if (!goes_down(timer) && timer->mode.from == OF_CAPTURE && length == timer->captured + 1U) {
    request_raise(timer->capture);
  }
  if (timer->mode.kind == FAST || timer->mode.kind == PHASE_AND_FREQUENCY) {
    load(timer);
  }
}

static void happen(timer_unit_t *timer, uint32_t place, uint32_t length) {
  const uint32_t top = timer_top(timer);
  const bool is_blocked = timer->origin + place == timer->blocked;

  timer->seen = place;
  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    if (matches(timer, channel, place) && !is_blocked) {
      request_raise(timer->compares[channel]);
      waves_match(timer, channel);
    }
  }
  if (goes_down(timer) && place == (top == 0 ? length : top)) {
    if (timer->mode.from == OF_CAPTURE) {
      request_raise(timer->capture);
    }
    if (timer->mode.kind == PHASE) {
      load(timer);
    }
  }
  if (place == length) {
    end_round(timer, length);
  }
}

static avr_cycle_count_t on_tick(avr_t *of, avr_cycle_count_t when, void *subject);

/* Everything up to a time happens, and the next thing is an alarm. */
static void advance(timer_unit_t *timer, uint64_t cycle) {
  for (;;) {
    const uint32_t next = next_place(timer);
    const int64_t place = place_at(timer, cycle);

    if (place < (int64_t)next) {
      timer->seen = place > (int64_t)timer->seen ? (uint32_t)place : timer->seen;
      break;
    }
    happen(timer, next, timer_length(timer));
  }
  if (timer->cycles == 0) {
    alarm_off(on_tick, timer);
  } else {
    alarm_at((timer->origin + next_place(timer)) * timer->cycles, on_tick, timer);
  }
}

static avr_cycle_count_t on_tick(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  advance(subject, when);
  return 0;
}

static bool is_on_way_down(const timer_unit_t *timer) {
  return goes_down(timer) && timer->seen > timer_top(timer);
}

/* The count goes on from a place, whatever the clock and the mode are now. */
static void go_on(timer_unit_t *timer, uint16_t count, bool is_down) {
  timer->seen = place_of(timer, count, is_down);
  timer->origin = ticks_at(timer, avr->cycle) - timer->seen;
  advance(timer, avr->cycle);
}

/* ATmega328P, tables 15-8 and 16-4, waveform generation modes. */
static timer_mode_t mode_of(const timer_unit_t *timer) {
  static const timer_mode_t narrow[8] = {
      {NORMAL, OF_MODE, 0xFF}, {PHASE, OF_MODE, 0xFF}, {CLEARED, OF_COMPARE, 0}, {FAST, OF_MODE, 0xFF},
      {NORMAL, OF_MODE, 0xFF}, {PHASE, OF_COMPARE, 0}, {NORMAL, OF_MODE, 0xFF},  {FAST, OF_COMPARE, 0}};
  static const timer_mode_t wide[16] = {
      {NORMAL, OF_MODE, 0xFFFF},
      {PHASE, OF_MODE, 0xFF},
      {PHASE, OF_MODE, 0x1FF},
      {PHASE, OF_MODE, 0x3FF},
      {CLEARED, OF_COMPARE, 0},
      {FAST, OF_MODE, 0xFF},
      {FAST, OF_MODE, 0x1FF},
      {FAST, OF_MODE, 0x3FF},
      {PHASE_AND_FREQUENCY, OF_CAPTURE, 0},
      {PHASE_AND_FREQUENCY, OF_COMPARE, 0},
      {PHASE, OF_CAPTURE, 0},
      {PHASE, OF_COMPARE, 0},
      {CLEARED, OF_CAPTURE, 0},
      {NORMAL, OF_MODE, 0xFFFF},
      {FAST, OF_CAPTURE, 0},
      {FAST, OF_COMPARE, 0}};
  const unsigned low = avr->data[timer->facts->base] & 3U;
  const unsigned high = avr->data[timer->facts->base + TCCRB] >> 3;

  return timer->facts->is_wide ? wide[low | (high & 3U) << 2] : narrow[low | (high & 1U) << 2];
}

static void set_clock(timer_unit_t *timer) {
  static const uint16_t usual[] = {0, 1, 8, 64, 256, 1024, 0, 0};
  static const uint16_t asynchronous[] = {0, 1, 8, 32, 64, 128, 256, 1024};
  const unsigned select = avr->data[timer->facts->base + TCCRB] & CLOCK_MASK;
  const bool is_usual = timer->number != ASYNCHRONOUS;

  timer->held = ticks_at(timer, avr->cycle);
  timer->cycles = is_usual ? usual[select] : asynchronous[select];
  timer->counts_edges = is_usual && select >= EDGES_FALLING;
  timer->is_rising = select == EDGES_RISING;
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  timer_unit_t *const timer = subject;
  uint16_t count;
  bool is_down;

  advance(timer, of->cycle);
  count = timer_count(timer, of->cycle);
  is_down = is_on_way_down(timer);
  of->data[address] = value;
  timer->mode = mode_of(timer);
  set_clock(timer);
  if (!has_waves(timer)) {
    load(timer);
  }
  go_on(timer, count, is_down);
  waves_look(timer);
}

static uint8_t read_count(avr_t *of, avr_io_addr_t address, void *subject) {
  timer_unit_t *const timer = subject;
  uint16_t count;

  (void)address;
  advance(timer, of->cycle);
  count = timer_count(timer, of->cycle);
  timer->high = (uint8_t)(count >> 8);
  return (uint8_t)count;
}

static uint8_t read_captured(avr_t *of, avr_io_addr_t address, void *subject) {
  timer_unit_t *const timer = subject;

  (void)of;
  (void)address;
  timer->high = (uint8_t)(timer->captured >> 8);
  return (uint8_t)timer->captured;
}

static uint8_t read_high(avr_t *of, avr_io_addr_t address, void *subject) {
  (void)of;
  (void)address;
  return ((const timer_unit_t *)subject)->high;
}

static void write_high(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)of;
  (void)address;
  ((timer_unit_t *)subject)->high = value;
}

static uint16_t joined(const timer_unit_t *timer, uint8_t low) {
  return timer->facts->is_wide ? (uint16_t)(timer->high << 8 | low) : low;
}

static void write_count(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  timer_unit_t *const timer = subject;

  (void)address;
  advance(timer, of->cycle);
  go_on(timer, joined(timer, value), false);
  timer->blocked = timer->origin + timer->seen + 1;
}

static void write_captured(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  timer_unit_t *const timer = subject;
  uint16_t count;
  bool is_down;

  (void)address;
  /* Only what counts up to it may write it. */
  if (timer->mode.from != OF_CAPTURE) {
    return;
  }
  advance(timer, of->cycle);
  count = timer_count(timer, of->cycle);
  is_down = is_on_way_down(timer);
  timer->captured = joined(timer, value);
  go_on(timer, count, is_down);
  waves_look(timer);
}

static void write_compare(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  timer_unit_t *const timer = subject;
  const unsigned size = timer->facts->is_wide ? 2 : 1;
  const unsigned channel = (unsigned)(address - timer->facts->base - layout(timer)->compare) / size;

  advance(timer, of->cycle);
  timer->written[channel] = joined(timer, value);
  of->data[address] = value;
  if (timer->facts->is_wide) {
    of->data[address + 1] = timer->high;
  }
  if (!has_waves(timer)) {
    load(timer);
    advance(timer, of->cycle);
  } else if (timer->cycles == 0 && !timer->counts_edges) {
    /* Nothing comes that would load it; a wave that stands is none. */
    load(timer);
  }
}

static bool is_same(pad_t one, pad_t other) {
  return one.port != 0 && one.port == other.port && one.pin == other.pin;
}

void timers_pin(pad_t pad, bool is_high, uint64_t cycle) {
  for (unsigned number = 0; number < TIMERS; number++) {
    timer_unit_t *const timer = &timers[number];

    if (timer->facts == NULL) {
      continue;
    }
    if (timer->counts_edges && is_same(timer->facts->clock, pad) && is_high == timer->is_rising) {
      timer->edges++;
      advance(timer, cycle);
    }
    if (timer->facts->is_wide && is_same(timer->facts->capture, pad) && timer->mode.from != OF_CAPTURE &&
        is_high == is_set(timer->facts->base + TCCRB, RISING_CAPTURE)) {
      timer->captured = timer_count(timer, cycle);
      request_raise(timer->capture);
    }
  }
}

void timers_direction(pad_t pad) {
  for (unsigned number = 0; number < TIMERS; number++) {
    timer_unit_t *const timer = &timers[number];

    for (unsigned channel = 0; timer->facts != NULL && channel < channels_of(timer); channel++) {
      if (is_same(timer->facts->outputs[channel], pad)) {
        waves_look(timer);
      }
    }
  }
}

int timers_wave_level(pad_t pad) {
  for (unsigned number = 0; number < TIMERS; number++) {
    const timer_unit_t *const timer = &timers[number];

    for (unsigned channel = 0; timer->facts != NULL && channel < channels_of(timer); channel++) {
      const int level = is_same(timer->facts->outputs[channel], pad) ? waves_level(timer, channel) : -1;

      if (level >= 0) {
        return level;
      }
    }
  }
  return -1;
}

void timers_reset(void) {
  for (unsigned number = 0; number < TIMERS; number++) {
    timer_unit_t *const timer = &timers[number];

    if (timer->facts != NULL) {
      timer->mode = mode_of(timer);
      set_clock(timer);
      timer->captured = 0;
      for (unsigned channel = 0; channel < CHANNELS; channel++) {
        timer->written[channel] = 0;
        timer->used[channel] = 0;
        timer->outputs[channel].is_high = false;
      }
      go_on(timer, 0, false);
      waves_look(timer);
    }
  }
}

static void init_requests(timer_unit_t *timer) {
  const timer_facts_t *const facts = timer->facts;
  const uint16_t flags = (uint16_t)(TIFR + timer->number);
  const uint16_t masks = (uint16_t)(TIMSK + timer->number);

  timer->overflow = request_new(facts->overflow_vector, flags, 0, masks, 0, false);
  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    timer->compares[channel] =
        request_new(facts->compare_vectors[channel], flags, 1 + channel, masks, 1 + channel, false);
  }
  if (facts->is_wide) {
    timer->capture = request_new(facts->capture_vector, flags, CAPTURE_FLAG, masks, CAPTURE_FLAG, false);
  }
  flags_at(flags);
  masks_at(masks);
}

/* A register of one or two bytes, of which the lower one counts. */
static void init_register(timer_unit_t *timer, unsigned place, avr_io_read_t read, avr_io_write_t write) {
  const uint16_t address = (uint16_t)(timer->facts->base + place);

  avr_register_io_write(avr, address, write, timer);
  if (read != NULL) {
    avr_register_io_read(avr, address, read, timer);
  }
  if (timer->facts->is_wide) {
    avr_register_io_write(avr, address + 1, write_high, timer);
    if (read != NULL) {
      avr_register_io_read(avr, address + 1, read_high, timer);
    }
  }
}

static void init_timer(timer_unit_t *timer, unsigned number) {
  const unsigned size = part->timers[number].is_wide ? 2 : 1;

  timer->number = number;
  timer->facts = &part->timers[number];
  init_requests(timer);
  avr_register_io_write(avr, timer->facts->base, write_control, timer);
  avr_register_io_write(avr, timer->facts->base + TCCRB, write_control, timer);
  init_register(timer, layout(timer)->count, read_count, write_count);
  for (unsigned channel = 0; channel < channels_of(timer); channel++) {
    init_register(timer, layout(timer)->compare + size * channel, NULL, write_compare);
  }
  if (timer->facts->is_wide) {
    init_register(timer, CAPTURE_AT, read_captured, write_captured);
  }
}

void timers_init(void) {
  for (unsigned number = 0; number < TIMERS; number++) {
    if (part->timers[number].is_there) {
      init_timer(&timers[number], number);
    }
  }
}
