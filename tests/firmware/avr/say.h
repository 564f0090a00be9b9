/*
 * Text from a program, on a simulated AVR and on the computer.
 */
#ifndef SAY_H
#define SAY_H

#include "up_rom.h"

#if defined(__AVR__)
#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

static inline void say_byte(char letter) {
  while ((UCSR0A & _BV(UDRE0)) == 0U) {
  }
  UDR0 = (uint8_t)letter;
}

static inline void begin(void) {
  UCSR0B = _BV(TXEN0);
}

/* The simulator ends where nothing can wake the processor up. */
static inline void end(void) {
  while ((UCSR0A & _BV(UDRE0)) == 0U) {
  }
  cli();
  sleep_enable();
  sleep_cpu();
}
#else
#include <stdio.h>

static inline void say_byte(char letter) {
  (void)putchar(letter);
}

static inline void begin(void) {
}

static inline void end(void) {
}
#endif

static inline void say(const char *text) {
  for (; *text != '\0'; text++) {
    say_byte(*text);
  }
}

static inline void say_rom(UP_ROM char *text) {
  for (; *text != '\0'; text++) {
    say_byte(*text);
  }
}

static inline void say_bytes(const uint8_t *bytes, size_t count) {
  static UP_ROM char digits[] = "0123456789abcdef";
  size_t i;

  for (i = 0U; i < count; i++) {
    say_byte(digits[bytes[i] >> 4]);
    say_byte(digits[bytes[i] & 15U]);
  }
  say_byte('\n');
}

#endif
