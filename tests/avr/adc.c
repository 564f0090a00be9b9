/*
 * The converter: its registers in, the voltages of pads as numbers out.
 *
 * simavr's takes the voltage when the result is read, and knows no trigger. Here a conversion holds the voltage when
 * the data sheets say so.
 */
#include "talk.h"

#define ADCL 0x78
#define ADCH 0x79
#define ADCSRA 0x7A
#define ADCSRB 0x7B
#define ADMUX 0x7C
#define MASK 3U     /* ADIE */
#define FLAG 4U     /* ADIF */
#define TRIGGERED 5U /* ADATE */
#define START 6U
#define ENABLED 7U
#define LEFT 5U /* ADLAR */
#define STEPS 1024U
#define SUPPLY_UV 5000000U
#define GAP_UV 1100000U
#define WIDE_UV 2560000U
/* In half cycles of the converter's clock: until the voltage is held, and until the result is there. */
#define HOLDS 3U
#define FIRST_HOLDS 27U
#define ENDS 26U
#define FIRST_ENDS 50U

static const request_t *request;
static bool is_first;
static bool is_locked;
static unsigned input;
static uint32_t reference_uv;
static uint16_t result;

static uint32_t reference_of(void) {
  const unsigned select = avr->data[ADMUX] >> 6;

  /* REFS: AREF and AVCC have the board's supply. The smaller parts have no 2.56 V. */
  if (select < 2) {
    return SUPPLY_UV;
  }
  if (part->high_inputs == 0) {
    return GAP_UV;
  }
  return select == 2 ? GAP_UV : WIDE_UV;
}

static unsigned input_of(void) {
  const bool is_high = part->high_inputs != 0 && is_set(ADCSRB, part->high_inputs);
  const unsigned mask = part->high_inputs == 0 ? 0xF : 0x1F;

  return (avr->data[ADMUX] & mask) | (is_high ? 0x20U : 0);
}

/* Single inputs, the band gap and ground; what else there is reads as ground. */
static uint32_t microvolts(uint64_t cycle) {
  const bool is_small = part->high_inputs == 0;
  const unsigned gap = is_small ? 14 : 30;

  if (input == gap) {
    return GAP_UV;
  }
  if (input < 8) {
    return ask_microvolts(part->inputs[input], input, cycle);
  }
  if (!is_small && input >= 0x20 && input < 0x28 && part->inputs[input - 0x20 + 8].port != 0) {
    return ask_microvolts(part->inputs[input - 0x20 + 8], input - 0x20 + 8, cycle);
  }
  return 0;
}

static avr_cycle_count_t on_hold(avr_t *of, avr_cycle_count_t when, void *subject) {
  const uint64_t steps = (uint64_t)microvolts(when) * STEPS / reference_uv;

  (void)of;
  (void)subject;
  result = (uint16_t)(steps < STEPS ? steps : STEPS - 1);
  return 0;
}

static avr_cycle_count_t on_end(avr_t *of, avr_cycle_count_t when, void *subject);

static void start(uint64_t cycle) {
  const unsigned select = avr->data[ADCSRA] & 7U;
  const uint64_t half = select == 0 ? 1 : 1ULL << (select - 1);

  input = input_of();
  reference_uv = reference_of();
  put(ADCSRA, START, true);
  alarm_at(cycle + half * (is_first ? FIRST_HOLDS : HOLDS), on_hold, NULL);
  alarm_at(cycle + half * (is_first ? FIRST_ENDS : ENDS), on_end, NULL);
  is_first = false;
}

static avr_cycle_count_t on_end(avr_t *of, avr_cycle_count_t when, void *subject) {
  const uint16_t shown = is_set(ADMUX, LEFT) ? (uint16_t)(result << 6) : result;

  (void)subject;
  put(ADCSRA, START, false);
  if (!is_locked) {
    of->data[ADCL] = (uint8_t)shown;
    of->data[ADCH] = (uint8_t)(shown >> 8);
  }
  request_raise(request);
  /* ADTS 0: the next one begins at once. */
  if (is_set(ADCSRA, TRIGGERED) && (of->data[ADCSRB] & 7U) == 0) {
    start(when);
  }
  return 0;
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const uint8_t before = of->data[address];
  const uint8_t flag = (uint8_t)(before & ~written_bits(value) & bit(FLAG));
  const uint8_t running = before & bit(START);

  (void)subject;
  of->data[address] = (uint8_t)((value & ~(bit(FLAG) | bit(START))) | flag | running);
  if (!is_set(ADCSRA, ENABLED)) {
    put(ADCSRA, START, false);
    alarm_off(on_hold, NULL);
    alarm_off(on_end, NULL);
    is_first = true;
  } else if ((value & bit(START)) != 0 && running == 0) {
    start(of->cycle);
  }
  requests_look();
}

/* Both bytes are of one conversion: the lower one locks the higher one. */
static uint8_t read_low(avr_t *of, avr_io_addr_t address, void *subject) {
  (void)subject;
  is_locked = true;
  return of->data[address];
}

static uint8_t read_high(avr_t *of, avr_io_addr_t address, void *subject) {
  (void)subject;
  is_locked = false;
  return of->data[address];
}

void adc_reset(void) {
  is_first = true;
  is_locked = false;
}

void adc_init(void) {
  request = request_new(part->adc_vector, ADCSRA, FLAG, ADCSRA, MASK, false);
  avr_register_io_write(avr, ADCSRA, write_control, NULL);
  avr_register_io_read(avr, ADCL, read_low, NULL);
  avr_register_io_read(avr, ADCH, read_high, NULL);
}
