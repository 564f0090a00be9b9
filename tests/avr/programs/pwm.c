/* A servo on OC1A with the top in ICR1, fast pulses on OC0A, slower ones in both directions on OC2B, a tone on OC0B. */
#include "program.h"

#include <util/delay.h>

int main(void) {
  DDRB = _BV(PB1);
  DDRD = _BV(PD6) | _BV(PD3) | _BV(PD4);
  ICR1 = 39999;
  TCCR1A = _BV(COM1A1) | _BV(WGM11);
  TCCR1B = _BV(WGM13) | _BV(WGM12) | _BV(CS11);
  ICR1 = 39999;
  OCR1A = 2999;
  OCR0A = 63;
  TCCR0A = _BV(COM0A1) | _BV(WGM01) | _BV(WGM00);
  TCCR0B = _BV(CS01) | _BV(CS00);
  OCR2B = 51;
  TCCR2A = _BV(COM2B1) | _BV(WGM20);
  TCCR2B = _BV(CS22);
  _delay_ms(100);
  OCR1A = 3999;
  PORTD |= _BV(PD4);
  _delay_ms(100);
  TCCR0A = 0;
  for (;;) {
  }
}
