/*
 * What a decoder remembers of failed candidates, so that candidates that overlap with them do not process the same
 * bytes again. Only for up_decode.c.
 *
 * Sums over blocks of the stream serve checksums and arrays of bools. Walks serve identifiers: from the place where two
 * candidates meet the same identifier, they take the same steps. All that is kept of a walk is therefore a window in
 * which no identifier occurs twice; it is extended when a later candidate ends further on.
 */
#ifndef UP_MEMO_H
#define UP_MEMO_H

#include "up_decode.h"

/* The decoder calls these through pointers, so that a program that does not need them does not link them. */
typedef struct up_memo {
  /* Sets up the memory after the buffer of the decoder, whose size is set. */
  void (*init)(up_decoder_t *decoder, size_t frame_bytes);

  /* The register after the bytes [from, to) of the candidate, and whether all of them are bools. */
  up_register_t (*crc)(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);
  bool (*bools)(up_decoder_t *decoder, const uint8_t *bytes, size_t from, size_t to);

  /* Goes to the end of the values along another candidate's walk, if one has an identifier at the candidate's place. */
  up_verdict_t (*join)(up_decoder_t *decoder, const uint8_t *bytes, size_t size, bool *is_known);

  /* Gives up the candidate, which starts at `bytes`, for one that starts this many bytes further on. */
  void (*leave)(up_decoder_t *decoder, const uint8_t *bytes, size_t skipped, bool has_failed);
} up_memo_t;

/* For up_memo: checks the elements of the value [value, end), as many as are there. */
up_verdict_t up_decoder_look_at_bools(up_decoder_t *decoder, const uint8_t *bytes, size_t size, size_t value, size_t end);

extern UP_ROM up_memo_t up_memo;

#endif
