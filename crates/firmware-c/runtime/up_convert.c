#include "up_convert.h"

#include <string.h>

typedef struct {
  up_signed_t min;
  up_unsigned_t max;
} range_t;

static UP_ROM range_t ranges[] = {
    [UP_TYPE_BOOL] = {0, 1U},
    [UP_TYPE_UINT8] = {0, UINT8_MAX},
    [UP_TYPE_INT8] = {INT8_MIN, INT8_MAX},
    [UP_TYPE_UINT16] = {0, UINT16_MAX},
    [UP_TYPE_INT16] = {INT16_MIN, INT16_MAX},
    [UP_TYPE_UINT32] = {0, UINT32_MAX},
    [UP_TYPE_INT32] = {INT32_MIN, INT32_MAX},
#if UP_USES_WIDE
    [UP_TYPE_UINT64] = {0, UINT64_MAX},
    [UP_TYPE_INT64] = {INT64_MIN, INT64_MAX},
#endif
};

#if UP_USES_REALS
/* Stores mantissa * 2^exponent; `is_more`: the exact number is a little greater. Rounded to nearest, ties to even,
 * as hardware would, but without linking the emulation of doubles. 64-bit numbers and their ratios are in range. */
static void store_real(uint8_t type, bool is_negative, uint64_t mantissa, int exponent, bool is_more, void *element) {
  const bool is_wide = type == UP_TYPE_FLOAT64;
  const unsigned fraction_bits = is_wide ? 52U : 23U;
  const unsigned spare_bits = 63U - fraction_bits;
  const uint64_t half = (uint64_t)1U << (spare_bits - 1U);
  uint64_t bits = 0U;
  uint64_t rest;

  if (mantissa != 0U) {
    while ((mantissa >> 63) == 0U) {
      mantissa <<= 1;
      exponent--;
    }
    rest = mantissa & (2U * half - 1U);
    bits = mantissa >> spare_bits;
    if (rest > half || (rest == half && (is_more || (bits & 1U) != 0U))) {
      bits++;
    }
    /* The leading 1 is not stored: it adds one to the exponent, and so does a carry out of the fraction. */
    bits += (uint64_t)(exponent + 63 + (is_wide ? 1022 : 126)) << fraction_bits;
    bits |= is_negative ? (uint64_t)1U << (is_wide ? 63 : 31) : 0U;
  }
  up_element_store(type, bits, element);
}
#endif

static bool is_signed(uint8_t type) {
  return type == UP_TYPE_INT8 || type == UP_TYPE_INT16 || type == UP_TYPE_INT32 || type == UP_TYPE_INT64;
}

static bool is_real(uint8_t type) {
  return UP_USES_REALS && (type == UP_TYPE_FLOAT32 || type == UP_TYPE_FLOAT64);
}

static void store_number(uint8_t type, bool is_negative, up_unsigned_t raw, void *element) {
#if UP_USES_REALS
  if (is_real(type)) {
    store_real(type, is_negative, raw, 0, false, element);
    return;
  }
#endif
  if (type >= sizeof ranges / sizeof ranges[0]) {
    return;
  }
  if (!is_negative || type == UP_TYPE_BOOL) {
    up_element_store(type, (raw > ranges[type].max) ? ranges[type].max : raw, element);
  } else {
    const up_unsigned_t greatest = 0U - (up_unsigned_t)ranges[type].min;
    up_element_store(type, 0U - ((raw > greatest) ? greatest : raw), element);
  }
}

void up_store_unsigned(uint8_t type, up_unsigned_t raw, void *element) {
  store_number(type, false, raw, element);
}

void up_store_signed(uint8_t type, up_signed_t raw, void *element) {
  store_number(type, raw < 0, (raw < 0) ? 0U - (up_unsigned_t)raw : (up_unsigned_t)raw, element);
}

#if !UP_USES_WIDE
void up_store_output(uint8_t type, int64_t output, void *element) {
  const uint64_t magnitude = (output < 0) ? 0U - (uint64_t)output : (uint64_t)output;

  store_number(type, output < 0, (magnitude > UINT32_MAX) ? UINT32_MAX : (uint32_t)magnitude, element);
}
#endif

#if UP_USES_REALS
static void store_real_ratio(uint8_t type, bool is_negative, uint64_t numerator, uint64_t denominator, void *element) {
  uint64_t quotient = numerator / denominator;
  uint64_t remainder = numerator % denominator;
  int exponent = 0;

  /* Digit by digit, until there are more than a double holds. */
  while (numerator != 0U && quotient < (uint64_t)1U << 55) {
    const bool is_carried = (remainder >> 63) != 0U;
    remainder <<= 1;
    quotient <<= 1;
    exponent--;
    if (is_carried || remainder >= denominator) {
      remainder -= denominator;
      quotient++;
    }
  }
  store_real(type, is_negative, quotient, exponent, remainder != 0U, element);
}
#endif

static up_unsigned_t rounded(up_unsigned_t numerator, up_unsigned_t denominator) {
  const up_unsigned_t remainder = numerator % denominator;

  return numerator / denominator + ((remainder >= denominator - remainder) ? 1U : 0U);
}

void up_store_signed_ratio(uint8_t type, bool is_negative, up_unsigned_t numerator, up_unsigned_t denominator,
                           void *element) {
  if (denominator == 0U) {
    up_store_unsigned(type, 0U, element);
    return;
  }
#if UP_USES_REALS
  if (is_real(type)) {
    store_real_ratio(type, is_negative, numerator, denominator, element);
    return;
  }
#endif
  store_number(type, is_negative, rounded(numerator, denominator), element);
}

