/* The same report with nanopb: delimited, as its length has to be told as well. */
#include "bench.h"
#include "fig2.pb.h"
#include "pb_decode.h"
#include "pb_encode.h"

static Report in = {true, 300U, true, 0U, true, 255U, true, 100000U}, out;
static uint8_t frame[32];

int main(void) {
  bool is_right = true;
  size_t size = 0U;
  uint32_t i, from;

  bench_start();
  from = bench_now();
  for (i = 0U; i < ROUNDS; i++) {
    pb_ostream_t stream = pb_ostream_from_buffer(frame, sizeof frame);
    is_right = pb_encode_ex(&stream, Report_fields, &in, PB_ENCODE_DELIMITED) && is_right;
    size = stream.bytes_written;
  }
  bench_say("encode", from, bench_now());
  from = bench_now();
  for (i = 0U; i < ROUNDS; i++) {
    pb_istream_t stream = pb_istream_from_buffer(frame, size);
    is_right = pb_decode_ex(&stream, Report_fields, &out, PB_DECODE_DELIMITED) && is_right;
  }
  bench_say("decode", from, bench_now());
  return (is_right && out.wheel_encoder == 100000U) ? 0 : 1;
}
