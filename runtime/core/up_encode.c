#include "up_encode.h"

#define CHECKSUM_BYTES 3U /* identifier 255 and the CRC */

bool up_bit_get(const uint8_t *bitmap, size_t index) {
  return (bitmap[index / 8U] & (1U << (index % 8U))) != 0U;
}

void up_bit_set(uint8_t *bitmap, size_t index) {
  bitmap[index / 8U] = (uint8_t)(bitmap[index / 8U] | (1U << (index % 8U)));
}

/* The polynomial has so few terms that eight bits go in at once without a table. */
uint16_t up_crc16(uint16_t crc, const uint8_t *bytes, size_t size) {
  size_t i;

  for (i = 0U; i < size; i++) {
    unsigned high = (unsigned)(crc >> 8) ^ bytes[i];
    high ^= high >> 4;
    crc = (uint16_t)(((unsigned)crc << 8) ^ (high << 12) ^ (high << 5) ^ high);
  }
  return crc;
}

/* Elements pass through an unsigned integer of their own size, so the code is right on any machine. */
void up_value_to_wire(const up_field_t *field, const void *value, uint8_t *wire) {
  const size_t size = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t element, byte;

  for (element = 0U; element < field->count; element++) {
    uint64_t bits = up_element_load(field->type, &memory[element * size]);
    for (byte = size; byte > 0U; byte--) {
      wire[element * size + byte - 1U] = (uint8_t)bits;
      bits >>= 8;
    }
  }
}

void up_value_from_wire(const up_field_t *field, const uint8_t *wire, void *value) {
  const size_t size = up_type_bytes(field->type);
  uint8_t *memory = value;
  size_t element, byte;

  for (element = 0U; element < field->count; element++) {
    uint64_t bits = 0U;
    for (byte = 0U; byte < size; byte++) {
      bits = (bits << 8) | wire[element * size + byte];
    }
    up_element_store(field->type, bits, &memory[element * size]);
  }
}

/* Writes "LEN:" and returns where the payload starts, or 0 when the whole frame would not fit. */
static size_t open_frame(size_t payload_bytes, uint8_t *frame, size_t frame_bytes) {
  size_t digits = 1U;
  size_t rest, i;

  if (payload_bytes > UP_PAYLOAD_BYTES_LIMIT) {
    return 0U;
  }
  for (rest = payload_bytes; rest >= 10U; rest /= 10U) {
    digits++;
  }
  if (digits + 1U + payload_bytes + 1U > frame_bytes) {
    return 0U;
  }
  rest = payload_bytes;
  for (i = digits; i > 0U; i--) {
    frame[i - 1U] = (uint8_t)('0' + (rest % 10U));
    rest /= 10U;
  }
  frame[digits] = (uint8_t)':';
  return digits + 1U;
}

/* Adds the checksum, if the link has one, and the closing comma; returns the bytes of the frame. */
static size_t close_frame(const up_schema_t *schema, uint8_t *frame, size_t start, size_t end) {
  if (schema->checksum_crc16) {
    const uint16_t crc = up_crc16(UP_CRC16_INIT, &frame[start], end - start);
    frame[end] = UP_ID_CHECKSUM;
    frame[end + 1U] = (uint8_t)(crc >> 8);
    frame[end + 2U] = (uint8_t)crc;
    end += CHECKSUM_BYTES;
  }
  frame[end] = (uint8_t)',';
  return end + 1U;
}

static bool is_chosen(const up_schema_t *schema, up_direction_t direction, const uint8_t *chosen, size_t i) {
  return up_bit_get(chosen, i) && schema->fields[i].direction == (uint8_t)direction;
}

size_t up_encode_values(const up_schema_t *schema, up_direction_t direction, const uint8_t *chosen,
                        const void *values, uint8_t *frame, size_t frame_bytes) {
  const uint8_t *memory = values;
  size_t payload_bytes = 0U;
  size_t start, at, i;

  for (i = 0U; i < schema->fields_count; i++) {
    if (is_chosen(schema, direction, chosen, i)) {
      payload_bytes += 1U + up_field_bytes(&schema->fields[i]);
    }
  }
  if (payload_bytes == 0U) {
    return 0U;
  }
  payload_bytes += schema->checksum_crc16 ? CHECKSUM_BYTES : 0U;
  start = open_frame(payload_bytes, frame, frame_bytes);
  if (start == 0U) {
    return 0U;
  }
  at = start;
  for (i = 0U; i < schema->fields_count; i++) {
    const up_field_t *field = &schema->fields[i];
    if (is_chosen(schema, direction, chosen, i)) {
      frame[at] = field->id;
      up_value_to_wire(field, &memory[field->offset], &frame[at + 1U]);
      at += 1U + up_field_bytes(field);
    }
  }
  return close_frame(schema, frame, start, at);
}

size_t up_encode_hello(const up_schema_t *schema, uint8_t *frame, size_t frame_bytes) {
  const size_t payload_bytes = 5U + (schema->checksum_crc16 ? CHECKSUM_BYTES : 0U);
  const size_t start = open_frame(payload_bytes, frame, frame_bytes);

  if (start == 0U) {
    return 0U;
  }
  frame[start] = UP_ID_HELLO;
  frame[start + 1U] = (uint8_t)(schema->hash >> 24);
  frame[start + 2U] = (uint8_t)(schema->hash >> 16);
  frame[start + 3U] = (uint8_t)(schema->hash >> 8);
  frame[start + 4U] = (uint8_t)schema->hash;
  return close_frame(schema, frame, start, start + 5U);
}

size_t up_encode_hello_request(const up_schema_t *schema, uint8_t *frame, size_t frame_bytes) {
  const size_t payload_bytes = 1U + (schema->checksum_crc16 ? CHECKSUM_BYTES : 0U);
  const size_t start = open_frame(payload_bytes, frame, frame_bytes);

  if (start == 0U) {
    return 0U;
  }
  frame[start] = UP_ID_HELLO;
  return close_frame(schema, frame, start, start + 1U);
}
