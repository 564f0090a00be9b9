/*
 * The parts of the core that the values of a program need. A part that none of them needs can be left out: set its
 * macro to 0 for the compiler. The tables of the program must then not use it.
 *
 * Sizes that a small machine sets lower stand beside what they are for: UP_FIELD_BITMAP_BYTES, UP_DECODER_WALKS,
 * UP_PPM_CHANNELS_MAX and UP_REPORTER_READ_BYTES.
 */
#ifndef UP_USES_H
#define UP_USES_H

#include <stdint.h>

/* Where a program is built without options of its own, they stand in a file. */
#if defined(ARDUINO)
#include "sense_conf.h"
#endif

#ifndef UP_USES_CRC32
#define UP_USES_CRC32 1 /* links whose frames end with a CRC-32 */
#endif
#ifndef UP_USES_REALS
#define UP_USES_REALS 1 /* fields of float32 and float64 */
#endif
#ifndef UP_USES_WIDE
#define UP_USES_WIDE 1 /* numbers of more than 32 bits: fields and words of that size, reals, decimal text */
#endif
#if UP_USES_REALS && !UP_USES_WIDE
#error "reals are converted in 64 bits: UP_USES_REALS needs UP_USES_WIDE"
#endif
#ifndef UP_USES_COMMANDS
#define UP_USES_COMMANDS 1 /* reporters whose hosts send values, and that let others see what comes */
#endif
#ifndef UP_USES_HEALTH
#define UP_USES_HEALTH 1 /* reporters that note how devices are, and tell hosts that ask */
#endif
#ifndef UP_USES_CODES
#define UP_USES_CODES 1 /* words that are floats, BCD or packed */
#endif
#ifndef UP_USES_WORD_CRC
#define UP_USES_WORD_CRC 1 /* checksums between words */
#endif
#ifndef UP_USES_WORD_BITS
#define UP_USES_WORD_BITS 1 /* words of which only some bits are the value, or that are packed */
#endif
#ifndef UP_USES_LAMPS
#define UP_USES_LAMPS 1 /* commands that are colours of a strip */
#endif
#ifndef UP_USES_LETTERS
#define UP_USES_LETTERS 1 /* commands that are letters on a display */
#endif
#ifndef UP_USES_INVALID
#define UP_USES_INVALID 1
#endif
#ifndef UP_USES_MEDIAN
#define UP_USES_MEDIAN 1
#endif
#ifndef UP_USES_SMOOTH
#define UP_USES_SMOOTH 1
#endif
#ifndef UP_USES_CHANGE
#define UP_USES_CHANGE 1
#endif
#ifndef UP_USES_CAPTURE_TIMES
#define UP_USES_CAPTURE_TIMES 1 /* captures of widths, periods, frequencies and duties: of anything but counts */
#endif
#ifndef UP_USES_CHIP_INIT
#define UP_USES_CHIP_INIT 1 /* chips that are written to before they measure */
#endif
#ifndef UP_USES_CHIP_IDENTITY
#define UP_USES_CHIP_IDENTITY 1
#endif
#ifndef UP_USES_CHIP_TRIGGERS
#define UP_USES_CHIP_TRIGGERS 1 /* transfers that start a measurement and fetch it later */
#endif
#ifndef UP_USES_CHIP_READS
#define UP_USES_CHIP_READS 1 /* transfers of chips that measure by themselves */
#endif
#ifndef UP_USES_CHIP_TURNS
#define UP_USES_CHIP_TURNS 1 /* chips that do not have exactly one transfer */
#endif
#ifndef UP_USES_CHIP_FORMULAS
#define UP_USES_CHIP_FORMULAS 1 /* and calibration */
#endif
#ifndef UP_USES_CHIP_COMMANDS
#define UP_USES_CHIP_COMMANDS 1
#endif
#ifndef UP_USES_CHIP_EXCHANGES
#define UP_USES_CHIP_EXCHANGES 1
#endif

/* Where a double is as short as a float, as on AVR, there can be no fields of float64. */
#if defined(__SIZEOF_DOUBLE__) && __SIZEOF_DOUBLE__ < 8
#define UP_USES_DOUBLES 0
#else
#define UP_USES_DOUBLES 1
#endif

/* How far events are counted that only people look at: in 32 bits, and each fault of a device in 16; or, to save RAM,
 * in 16 and 8. Counts of events wrap, those of faults stop. */
#ifndef UP_SHORT_COUNTS
#if defined(__AVR__)
#define UP_SHORT_COUNTS 1
#else
#define UP_SHORT_COUNTS 0
#endif
#endif
#if UP_SHORT_COUNTS
typedef uint16_t up_events_t;
typedef uint8_t up_fault_count_t;
#define UP_FAULT_COUNT_MAX UINT8_MAX
#else
typedef uint32_t up_events_t;
typedef uint16_t up_fault_count_t;
#define UP_FAULT_COUNT_MAX UINT16_MAX
#endif

#endif
