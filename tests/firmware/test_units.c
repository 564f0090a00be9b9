/* The core of the runtime, function by function, with the hardware replaced by tables. */
#include <string.h>

#include "check.h"
#include "model_model.h"
#include "up_capture.h"
#include "up_convert.h"
#include "up_decode.h"
#include "up_encode.h"
#include "up_report.h"
#include "up_text.h"

/* ---- conversion ---- */

static uint64_t stored_unsigned(uint8_t type, uint64_t raw) {
  uint64_t element = 0U;
  up_store_unsigned(type, raw, &element);
  return up_element_load(type, &element);
}

static uint64_t stored_signed(uint8_t type, int64_t raw) {
  uint64_t element = 0U;
  up_store_signed(type, raw, &element);
  return up_element_load(type, &element);
}

static void test_saturation(void) {
  CHECK(strcmp(up_type_name(UP_TYPE_BOOL), "bool") == 0 && strcmp(up_type_name(UP_TYPE_INT16), "int16") == 0);
  CHECK(strcmp(up_type_name(UP_TYPE_FLOAT64), "float64") == 0 && strcmp(up_type_name(99U), "?") == 0);
  CHECK(stored_unsigned(UP_TYPE_UINT8, 255U) == 255U);
  CHECK(stored_unsigned(UP_TYPE_UINT8, 256U) == 255U);
  CHECK(stored_unsigned(UP_TYPE_INT8, 200U) == 127U);
  CHECK(stored_unsigned(UP_TYPE_BOOL, 7U) == 1U);
  CHECK(stored_unsigned(UP_TYPE_UINT64, UINT64_MAX) == UINT64_MAX);
  CHECK(stored_unsigned(UP_TYPE_INT64, UINT64_MAX) == (uint64_t)INT64_MAX);
  CHECK(stored_signed(UP_TYPE_UINT16, -1) == 0U);
  CHECK(stored_signed(UP_TYPE_BOOL, -1) == 1U);
  CHECK(stored_signed(UP_TYPE_INT8, -129) == 0x80U);
  CHECK(stored_signed(UP_TYPE_INT16, -2) == 0xFFFEU);
  CHECK(stored_signed(UP_TYPE_INT32, INT64_MIN) == 0x80000000U);
  CHECK(stored_signed(UP_TYPE_INT64, INT64_MIN) == (uint64_t)1U << 63);
}

static void test_mean(void) {
  const uint16_t samples[] = {10U, 1000U, 11U, 2000U, 11U, 3001U};
  uint16_t mean = 0U;
  uint8_t small = 0U;
  float real = 0.0F;

  up_store_mean(UP_TYPE_UINT16, &samples[0], 3U, 2U, &mean);
  CHECK(mean == 11U); /* 32/3 rounds up */
  up_store_mean(UP_TYPE_UINT16, &samples[1], 3U, 2U, &mean);
  CHECK(mean == 2000U);
  up_store_mean(UP_TYPE_UINT8, &samples[1], 3U, 2U, &small);
  CHECK(small == 255U);
  up_store_mean(UP_TYPE_FLOAT32, &samples[0], 2U, 2U, &real);
  CHECK(real > 10.49F && real < 10.51F);
}

static void test_bytes(void) {
  const up_field_t small = {"s", 1U, UP_TYPE_UINT8, UP_TO_HOST, false, 1U, 0U};
  const up_field_t triple = {"t", 2U, UP_TYPE_INT16, UP_TO_HOST, false, 3U, 0U};
  const up_field_t wide = {"w", 3U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 0U};
  const up_field_t real = {"r", 4U, UP_TYPE_FLOAT32, UP_TO_HOST, false, 1U, 0U};
  const uint8_t near[] = {0x00U, 0x07U}, far[] = {0x01U, 0x2CU};
  const uint8_t axes[] = {0xFFU, 0xFEU, 0x00U, 0x01U, 0x80U, 0x00U};
  const uint8_t one[] = {0x3FU, 0x80U, 0x00U, 0x00U};
  int16_t vector[3];
  uint8_t byte = 0U, back[6];
  int32_t word = 0;
  float number = 0.0F;

  CHECK(up_store_bytes(&small, near, 2U, false, &byte) && byte == 7U);
  CHECK(up_store_bytes(&small, far, 2U, false, &byte) && byte == 255U);
  CHECK(up_store_bytes(&triple, axes, 6U, false, vector));
  CHECK(vector[0] == -2 && vector[1] == 1 && vector[2] == -32768);
  CHECK(up_load_bytes(&triple, vector, back, 6U, false) && memcmp(back, axes, 6U) == 0);
  CHECK(up_store_bytes(&wide, axes, 2U, true, &word) && word == -257);
  CHECK(up_load_bytes(&wide, &word, back, 3U, true) && back[0] == 0xFFU && back[1] == 0xFEU && back[2] == 0xFFU);
  CHECK(up_store_bytes(&real, one, 4U, false, &number) && number > 0.99F && number < 1.01F);
  CHECK(up_store_bytes(&real, far, 2U, false, &number) && number > 299.0F && number < 301.0F);
  CHECK(!up_store_bytes(&triple, axes, 5U, false, vector));
  CHECK(!up_load_bytes(&small, &byte, back, 2U, false));
}

