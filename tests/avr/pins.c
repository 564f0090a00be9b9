/*
 * Ports: what the program drives and what is around the board in; levels, pin changes and external interrupts out.
 */
#include "talk.h"

#define PIN_OFFSET 0U
#define DIRECTION 1U
#define LATCH 2U
#define EICRA 0x69
#define EICRB 0x6A
#define EIMSK 0x3D
#define EIFR 0x3C
#define PCICR 0x68
#define PCIFR 0x3B
#define PCMSK 0x6B
#define MCUCR 0x55
#define PULL_UPS_OFF 4U

/* ATmega328P, table 13-1, interrupt sense control. */
enum { SENSE_LOW, SENSE_BOTH, SENSE_FALLING, SENSE_RISING };

typedef struct {
  level_t outside;
  uint64_t next_ns;
  level_t next;
  level_t told; /* what the world knows of the board's own drive */
  bool is_high;
  bool is_taken; /* by a timer */
  bool has_wave; /* which is told as a whole */
  level_t timer;
} state_t;

static state_t states[PORTS][PINS];
static request_t *outsides[OUTSIDES];

static state_t *state_of(pad_t pad) {
  return &states[pad.port - 'A'][pad.pin & 7U];
}

static bool is_same(pad_t one, pad_t other) {
  return one.port != 0 && one.port == other.port && one.pin == other.pin;
}

static uint16_t base_of(pad_t pad) {
  return part->ports[pad.port - 'A'];
}

bool pin_is_output(pad_t pad) {
  return pad.port != 0 && is_set(base_of(pad) + DIRECTION, pad.pin);
}

level_t pin_outside(pad_t pad) {
  return pad.port == 0 ? FLOATING : state_of(pad)->outside;
}

bool pin_level(pad_t pad) {
  const state_t *const state = state_of(pad);

  if (pin_is_output(pad)) {
    if (state->is_taken) {
      return state->has_wave ? timers_wave_level(pad) > 0 : state->timer == HIGH;
    }
    return is_set(base_of(pad) + LATCH, pad.pin);
  }
  if (state->outside != FLOATING) {
    return state->outside == HIGH;
  }
  return is_set(base_of(pad) + LATCH, pad.pin) && !is_set(MCUCR, PULL_UPS_OFF);
}

static unsigned sense_of(unsigned number) {
  return avr->data[number < 4 ? EICRA : EICRB] >> (2 * (number & 3U)) & 3U;
}

static void look_outside(unsigned number, bool has_changed, bool is_high) {
  request_t *const request = outsides[number];
  const unsigned sense = sense_of(number);

  request->stays = sense == SENSE_LOW;
  if (sense == SENSE_LOW) {
    put(EIFR, number, !is_high);
  } else if (has_changed && (sense == SENSE_BOTH || is_high == (sense == SENSE_RISING))) {
    put(EIFR, number, true);
  }
}

/* Whoever reacts to a pad looks at it. */
static void look(pad_t pad, uint64_t cycle) {
  state_t *const state = state_of(pad);
  const bool is_high = pin_level(pad);

  if (is_high == state->is_high) {
    return;
  }
  state->is_high = is_high;
  for (unsigned number = 0; number < OUTSIDES; number++) {
    if (is_same(part->outsides[number], pad)) {
      look_outside(number, true, is_high);
    }
  }
  for (unsigned group = 0; group < CHANGES; group++) {
    for (unsigned place = 0; place < PINS; place++) {
      if (is_same(part->changes[group][place], pad) && is_set(PCMSK + group, place)) {
        put(PCIFR, group, true);
      }
    }
  }
  timers_pin(pad, is_high, cycle);
  requests_look();
}

/* What the board does with a pad, if that is new. */
static void tell(pad_t pad) {
  state_t *const state = state_of(pad);
  level_t level = FLOATING;

  if (pin_is_output(pad) && !(state->is_taken && state->has_wave)) {
    level = pin_level(pad) ? HIGH : LOW;
  }
  if (level != state->told) {
    state->told = level;
    ask_driven(pad, level, avr->cycle);
  }
  look(pad, avr->cycle);
}

static void tell_port(unsigned port) {
  for (unsigned pin = 0; pin < PINS; pin++) {
    tell((pad_t){(char)('A' + port), (uint8_t)pin});
  }
}

void pin_take(pad_t pad, level_t level, bool has_wave) {
  state_t *const state = state_of(pad);

  state->is_taken = true;
  state->has_wave = has_wave;
  state->timer = level;
  tell(pad);
}

void pin_give(pad_t pad) {
  state_of(pad)->is_taken = false;
  tell(pad);
}

static avr_cycle_count_t on_edge(avr_t *of, avr_cycle_count_t when, void *subject);

/* The first edge of all pads is an alarm. */
static void plan_edges(void) {
  uint64_t first_ns = NEVER;

  for (unsigned port = 0; port < PORTS; port++) {
    for (unsigned pin = 0; pin < PINS; pin++) {
      const uint64_t next_ns = states[port][pin].next_ns;

      first_ns = next_ns < first_ns ? next_ns : first_ns;
    }
  }
  if (first_ns == NEVER) {
    alarm_off(on_edge, NULL);
  } else {
    alarm_at(cycle_of(first_ns), on_edge, NULL);
  }
}

