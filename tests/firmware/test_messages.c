/* Serial devices: recorded and published messages, intact, cut, damaged and hidden in others. */
#include <string.h>

#include "check.h"
#include "up_compose.h"
#include "up_message.h"
#include "up_parse.h"

typedef struct {
  up_result_t results[4];
  unsigned reported[4];
  uint16_t channels[18];
  int32_t numbers[4];
} received_t;

static const up_field_t fields[] = {
    {"A", 1U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 0U},
    {"B", 2U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 4U},
    {"C", 3U, UP_TYPE_INT32, UP_TO_HOST, false, 1U, 8U},
    {"Channels", 4U, UP_TYPE_UINT16, UP_TO_HOST, true, 16U, 12U},
    {"Servos", 5U, UP_TYPE_UINT16, UP_TO_HOST, true, 14U, 0U},
};
static const up_schema_t schema = {fields, 5U, false, 0U};

static void on_value(void *context, uint16_t field, up_result_t result, void *value) {
  received_t *received = context;
  const uint16_t at = (field > 3U) ? 3U : field;

  received->results[at] = result;
  received->reported[at]++;
  if (value != NULL && field < 3U) {
    memcpy(&received->numbers[field], value, sizeof received->numbers[0]);
  } else if (value != NULL) {
    memcpy(received->channels, value, up_field_bytes(&fields[field]));
  }
}

typedef struct {
  received_t received;
  uint8_t buffer[128];
  uint64_t scratch[8];
  up_message_state_t state;
} port_t;

static void set_up(port_t *port) {
  memset(port, 0, sizeof *port);
  port->state.buffer = port->buffer;
  port->state.scratch = port->scratch;
}

static void feed(port_t *port, const up_message_t *message, const void *bytes, size_t count) {
  const up_value_sink_t sink = {on_value, &port->received};

  up_message_feed(message, &port->state, &schema, bytes, count, &sink);
}

static void feed_text(port_t *port, const up_message_t *message, const char *text) {
  feed(port, message, text, strlen(text));
}

/* ---- binary messages ---- */

static const uint8_t yy[] = {0x59U, 0x59U};
static const up_message_field_t tfmini_fields[] = {
    {.field = 0U, .byte = 0U, .value = {.word_bytes = 2U, .little_endian = true}},
    {.field = 1U, .byte = 2U, .value = {.word_bytes = 2U, .little_endian = true}},
};
static const up_message_t tfmini = {.start = yy, .start_count = 2U, .length = 6U, .checksum = UP_CHECKSUM_SUM8,
                                    .bytes_max = 9U, .fields = tfmini_fields, .fields_count = 2U};

/* The data sheet's example of a distance, 1000 = 0x03E8, with the sum of all bytes before it. */
static void test_tfmini(void) {
  static const uint8_t frame[] = {0x59U, 0x59U, 0xE8U, 0x03U, 0x2CU, 0x01U, 0x00U, 0x00U, 0xCAU};
  /* A distance and a strength that look like the start, preceded by one more start. */
  static const uint8_t hard[] = {0x59U, 0x59U, 0x59U, 0x59U, 0x59U, 0x59U, 0x59U, 0x00U, 0x00U, 0x16U};
  port_t port;
  size_t i;

  set_up(&port);
  feed(&port, &tfmini, frame, sizeof frame);
  CHECK(port.received.numbers[0] == 1000 && port.received.numbers[1] == 300 && port.state.messages == 1U);
  for (i = 0U; i < sizeof frame; i++) {
    feed(&port, &tfmini, &frame[i], 1U);
  }
  CHECK(port.state.messages == 2U && port.state.dropped_bytes == 0U);
  feed(&port, &tfmini, hard, sizeof hard);
  CHECK(port.state.messages == 3U && port.received.numbers[0] == 0x5959 && port.state.dropped_bytes == 1U);
  feed(&port, &tfmini, frame, 5U); /* cut off, and the next one follows at once */
  feed(&port, &tfmini, frame, sizeof frame);
  CHECK(port.state.messages == 4U && port.state.dropped_bytes == 6U && port.state.wrong_checksum >= 1U);
  CHECK(port.state.values == 8U);
}

