/* Instructions of an emulated Cortex-M4: with `-icount shift=0` QEMU's clock is one nanosecond an instruction, and this
 * timer of the board mps2-an386 counts at 25 MHz. */
#ifndef BENCH_H
#define BENCH_H

#include <stdint.h>
#include <stdio.h>

#define ROUNDS 10000U
#define TIMER ((volatile uint32_t *)0x40000000U)

static inline void bench_start(void) {
  TIMER[2] = 0xFFFFFFFFU;
  TIMER[1] = 0xFFFFFFFFU;
  TIMER[0] = 1U;
}

static inline uint32_t bench_now(void) {
  return TIMER[1];
}

static inline void bench_say(const char *what, uint32_t from, uint32_t to) {
  printf("%s %lu\n", what, (unsigned long)((uint64_t)(from - to) * 40U / ROUNDS));
}

#endif
