/*
 * What a decoder remembers of candidates for a frame that failed, so that those that overlap with them do not go
 * through the same bytes again. For up_decode.c alone.
 *
 * Sums over blocks of the stream answer for checksums and arrays of bools. Walks answer for identifiers: from where
 * two candidates come upon the same identifier they go the same way, so all that is kept of the way is a window in
 * which no identifier stands twice; it goes on where a later candidate ends further on.
 */
#ifndef UP_MEMO_H
#define UP_MEMO_H

#include "up_decode.h"

/* Behind the buffer of the decoder, whose size and schema are set. */
void up_memo_init(up_decoder_t *decoder, size_t frame_bytes);

/* The checksum of the bytes [from, to) of the candidate, and whether all of them are bools. */
uint16_t up_memo_crc(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);
bool up_memo_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);

/* The candidate, which starts at `bytes`, is given up for one that starts so many bytes further on. */
void up_memo_advance(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped);

/* Bytes of the value behind an identifier; 0 for an unknown one. */
size_t up_decoder_value_bytes(const up_decoder_t *decoder, uint8_t id);

#if UP_DECODER_WALKS > 0U

typedef enum {
  UP_STEP_TAKEN,
  UP_STEP_REPEATS, /* an identifier of the candidate stands twice */
  UP_STEP_MISSES,  /* none of its items ends where its values do */
  UP_STEP_UNKNOWN  /* the walk does not tell */
} up_step_t;

/* A walk that has an identifier at this place; NULL when none has. */
up_walk_t *up_memo_walk(up_decoder_t *decoder, size_t place);

/* The candidate stands at an identifier of the walk. One step further at the head of it, to `next`. */
up_step_t up_memo_step(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes, size_t next);

/* Whether the candidate comes to the end of its values by the walk, which goes so far. */
up_step_t up_memo_leap(up_decoder_t *decoder, up_walk_t *walk, const uint8_t *bytes);

/* The way of a candidate that has failed, unless it was on another's. */
void up_memo_keep(up_decoder_t *decoder, const uint8_t *bytes);

#endif

#endif
