/* The decoder of the firmware. */
#include "decoders.h"

#include <stdlib.h>
#include <string.h>

#include "up_decode.h"
#include "up_memo.h"

#ifndef DECODERS_C_MEMO
#define DECODERS_C_MEMO 1
#endif

typedef struct {
  decoders_out_t out;
  void *context;
  uint8_t report[5U + UP_PAYLOAD_BYTES_LIMIT];
} log_t;

static void put_u32(uint8_t *bytes, uint32_t number) {
  bytes[0] = (uint8_t)(number >> 24);
  bytes[1] = (uint8_t)(number >> 16);
  bytes[2] = (uint8_t)(number >> 8);
  bytes[3] = (uint8_t)number;
}

/* 'R' or 'D', the size, and the bytes. */
static void say(log_t *log, char word, const uint8_t *front, size_t front_bytes, const uint8_t *bytes, size_t size) {
  if (log->out == NULL) {
    log->report[0] ^= bytes[0];
    return;
  }
  log->report[0] = (uint8_t)word;
  put_u32(&log->report[1], (uint32_t)(front_bytes + size));
  if (front_bytes > 0U) {
    memcpy(&log->report[5], front, front_bytes);
  }
  memcpy(&log->report[5U + front_bytes], bytes, size);
  log->out(log->context, log->report, 5U + front_bytes + size);
}

static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  uint8_t front[6] = {0U};

  if (stamp != NULL) {
    put_u32(&front[1], stamp->time_us);
    front[5] = stamp->counter;
  }
  say(context, 'R', front, (stamp != NULL) ? sizeof front : 0U, items, size);
}

static void on_hello(void *context, uint32_t hash, const char word) {
  const log_t *log = context;
  uint8_t said[5] = {(uint8_t)word, 0U, 0U, 0U, 0U};

  put_u32(&said[1], hash);
  if (log->out != NULL) {
    log->out(log->context, said, (word == 'H') ? sizeof said : 1U);
  }
}

static void on_hello_to_host(void *context, uint32_t hash) {
  on_hello(context, hash, 'H');
}

static void on_request(void *context, uint32_t hash) {
  (void)hash;
  on_hello(context, 0U, 'Q');
}

static void on_health(void *context, const uint8_t *payload, size_t size) {
  const log_t *log = context;
  up_health_board_t board;
  uint8_t said[2] = {(uint8_t)'A', 0U};

  if (size > 0U && up_health_read_board(payload, size, &board)) {
    say(context, 'D', NULL, 0U, payload, size);
    return;
  }
  if (size > 0U) {
    said[0] = (uint8_t)'V';
    said[1] = payload[1];
  }
  if (log->out != NULL) {
    log->out(log->context, said, (size > 0U) ? 2U : 1U);
  }
}

/* What a generator prints as a switch, from a table: any schema comes at run time. */
static up_item_t item_of[256];

static up_item_t item(uint8_t id) {
  return item_of[id];
}

static size_t digits_of(size_t number) {
  size_t digits = 1U;

  for (; number >= 10U; number /= 10U) {
    digits++;
  }
  return digits;
}

static void read_schema(const decoders_input_t *input, up_wire_t *wire) {
  const bool is_to_board = (input->schema[0] & 2U) != 0U;
  size_t at, devices = 0U, values_bytes = 0U, payload_bytes = is_to_board ? 2U : 5U;

  memset(wire, 0, sizeof *wire);
  memset(item_of, 0, sizeof item_of);
  wire->direction = is_to_board ? UP_TO_BOARD : UP_TO_HOST;
  wire->checksum = (uint8_t)(((input->schema[0] & 1U) != 0U)   ? UP_LINK_CRC16
                             : ((input->schema[0] & 8U) != 0U) ? UP_LINK_CRC32
                                                               : UP_LINK_NONE);
  wire->has_stamp = !is_to_board && (input->schema[0] & 4U) != 0U;
  for (at = 1U; at + 5U <= input->schema_bytes && devices < UP_FIELDS_MAX; at += 5U, devices++) {
    const uint8_t type = input->schema[at + 1U];
    const size_t count = ((size_t)input->schema[at + 3U] << 8) | input->schema[at + 4U];
    if (input->schema[at + 2U] == wire->direction) {
      item_of[input->schema[at]] = UP_ITEM(up_type_bytes(type) * count, type == UP_TYPE_BOOL);
      values_bytes += 1U + up_type_bytes(type) * count;
    }
  }
  values_bytes += (wire->has_stamp && values_bytes > 0U) ? 6U : 0U;
  wire->values_bytes_max = (uint16_t)values_bytes;
  wire->health_bytes = (uint16_t)(is_to_board ? 0U : UP_HEALTH_BOARD_BYTES + UP_HEALTH_DEVICE_BYTES * devices);
  payload_bytes = (values_bytes > payload_bytes) ? values_bytes : payload_bytes;
  payload_bytes = (wire->health_bytes > payload_bytes) ? wire->health_bytes : payload_bytes;
  payload_bytes += UP_WIRE_CHECKSUM_BYTES(wire);
  wire->payload_bytes_max = (uint16_t)payload_bytes;
  wire->head_bytes = (uint8_t)(digits_of(payload_bytes) + 1U);
  wire->item = item;
#if DECODERS_C_MEMO
  wire->memo = &up_memo;
#endif
}

void decoders_c(const decoders_input_t *input, decoders_out_t out, void *context) {
  static log_t log;
  up_sink_t sink = {on_values, on_hello_to_host, on_health, &log};
  up_wire_t wire;
  up_decoder_t decoder;
  uint8_t *buffer;
  uint8_t end[9] = {(uint8_t)'E'};
  size_t at, frame_bytes, buffer_bytes, piece = 0U;

  read_schema(input, &wire);
  log.out = out;
  log.context = context;
  if (wire.direction == (uint8_t)UP_TO_BOARD) {
    sink.on_hello = on_request;
  }
  /* Exactly as much as it needs, so that a sanitizer sees each byte too far. */
  frame_bytes = UP_WIRE_FRAME_BYTES(&wire);
  buffer_bytes = (DECODERS_C_FRAMES - 1U) * frame_bytes;
  buffer_bytes += (wire.memo != NULL) ? UP_DECODER_BYTES(frame_bytes) : frame_bytes;
  buffer = malloc(buffer_bytes);
  if (buffer == NULL || !up_decoder_init(&decoder, &wire, buffer, buffer_bytes, &sink)) {
    abort();
  }
  for (at = 0U; at < input->stream_bytes; piece++) {
    size_t size = (input->pieces_count == 0U) ? 0U : input->pieces[piece % input->pieces_count];
    if (size == 0U || size > input->stream_bytes - at) {
      size = input->stream_bytes - at;
    }
    up_decoder_feed(&decoder, &input->stream[at], size);
    at += size;
  }
  put_u32(&end[1], decoder.frames);
  put_u32(&end[5], decoder.dropped_bytes);
  if (out != NULL) {
    out(context, end, sizeof end);
  }
  free(buffer);
}