static void check_text(uint8_t type, uint64_t bits, const char *wanted) {
  uint64_t element = 0U;
  char text[UP_TEXT_BYTES];

  up_element_store(type, bits, &element);
  CHECK(up_text_element(type, &element, text) == strlen(wanted) && strcmp(text, wanted) == 0);
}

static void test_text(void) {
  check_text(UP_TYPE_BOOL, 1U, "true");
  check_text(UP_TYPE_UINT8, 0U, "0");
  check_text(UP_TYPE_INT8, 0x80U, "-128");
  check_text(UP_TYPE_UINT64, UINT64_MAX, "18446744073709551615");
  check_text(UP_TYPE_INT64, (uint64_t)1U << 63, "-9223372036854775808");
  check_text(UP_TYPE_FLOAT32, 0x3FC00000U, "1.500000");
  check_text(UP_TYPE_FLOAT64, 0xBFB999999999999AU, "-0.100000");
  check_text(UP_TYPE_FLOAT64, 0x3FEFFFFFFFFFFFFFU, "1.000000");
  check_text(UP_TYPE_FLOAT32, 0x7FC00000U, "nan");
  check_text(UP_TYPE_FLOAT32, 0xFF800000U, "-large");
}

/* ---- reports: a printed codec of three values ---- */

static void test_reports(void) {
  static const up_stamp_t stamp = {0U, 0U};
  model_values_t model;
  up_store_t store;
  const uint16_t front = 300U;
  const uint8_t rear = 9U;
  const int16_t motor = -5;
  uint8_t frame[MODEL_REPORT_FRAME_BYTES], taken[UP_FIELD_BITMAP_BYTES];
  const size_t size = sizeof frame;

  up_store_init(&store, &model_schema, &model);
  CHECK(up_report_take(&store, &model_reports, &stamp, frame, size, taken) == 0U && !up_report_is_due(&store));
  CHECK(up_store_get(&store, 0U) == NULL);
  up_store_put(&store, 2U, &motor); /* an actuator's value is never reported */
  CHECK(!up_report_is_due(&store) && model.MODEL_Motor == -5);
  up_store_put(&store, 1U, &rear);
  CHECK(up_report_is_due(&store));
  CHECK(up_report_take(&store, &model_reports, &stamp, frame, size, taken) == 5U);
  CHECK(memcmp(frame, "2:\x13\x09,", 5U) == 0);
  CHECK(up_report_take(&store, &model_reports, &stamp, frame, size, taken) == 0U && !up_report_is_due(&store));
  up_store_put(&store, 1U, &rear);
  up_store_put(&store, 0U, &front);
  CHECK(up_report_take(&store, &model_reports, &stamp, frame, size, taken) == 8U);
  CHECK(memcmp(frame, "5:\x11\x01\x2c\x13\x09,", 8U) == 0);
  up_report_restore(&store, taken);
  up_report_forget(&store, 0U);
  CHECK(up_report_take(&store, &model_reports, &stamp, frame, size, taken) == 5U);
  CHECK(up_store_get(&store, 0U) == &model.MODEL_Front && model.MODEL_Front == 300U);
}

static unsigned requests, health_requests, values_seen;
static int16_t motor_seen;

static void on_motor(void *context, const up_stamp_t *stamp, const uint8_t *items, size_t size) {
  model_values_t model;
  uint8_t taken[UP_FIELD_BITMAP_BYTES] = {0U};

  (void)context;
  CHECK(stamp == NULL);
  model_commands.take(items, &items[size], &model, taken);
  CHECK(taken[0] == 4U);
  values_seen++;
  motor_seen = model.MODEL_Motor;
}

