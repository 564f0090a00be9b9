/* Times are 64-bit numbers and are divided by small numbers: in steps of 32 bits, which all cores support or the
 * compiler makes short, so that no program links the compiler's 64-bit division only for that. */
#ifndef UP_DIVIDE_H
#define UP_DIVIDE_H

#include <stdint.h>

/* The low 32 bits of the quotient; the divisor is not 0. */
static inline uint32_t up_divide(uint64_t number, uint16_t divisor) {
  const uint32_t high = (uint32_t)(number >> 32) % divisor;
  const uint32_t middle = (high << 16) | ((uint32_t)number >> 16);
  const uint32_t low = ((middle % divisor) << 16) | ((uint32_t)number & 0xFFFFU);

  return ((middle / divisor) << 16) + low / divisor;
}

#endif