static const uint8_t sbus_start[] = {0x0FU}, sbus_end[] = {0x00U};
static const up_message_field_t sbus_fields[] = {
    {.field = 3U, .byte = 0U, .value = {.code = UP_CODE_PACKED, .bits = 11U}},
    {.field = 0U, .byte = 22U, .value = {.word_bytes = 1U, .low = 2U, .bits = 2U}},
};
static const up_message_t sbus = {.start = sbus_start, .end = sbus_end, .start_count = 1U, .end_count = 1U,
                                  .length = 23U, .bytes_max = 25U, .fields = sbus_fields, .fields_count = 2U};

/* Two published frames, with the channels that other decoders found in them. */
static void test_sbus(void) {
  static const uint8_t first[] = {0x0FU, 0xE0U, 0x03U, 0x1FU, 0x58U, 0xC0U, 0x07U, 0x16U, 0xB0U, 0x80U, 0x05U, 0x2CU,
                                  0x60U, 0x01U, 0x0BU, 0xF8U, 0xC0U, 0x07U, 0x00U, 0x00U, 0x00U, 0x00U, 0x00U, 0x03U,
                                  0x00U};
  static const uint16_t first_channels[] = {992U, 992U, 352U, 992U, 352U, 352U, 352U, 352U,
                                            352U, 352U, 992U, 992U, 0U,   0U,   0U,   0U};
  static const uint8_t second[] = {15U,  41U, 107U, 214U, 235U, 44U,  169U, 3U,   33U, 187U, 239U, 95U, 95U,
                                   76U, 252U, 16U,  236U, 190U, 212U, 237U, 81U, 6U,   69U,  77U, 0U};
  static const uint16_t second_channels[] = {809U,  717U,  943U, 1174U, 58U,   1602U, 1006U, 767U,
                                             1119U, 1929U, 67U,  1910U, 1355U, 987U,  404U,  552U};
  port_t port;

  set_up(&port);
  feed(&port, &sbus, first, sizeof first);
  CHECK(memcmp(port.received.channels, first_channels, sizeof first_channels) == 0 && port.received.numbers[0] == 0);
  feed(&port, &sbus, second, sizeof second);
  CHECK(memcmp(port.received.channels, second_channels, sizeof second_channels) == 0 && port.received.numbers[0] == 3);
  feed(&port, &sbus, first, 10U); /* the rest is lost; the line is silent, then everything is right again */
  up_message_gap(&port.state);
  feed(&port, &sbus, first, sizeof first);
  CHECK(port.state.messages == 3U && port.state.dropped_bytes == 10U);
}

static void test_ibus(void) {
  static const uint8_t start[] = {0x20U, 0x40U};
  static const up_message_field_t servos[] = {
      {.field = 4U, .value = {.word_bytes = 2U, .little_endian = true}}};
  static const up_message_t ibus = {.start = start, .start_count = 2U, .length = 28U, .checksum = UP_CHECKSUM_IBUS,
                                    .bytes_max = 32U, .fields = servos, .fields_count = 1U};
  /* A published message of a FlySky receiver. */
  uint8_t frame[] = {0x20U, 0x40U, 0xDBU, 0x05U, 0xDCU, 0x05U, 0x54U, 0x05U, 0xDCU, 0x05U, 0xE8U,
                     0x03U, 0xD0U, 0x07U, 0xD2U, 0x05U, 0xE8U, 0x03U, 0xDCU, 0x05U, 0xDCU, 0x05U,
                     0xDCU, 0x05U, 0xDCU, 0x05U, 0xDCU, 0x05U, 0xDCU, 0x05U, 0xDAU, 0xF3U};
  port_t port;

  set_up(&port);
  feed(&port, &ibus, frame, sizeof frame);
  CHECK(port.state.messages == 1U && port.received.channels[0] == 0x5DBU && port.received.channels[5] == 2000U);
  frame[31] ^= 1U;
  feed(&port, &ibus, frame, sizeof frame);
  CHECK(port.state.messages == 1U && port.state.wrong_checksum == 1U);
  frame[31] ^= 1U;
  frame[7] ^= 1U;
  feed(&port, &ibus, frame, sizeof frame);
  CHECK(port.state.messages == 1U && port.state.wrong_checksum == 2U && port.received.reported[3] == 3U);
  CHECK(port.received.results[3] == UP_WRONG_CRC && port.received.channels[0] == 0x5DBU);
}

