/* What the decoders in C and C++ are given by the fuzzer, and what they give back. */
#ifndef SENSE_DECODE_H
#define SENSE_DECODE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  uint8_t id;
  uint8_t type; /* in the order of the language reference */
  uint8_t to_board;
  uint16_t count;
} sense_item_t;

typedef struct {
  const sense_item_t *items;
  size_t items_count;
  uint8_t checksum; /* 0, or the bytes of its number */
  uint8_t stamp;
  uint8_t to_board;
  const uint8_t *bytes;
  size_t size;
  const size_t *cuts; /* in order, none beyond `size` */
  size_t cuts_count;
} sense_stream_t;

/* A report is `R`, identifiers with their bytes, `.`, and before it where there are stamps `S` with time and
 * counter; a hello `H` and its hash; health `D` and its payload; its other versions `V` and the version; a request
 * `Q`, and for health `A`. */
typedef struct {
  uint8_t *log;
  size_t log_size;
  size_t log_bytes_max;
  uint64_t frames;
  uint64_t dropped_bytes;
} sense_decoded_t;

void sense_decode_c(const sense_stream_t *stream, sense_decoded_t *decoded);
void sense_decode_cpp(const sense_stream_t *stream, sense_decoded_t *decoded);

#ifdef __cplusplus
}
#endif

#endif
