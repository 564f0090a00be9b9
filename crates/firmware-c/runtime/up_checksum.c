#include "up_checksum.h"

#include <stdbool.h>

uint16_t up_sum16(const uint8_t *bytes, size_t count) {
  uint16_t sum = 0U;
  size_t i;

  for (i = 0U; i < count; i++) {
    sum = (uint16_t)(sum + bytes[i]);
  }
  return sum;
}

uint8_t up_sum8(const uint8_t *bytes, size_t count) {
  return (uint8_t)up_sum16(bytes, count);
}

uint8_t up_xor8(const uint8_t *bytes, size_t count) {
  uint8_t sum = 0U;
  size_t i;

  for (i = 0U; i < count; i++) {
    sum ^= bytes[i];
  }
  return sum;
}

uint8_t up_crc8(uint8_t polynomial, uint8_t start, const uint8_t *bytes, size_t count) {
  uint8_t crc = start;
  size_t i;
  unsigned bit;

  for (i = 0U; i < count; i++) {
    crc ^= bytes[i];
    for (bit = 0U; bit < 8U; bit++) {
      const bool is_carried = (crc & 0x80U) != 0U;
      crc = (uint8_t)(crc << 1);
      crc ^= is_carried ? polynomial : 0U;
    }
  }
  return crc;
}

uint16_t up_crc16_of(uint16_t polynomial, const uint8_t *bytes, size_t count) {
  uint16_t crc = 0U;
  size_t i;
  unsigned bit;

  for (i = 0U; i < count; i++) {
    crc ^= (uint16_t)((unsigned)bytes[i] << 8);
    for (bit = 0U; bit < 8U; bit++) {
      crc = (uint16_t)(((crc & 0x8000U) != 0U) ? (((unsigned)crc << 1) ^ polynomial) : ((unsigned)crc << 1));
    }
  }
  return crc;
}
