/*
 * What a host sends to a board that it has nothing to set on: the requests for a hello and for health.
 *
 * Each is a frame that never differs, so it is recognised as a whole, wherever it stands in a stream: what up_decode
 * would deliver, with less memory and code. No end of one of them is a beginning of another, so that none is missed.
 */
#ifndef UP_REQUEST_H
#define UP_REQUEST_H

#include "up_encode.h"

/* The longest: a digit, a colon, two bytes, a checksum with its identifier, a comma. */
#define UP_REQUEST_BYTES_MAX 10U

typedef enum { UP_REQUEST_NONE, UP_REQUEST_HELLO, UP_REQUEST_HEALTH } up_request_t;

/* The last bytes of the stream. All zero at the start. */
typedef struct {
  uint8_t last[UP_REQUEST_BYTES_MAX];
} up_requests_t;

/* The request that ends with the next byte of the stream. `wire` is that to the board. */
up_request_t up_request_take(up_requests_t *requests, UP_ROM up_wire_t *wire, uint8_t byte);

#endif
