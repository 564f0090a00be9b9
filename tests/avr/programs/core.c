/* Sends what becomes of small things that simavr's own units or requests get wrong; each says what it should be. */
#include "program.h"

static volatile uint8_t overflows;
static volatile uint8_t order;

ISR(TIMER0_OVF_vect) {
  overflows++;
}

ISR(TIMER2_COMPB_vect) {
  order = order == 1 ? 2 : 0xFF;
}

/* A single bit of PINB is written: 0x07. */
static uint8_t turned_over(void) {
  DDRB = 0x0F;
  PORTB = 0x03;
  PINB |= _BV(PB2);
  return PORTB;
}

/* A flag that was there before its mask opens asks once: 1. */
static uint8_t asked_late(void) {
  TCCR0B = _BV(CS00);
  loop_until_bit_is_set(TIFR0, TOV0);
  TCCR0B = 0;
  TIMSK0 = _BV(TOIE0);
  sei();
  __asm__ volatile("nop\n\tnop");
  cli();
  return overflows;
}

/* Flags that are written with ones are gone, the others stay: 0. */
static uint8_t cleared(void) {
  TIMSK0 = 0;
  TCCR0B = _BV(CS00);
  loop_until_bit_is_set(TIFR0, TOV0);
  TCCR0B = 0;
  TIFR0 = _BV(TOV0);
  return TIFR0 & _BV(TOV0);
}

/* The instruction after `sei` comes before the interrupt: 2. */
static uint8_t after_sei(void) {
  OCR2B = 10;
  TCCR2B = _BV(CS20);
  loop_until_bit_is_set(TIFR2, OCF2B);
  TCCR2B = 0;
  TIMSK2 = _BV(OCIE2B);
  __asm__ volatile("ldi r24, 1\n\tsei\n\tsts %0, r24\n\tnop\n\tcli" ::"m"(order) : "r24", "memory");
  return order;
}

/* A count that goes up and down, a quarter and three quarters of its round after the start: about 64 both times. */
static uint16_t up_and_down(void) {
  uint8_t up;
  uint8_t down;

  TIMSK2 = 0;
  TCCR2A = _BV(WGM20);
  TCNT2 = 0;
  TCCR2B = _BV(CS22);
  for (up = TCNT2; up < 64; up = TCNT2) {
  }
  while (TCNT2 != 255) {
  }
  for (down = TCNT2; down > 64; down = TCNT2) {
  }
  return (uint16_t)(up << 8 | down);
}

/* Rising edges at T1, which the program makes: 3. */
static uint8_t counted(void) {
  DDRD |= _BV(PD5);
  TCCR1B = _BV(CS12) | _BV(CS11) | _BV(CS10);
  for (uint8_t edge = 0; edge < 3; edge++) {
    PORTD |= _BV(PD5);
    PORTD &= (uint8_t)~_BV(PD5);
  }
  return (uint8_t)TCNT1;
}

/* A count beyond its new top goes on to the greatest one: above 0xFF00. */
static uint16_t ran_over(void) {
  TCCR1B = 0;
  TCNT1 = 0xFF00;
  OCR1A = 100;
  TCCR1B = _BV(WGM12) | _BV(CS10);
  __asm__ volatile("nop\n\tnop\n\tnop\n\tnop");
  return TCNT1;
}

int main(void) {
  serial_begin();
  serial_send(turned_over());
  serial_send(asked_late());
  serial_send(cleared());
  serial_send(after_sei());
  serial_send16(up_and_down());
  serial_send(counted());
  serial_send16(ran_over());
  for (;;) {
  }
}
