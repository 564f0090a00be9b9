/* What the programs of these tests share: a serial port of 250,000 baud (no error at 16 MHz), without interrupts. */
#ifndef PROGRAM_H
#define PROGRAM_H

#include <avr/interrupt.h>
#include <avr/io.h>
#include <stdint.h>

static inline void serial_begin(void) {
  UBRR0 = 3;
  UCSR0B = _BV(RXEN0) | _BV(TXEN0);
}

static inline void serial_send(uint8_t byte) {
  loop_until_bit_is_set(UCSR0A, UDRE0);
  UDR0 = byte;
}

static inline void serial_send16(uint16_t value) {
  serial_send((uint8_t)value);
  serial_send((uint8_t)(value >> 8));
}

#endif
