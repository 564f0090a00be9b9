/*
 * Writes a register's number to the chip at 0x50, reads two bytes of it, then addresses a chip that is not there. Sends
 * the states of the bus and the bytes, and 0xEE where a flag did not come in 5 ms.
 */
#include "program.h"

#include <util/delay.h>

#define LATE 0xEE

static uint8_t order(uint8_t bits) {
  TWCR = _BV(TWINT) | _BV(TWEN) | bits;
  for (uint16_t tens = 0; tens < 500; tens++) {
    if (bit_is_set(TWCR, TWINT)) {
      return TWSR & 0xF8;
    }
    _delay_us(10);
  }
  TWCR = 0;
  return LATE;
}

static uint8_t send(uint8_t byte) {
  TWDR = byte;
  return order(0);
}

static void stop(void) {
  TWCR = _BV(TWINT) | _BV(TWEN) | _BV(TWSTO);
  for (uint8_t tens = 0; tens < 100 && bit_is_set(TWCR, TWSTO); tens++) {
    _delay_us(10);
  }
}

int main(void) {
  serial_begin();
  TWBR = 72;
  for (;;) {
    serial_send(order(_BV(TWSTA)));
    serial_send(send(0x50 << 1));
    serial_send(send(0x07));
    serial_send(order(_BV(TWSTA)));
    serial_send(send(0x50 << 1 | 1));
    serial_send(order(_BV(TWEA)));
    serial_send(TWDR);
    serial_send(order(0));
    serial_send(TWDR);
    stop();
    serial_send(order(_BV(TWSTA)));
    serial_send(send(0x51 << 1));
    stop();
    serial_send('.');
    _delay_ms(2);
  }
}
