/* Sends the times of edges: at INT0 both, at a pin change, and at ICP1 rising ones. A tick is half a microsecond. */
#include "program.h"

#define QUEUE 64U

typedef struct {
  uint8_t where;
  uint16_t ticks;
} edge_t;

static volatile edge_t queue[QUEUE];
static volatile uint8_t written;

static inline void keep(uint8_t where, uint16_t ticks) {
  queue[written % QUEUE].where = where;
  queue[written % QUEUE].ticks = ticks;
  written++;
}

ISR(INT0_vect) {
  const uint16_t ticks = TCNT1;

  keep('i', ticks);
}

ISR(PCINT2_vect) {
  const uint16_t ticks = TCNT1;

  keep('p', ticks);
}

ISR(TIMER1_CAPT_vect) {
  keep('c', ICR1);
}

int main(void) {
  uint8_t sent = 0;

  serial_begin();
  TCCR1B = _BV(ICES1) | _BV(CS11);
  TIMSK1 = _BV(ICIE1);
  EICRA = _BV(ISC00);
  EIMSK = _BV(INT0);
  PCMSK2 = _BV(PCINT23);
  PCICR = _BV(PCIE2);
  sei();
  for (;;) {
    if (sent != written) {
      serial_send(queue[sent % QUEUE].where);
      serial_send16(queue[sent % QUEUE].ticks);
      sent++;
    }
  }
}