void up_store_ratio(uint8_t type, up_unsigned_t numerator, up_unsigned_t denominator, void *element) {
  up_store_signed_ratio(type, false, numerator, denominator, element);
}

uint32_t up_scale(uint32_t number, uint32_t factor, uint32_t divisor) {
  const uint64_t product = (uint64_t)number * factor;
  uint32_t remainder = (uint32_t)(product >> 32), quotient = (uint32_t)product;
  unsigned bit;

  if (divisor == 0U) {
    return 0U;
  }
  if (remainder >= divisor) {
    return UINT32_MAX;
  }
  /* The digits of the product go from the quotient into the remainder, and those of the result come in behind. */
  for (bit = 0U; bit < 32U; bit++) {
    const bool is_carried = (remainder >> 31) != 0U;

    remainder = (remainder << 1) | (quotient >> 31);
    quotient <<= 1;
    if (is_carried || remainder >= divisor) {
      remainder -= divisor;
      quotient |= 1U;
    }
  }
  return quotient + ((quotient != UINT32_MAX && remainder >= divisor - remainder) ? 1U : 0U);
}

#if UP_USES_REALS
/* The magnitude of a floating-point number, rounded half away from zero. */
static uint64_t round_real(uint64_t bits, unsigned fraction_bits, int bias) {
  const uint64_t mantissa = bits & (((uint64_t)1U << fraction_bits) - 1U);
  const int biased = (int)(bits >> fraction_bits);
  const int shift = biased - bias - (int)fraction_bits;

  if (biased == 2 * bias + 1) {
    return (mantissa != 0U) ? 0U : UINT64_MAX;
  }
  if (biased == 0 || shift < -(int)fraction_bits - 1) {
    return 0U;
  }
  if (shift > 63 - (int)fraction_bits) {
    return UINT64_MAX;
  }
  if (shift >= 0) {
    return (mantissa | (uint64_t)1U << fraction_bits) << shift;
  }
  return (((mantissa | (uint64_t)1U << fraction_bits) >> (-shift - 1)) + 1U) >> 1;
}

#endif

up_unsigned_t up_load_magnitude(uint8_t type, const void *element, bool *is_negative) {
  const up_unsigned_t bits = up_element_load(type, element);
  const up_unsigned_t sign = (up_unsigned_t)1U << (8U * up_type_bytes(type) - 1U);

  *is_negative = (is_real(type) || is_signed(type)) && (bits & sign) != 0U;
#if UP_USES_REALS
  if (type == UP_TYPE_FLOAT32) {
    return round_real(bits & ~sign, 23U, 127);
  }
  if (type == UP_TYPE_FLOAT64) {
    return round_real(bits & ~sign, 52U, 1023);
  }
#endif
  return *is_negative ? 0U - ((bits ^ sign) - sign) : bits;
}

void up_store_mean(uint8_t type, const uint16_t *samples, size_t count, size_t stride, void *element) {
  up_unsigned_t sum = 0U;
  size_t i;

  for (i = 0U; i < count; i++) {
    sum += samples[i * stride];
  }
  up_store_ratio(type, sum, (up_unsigned_t)count, element);
}

static up_unsigned_t gather(const uint8_t *bytes, size_t size, bool little_endian) {
  up_unsigned_t bits = 0U;
  size_t i;

  for (i = 0U; i < size; i++) {
    bits = (bits << 8) | bytes[little_endian ? (size - 1U - i) : i];
  }
  return bits;
}

static void store_gathered(uint8_t type, up_unsigned_t bits, size_t size, void *element) {
  if (is_real(type) && size == up_type_bytes(type)) {
    up_element_store(type, bits, element);
  } else if (is_signed(type)) {
    const up_unsigned_t sign = (up_unsigned_t)1U << (8U * size - 1U);
    up_signed_t extended;
    bits = (bits ^ sign) - sign;
    memcpy(&extended, &bits, sizeof extended);
    up_store_signed(type, extended, element);
  } else {
    up_store_unsigned(type, bits, element);
  }
}

/* Bytes of a device for each element of a field; 0 if they do not divide evenly. */
static size_t element_bytes(UP_ROM up_field_t *field, size_t bytes_count) {
  const size_t size = (field->count == 0U) ? 0U : bytes_count / field->count;

  return (size <= sizeof(up_unsigned_t) && size * field->count == bytes_count) ? size : 0U;
}

bool up_store_bytes(UP_ROM up_field_t *field, const uint8_t *bytes, size_t bytes_count, bool little_endian,
                    void *value) {
  const size_t size = element_bytes(field, bytes_count);
  const size_t stored_bytes = up_type_bytes(field->type);
  uint8_t *memory = value;
  size_t i;

  if (size == 0U) {
    return false;
  }
  for (i = 0U; i < field->count; i++) {
    const up_unsigned_t bits = gather(&bytes[i * size], size, little_endian);
    store_gathered(field->type, bits, size, &memory[i * stored_bytes]);
  }
  return true;
}

bool up_load_bytes(UP_ROM up_field_t *field, const void *value, uint8_t *bytes, size_t bytes_count,
                   bool little_endian) {
  const size_t size = element_bytes(field, bytes_count);
  const size_t stored_bytes = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t element, byte;

  if (size == 0U || size > stored_bytes) {
    return false;
  }
  for (element = 0U; element < field->count; element++) {
    up_unsigned_t bits = up_element_load(field->type, &memory[element * stored_bytes]);
    for (byte = 0U; byte < size; byte++) {
      bytes[element * size + (little_endian ? byte : (size - 1U - byte))] = (uint8_t)bits;
      bits >>= 8;
    }
  }
  return true;
}
