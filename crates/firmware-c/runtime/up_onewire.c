#include "up_onewire.h"

#include <string.h>

/* From one falling edge to the next, in microseconds: 50 low and 26 high are a zero, 50 low and 70 high are a one. An
 * edge that is 14 late makes its own bit or the next one none of these. */
#define ZERO_LEAST_US 62U
#define ZERO_MOST_US 91U
#define ONE_LEAST_US 105U
#define ONE_MOST_US 150U

/* Polynomial x^8 + x^5 + x^4 + 1, the lowest bit first, from 0. */
static uint8_t crc(const uint8_t *bytes, size_t count) {
  unsigned crc = 0U;
  size_t i;
  unsigned bit;

  for (i = 0U; i < count; i++) {
    crc ^= bytes[i];
    for (bit = 0U; bit < 8U; bit++) {
      crc = ((crc & 1U) != 0U) ? (crc >> 1) ^ 0x8CU : crc >> 1;
    }
  }
  return (uint8_t)crc;
}

static bool are_all(const uint8_t *bytes, size_t count, uint8_t byte) {
  size_t i = 0U;

  while (i < count && bytes[i] == byte) {
    i++;
  }
  return i == count;
}

up_result_t up_onewire_check(const uint8_t *bytes, size_t count) {
  /* The checksum of zeros is right. */
  if (are_all(bytes, count, 0xFFU) || are_all(bytes, count, 0U)) {
    return UP_NOT_ACKNOWLEDGED;
  }
  return (crc(bytes, count) == 0U) ? UP_FRESH : UP_WRONG_CRC;
}

up_result_t up_burst_decode(const uint32_t *falls_us, size_t falls_count, uint8_t bytes[UP_BURST_BYTES]) {
  size_t i;

  if (falls_count != UP_BURST_FALLS) {
    return (falls_count == 0U) ? UP_NOT_ACKNOWLEDGED : UP_TIMED_OUT;
  }
  memset(bytes, 0, UP_BURST_BYTES);
  for (i = 0U; i < 8U * UP_BURST_BYTES; i++) {
    const uint32_t us = falls_us[i + 2U] - falls_us[i + 1U];

    if (us >= ONE_LEAST_US && us <= ONE_MOST_US) {
      bytes[i / 8U] = (uint8_t)(bytes[i / 8U] | (0x80U >> (i % 8U)));
    } else if (us < ZERO_LEAST_US || us > ZERO_MOST_US) {
      return UP_BUS_ERROR;
    }
  }
  return ((uint8_t)(bytes[0] + bytes[1] + bytes[2] + bytes[3]) == bytes[4]) ? UP_FRESH : UP_WRONG_CRC;
}
