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

/* A decoder calls it by these, so that one that has no need of it has none of it. */
typedef struct up_memo {
  /* Behind the buffer of the decoder, whose size is set. */
  void (*init)(up_decoder_t *decoder, size_t frame_bytes);

  /* The register behind the bytes [from, to) of the candidate, and whether all of them are bools. */
  up_register_t (*crc)(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);
  bool (*bools)(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);

  /* To the end of the values by a walk of others, when one has an identifier where the candidate stands. */
  up_verdict_t (*join)(up_decoder_t *decoder, const uint8_t *bytes, size_t size, bool *is_known);

  /* The candidate, which starts at `bytes`, is given up for one that starts so many bytes further on. */
  void (*leave)(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped, bool has_failed);
} up_memo_t;

/* For it: the elements of the value [value, end), as many as are there. */
up_verdict_t up_decoder_look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t value, size_t end);

extern const up_memo_t up_memo;

#endif
