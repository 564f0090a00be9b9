/*
 * Interrupt requests: flags and masks in registers in, the next interrupt out.
 *
 * simavr's own list loses a request that is made again before it was served, and misses flags that are set when their
 * mask opens. Here a request is what the data sheets say: a flag and a mask, looked at again whenever either changes.
 */
#include "board.h"

#include <simavr/sim_core.h>

#define REQUESTS 64U
#define SBI 0x9A00U
#define SBI_MASK 0xFF00U

/* By vector: the first one that asks is served. */
static request_t *requests[REQUESTS];
static request_t storage[REQUESTS];
static size_t count;

request_t *request_new(uint8_t vector, uint16_t flag_at, unsigned flag, uint16_t mask_at, unsigned mask, bool stays) {
  request_t *const one = &storage[count];
  size_t at = count++;

  *one = (request_t){.vector = vector, .flag_at = flag_at, .flag = (uint8_t)flag, .mask_at = mask_at,
                     .mask = (uint8_t)mask, .stays = stays};
  for (; at > 0 && requests[at - 1]->vector > vector; at--) {
    requests[at] = requests[at - 1];
  }
  requests[at] = one;
  return one;
}

static request_t *first(void) {
  for (size_t at = 0; at < count; at++) {
    request_t *const one = requests[at];

    if (is_set(one->flag_at, one->flag) != one->is_clear && is_set(one->mask_at, one->mask)) {
      return one;
    }
  }
  return NULL;
}

void requests_look(void) {
  if (first() == NULL) {
    return;
  }
  if (avr->state == cpu_Sleeping) {
    avr->state = cpu_Running;
  }
  if (avr->sreg[S_I] && avr->interrupt_state == 0) {
    avr->interrupt_state = 1;
  }
}

void request_raise(const request_t *request) {
  put(request->flag_at, request->flag, true);
  requests_look();
}

void requests_serve(void) {
  request_t *one;

  if (!avr->sreg[S_I] || avr->interrupt_state == 0) {
    return;
  }
  /* The instruction after `sei` or `reti` is executed in any case. */
  if (avr->interrupt_state < 0 && ++avr->interrupt_state < 0) {
    return;
  }
  one = first();
  avr->interrupt_state = 0;
  if (one == NULL) {
    return;
  }
  _avr_push_addr(avr, avr->pc);
  avr_sreg_set(avr, S_I, 0);
  avr->pc = (avr_flashaddr_t)one->vector * avr->vector_size;
  /* ATmega328P, 6.7.1, interrupt response time. */
  avr->cycle += avr->address_size == 3 ? 5 : 4;
  if (!one->stays) {
    put(one->flag_at, one->flag, false);
  }
  if (one->closes) {
    put(one->mask_at, one->mask, false);
  }
}

uint8_t written_bits(uint8_t value) {
  const unsigned opcode = avr->flash[avr->pc] | (unsigned)avr->flash[avr->pc + 1] << 8;

  return (opcode & SBI_MASK) == SBI ? bit(opcode & 7U) : value;
}

static void write_flags(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] &= (uint8_t)~written_bits(value);
}

static void write_masks(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = value;
  requests_look();
}

void flags_at(uint16_t address) {
  avr_register_io_write(avr, address, write_flags, NULL);
}

void masks_at(uint16_t address) {
  avr_register_io_write(avr, address, write_masks, NULL);
}
