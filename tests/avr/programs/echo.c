/* Sends back what it receives, one more each, with interrupts; sleeps in between. */
#include "program.h"

#include <avr/sleep.h>

ISR(USART_RX_vect) {
  const uint8_t byte = UDR0;

  UDR0 = (uint8_t)(byte + 1);
}

int main(void) {
  serial_begin();
  UCSR0B |= _BV(RXCIE0);
  set_sleep_mode(SLEEP_MODE_IDLE);
  sei();
  for (;;) {
    sleep_mode();
  }
}
