/*
 * From a byte stream to values: any split of the stream, any garbage between frames.
 *
 * The decoder keeps the bytes from the first possible frame start on. What cannot become a valid frame of the
 * schema loses its first byte only and the rest is looked at again, so that a torn frame costs itself and never
 * the whole frame behind it. Its memory is one buffer of up_frame_bytes_max() bytes.
 */
#ifndef UP_DECODE_H
#define UP_DECODE_H

#include "up_schema.h"

/* What a delivered frame says; each callback may be NULL. The values of one frame come in the order of its
 * payload, then on_frame closes them. A frame that is not valid to its last byte delivers nothing. */
typedef struct {
  void (*on_value)(void *context, const up_field_t *field, const uint8_t *wire);
  void (*on_frame)(void *context);
  /* Towards the host: the board's hello. Towards the board: the request for one (`hash` is 0). */
  void (*on_hello)(void *context, uint32_t hash);
  void *context;
} up_sink_t;

typedef enum {
  UP_PHASE_LENGTH,
  UP_PHASE_ID,
  UP_PHASE_VALUE,
  UP_PHASE_HELLO,
  UP_PHASE_CHECKSUM,
  UP_PHASE_COMMA
} up_phase_t;

typedef struct {
  const up_schema_t *schema;
  const up_sink_t *sink;
  uint8_t *buffer;
  size_t buffer_bytes;
  size_t payload_bytes_max;
  size_t start; /* of the possible frame in the buffer; the positions below count from here */
  size_t size;  /* bytes behind `start` */
  size_t at;    /* bytes looked at */
  size_t payload_start;
  size_t values_end; /* where the values end and the checksum or the comma starts */
  size_t item_end;
  size_t length; /* LEN so far */
  uint8_t phase; /* up_phase_t */
  uint8_t direction;
  uint8_t item_type;
  uint8_t seen[UP_FIELD_BITMAP_BYTES]; /* identifiers of this payload */
  uint32_t frames;
  uint32_t dropped_bytes; /* bytes that were part of no delivered frame */
} up_decoder_t;

/* `buffer` holds at least up_frame_bytes_max(schema, direction) bytes; false when it does not. */
bool up_decoder_init(up_decoder_t *decoder, const up_schema_t *schema, up_direction_t direction,
                     uint8_t *buffer, size_t buffer_bytes, const up_sink_t *sink);

/* Takes the next bytes of the stream and hands each whole frame to the sink. */
void up_decoder_feed(up_decoder_t *decoder, const uint8_t *bytes, size_t size);

/* True when no frame has begun: what comes next is the first byte of a frame, or garbage. */
bool up_decoder_is_idle(const up_decoder_t *decoder);

#endif
