/*
 * The timer 4 of the ATmega32U4, as far as it makes waves: its registers in, periods and widths out.
 *
 * It has 10 bits in two registers, a top of its own, and outputs with complements. Neither its count nor its interrupts
 * are modelled, nor the clock of the PLL, dead times and the mode with six outputs. ATmega16U4/32U4, 15.
 */
#include "talk.h"

#define NUMBER 4U
#define TC4H 0xBF
#define TCCR4A 0xC0
#define TCCR4B 0xC1
#define TCCR4C 0xC2
#define TCCR4D 0xC3
#define OCR4A 0xCF
#define OCR4B 0xD0
#define OCR4C 0xD1
#define OCR4D 0xD2
#define OUTPUTS 3U
#define UP_AND_DOWN 1U

/* ATmega16U4/32U4, tables 15-9 to 15-14, compare output modes. */
enum { APART, WITH_COMPLEMENT, CLEARS, SETS };

typedef struct {
  unsigned channel;
  uint16_t control;
  unsigned action_at;
  unsigned wave_at;
  uint16_t compare;
  pad_t pads[2]; /* the output, and its complement */
} facts_t;

static const facts_t FACTS[OUTPUTS] = {
    {1, TCCR4A, 6, 1, OCR4A, {{'C', 7}, {'C', 6}}},
    {2, TCCR4A, 4, 0, OCR4B, {{'B', 6}, {'B', 5}}},
    {4, TCCR4C, 2, 0, OCR4D, {{'D', 7}, {'D', 6}}},
};

static uint16_t values[OCR4D - OCR4A + 1];
static bool has_pad[OUTPUTS][2];
static uint64_t told[OUTPUTS][2][2];

static void tell(unsigned at, unsigned side, uint64_t period, uint64_t width) {
  uint64_t *const before = told[at][side];

  if (before[0] != period || before[1] != width) {
    before[0] = period;
    before[1] = width;
    tell_wave(NUMBER, FACTS[at].channel, side == 1, period, width, avr->cycle);
  }
}

static void look_at(unsigned at, unsigned side) {
  const facts_t *const facts = &FACTS[at];
  const unsigned action = avr->data[facts->control] >> facts->action_at & 3U;
  const unsigned select = avr->data[TCCR4B] & 15U;
  const uint64_t tick = select == 0 ? 0 : 1ULL << (select - 1);
  const bool is_wave = is_set(facts->control, facts->wave_at);
  const bool is_there = is_wave && action != APART && (side == 0 || action == WITH_COMPLEMENT);
  const bool both_ways = (avr->data[TCCR4D] & 3U) == UP_AND_DOWN;
  const uint64_t top = values[OCR4C - OCR4A];
  const uint64_t value = values[facts->compare - OCR4A];
  const uint64_t length = both_ways ? 2 * top : top + 1;
  uint64_t high = value >= top ? length : both_ways ? 2 * value : value + 1;

  if (action == SETS || side == 1) {
    high = length - high;
  }
  if (is_there && pin_is_output(facts->pads[side])) {
    tell(at, side, length * tick, high * tick);
  } else {
    tell(at, side, 0, 0);
  }
  if (is_there != has_pad[at][side]) {
    has_pad[at][side] = is_there;
    is_there ? pin_take(facts->pads[side], LOW, true) : pin_give(facts->pads[side]);
  }
}

void fast_timer_direction(void) {
  for (unsigned at = 0; part->has_fast_timer && at < OUTPUTS; at++) {
    look_at(at, 0);
    look_at(at, 1);
  }
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = value;
  fast_timer_direction();
}

static void write_value(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = value;
  values[address - OCR4A] = (uint16_t)((of->data[TC4H] & 3U) << 8 | value);
  fast_timer_direction();
}

void fast_timer_reset(void) {
  if (!part->has_fast_timer) {
    return;
  }
  for (unsigned at = 0; at < COUNT_OF(values); at++) {
    values[at] = 0;
  }
  values[OCR4C - OCR4A] = UINT8_MAX;
  fast_timer_direction();
}

void fast_timer_init(void) {
  static const uint16_t controls[] = {TCCR4A, TCCR4B, TCCR4C, TCCR4D};

  if (!part->has_fast_timer) {
    return;
  }
  for (size_t at = 0; at < COUNT_OF(controls); at++) {
    avr_register_io_write(avr, controls[at], write_control, NULL);
  }
  for (uint16_t address = OCR4A; address <= OCR4D; address++) {
    avr_register_io_write(avr, address, write_value, NULL);
  }
}
