/* Selects a chip, exchanges three bytes at 1 MHz in mode 0, and sends what came; over and over. */
#include "program.h"

#include <util/delay.h>

int main(void) {
  serial_begin();
  DDRB = _BV(PB2) | _BV(PB3) | _BV(PB5);
  PORTB = _BV(PB2);
  SPCR = _BV(SPE) | _BV(MSTR) | _BV(SPR0);
  for (uint8_t first = 0;; first += 3) {
    PORTB &= (uint8_t)~_BV(PB2);
    for (uint8_t at = 0; at < 3; at++) {
      SPDR = first + at;
      loop_until_bit_is_set(SPSR, SPIF);
      serial_send(SPDR);
    }
    PORTB |= _BV(PB2);
    _delay_ms(1);
  }
}