static void test_crsf(void) {
  static const uint8_t start[] = {0xEEU, 0x18U, 0x16U};
  static const up_message_field_t channels[] = {{.field = 3U, .value = {.code = UP_CODE_PACKED, .bits = 11U}}};
  static const up_message_t crsf = {.start = start, .start_count = 3U, .length = 22U, .bytes_max = 26U,
                                    .checksum = UP_CHECKSUM_CRC8_DVB_S2, .checksum_from = 2U,
                                    .fields = channels, .fields_count = 1U};
  /* A published frame to a Crossfire transmitter: four sticks, a switch, and eleven channels in the middle. */
  static const uint8_t frame[] = {0xEEU, 0x18U, 0x16U, 0xE1U, 0xE3U, 0xDEU, 0x09U, 0xC7U, 0xD7U, 0x8AU, 0x56U, 0x80U,
                                  0x0FU, 0x7CU, 0xE0U, 0x03U, 0x1FU, 0xF8U, 0xC0U, 0x07U, 0x3EU, 0xF0U, 0x81U, 0x0FU,
                                  0x7CU, 0x36U};
  port_t port;
  size_t i;

  set_up(&port);
  feed(&port, &crsf, frame, sizeof frame);
  CHECK(port.state.messages == 1U && port.received.channels[0] == 993U && port.received.channels[1] == 988U);
  for (i = 6U; i < 16U; i++) {
    CHECK(port.received.channels[i] == 992U);
  }
}

/* ---- sentences ---- */

static const uint8_t dollar[] = {'$'}, line_end[] = {'\r', '\n'};
static const up_message_field_t gps_fields[] = {
    {.field = 0U, .format = UP_FORMAT_DEGREES, .sentence = "RMC", .separator = ',', .index = 2U},
    {.field = 1U, .format = UP_FORMAT_DEGREES, .sentence = "RMC", .separator = ',', .index = 4U},
    {.field = 2U, .format = UP_FORMAT_DECIMAL, .sentence = "GGA", .separator = ',', .index = 8U, .decimals = 2U},
};
static const up_message_t gps = {.start = dollar, .end = line_end, .start_count = 1U, .end_count = 2U,
                                 .checksum = UP_CHECKSUM_NMEA, .bytes_max = 100U,
                                 .fields = gps_fields, .fields_count = 3U};

/* Sentences of a u-blox module without a position, and of a receiver at sea with one. */
static void test_nmea(void) {
  port_t port;

  set_up(&port);
  feed_text(&port, &gps, "$GPTXT,01,01,02,ANTSTATUS=DONTKNOW*33\r\n$GPRMC,,V,,,,,,,,,,N*53\r\n");
  CHECK(port.state.messages == 2U && port.received.results[0] == UP_NOTHING && port.received.reported[0] == 1U);
  CHECK(port.received.reported[2] == 0U);
  feed_text(&port, &gps, "$GPGGA,,,,,,0,00,99.99,,,,,,*48\r\n");
  CHECK(port.received.reported[2] == 1U && port.received.results[2] == UP_NOTHING);
  feed_text(&port, &gps, "$GPRMC,200000.00,A,1541.31248595,N,05130.51199976,W,0.59,154.37,140120,16.9,W,D*0C\r\n");
  /* 15 + 41.31248595 / 60 and -(51 + 30.51199976 / 60) degrees */
  CHECK(port.received.results[0] == UP_FRESH && port.received.numbers[0] == 156885414);
  CHECK(port.received.results[1] == UP_FRESH && port.received.numbers[1] == -515085333);
  feed_text(&port, &gps, "$GPGGA,200000.00,1541.31248595,N,05130.51199976,W,2,06,1.5,8.8,M,-37.6,M,5.0,0138*7D\r\n");
  CHECK(port.received.results[2] == UP_FRESH && port.received.numbers[2] == 880 && port.state.messages == 5U);
  /* Damaged; without its end; with lower-case digits; a sentence of a Galileo talker. */
  feed_text(&port, &gps, "$GPGGA,200000.00,1541.31248595,N,05130.51199976,W,2,06,1.5,9.8,M,-37.6,M,5.0,0138*7D\r\n");
  feed_text(&port, &gps, "$GPGGA,2000$GPGGA,,,,,,0,00,99.99,,,,,,*48\r\n$GPGLL,,,,,,V,N*64\r\n"
                         "$GPGGA,,,,,,1,,,-5.006,,,,,*67\r\n");
  CHECK(port.state.wrong_checksum >= 2U && port.state.messages == 8U && port.received.numbers[2] == -501);
  /* Of the damaged sentences, only a value that is complete is reported. */
  CHECK(port.received.reported[2] == 6U && port.received.reported[0] == 2U);
}

