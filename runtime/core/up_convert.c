#include "up_convert.h"

#include <string.h>

typedef struct {
  int64_t min;
  uint64_t max;
} range_t;

static const range_t ranges[] = {
    [UP_TYPE_BOOL] = {0, 1U},
    [UP_TYPE_UINT8] = {0, UINT8_MAX},
    [UP_TYPE_INT8] = {INT8_MIN, INT8_MAX},
    [UP_TYPE_UINT16] = {0, UINT16_MAX},
    [UP_TYPE_INT16] = {INT16_MIN, INT16_MAX},
    [UP_TYPE_UINT32] = {0, UINT32_MAX},
    [UP_TYPE_INT32] = {INT32_MIN, INT32_MAX},
    [UP_TYPE_UINT64] = {0, UINT64_MAX},
    [UP_TYPE_INT64] = {INT64_MIN, INT64_MAX},
};

static void store_float32(float value, void *element) {
  memcpy(element, &value, sizeof value);
}

static void store_float64(double value, void *element) {
  memcpy(element, &value, sizeof value);
}

void up_store_unsigned(uint8_t type, uint64_t raw, void *element) {
  if (type == UP_TYPE_FLOAT32) {
    store_float32((float)raw, element);
  } else if (type == UP_TYPE_FLOAT64) {
    store_float64((double)raw, element);
  } else if (type < sizeof ranges / sizeof ranges[0]) {
    up_element_store(type, (raw > ranges[type].max) ? ranges[type].max : raw, element);
  }
}

void up_store_signed(uint8_t type, int64_t raw, void *element) {
  if (raw >= 0) {
    up_store_unsigned(type, (uint64_t)raw, element);
  } else if (type == UP_TYPE_FLOAT32) {
    store_float32((float)raw, element);
  } else if (type == UP_TYPE_FLOAT64) {
    store_float64((double)raw, element);
  } else if (type == UP_TYPE_BOOL) {
    up_element_store(type, 1U, element);
  } else if (type < sizeof ranges / sizeof ranges[0]) {
    up_element_store(type, (uint64_t)((raw < ranges[type].min) ? ranges[type].min : raw), element);
  }
}

void up_store_ratio(uint8_t type, uint64_t numerator, uint64_t denominator, void *element) {
  if (denominator == 0U) {
    up_store_unsigned(type, 0U, element);
  } else if (type == UP_TYPE_FLOAT32) {
    store_float32((float)((double)numerator / (double)denominator), element);
  } else if (type == UP_TYPE_FLOAT64) {
    store_float64((double)numerator / (double)denominator, element);
  } else {
    const uint64_t quotient = numerator / denominator;
    const uint64_t remainder = numerator % denominator;
    const uint64_t round_up = (remainder >= denominator - remainder) ? 1U : 0U;
    up_store_unsigned(type, quotient + round_up, element);
  }
}

void up_store_mean(uint8_t type, const uint16_t *samples, size_t count, size_t stride, void *element) {
  uint64_t sum = 0U;
  size_t i;

  for (i = 0U; i < count; i++) {
    sum += samples[i * stride];
  }
  up_store_ratio(type, sum, count, element);
}

static uint64_t gather(const uint8_t *bytes, size_t size, bool little_endian) {
  uint64_t bits = 0U;
  size_t i;

  for (i = 0U; i < size; i++) {
    bits = (bits << 8) | bytes[little_endian ? (size - 1U - i) : i];
  }
  return bits;
}

static bool is_signed(uint8_t type) {
  return type == UP_TYPE_INT8 || type == UP_TYPE_INT16 || type == UP_TYPE_INT32 || type == UP_TYPE_INT64;
}

static void store_gathered(uint8_t type, uint64_t bits, size_t size, void *element) {
  const bool is_float = type == UP_TYPE_FLOAT32 || type == UP_TYPE_FLOAT64;

  if (is_float && size == up_type_bytes(type)) {
    up_element_store(type, bits, element);
  } else if (is_signed(type)) {
    const uint64_t sign = (uint64_t)1U << (8U * size - 1U);
    int64_t extended;
    bits = (bits ^ sign) - sign;
    memcpy(&extended, &bits, sizeof extended);
    up_store_signed(type, extended, element);
  } else {
    up_store_unsigned(type, bits, element);
  }
}

/* Bytes of a device for each element of a field; 0 when they do not fit together. */
static size_t element_bytes(const up_field_t *field, size_t bytes_count) {
  const size_t size = (field->count == 0U) ? 0U : bytes_count / field->count;

  return (size <= 8U && size * field->count == bytes_count) ? size : 0U;
}

bool up_store_bytes(const up_field_t *field, const uint8_t *bytes, size_t bytes_count, bool little_endian,
                    void *value) {
  const size_t size = element_bytes(field, bytes_count);
  const size_t stored_bytes = up_type_bytes(field->type);
  uint8_t *memory = value;
  size_t i;

  if (size == 0U) {
    return false;
  }
  for (i = 0U; i < field->count; i++) {
    const uint64_t bits = gather(&bytes[i * size], size, little_endian);
    store_gathered(field->type, bits, size, &memory[i * stored_bytes]);
  }
  return true;
}

bool up_load_bytes(const up_field_t *field, const void *value, uint8_t *bytes, size_t bytes_count,
                   bool little_endian) {
  const size_t size = element_bytes(field, bytes_count);
  const size_t stored_bytes = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t element, byte;

  if (size == 0U || size > stored_bytes) {
    return false;
  }
  for (element = 0U; element < field->count; element++) {
    uint64_t bits = up_element_load(field->type, &memory[element * stored_bytes]);
    for (byte = 0U; byte < size; byte++) {
      bytes[element * size + (little_endian ? byte : (size - 1U - byte))] = (uint8_t)bits;
      bits >>= 8;
    }
  }
  return true;
}
