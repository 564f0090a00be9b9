/* Sends what the converter gives for ADC0, and for ADC6, which no port has. */
#include "program.h"

static uint16_t converted(uint8_t input) {
  ADMUX = _BV(REFS0) | input;
  ADCSRA = _BV(ADEN) | _BV(ADSC) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);
  loop_until_bit_is_clear(ADCSRA, ADSC);
  return ADC;
}

int main(void) {
  serial_begin();
  for (;;) {
    serial_send16(converted(0));
    serial_send16(converted(6));
  }
}