/* MaxSonar: `R`, digits, carriage return; lines of numbers without a start; a distance or a word. */
static void test_text(void) {
  static const uint8_t r[] = {'R'}, cr[] = {'\r'}, lf[] = {'\n'};
  static const up_message_field_t range[] = {{.field = 0U, .format = UP_FORMAT_DECIMAL}};
  static const up_message_field_t pair[] = {
      {.field = 0U, .format = UP_FORMAT_DECIMAL, .separator = ';', .index = 0U, .decimals = 1U},
      {.field = 1U, .format = UP_FORMAT_HEX, .separator = ';', .index = 1U},
  };
  static const up_message_t maxsonar = {.start = r, .end = cr, .start_count = 1U, .end_count = 1U, .bytes_max = 8U,
                                        .fields = range, .fields_count = 1U};
  static const up_message_t lines = {.end = lf, .end_count = 1U, .bytes_max = 10U, .fields = pair, .fields_count = 2U};
  port_t port;

  set_up(&port);
  feed_text(&port, &maxsonar, "12\rR087\rR0R088\rR123456789\rR300\rRabc\r");
  CHECK(port.state.messages == 4U && port.received.reported[0] == 4U && port.received.numbers[0] == 300);
  CHECK(port.state.values == 3U);
  CHECK(port.received.results[0] == UP_INVALID && port.state.invalid == 1U);
  set_up(&port);
  feed_text(&port, &lines, "99;1\n1.25;fF\n"); /* the first line began before reception started */
  CHECK(port.state.messages == 1U && port.received.numbers[0] == 13 && port.received.numbers[1] == 255);
  feed_text(&port, &lines, "1234567890123;7\n-2 ;\n");
  CHECK(port.state.messages == 2U && port.received.numbers[0] == -20 && port.received.results[1] == UP_NOTHING);
  up_message_gap(&port.state);
  feed_text(&port, &lines, "4\n");
  CHECK(port.state.messages == 3U && port.received.numbers[0] == 40 && port.received.results[1] == UP_NOTHING);
}

/* Without a start: a checksum finds messages, and a gap finds blocks; nothing else does. */
static void test_without_start(void) {
  static const up_message_field_t words[] = {{.field = 0U, .value = {.word_bytes = 2U}}};
  static const up_message_t summed = {.length = 2U, .checksum = UP_CHECKSUM_XOR8, .bytes_max = 3U, .fields = words,
                                      .fields_count = 1U};
  static const up_message_t blocks = {.length = 2U, .bytes_max = 2U, .fields = words, .fields_count = 1U};
  static const uint8_t stream[] = {0x77U, 0x12U, 0x34U, 0x26U, 0x00U, 0x05U, 0x05U};
  port_t port;

  set_up(&port);
  feed(&port, &summed, stream, sizeof stream);
  CHECK(port.state.messages == 2U && port.received.numbers[0] == 5 && port.state.dropped_bytes == 1U);
  set_up(&port);
  feed(&port, &blocks, stream, sizeof stream);
  CHECK(port.state.messages == 0U);
  up_message_gap(&port.state);
  feed(&port, &blocks, &stream[1], 2U);
  CHECK(port.state.messages == 1U && port.received.numbers[0] == 0x1234);
}

