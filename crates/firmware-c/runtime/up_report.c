#include "up_report.h"

#include <string.h>

static uint8_t *value_of(const up_store_t *store, size_t index) {
  return (uint8_t *)store->values + store->schema->fields[index].offset;
}

void up_store_init(up_store_t *store, UP_ROM up_schema_t *schema, void *values) {
  memset(store, 0, sizeof *store);
  store->schema = schema;
  store->values = values;
}

void up_store_put(up_store_t *store, size_t index, const void *value) {
  memcpy(value_of(store, index), value, up_field_bytes(&store->schema->fields[index]));
  up_bit_set(store->known, index);
  if (store->schema->fields[index].direction == (uint8_t)UP_TO_HOST) {
    up_bit_set(store->due, index);
  }
}

const void *up_store_get(const up_store_t *store, size_t index) {
  return up_bit_get(store->known, index) ? value_of(store, index) : NULL;
}

bool up_report_is_due(const up_store_t *store) {
  size_t i;

  for (i = 0U; i < sizeof store->due; i++) {
    if (store->due[i] != 0U) {
      return true;
    }
  }
  return false;
}

void up_report_forget(up_store_t *store, size_t index) {
  store->due[index / 8U] = (uint8_t)(store->due[index / 8U] & ~(1U << (index % 8U)));
}

size_t up_report_take(up_store_t *store, UP_ROM up_wire_t *wire, const up_stamp_t *stamp, uint8_t *frame,
                      size_t frame_bytes, uint8_t *taken) {
  memcpy(taken, store->due, sizeof store->due);
  memset(store->due, 0, sizeof store->due);
  return up_encode_values(wire, stamp, taken, store->values, frame, frame_bytes);
}

void up_report_restore(up_store_t *store, const uint8_t *taken) {
  size_t i;

  for (i = 0U; i < sizeof store->due; i++) {
    store->due[i] = (uint8_t)(store->due[i] | taken[i]);
  }
}
