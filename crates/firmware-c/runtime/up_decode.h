/*
 * From a byte stream to values: any split of the stream, any garbage between frames.
 *
 * A candidate for a frame that cannot become a valid one loses its first byte only, and the rest is looked at
 * again: so the first valid frame is found wherever it starts. A frame that lies whole in the bytes of one call
 * is read there; only what a call leaves unfinished is copied.
 *
 * Time. It is linear in the bytes, whatever they are, and does not grow with the length of a frame. At most one
 * candidate starts at a digit, and it costs at most one step for each field of the schema, because no identifier
 * stands twice in a payload and values are stepped over; its comma is looked at before that. Where a candidate
 * failed whose checksum or arrays of bools had been gone through, sums over blocks of the stream are kept, so that
 * the others that overlap with it cost no more than the bytes of three blocks. Where one failed behind many
 * identifiers, its walk is kept, so that those that come upon it cost a few steps.
 *
 * Memory: one buffer for a frame and the sums and walks over it. With another frame's room a byte is moved once on
 * average, however often candidates fail; without it the rest of a frame moves whenever one fails.
 */
#ifndef UP_DECODE_H
#define UP_DECODE_H

#include "up_encode.h"
#include "up_wire.h"

/* How many walks from identifier to identifier are kept, 0 to 255: each takes an eighth of a frame and 44 bytes (on
 * a machine of 32 bits). With 0 a candidate costs a step for each identifier. */
#ifndef UP_DECODER_WALKS
#define UP_DECODER_WALKS 1U
#endif

/* The buffer of a decoder with &up_memo whose longest frame is of so many bytes: sums take 6 bytes for a block of 32,
 * where a link of the program may have a CRC-32 12. Without it a buffer is as long as a frame. */
#define UP_DECODER_BLOCK_BYTES 32U
#define UP_DECODER_SUM_BYTES (3U * sizeof(up_register_t))
#define UP_DECODER_BLOCKS(frame_bytes) ((frame_bytes) / UP_DECODER_BLOCK_BYTES + 1U)
#define UP_DECODER_BYTES(frame_bytes) \
  ((frame_bytes) + (UP_DECODER_SUM_BYTES + 4U * UP_DECODER_WALKS) * UP_DECODER_BLOCKS(frame_bytes))

/* What a delivered frame says; each callback may be NULL. A frame that is not valid to its last byte delivers nothing. */
typedef struct {
  /* Values: the items of the payload, for the wire's take(); the stamp is NULL where the wire has none. */
  void (*on_values)(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size);
  /* Towards the host: the board's hello. Towards the board: the request for one (`hash` is 0). */
  void (*on_hello)(void *context, uint32_t hash);
  /* Towards the host: the payload, for up_health_read_board() and up_health_read_row(). Towards the board: the request,
   * without bytes. */
  void (*on_health)(void *context, const uint8_t *payload, size_t size);
  void *context;
} up_sink_t;

/* What the bytes of a candidate can be. */
typedef enum { UP_VERDICT_INVALID, UP_VERDICT_INCOMPLETE, UP_VERDICT_COMPLETE } up_verdict_t;

/* Identifiers from place to place of the stream, none of them twice; places are counted from the candidate's first
 * byte. */
typedef struct {
  size_t tail;
  size_t head; /* behind the value of the last one; 0 for no walk */
  uint32_t ids[UP_FIELD_BITMAP_BYTES / 4U];
  uint8_t *places; /* a bit for each byte of the stream, in a ring: an identifier of the walk stands there */
} up_walk_t;

typedef struct {
  const up_wire_t *wire;
  const up_sink_t *sink;
  uint8_t *buffer; /* the first bytes of a frame whose end has not come; the candidate starts at `start` */
  size_t buffer_bytes;
  size_t start;
  size_t size; /* bytes behind `start` */
  size_t payload_bytes_max; /* 0 where a frame does not fit into the buffer */
  /* The candidate; all places are counted from its first byte. */
  size_t payload_start; /* 0 as long as its length has not been read */
  size_t items_start;   /* where its first item stands: behind a stamp */
  size_t values_end;    /* where the values end and the checksum or the comma starts */
  size_t frame_bytes;
  size_t at;        /* where the next identifier stands */
  size_t looked_at; /* up to here arrays of bools and the checksum were gone through */
  bool checksum_right;
  uint32_t seen[UP_FIELD_BITMAP_BYTES / 4U]; /* identifiers of this payload */
  /* Sums over the stream; also counted from the candidate's first byte. */
  uint8_t *sums;     /* behind the buffer: a ring of the blocks, then what so many blocks multiply a CRC by */
  size_t ring_bytes; /* of the stream that the ring covers */
  size_t ring_at;    /* where in the ring the candidate starts */
  size_t summed;     /* up to here there are sums; 0 for none */
  size_t spent;      /* up to here a candidate that failed was gone through; 0 for none */
#if UP_DECODER_WALKS > 0U
  up_walk_t walks[UP_DECODER_WALKS];
  uint8_t walks_put; /* which one the next takes the place of */
#endif
  bool has_walks; /* one at least */
  uint8_t steps;  /* from identifier to identifier that the candidate has taken by itself */
  bool joined;    /* the candidate has come upon a walk */
  bool alone;     /* and goes on without it */
  uint32_t frames;
  uint32_t dropped_bytes; /* bytes that were part of no delivered frame */
} up_decoder_t;

/* The wire has an item(). `buffer` holds at least UP_WIRE_FRAME_BYTES(wire) bytes, and UP_DECODER_BYTES() of that with
 * &up_memo; false when it does not: then every frame is dropped. */
bool up_decoder_init(up_decoder_t *decoder, const up_wire_t *wire, uint8_t *buffer, size_t buffer_bytes,
                     const up_sink_t *sink);

/* Takes the next bytes of the stream and hands each whole frame to the sink, which must not feed the decoder. */
void up_decoder_feed(up_decoder_t *decoder, const uint8_t *bytes, size_t size);

/* True when no frame has begun but for digits of its length: a letter that comes next belongs to none. */
bool up_decoder_is_idle(const up_decoder_t *decoder);

#endif
