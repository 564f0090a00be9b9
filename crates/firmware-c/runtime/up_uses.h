/*
 * The parts of the core that the values of a program need. A part that none of them needs can be left out: set its
 * macro to 0 for the compiler. The tables of the program must then not use it.
 */
#ifndef UP_USES_H
#define UP_USES_H

#ifndef UP_USES_CRC32
#define UP_USES_CRC32 1 /* links whose frames end with a CRC-32 */
#endif
#ifndef UP_USES_REALS
#define UP_USES_REALS 1 /* fields of float32 and float64 */
#endif
#ifndef UP_USES_CODES
#define UP_USES_CODES 1 /* words that are floats, BCD or packed */
#endif
#ifndef UP_USES_WORD_CRC
#define UP_USES_WORD_CRC 1 /* checksums between words */
#endif
#ifndef UP_USES_LAMPS
#define UP_USES_LAMPS 1 /* commands that are colours of a strip */
#endif
#ifndef UP_USES_LETTERS
#define UP_USES_LETTERS 1 /* commands that are letters on a display */
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
#ifndef UP_USES_CHIP_INIT
#define UP_USES_CHIP_INIT 1 /* chips that are written to before they measure */
#endif
#ifndef UP_USES_CHIP_IDENTITY
#define UP_USES_CHIP_IDENTITY 1
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

#endif
