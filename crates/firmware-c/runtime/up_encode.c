#include "up_encode.h"

bool up_bit_get(const uint8_t *bitmap, size_t index) {
  return (bitmap[index / 8U] & (1U << (index % 8U))) != 0U;
}

void up_bit_set(uint8_t *bitmap, size_t index) {
  bitmap[index / 8U] = (uint8_t)(bitmap[index / 8U] | (1U << (index % 8U)));
}

/* The polynomial has so few terms that eight bits can be processed at once without a table. */
uint16_t up_crc16(uint16_t crc, const uint8_t *bytes, size_t size) {
  size_t i;

  for (i = 0U; i < size; i++) {
    unsigned high = (unsigned)(crc >> 8) ^ bytes[i];
    high ^= high >> 4;
    crc = (uint16_t)(((unsigned)crc << 8) ^ (high << 12) ^ (high << 5) ^ high);
  }
  return crc;
}

/* Four bits at a time, so the table has only 64 bytes. */
uint32_t up_crc32(uint32_t crc, const uint8_t *bytes, size_t size) {
  static UP_ROM uint32_t of_nibble[16] = {
      0x00000000U, 0x1DB71064U, 0x3B6E20C8U, 0x26D930ACU, 0x76DC4190U, 0x6B6B51F4U, 0x4DB26158U, 0x5005713CU,
      0xEDB88320U, 0xF00F9344U, 0xD6D6A3E8U, 0xCB61B38CU, 0x9B64C2B0U, 0x86D3D2D4U, 0xA00AE278U, 0xBDBDF21CU,
  };
  size_t i;

  for (i = 0U; i < size; i++) {
    crc ^= bytes[i];
    crc = (crc >> 4) ^ of_nibble[crc & 15U];
    crc = (crc >> 4) ^ of_nibble[crc & 15U];
  }
  return crc;
}

/* The start of the payload; NULL if the longest frame would not fit. */
static uint8_t *open_frame(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes) {
  return (frame_bytes < UP_WIRE_FRAME_BYTES(wire)) ? NULL : &frame[wire->head_bytes];
}

/* A tenth, rounded down. An AVR divides by a function, and its frames are short. */
static inline size_t tens_of(size_t number) {
#if defined(__AVR__)
  size_t tens = 0U;

  while (number >= 10U) {
    number -= 10U;
    tens++;
  }
  return tens;
#else
  return number / 10U;
#endif
}

/* Adds a checksum, if the link has one, and the comma after the payload, which ends at `end`, and its length before
 * it. A payload that is shorter than the longest may move down by a few bytes. Returns the size of the frame. */
static size_t close_frame(UP_ROM up_wire_t *wire, uint8_t *frame, uint8_t *end) {
  uint8_t *const payload = &frame[wire->head_bytes];
  uint8_t *head = payload;
  size_t rest, bytes, i;

  if (UP_WIRE_HAS_CHECKSUM(wire)) {
    const up_register_t crc = up_register_add(wire, up_register_init(wire), payload, (size_t)(end - payload));
    end = up_register_put(wire, crc, up_put_8(end, UP_ID_CHECKSUM));
  }
  rest = (size_t)(end - payload);
  *end = (uint8_t)',';
  head--;
  *head = (uint8_t)':';
  do {
    const size_t tens = tens_of(rest);

    head--;
    *head = (uint8_t)('0' + (rest - 10U * tens));
    rest = tens;
  } while (rest > 0U);
  bytes = (size_t)(end - head) + 1U;
  /* Forwards, so that no byte is overwritten before it is moved. */
  for (i = 0U; i < bytes; i++) {
    frame[i] = head[i];
  }
  return bytes;
}

size_t up_encode_values(UP_ROM up_wire_t *wire, const up_stamp_t *stamp, const uint8_t *due, const void *values,
                        uint8_t *frame, size_t frame_bytes) {
  uint8_t *at = open_frame(wire, frame, frame_bytes);
  size_t bytes;

  if (at == NULL) {
    return 0U;
  }
  if (UP_WIRE_HAS_STAMP(wire)) {
    at = up_put_8(up_put_32(up_put_8(at, UP_ID_HELLO), stamp->time_us), stamp->counter);
  }
  bytes = (wire->put == NULL) ? 0U : wire->put(due, values, at);
  return (bytes == 0U) ? 0U : close_frame(wire, frame, &at[bytes]);
}

size_t up_encode_hello(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes) {
  uint8_t *const at = open_frame(wire, frame, frame_bytes);

  return (at == NULL) ? 0U : close_frame(wire, frame, up_put_32(up_put_8(at, UP_ID_HELLO), wire->hash));
}

static uint8_t *put_row(uint8_t *at, const up_health_row_t *row) {
  at = up_put_32(up_put_8(at, row->status), row->age_ms);
  return up_put_array(at, row->counts, sizeof row->counts[0], UP_FAULTS);
}

size_t up_encode_health(UP_ROM up_wire_t *wire, const up_health_board_t *board,
                        void (*row_of)(void *context, size_t field, up_health_row_t *row), void *context,
                        uint8_t *frame, size_t frame_bytes) {
  const size_t devices = ((size_t)wire->health_bytes - UP_HEALTH_BOARD_BYTES) / UP_HEALTH_DEVICE_BYTES;
  uint8_t *at = open_frame(wire, frame, frame_bytes);
  size_t i;

  if (at == NULL) {
    return 0U;
  }
  at = up_put_8(up_put_8(at, UP_ID_HEALTH), UP_HEALTH_VERSION);
  at = up_put_8(up_put_8(up_put_32(at, board->uptime_ms), board->reset_cause), board->reset_device);
  at = up_put_32(up_put_32(at, board->reports_sent), board->reports_refused);
  at = up_put_16(up_put_8(at, board->load_percent), board->stack_left_bytes);
  for (i = 0U; i < devices; i++) {
    up_health_row_t row;
    row_of(context, i, &row);
    at = put_row(at, &row);
  }
  return close_frame(wire, frame, at);
}

size_t up_encode_hello_request(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes) {
  uint8_t *const at = open_frame(wire, frame, frame_bytes);

  return (at == NULL) ? 0U : close_frame(wire, frame, up_put_8(at, UP_ID_HELLO));
}

size_t up_encode_health_request(UP_ROM up_wire_t *wire, uint8_t *frame, size_t frame_bytes) {
  uint8_t *const at = open_frame(wire, frame, frame_bytes);

  return (at == NULL) ? 0U : close_frame(wire, frame, up_put_8(up_put_8(at, UP_ID_HELLO), UP_HEALTH_REQUEST));
}
