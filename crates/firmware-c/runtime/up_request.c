#include "up_request.h"

static bool ends_with(const up_requests_t *requests, const uint8_t *frame, size_t size) {
  return size > 0U && memcmp(&requests->last[sizeof requests->last - size], frame, size) == 0;
}

up_request_t up_request_take(up_requests_t *requests, UP_ROM up_wire_t *wire, uint8_t byte) {
  uint8_t frame[UP_REQUEST_BYTES_MAX];

  memmove(requests->last, &requests->last[1], sizeof requests->last - 1U);
  requests->last[sizeof requests->last - 1U] = byte;
  if (byte != (uint8_t)',') {
    return UP_REQUEST_NONE;
  }
  if (ends_with(requests, frame, up_encode_hello_request(wire, frame, sizeof frame))) {
    return UP_REQUEST_HELLO;
  }
  if (ends_with(requests, frame, up_encode_health_request(wire, frame, sizeof frame))) {
    return UP_REQUEST_HEALTH;
  }
  return UP_REQUEST_NONE;
}