/* A SLAMTEC capsule of six bytes, its first two being marks and sum: none of its bits can be another one. What announces
 * capsules has the marks of one. */
static void test_slamtec(void) {
  static const up_message_field_t words[] = {{.field = 0U, .byte = 2U, .value = {.word_bytes = 2U}}};
  static const up_message_t capsules = {.length = 6U, .checksum = UP_CHECKSUM_SLAMTEC, .bytes_max = 6U,
                                        .fields = words, .fields_count = 1U};
  static const uint8_t announced[] = {0xA5U, 0x5AU, 0x06U, 0x00U, 0x00U, 0x40U, 0x82U};
  static const uint8_t capsule[] = {0xACU, 0x5BU, 0x12U, 0x34U, 0x9AU, 0x00U}; /* 12 ^ 34 ^ 9A = BC */
  port_t port;
  size_t bit;

  set_up(&port);
  feed(&port, &capsules, announced, sizeof announced);
  feed(&port, &capsules, capsule, sizeof capsule);
  CHECK(port.state.messages == 1U && port.received.numbers[0] == 0x1234);
  CHECK(port.state.dropped_bytes == sizeof announced && port.state.wrong_checksum == 0U);
  for (bit = 0U; bit < 8U * sizeof capsule; bit++) {
    uint8_t wrong[sizeof capsule];
    memcpy(wrong, capsule, sizeof wrong);
    wrong[bit / 8U] ^= (uint8_t)(1U << (bit % 8U));
    set_up(&port);
    feed(&port, &capsules, wrong, sizeof wrong);
    feed(&port, &capsules, capsule, sizeof capsule);
    CHECK(port.state.messages == 1U && port.state.values == 1U && port.received.numbers[0] == 0x1234);
    CHECK(port.state.wrong_checksum == ((bit % 8U >= 4U && bit < 16U) ? 0U : 1U));
  }
}

/* u-blox: a pause, two messages in a row, a pause, one more message. */
static void test_setting_up(void) {
  static const uint8_t text[] = {'a', 'b', 'c'};
  static const up_message_init_t init[] = {{NULL, 0U, 200U}, {text, 3U, 0U}, {text, 2U, 50U}, {text, 1U, 0U}};
  const uint32_t t0 = 0xFFFFFF80U;
  up_message_start_t start = {0U, 0U, false};

  CHECK(up_message_start(init, 4U, &start, t0) == &init[0] && up_message_start(init, 4U, &start, t0 + 200U) == NULL);
  CHECK(up_message_start(init, 4U, &start, t0 + 201U) == &init[1]);
  CHECK(up_message_start(init, 4U, &start, t0 + 201U) == &init[2]);
  CHECK(up_message_start(init, 4U, &start, t0 + 251U) == NULL);
  CHECK(up_message_start(init, 4U, &start, t0 + 252U) == &init[3] && start.at == 4U && !start.is_pausing);
  CHECK(up_message_start(init, 4U, &start, t0 + 252U) == NULL);
}

/* Nothing is written to a buffer that is too small for any message. */
static void test_too_small(void) {
  static const uint8_t ends[] = {'a', 'b', 'c', 'd'};
  static const up_message_t lines = {.end = ends, .end_count = 4U, .bytes_max = 3U};
  static const up_message_t blocks = {.length = 4U, .bytes_max = 3U};
  static const up_message_t nothing = {.length = 0U, .bytes_max = 0U};
  uint8_t buffer[] = {9U, 9U, 9U, 9U};
  port_t port;

  set_up(&port);
  port.state.buffer = buffer;
  feed_text(&port, &lines, "abcdabcdabcd");
  up_message_gap(&port.state);
  feed_text(&port, &blocks, "abcdabcd");
  feed_text(&port, &nothing, "ab");
  CHECK(port.state.messages == 0U && port.state.dropped_bytes == 22U && buffer[3] == 9U);
}

