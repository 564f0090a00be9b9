/*
 * From a byte stream to values, however it is split and whatever garbage is between frames.
 *
 * A candidate that cannot become a valid frame loses only its first byte, and the rest is scanned again, so the first
 * valid frame is found wherever it starts. A frame that is complete within the bytes of one call is read in place; only
 * what a call leaves unfinished is copied.
 *
 * Time: linear in the bytes, whatever they are, and independent of the length of a frame. At most one candidate starts
 * at a digit, and it costs at most one step for each field of the schema, because no identifier occurs twice in a
 * payload and values are stepped over; its comma is checked before that. If a candidate fails after its checksum or its
 * arrays of bools have been checked, sums over blocks of the stream are kept, so that each candidate that overlaps with
 * it costs no more than the bytes of three blocks. If one fails after many identifiers, its walk is kept, so that
 * candidates that meet it cost only a few steps.
 *
 * Memory: a buffer for one frame, plus the sums and walks over it. With room for a second frame, a byte is moved once
 * on average, however often candidates fail; without it, the rest of a frame is moved whenever one fails.
 */
#ifndef UP_DECODE_H
#define UP_DECODE_H

#include "up_encode.h"
#include "up_wire.h"

/* The number of walks from identifier to identifier that are kept, 0 to 255: each takes an eighth of a frame and 44
 * bytes (on a 32-bit machine). With 0 a candidate costs a step for each identifier. */
#ifndef UP_DECODER_WALKS
#if defined(__AVR__)
#define UP_DECODER_WALKS 0U
#else
#define UP_DECODER_WALKS 1U
#endif
#endif

/* A part of a set of identifiers, as large as what the machine handles at once. */
#if defined(__AVR__)
typedef uint8_t up_ids_t;
#else
typedef uint32_t up_ids_t;
#endif
#define UP_IDS_BITS (8U * sizeof(up_ids_t))
#define UP_IDS_PARTS (256U / UP_IDS_BITS)
#define UP_IDS_BIT(id) ((up_ids_t)((up_ids_t)1U << ((id) % UP_IDS_BITS)))

/* The buffer of a decoder with &up_memo, by the size of its longest frame: sums take 6 bytes for each block of 32,
 * or 12 if any link of the program may have a CRC-32. Without &up_memo the buffer is as long as a frame. */
#define UP_DECODER_BLOCK_BYTES 32U
#define UP_DECODER_SUM_BYTES (3U * sizeof(up_register_t))
#define UP_DECODER_BLOCKS(frame_bytes) ((frame_bytes) / UP_DECODER_BLOCK_BYTES + 1U)
#define UP_DECODER_BYTES(frame_bytes) \
  ((frame_bytes) + (UP_DECODER_SUM_BYTES + 4U * UP_DECODER_WALKS) * UP_DECODER_BLOCKS(frame_bytes))

/* The receiver of frames; each callback may be NULL. A frame that is not valid to its last byte delivers nothing. */
typedef struct {
  /* Values: the items of the payload, for the wire's take(); the stamp is NULL if the wire has none. */
  void (*on_values)(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size);
  /* To the host: the board's hello. To the board: the request for one (`hash` is 0). */
  void (*on_hello)(void *context, uint32_t hash);
  /* To the host: the payload, for up_health_read_board() and up_health_read_row(). To the board: the request,
   * without bytes. */
  void (*on_health)(void *context, const uint8_t *payload, size_t size);
  void *context;
} up_sink_t;

/* What the bytes of a candidate can become. */
typedef enum { UP_VERDICT_INVALID, UP_VERDICT_INCOMPLETE, UP_VERDICT_COMPLETE } up_verdict_t;

/* Consecutive identifiers in the stream, none of them twice; offsets count from the candidate's first byte. */
typedef struct {
  size_t tail;
  size_t head; /* after the value of the last one; 0 for no walk */
  up_ids_t ids[UP_IDS_PARTS];
  uint8_t *places; /* a ring with a bit for each byte of the stream: set if an identifier of the walk is there */
} up_walk_t;

typedef struct {
  UP_ROM up_wire_t *wire;
  const up_sink_t *sink;
  uint8_t *buffer; /* the first bytes of an unfinished frame; the candidate starts at `start` */
  size_t buffer_bytes;
  size_t start;
  size_t size; /* bytes after `start` */
  size_t payload_bytes_max; /* 0 if a frame does not fit into the buffer */
  /* The candidate; all offsets count from its first byte. */
  size_t payload_start; /* 0 until its length has been read */
  size_t items_start;   /* start of its first item, after a stamp */
  size_t values_end;    /* end of the values, where the checksum or the comma starts */
  size_t frame_bytes;
  size_t at;        /* the next identifier */
  size_t looked_at; /* how far arrays of bools and the checksum have been checked */
  bool checksum_right;
  up_ids_t seen[UP_IDS_PARTS]; /* identifiers seen in this payload */
  /* Sums over the stream; offsets also count from the candidate's first byte. */
  uint8_t *sums;     /* after the buffer: a ring of the blocks, then for each number of blocks the factor for a CRC */
  size_t ring_bytes; /* bytes of the stream that the ring covers */
  size_t ring_at;    /* start of the candidate in the ring */
  size_t summed;     /* how far the sums reach; 0 for none */
  size_t spent;      /* how far failed candidates have been checked; 0 for none */
#if UP_DECODER_WALKS > 0U
  up_walk_t walks[UP_DECODER_WALKS];
  uint8_t walks_put; /* the walk to replace next */
#endif
  bool has_walks; /* at least one */
  uint8_t steps;  /* from identifier to identifier, that the candidate has taken by itself */
  bool joined;    /* the candidate has met a walk */
  bool alone;     /* and continues without it */
  up_events_t frames;
  up_events_t dropped_bytes; /* bytes that were in no delivered frame */
} up_decoder_t;

/* The wire must have an item(). `buffer` must hold at least UP_WIRE_FRAME_BYTES(wire) bytes, and UP_DECODER_BYTES()
 * of that with &up_memo; otherwise the result is false, and every frame is dropped. */
bool up_decoder_init(up_decoder_t *decoder, UP_ROM up_wire_t *wire, uint8_t *buffer, size_t buffer_bytes,
                     const up_sink_t *sink);

/* Takes the next bytes of the stream and passes each complete frame to the sink, which must not feed the decoder. */
void up_decoder_feed(up_decoder_t *decoder, const uint8_t *bytes, size_t size);

/* True if nothing of a frame has arrived except digits of its length: a letter that comes next is not part of one. */
bool up_decoder_is_idle(const up_decoder_t *decoder);

#endif