static avr_cycle_count_t on_edge(avr_t *of, avr_cycle_count_t when, void *subject) {
  const uint64_t now_ns = ns_of(when);

  (void)of;
  (void)subject;
  for (unsigned port = 0; port < PORTS; port++) {
    for (unsigned pin = 0; pin < PINS; pin++) {
      const pad_t pad = {(char)('A' + port), (uint8_t)pin};
      state_t *const state = &states[port][pin];

      while (state->next_ns <= now_ns) {
        const uint64_t at_ns = state->next_ns;

        state->outside = state->next;
        state->next_ns = NEVER;
        look(pad, cycle_of(at_ns));
        ask_edge(pad, at_ns);
      }
    }
  }
  plan_edges();
  return 0;
}

void pin_set_outside(pad_t pad, level_t level, uint64_t next_ns, level_t next) {
  const unsigned port = (unsigned)(pad.port - 'A');
  state_t *state;

  if (port >= PORTS || pad.pin >= PINS || part->ports[port] == 0) {
    return;
  }
  state = state_of(pad);
  state->outside = level;
  state->next_ns = next_ns;
  state->next = next;
  look(pad, avr->cycle);
  plan_edges();
}

static uint8_t read_pins(avr_t *of, avr_io_addr_t address, void *subject) {
  const char port = (char)(intptr_t)subject;
  uint8_t value = 0;

  (void)of;
  (void)address;
  for (unsigned pin = 0; pin < PINS; pin++) {
    value |= pin_level((pad_t){port, (uint8_t)pin}) ? bit(pin) : 0;
  }
  return value;
}

/* A one at PINx turns the latch over. */
static void write_pins(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  of->data[address - PIN_OFFSET + LATCH] ^= written_bits(value);
  tell_port((unsigned)((intptr_t)subject - 'A'));
}

static void write_latch(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  of->data[address] = value;
  tell_port((unsigned)((intptr_t)subject - 'A'));
}

static void write_direction(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const unsigned port = (unsigned)((intptr_t)subject - 'A');
  const uint8_t changed = of->data[address] ^ value;

  of->data[address] = value;
  for (unsigned pin = 0; pin < PINS; pin++) {
    if ((changed >> pin & 1) != 0) {
      timers_direction((pad_t){(char)('A' + port), (uint8_t)pin});
    }
  }
  fast_timer_direction();
  tell_port(port);
}

/* What is low now asks at once where that is what counts, and leaves no flag behind where it no longer is. */
static void write_senses(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  for (unsigned number = 0; number < OUTSIDES; number++) {
    if (sense_of(number) == SENSE_LOW) {
      put(EIFR, number, false);
    }
  }
  of->data[address] = value;
  for (unsigned number = 0; number < OUTSIDES; number++) {
    if (part->outsides[number].port != 0) {
      look_outside(number, false, pin_level(part->outsides[number]));
    }
  }
  requests_look();
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = value;
  for (unsigned port = 0; port < PORTS; port++) {
    if (part->ports[port] != 0) {
      tell_port(port);
    }
  }
}

void pins_registers(unsigned port, uint8_t *direction, uint8_t *latch) {
  const uint16_t base = part->ports[port];

  *direction = base == 0 ? 0 : avr->data[base + DIRECTION];
  *latch = base == 0 ? 0 : avr->data[base + LATCH];
}

void pins_reset(void) {
  for (unsigned port = 0; port < PORTS; port++) {
    for (unsigned pin = 0; pin < PINS; pin++) {
      states[port][pin].is_taken = false;
    }
    if (part->ports[port] != 0) {
      tell_port(port);
    }
  }
  plan_edges();
}

void pins_init(void) {
  for (unsigned port = 0; port < PORTS; port++) {
    const uint16_t base = part->ports[port];
    void *const letter = (void *)(intptr_t)('A' + (int)port);

    for (unsigned pin = 0; pin < PINS; pin++) {
      states[port][pin] = (state_t){.outside = FLOATING, .next_ns = NEVER, .told = FLOATING};
    }
    if (base != 0) {
      avr_register_io_read(avr, base + PIN_OFFSET, read_pins, letter);
      avr_register_io_write(avr, base + PIN_OFFSET, write_pins, letter);
      avr_register_io_write(avr, base + DIRECTION, write_direction, letter);
      avr_register_io_write(avr, base + LATCH, write_latch, letter);
    }
  }
  for (unsigned number = 0; number < OUTSIDES; number++) {
    if (part->outsides[number].port != 0) {
      outsides[number] = request_new((uint8_t)(number + 1), EIFR, number, EIMSK, number, false);
    }
  }
  for (unsigned group = 0; group < CHANGES; group++) {
    if (part->changes[group][1].port != 0) {
      request_new((uint8_t)(part->change_vector + group), PCIFR, group, PCICR, group, false);
    }
  }
  flags_at(EIFR);
  masks_at(EIMSK);
  flags_at(PCIFR);
  masks_at(PCICR);
  avr_register_io_write(avr, EICRA, write_senses, NULL);
  avr_register_io_write(avr, EICRB, write_senses, NULL);
  avr_register_io_write(avr, MCUCR, write_control, NULL);
}
