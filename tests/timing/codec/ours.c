/* Fig. 2 with all four values: a report to a frame, a frame to values. */
#include "bench.h"
#include "sense_model.h"
#include "up_encode.h"

static sense_values_t in = {300U, 0U, 255U, 100000U}, out;
static uint8_t frame[SENSE_REPORT_FRAME_BYTES], buffer[SENSE_REPORT_BUFFER_BYTES], taken[1];

static void on_values(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  (void)context;
  (void)stamp;
  sense_reports.take(items, &items[size], &out, taken);
}

int main(void) {
  static const uint8_t due[] = {0x0FU};
  static const up_sink_t sink = {.on_values = on_values};
  static up_decoder_t decoder;
  size_t size = 0U;
  uint32_t i, from;

  bench_start();
  (void)up_decoder_init(&decoder, &sense_reports, buffer, sizeof buffer, &sink);
  from = bench_now();
  for (i = 0U; i < ROUNDS; i++) {
    size = up_encode_values(&sense_reports, NULL, due, &in, frame, sizeof frame);
  }
  bench_say("encode", from, bench_now());
  from = bench_now();
  for (i = 0U; i < ROUNDS; i++) {
    up_decoder_feed(&decoder, frame, size);
  }
  bench_say("decode", from, bench_now());
  return (decoder.frames == ROUNDS && taken[0] == 0x0FU && out.SENSE_WheelEncoder == 100000U) ? 0 : 1;
}
