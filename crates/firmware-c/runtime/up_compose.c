#include "up_compose.h"

#include <string.h>

#include "up_convert.h"

#define DIGITS_MAX 20U
/* A number in a text: a sign, its digits, a point, and what separates it from the next. */
#define TEXT_BYTES (DIGITS_MAX + 3U)

static size_t put(UP_ROM uint8_t *from, size_t count, uint8_t *to) {
  if (count > 0U) {
    up_rom_copy(to, from, count);
  }
  return count;
}

/* The digits of a number, the highest first, with a point before the last `decimals`. */
static size_t put_number(UP_ROM up_compose_t *how, up_unsigned_t number, uint8_t *text) {
  const unsigned base = (how->format == (uint8_t)UP_FORMAT_HEX) ? 16U : 10U;
  const size_t decimals = (base == 10U) ? how->decimals : 0U;
  uint8_t digits[DIGITS_MAX];
  size_t count = 0U, size = 0U;

  while (count < DIGITS_MAX && (number != 0U || count <= decimals)) {
    const unsigned digit = (unsigned)(number % base);
    digits[count] = (uint8_t)((digit < 10U) ? (48U + digit) : (55U + digit)); /* '0' and 'A' - 10 */
    number /= base;
    count++;
  }
  while (count > 0U) {
    count--;
    text[size] = digits[count];
    size++;
    if (count == decimals && decimals > 0U) {
      text[size] = (uint8_t)'.';
      size++;
    }
  }
  return size;
}

static size_t put_text(UP_ROM up_compose_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *text,
                       size_t room) {
  const size_t element_bytes = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t size = 0U, i;

  if (room < TEXT_BYTES * (size_t)field->count) {
    return 0U;
  }
  for (i = 0U; i < field->count; i++) {
    bool is_negative;
    const up_unsigned_t magnitude = up_load_magnitude(field->type, &memory[i * element_bytes], &is_negative);

    if (i > 0U && how->separator != '\0') {
      text[size] = (uint8_t)how->separator;
      size++;
    }
    if (is_negative) {
      text[size] = (uint8_t)'-';
      size++;
    }
    size += put_number(how, magnitude, &text[size]);
  }
  return size;
}

size_t up_compose(UP_ROM up_compose_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes, size_t room) {
  const size_t around =
      (size_t)how->start_count + how->behind_count + how->end_count + up_checksum_bytes(how->checksum);
  uint8_t sum[UP_CHECKSUM_BYTES_MAX];
  size_t size, value_bytes, sum_bytes;

  if (room < around) {
    return 0U;
  }
  size = put(how->start, how->start_count, bytes);
  if (how->format == (uint8_t)UP_FORMAT_BINARY) {
    value_bytes = up_value_encode(&how->value, field, value, &bytes[size], room - around);
  } else {
    value_bytes = put_text(how, field, value, &bytes[size], room - around);
  }
  if (value_bytes == 0U) {
    return 0U;
  }
  size += value_bytes;
  size += put(how->behind, how->behind_count, &bytes[size]);
  sum_bytes = up_checksum_put(how->checksum, how->checksum_from, how->start_count, bytes, size, sum);
  memcpy(&bytes[size], sum, sum_bytes);
  size += sum_bytes;
  return size + put(how->end, how->end_count, &bytes[size]);
}
