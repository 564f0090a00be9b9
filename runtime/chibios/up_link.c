/* Frames in both directions over whatever channel there is. */
#include "up_decode.h"
#include "up_encode.h"
#include "up_link.h"
#include "up_shell.h"

static up_decoder_t decoder;
/* Two frames, so that what is left of a failed one moves once on average. */
static uint8_t decoder_buffer[UP_FRAME_BYTES_MAX_TO_BOARD + UP_DECODER_BYTES(UP_FRAME_BYTES_MAX_TO_BOARD)];
static uint8_t frame[UP_FRAME_BYTES_MAX_TO_HOST];
static up_link_counters_t counters;
static bool hello_due;
static bool was_open;

static void on_value(void *context, const up_field_t *field, const uint8_t *wire) {
  static uint64_t value[(UP_VALUE_BYTES_MAX + 7U) / 8U];
  const size_t index = (size_t)(field - up_config.schema->fields);

  (void)context;
  up_value_from_wire(field, wire, value);
  up_put(index, value);
  sense_apply(index, value);
  up_user_received(index);
}

static void on_hello(void *context, uint32_t hash) {
  (void)context;
  (void)hash;
  hello_due = true;
}

/* A frame goes out whole or not at all: what a full queue does not take stays due, and what it began to take is
 * finished. */
static bool send(const uint8_t *bytes, size_t size) {
  size_t sent = chnWriteTimeout(up_channel(), bytes, size, TIME_IMMEDIATE);

  if (sent == 0U) {
    counters.frames_refused++;
    return false;
  }
  if (sent < size) {
    sent += chnWriteTimeout(up_channel(), &bytes[sent], size - sent, TIME_MS2I(UP_LINK_FINISH_MS));
  }
  if (sent < size) {
    counters.frames_torn++;
    return false;
  }
  counters.frames_sent++;
  return true;
}

static void receive(void) {
  uint8_t byte;

  while (chnReadTimeout(up_channel(), &byte, 1U, TIME_IMMEDIATE) == 1U) {
    if (!up_shell_wants(&decoder, byte)) {
      up_decoder_feed(&decoder, &byte, 1U);
    }
  }
}

static void send_hello(void) {
  const size_t bytes = up_encode_hello(up_config.schema, frame, sizeof frame);

  hello_due = !send(frame, bytes);
}

static void send_report(void) {
  uint8_t taken[UP_FIELD_BITMAP_BYTES];
  const size_t bytes = up_take_report(frame, sizeof frame, taken);

  if (bytes > 0U && !send(frame, bytes)) {
    up_restore_report(taken);
  }
}

void up_link_start(void) {
  static const up_sink_t sink = {.on_value = on_value, .on_hello = on_hello};
  const bool fits = up_decoder_init(&decoder, up_config.schema, UP_TO_BOARD, decoder_buffer,
                                    sizeof decoder_buffer, &sink);

  /* The generated sizes and the generated tables are made together; this holds them together. */
  if (!fits || sizeof frame < up_frame_bytes_max(up_config.schema, UP_TO_HOST)) {
    chSysHalt("frame sizes");
  }
  up_channel_start();
}

void up_link_cycle(void) {
  const bool is_open = up_channel_is_open();

  if (is_open && !was_open) {
    hello_due = true;
  }
  if (!is_open && was_open) {
    up_shell_channel_closed();
  }
  was_open = is_open;
  if (!is_open) {
    return;
  }
  receive();
  if (hello_due) {
    send_hello();
  }
  if (!hello_due) {
    send_report();
  }
}

void up_link_pause(void) {
  was_open = false;
}

bool up_link_peek(uint8_t byte) {
  const uint32_t frames_before = decoder.frames;

  up_decoder_feed(&decoder, &byte, 1U);
  return decoder.frames != frames_before && hello_due;
}

const up_link_counters_t *up_link_counters(void) {
  return &counters;
}

const up_decoder_t *up_link_decoder(void) {
  return &decoder;
}