static void on_request(void *context, uint32_t hash) {
  (void)context;
  requests += (hash == 0U) ? 1U : 0U;
}

static void on_health_request(void *context, const uint8_t *payload, size_t size) {
  (void)context;
  (void)payload;
  health_requests += (size == 0U) ? 1U : 0U;
}

static const up_sink_t motor_sink = {on_motor, on_request, on_health_request, NULL};

static void test_link(void) {
  const uint8_t stream[] = {'\r', '\n', '1', ':', 0x00U, ',', '3', ':', 40U, 0xFFU, 0xFEU, ',', '2', ':', 0U, 1U, ','};
  up_decoder_t decoder;
  uint8_t buffer[MODEL_COMMAND_FRAME_BYTES], frame[MODEL_REPORT_FRAME_BYTES];

  CHECK(UP_WIRE_FRAME_BYTES(&model_commands) == 6U && MODEL_COMMAND_FRAME_BYTES == 6U);
  CHECK(UP_WIRE_FRAME_BYTES(&model_reports) == MODEL_REPORT_FRAME_BYTES && MODEL_REPORT_FRAME_BYTES == 74U);
  CHECK(model_commands.memo == NULL && model_commands.item(40U) == UP_ITEM(2U, false));
  CHECK(model_commands.item(17U) == UP_ITEM_NONE && model_reports.item(40U) == UP_ITEM_NONE);
  CHECK(!up_decoder_init(&decoder, &model_commands, buffer, sizeof buffer - 1U, &motor_sink));
  CHECK(up_decoder_init(&decoder, &model_commands, buffer, sizeof buffer, &motor_sink));
  up_decoder_feed(&decoder, stream, sizeof stream);
  CHECK(requests == 1U && health_requests == 1U && values_seen == 1U && motor_seen == -2);
  CHECK(decoder.frames == 3U && decoder.dropped_bytes == 2U && up_decoder_is_idle(&decoder));
  CHECK(up_encode_hello(&model_reports, frame, sizeof frame) == 8U && memcmp(frame, "5:\0", 3U) == 0);
  CHECK(up_get_32(&frame[3]) == model_schema.hash && frame[7] == ',');
  CHECK(up_encode_hello(&model_reports, frame, sizeof frame - 1U) == 0U);
  CHECK(up_encode_hello_request(&model_commands, frame, sizeof frame) == 4U && memcmp(frame, "1:\0,", 4U) == 0);
  CHECK(up_encode_health_request(&model_commands, frame, 6U) == 5U && memcmp(frame, "2:\0\1,", 5U) == 0);
}

/* Random bytes never break the decoder's bounds (a sanitizer checks), and a frame after them is found. */
static void test_noise(void) {
  const uint8_t frame[] = {'3', ':', 40U, 0x00U, 0x07U, ','};
  up_decoder_t decoder;
  uint8_t buffer[MODEL_COMMAND_BUFFER_BYTES], noise[16];
  uint32_t seed = 12345U, round, i;

  CHECK(up_decoder_init(&decoder, &model_commands, buffer, sizeof buffer, &motor_sink));
  for (round = 0U; round < 5000U; round++) {
    for (i = 0U; i < sizeof noise; i++) {
      seed = seed * 1664525U + 1013904223U;
      noise[i] = (uint8_t)("13:,\x28\x00\xff"[(seed >> 16) % 7U]);
    }
    noise[sizeof noise - 1U] = (uint8_t)'x'; /* nothing that began before can swallow the frame as its value */
    noise[sizeof noise - 2U] = (uint8_t)'x';
    noise[sizeof noise - 3U] = (uint8_t)'x';
    noise[sizeof noise - 4U] = (uint8_t)'x';
    motor_seen = 0;
    up_decoder_feed(&decoder, noise, sizeof noise);
    up_decoder_feed(&decoder, frame, sizeof frame);
    CHECK(motor_seen == 7);
  }
  CHECK(up_decoder_is_idle(&decoder));
}

/* ---- capture ---- */

