#include "up_schema.h"

#include <string.h>

#define NAME_BYTES 8U

static UP_ROM uint8_t type_bytes[] = {
    [UP_TYPE_BOOL] = 1U,   [UP_TYPE_UINT8] = 1U,   [UP_TYPE_INT8] = 1U,   [UP_TYPE_UINT16] = 2U,
    [UP_TYPE_INT16] = 2U,  [UP_TYPE_UINT32] = 4U,  [UP_TYPE_INT32] = 4U,  [UP_TYPE_UINT64] = 8U,
    [UP_TYPE_INT64] = 8U,  [UP_TYPE_FLOAT32] = 4U, [UP_TYPE_FLOAT64] = 8U,
};

static UP_ROM char type_names[][NAME_BYTES] = {
    [UP_TYPE_BOOL] = "bool",     [UP_TYPE_UINT8] = "uint8",     [UP_TYPE_INT8] = "int8",     [UP_TYPE_UINT16] = "uint16",
    [UP_TYPE_INT16] = "int16",   [UP_TYPE_UINT32] = "uint32",   [UP_TYPE_INT32] = "int32",   [UP_TYPE_UINT64] = "uint64",
    [UP_TYPE_INT64] = "int64",   [UP_TYPE_FLOAT32] = "float32", [UP_TYPE_FLOAT64] = "float64",
};

static UP_ROM char unknown[] = "?";

UP_ROM char *up_type_name(uint8_t type) {
  return (type < sizeof type_names / sizeof type_names[0]) ? type_names[type] : unknown;
}

size_t up_type_bytes(uint8_t type) {
  return (type < sizeof type_bytes) ? type_bytes[type] : 0U;
}

up_unsigned_t up_element_load(uint8_t type, const void *element) {
  uint8_t byte = 0U;
  uint16_t half = 0U;
  uint32_t word = 0U;
#if UP_USES_WIDE
  uint64_t wide = 0U;
#endif

  switch (up_type_bytes(type)) {
  case 1U:
    memcpy(&byte, element, sizeof byte);
    return byte;
  case 2U:
    memcpy(&half, element, sizeof half);
    return half;
  case 4U:
    memcpy(&word, element, sizeof word);
    return word;
#if UP_USES_WIDE
  case 8U:
    memcpy(&wide, element, sizeof wide);
    return wide;
#endif
  default:
    return 0U;
  }
}

void up_element_store(uint8_t type, up_unsigned_t bits, void *element) {
  const uint8_t byte = (uint8_t)bits;
  const uint16_t half = (uint16_t)bits;
  const uint32_t word = (uint32_t)bits;

  switch (up_type_bytes(type)) {
  case 1U:
    memcpy(element, &byte, sizeof byte);
    break;
  case 2U:
    memcpy(element, &half, sizeof half);
    break;
  case 4U:
    memcpy(element, &word, sizeof word);
    break;
#if UP_USES_WIDE
  case 8U:
    memcpy(element, &bits, sizeof bits);
    break;
#endif
  default:
    break;
  }
}

size_t up_field_bytes(UP_ROM up_field_t *field) {
  return up_type_bytes(field->type) * field->count;
}

UP_ROM up_field_t *up_schema_find(UP_ROM up_schema_t *schema, uint8_t id, up_direction_t direction) {
  uint8_t i;

  for (i = 0U; i < schema->fields_count; i++) {
    UP_ROM up_field_t *field = &schema->fields[i];
    if (field->id == id && field->direction == (uint8_t)direction) {
      return field;
    }
  }
  return UP_ROM_NULL;
}
