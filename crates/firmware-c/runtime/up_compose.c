#include "up_compose.h"

#include <string.h>

#include "up_checksum.h"

#define DVB_S2_POLYNOMIAL 0xD5U
#define LD06_POLYNOMIAL 0x4DU
#define IBUS_START 0xFFFFU
#define CHECKSUM_BYTES_MAX 3U

static uint8_t digit(uint8_t number) {
  return (uint8_t)((number < 10U) ? (48U + number) : (55U + number)); /* '0' and 'A' - 10 */
}

/* Writes the checksum of the first `at` bytes after them, and returns its size. */
static size_t put_checksum(const up_compose_t *how, uint8_t *bytes, size_t at) {
  const size_t from = (how->checksum_from < at) ? how->checksum_from : at;
  uint16_t sum;

  switch ((up_checksum_t)how->checksum) {
  case UP_CHECKSUM_SUM8:
    bytes[at] = up_sum8(&bytes[from], at - from);
    return 1U;
  case UP_CHECKSUM_XOR8:
    bytes[at] = up_xor8(&bytes[from], at - from);
    return 1U;
  case UP_CHECKSUM_CRC8_DVB_S2:
    bytes[at] = up_crc8(DVB_S2_POLYNOMIAL, 0U, &bytes[from], at - from);
    return 1U;
  case UP_CHECKSUM_CRC8_LD06:
    bytes[at] = up_crc8(LD06_POLYNOMIAL, 0U, &bytes[from], at - from);
    return 1U;
  case UP_CHECKSUM_SUM16:
    sum = up_sum16(&bytes[from], at - from);
    bytes[at] = (uint8_t)(sum >> 8);
    bytes[at + 1U] = (uint8_t)sum;
    return 2U;
  case UP_CHECKSUM_IBUS:
    sum = (uint16_t)(IBUS_START - up_sum16(&bytes[from], at - from));
    bytes[at] = (uint8_t)sum;
    bytes[at + 1U] = (uint8_t)(sum >> 8);
    return 2U;
  case UP_CHECKSUM_NMEA:
    sum = up_xor8(&bytes[how->start_count], at - how->start_count);
    bytes[at] = (uint8_t)'*';
    bytes[at + 1U] = digit((uint8_t)(sum >> 4));
    bytes[at + 2U] = digit((uint8_t)(sum & 15U));
    return 3U;
  case UP_CHECKSUM_NONE:
  default:
    return 0U;
  }
}

size_t up_compose(const up_compose_t *how, const up_field_t *field, const void *value, uint8_t *bytes, size_t room) {
  const size_t around = (size_t)how->start_count + how->end_count + CHECKSUM_BYTES_MAX;
  size_t size = how->start_count;
  size_t value_bytes;

  if (room < around) {
    return 0U;
  }
  if (how->start_count > 0U) {
    memcpy(bytes, how->start, how->start_count);
  }
  value_bytes = up_value_encode(&how->value, field, value, &bytes[size], room - around);
  if (value_bytes == 0U) {
    return 0U;
  }
  size += value_bytes;
  size += put_checksum(how, bytes, size);
  if (how->end_count > 0U) {
    memcpy(&bytes[size], how->end, how->end_count);
  }
  return size + how->end_count;
}