/* ---- numbers ---- */

static up_result_t decimal(const char *text, uint8_t decimals, int32_t *number) {
  const up_piece_t piece = {text, strlen(text)};

  return up_parse_decimal(piece, decimals, UP_TYPE_INT32, number);
}

static void test_decimals(void) {
  static const struct {
    const char *text;
    uint8_t decimals;
    int32_t number;
  } rows[] = {{"0", 0U, 0},         {"12.345", 2U, 1235},  {"-12.345", 2U, -1235}, {"12.344", 2U, 1234},
              {"+.5", 0U, 1},       {"-.5", 0U, -1},       {".49999999999999999999", 0U, 0}, {"7.", 1U, 70},
              {" 42 ", 0U, 42},     {"99999999999999999999999", 0U, INT32_MAX}, {"-2147483649", 0U, INT32_MIN},
              {"1", 18U, INT32_MAX}, {"0.000000000000000001", 18U, 1}, {"00000000000000000000000000000012", 0U, 12},
              {"3.00000000000000000000000000000", 3U, 3000}};
  static const char *const junk[] = {"-", "+", ".", "1.2.3", "1e3", "0x10", "12m", "--1", "1 2", "N/A"};
  int32_t number;
  float real = 0.0F;
  const up_piece_t third = {"-0.3333333", 10U};
  size_t i;

  for (i = 0U; i < sizeof rows / sizeof rows[0]; i++) {
    number = -99;
    CHECK(decimal(rows[i].text, rows[i].decimals, &number) == UP_FRESH && number == rows[i].number);
  }
  for (i = 0U; i < sizeof junk / sizeof junk[0]; i++) {
    number = -99;
    CHECK(decimal(junk[i], 2U, &number) == UP_INVALID && number == -99);
  }
  CHECK(decimal("", 2U, &number) == UP_NOTHING && decimal("  ", 2U, &number) == UP_NOTHING);
  CHECK(decimal("1", 19U, &number) == UP_INVALID);
  CHECK(up_parse_decimal(third, 1U, UP_TYPE_FLOAT32, &real) == UP_FRESH && real < -3.33333F && real > -3.33334F);
}

static up_result_t degrees(const char *text, const char *hemisphere, int32_t *angle) {
  const up_piece_t piece = {text, strlen(text)}, letter = {hemisphere, strlen(hemisphere)};

  return up_parse_degrees(piece, letter, UP_TYPE_INT32, angle);
}

static void test_degrees(void) {
  int32_t angle = 0;
  const up_piece_t wide = {"FFFFFFFFFFFFFFFFFF", 18U}, mixed = {"dEaD", 4U}, junk = {"12G4", 4U};
  const up_piece_t ninety_nine = {"99", 2U};
  uint64_t number = 0U;

  /* The example sentence that is in every text about NMEA. */
  CHECK(degrees("4807.038", "N", &angle) == UP_FRESH && angle == 481173000);
  CHECK(degrees("01131.000", "E", &angle) == UP_FRESH && angle == 115166667);
  CHECK(degrees("18000.0000", "W", &angle) == UP_FRESH && angle == -1800000000);
  CHECK(degrees("0000.00001", "S", &angle) == UP_FRESH && angle == -2);
  CHECK(degrees("9000.0001", "N", &angle) == UP_INVALID && degrees("18000.0001", "E", &angle) == UP_INVALID);
  CHECK(degrees("4860.0", "N", &angle) == UP_INVALID && degrees("48", "N", &angle) == UP_INVALID);
  CHECK(degrees("4807.038", "", &angle) == UP_INVALID && degrees("4807.038", "X", &angle) == UP_INVALID);
  CHECK(degrees("-4807.038", "N", &angle) == UP_INVALID && degrees("", "", &angle) == UP_NOTHING);
  CHECK(up_parse_hex(wide, UP_TYPE_UINT64, &number) == UP_FRESH && number == UINT64_MAX);
  CHECK(up_parse_hex(mixed, UP_TYPE_UINT64, &number) == UP_FRESH && number == 0xDEADU);
  CHECK(up_parse_decimal(ninety_nine, 18U, UP_TYPE_UINT64, &number) == UP_FRESH && number == UINT64_MAX);
  CHECK(up_parse_hex(junk, UP_TYPE_UINT64, &number) == UP_INVALID);
}

