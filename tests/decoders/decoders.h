/*
 * The decoders of the project behind one small interface: a schema and a stream in, what was said out.
 *
 * In: a schema as bytes (flags, bit 0 for a CRC-16 and bit 3 for a CRC-32, bit 1 for the direction to the board and
 * bit 2 for stamps; then for each item its identifier, its type as in up_type_t, its direction as in up_direction_t, its count in two bytes,
 * the high one first); a stream; how it is cut: sizes of pieces, used in turn, where 0 is all that is left.
 * Out, in pieces: 'R', the number of bytes in four bytes, and the payload as it stands there, its stamp included
 * and its checksum not; 'D' and the same of health; 'V' and the version of health that is not 1; 'H' and the hash;
 * 'Q' for the request of a hello and 'A' for that of health; at the end 'E', frames and dropped bytes in four
 * bytes each. Two decoders agree when they write the same bytes.
 */
#ifndef DECODERS_H
#define DECODERS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  const uint8_t *schema;
  size_t schema_bytes;
  const uint8_t *stream;
  size_t stream_bytes;
  const uint32_t *pieces;
  size_t pieces_count;
} decoders_input_t;

/* Takes some bytes of the answer; NULL for nobody who listens. */
typedef void (*decoders_out_t)(void *context, const uint8_t *bytes, size_t size);

/* The decoder of the firmware and the one of the C++ hosts. */
void decoders_c(const decoders_input_t *input, decoders_out_t out, void *context);
void decoders_cpp(const decoders_input_t *input, decoders_out_t out, void *context);

#ifdef __cplusplus
}
#endif

#endif