static void test_count(void) {
  const up_capture_config_t config = {UP_CAPTURE_COUNT, false, 10000U, 1000U};
  up_capture_state_t state = {0U, 0U, false, false};
  up_capture_raw_t raw = {0U, 0U, 0U, 0U, 0U};
  uint32_t count = 99U;

  /* A wheel at rest counts 0; this value is read, not assumed. */
  CHECK(up_capture_read(&config, &state, &raw, false, 5U, UP_TYPE_UINT32, &count) && count == 0U);
  CHECK(!up_capture_read(&config, &state, &raw, false, 15U, UP_TYPE_UINT32, &count));
  /* The driver does not report the first edge. */
  CHECK(up_capture_read(&config, &state, &raw, true, 25U, UP_TYPE_UINT32, &count) && count == 1U);
  up_capture_on_period(&raw, 100U);
  up_capture_on_width(&raw, 50U, false);
  up_capture_on_period(&raw, 100U);
  CHECK(up_capture_read(&config, &state, &raw, true, 35U, UP_TYPE_UINT32, &count) && count == 3U);
  CHECK(!up_capture_read(&config, &state, &raw, true, 1034U, UP_TYPE_UINT32, &count));
  CHECK(up_capture_read(&config, &state, &raw, true, 1035U, UP_TYPE_UINT32, &count) && count == 3U);
  up_capture_on_width(&raw, 50U, true);
  CHECK(up_capture_read(&config, &state, &raw, true, 1036U, UP_TYPE_UINT32, &count) && count == 4U);
}

static uint32_t captured(up_capture_mode_t mode, const up_capture_raw_t *raw) {
  const up_capture_config_t config = {(uint8_t)mode, false, 1000000U, 1000U};
  up_capture_state_t state = {0U, 0U, false, false};
  uint32_t value = 0U;

  CHECK(up_capture_read(&config, &state, raw, true, 1U, UP_TYPE_UINT32, &value));
  CHECK(!up_capture_read(&config, &state, raw, true, 2U, UP_TYPE_UINT32, &value));
  return value;
}

static void test_captures(void) {
  const up_capture_config_t config = {UP_CAPTURE_FREQUENCY, false, 1000000U, 1000U};
  up_capture_state_t state = {0U, 0U, false, false};
  up_capture_raw_t raw = {0U, 0U, 0U, 0U, 0U};
  uint16_t value = 7U;

  CHECK(!up_capture_read(&config, &state, &raw, false, 999U, UP_TYPE_UINT16, &value) && value == 7U);
  CHECK(up_capture_read(&config, &state, &raw, false, 1000U, UP_TYPE_UINT16, &value) && value == 0U);
  CHECK(!up_capture_read(&config, &state, &raw, false, 3000U, UP_TYPE_UINT16, &value));
  up_capture_on_width(&raw, 1500U, false);
  up_capture_on_period(&raw, 20000U);
  CHECK(captured(UP_CAPTURE_WIDTH, &raw) == 1500U);
  CHECK(captured(UP_CAPTURE_PERIOD, &raw) == 20000U);
  CHECK(captured(UP_CAPTURE_FREQUENCY, &raw) == 50U);
  CHECK(captured(UP_CAPTURE_DUTY, &raw) == 750U);
  CHECK(up_capture_read(&config, &state, &raw, true, 3010U, UP_TYPE_UINT16, &value) && value == 50U);
  up_capture_on_period(&raw, 30000U); /* 33.3 Hz */
  CHECK(up_capture_read(&config, &state, &raw, true, 3020U, UP_TYPE_UINT16, &value) && value == 33U);
}

/* A pulse is reported at its end: a ranger that answers once a cycle has no period that the timer could hold. */
static void test_single_pulses(void) {
  const up_capture_config_t config = {UP_CAPTURE_WIDTH, false, 1000000U, 1000U};
  up_capture_state_t state = {0U, 0U, false, false};
  up_capture_raw_t raw = {0U, 0U, 0U, 0U, 0U};
  uint16_t value = 0U;

  CHECK(!up_capture_read(&config, &state, &raw, false, 5000U, UP_TYPE_UINT16, &value));
  up_capture_on_width(&raw, 580U, false);
  CHECK(up_capture_read(&config, &state, &raw, true, 5010U, UP_TYPE_UINT16, &value) && value == 580U);
  up_capture_on_width(&raw, 580U, false);
  CHECK(up_capture_read(&config, &state, &raw, true, 5020U, UP_TYPE_UINT16, &value));
  CHECK(!up_capture_read(&config, &state, &raw, true, 9999U, UP_TYPE_UINT16, &value));
}

void test_units(void) {
  test_saturation();
  test_mean();
  test_bytes();
  test_text();
  test_reports();
  test_link();
  test_noise();
  test_count();
  test_captures();
  test_single_pulses();
}