/* ---- messages that are sent ---- */

#define COMPOSED_MAX 16U

/* Composes into a buffer that ends with guard bytes, and compares. */
static bool composes(const up_compose_t *how, uint8_t type, const void *value, const char *wanted, size_t count) {
  const up_field_t field = {"Sent", 1U, type, UP_TO_BOARD, true, 1U, 0U};
  uint8_t bytes[COMPOSED_MAX + 1U];
  size_t room;

  for (room = 0U; room <= COMPOSED_MAX; room++) {
    size_t made;

    memset(bytes, 0xEE, sizeof bytes);
    made = up_compose(how, &field, value, bytes, room);
    if (made > room || bytes[room] != 0xEEU || (made != 0U && made != count)) {
      return false;
    }
  }
  return up_compose(how, &field, value, bytes, COMPOSED_MAX) == count && memcmp(bytes, wanted, count) == 0;
}

static void test_composing(void) {
  static const uint8_t digits[] = "12345678";
  static const uint8_t head[] = {0x5AU, 0x05U};
  static const uint8_t servo[] = {0x20U, 0x40U};
  const uint16_t word = 0x1234U, width = 1500U;
  const uint8_t nine = '9', letter = 'A';
  up_compose_t how;

  memset(&how, 0, sizeof how);
  how.value.code = UP_CODE_INTEGER;
  how.value.word_bytes = 2U;
  how.checksum = UP_CHECKSUM_NONE;
  CHECK(composes(&how, UP_TYPE_UINT16, &word, "\x12\x34", 2U));
  how.value.little_endian = true;
  how.start = head;
  how.start_count = 2U;
  how.checksum = UP_CHECKSUM_SUM8;
  CHECK(composes(&how, UP_TYPE_UINT16, &word, "\x5A\x05\x34\x12\xA5", 5U));
  /* From the second byte on, and with an end after the checksum. */
  how.checksum = UP_CHECKSUM_XOR8;
  how.checksum_from = 1U;
  how.end = line_end;
  how.end_count = 2U;
  CHECK(composes(&how, UP_TYPE_UINT16, &word, "\x5A\x05\x34\x12\x23\r\n", 7U));
  /* A first byte after the whole message: nothing is summed. */
  how.checksum_from = 200U;
  CHECK(composes(&how, UP_TYPE_UINT16, &word, "\x5A\x05\x34\x12\x00\r\n", 7U));
  how.checksum = UP_CHECKSUM_IBUS;
  how.checksum_from = 0U;
  how.start = servo;
  how.end_count = 0U;
  CHECK(composes(&how, UP_TYPE_UINT16, &width, "\x20\x40\xDC\x05\xBE\xFE", 6U));
  /* The check value that every list of checksums gives for CRC-8/DVB-S2. */
  how.checksum = UP_CHECKSUM_CRC8_DVB_S2;
  how.start = digits;
  how.start_count = 8U;
  how.value.word_bytes = 1U;
  CHECK(composes(&how, UP_TYPE_UINT8, &nine, "123456789\xBC", 10U));
  how.checksum = UP_CHECKSUM_NMEA;
  how.start = dollar;
  how.start_count = 1U;
  how.end_count = 2U;
  CHECK(composes(&how, UP_TYPE_UINT8, &letter, "$A*41\r\n", 7U));
}

void test_messages(void) {
  test_tfmini();
  test_sbus();
  test_ibus();
  test_crsf();
  test_nmea();
  test_text();
  test_without_start();
  test_slamtec();
  test_setting_up();
  test_too_small();
  test_decimals();
  test_degrees();
  test_composing();
}
