/*
 * Constants in program memory.
 *
 * On AVR, constants take RAM, of which there is little, unless they are declared for program memory, which has pointers
 * and instructions of its own. Constant tables and pointers to them are therefore declared with UP_ROM; on all other
 * machines that is `const`. Only C has such pointers: C++ on AVR must leave the tables to functions in C. avr-gcc takes
 * one kind of pointer for the other without a word, unless it is called with `-Waddr-space-convert`.
 */
#ifndef UP_ROM_H
#define UP_ROM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__AVR__) && !defined(__cplusplus)

#include <avr/pgmspace.h>

#define UP_ROM const __flash
#define UP_ROM_NULL ((UP_ROM void *)0)

/* The functions of the library take the address of program memory as if it were one of RAM. */
#define UP_ROM_ADDRESS(rom) ((const void *)(uintptr_t)(rom))

static inline void up_rom_copy(void *to, UP_ROM void *from, size_t count) {
  memcpy_P(to, UP_ROM_ADDRESS(from), count);
}

static inline bool up_rom_is(const void *bytes, UP_ROM void *wanted, size_t count) {
  return memcmp_P(bytes, UP_ROM_ADDRESS(wanted), count) == 0;
}

static inline size_t up_rom_length(UP_ROM char *text) {
  return strlen_P(UP_ROM_ADDRESS(text));
}

#else

#define UP_ROM const
/* A pointer to no constant. */
#define UP_ROM_NULL NULL

/* Copies `count` bytes, at least 1, into RAM. */
static inline void up_rom_copy(void *to, UP_ROM void *from, size_t count) {
  memcpy(to, from, count);
}

/* Whether `count` bytes, at least 1, are those of a constant. */
static inline bool up_rom_is(const void *bytes, UP_ROM void *wanted, size_t count) {
  return memcmp(bytes, wanted, count) == 0;
}

/* The length of a text. */
static inline size_t up_rom_length(UP_ROM char *text) {
  return strlen(text);
}

#endif

#endif
