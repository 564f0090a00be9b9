#include "up_wire.h"

/* The place of byte `i` of an array in network byte order; memory has the machine's byte order. */
static size_t turned(size_t i, size_t element_bytes) {
  const uint16_t one = 1U;
  uint8_t low;

  memcpy(&low, &one, sizeof low);
  return (low == 0U) ? i : (i ^ (element_bytes - 1U));
}

uint8_t *up_put_array(uint8_t *at, const void *values, size_t element_bytes, size_t count) {
  const uint8_t *memory = values;
  const size_t size = element_bytes * count;
  size_t i;

  for (i = 0U; i < size; i++) {
    at[i] = memory[turned(i, element_bytes)];
  }
  return &at[size];
}

void up_get_array(const uint8_t *at, void *values, size_t element_bytes, size_t count) {
  uint8_t *memory = values;
  const size_t size = element_bytes * count;
  size_t i;

  for (i = 0U; i < size; i++) {
    memory[turned(i, element_bytes)] = at[i];
  }
}
