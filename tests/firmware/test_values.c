/* Values of devices: words, bit fields, packed bits, BCD, checksums; real numbers without the machine's own. */
#include <string.h>

#include "check.h"
#include "up_checksum.h"
#include "up_convert.h"
#include "up_value.h"

static const up_field_t byte_field = {"b", 1U, UP_TYPE_UINT8, UP_TO_HOST, false, 1U, 0U};
static const up_field_t half_field = {"h", 2U, UP_TYPE_UINT16, UP_TO_HOST, false, 1U, 0U};
static const up_field_t signed_field = {"s", 3U, UP_TYPE_INT16, UP_TO_HOST, false, 1U, 0U};
static const up_field_t triple_field = {"t", 4U, UP_TYPE_INT16, UP_TO_HOST, true, 3U, 0U};

static bool decodes(const up_value_t *how, const up_field_t *field, const uint8_t *bytes, const void *wanted) {
  uint8_t value[64];

  return up_value_decode(how, field, bytes, up_value_bytes(how, field->count), value) == UP_FRESH &&
         memcmp(value, wanted, up_field_bytes(field)) == 0;
}

/* Values from CRC catalogues and Sensirion's data sheets. */
static void test_checksums(void) {
  static const uint8_t beef[] = {0xBEU, 0xEFU};
  static const uint8_t digits[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

  CHECK(up_crc8(0x31U, 0xFFU, beef, 2U) == 0x92U);
  CHECK(up_crc8(0x31U, 0xFFU, digits, 9U) == 0xF7U); /* CRC-8/NRSC-5 */
  CHECK(up_crc8(0xD5U, 0x00U, digits, 9U) == 0xBCU); /* CRC-8/DVB-S2 */
  CHECK(up_sum16(digits, 9U) == 477U && up_sum8(digits, 9U) == 477U - 256U && up_xor8(digits, 9U) == 0x31U);
}

static void test_bits(void) {
  static const uint8_t image[] = {0x7FU, 0xE0U}, low[] = {0x0FU, 0xFEU};
  /* LM75: 11 bits at the top of a word; 0x7FE0 would be +127.875 degC times 8, 0x8020 is -127.75 */
  const up_value_t lm75 = {.word_bytes = 2U, .low = 5U, .bits = 11U, .is_signed = true};
  const up_value_t nibble = {.word_bytes = 1U, .low = 4U};
  const up_value_t little = {.word_bytes = 2U, .bits = 4U, .low = 8U, .little_endian = true};
  const up_value_t signed_byte = {.word_bytes = 1U, .is_signed = true};
  static const uint8_t cold[] = {0x80U, 0x20U};
  int16_t number = 1023;
  uint8_t byte = 7U;

  CHECK(decodes(&lm75, &signed_field, image, &number));
  number = -1023;
  CHECK(decodes(&lm75, &signed_field, cold, &number));
  CHECK(decodes(&nibble, &byte_field, image, &byte));
  byte = 0x0EU;
  CHECK(decodes(&little, &byte_field, low, &byte));
  byte = 0U; /* -128 into an unsigned field */
  CHECK(decodes(&signed_byte, &byte_field, cold, &byte));
  byte = 255U; /* 0x7FE0 into a byte */
  CHECK(decodes(&(const up_value_t){.word_bytes = 2U}, &byte_field, image, &byte));
}

/* HMC5883L: X, Z, Y on the wire. */
static void test_elements(void) {
  static const uint8_t order[] = {0U, 2U, 1U};
  static const uint8_t image[] = {0x00U, 0x01U, 0xFFU, 0xFEU, 0x01U, 0x00U};
  static const uint8_t gaps[] = {0U, 2U};
  const up_value_t hmc5883l = {.elements = order, .word_bytes = 2U, .is_signed = true};
  const up_value_t sparse = {.elements = gaps, .words = 3U, .word_bytes = 2U};
  const up_field_t pair = {"p", 5U, UP_TYPE_UINT16, UP_TO_HOST, true, 2U, 0U};
  const int16_t axes[] = {1, 256, -2};
  const uint16_t ends[] = {1U, 256U};
  uint8_t back[6];

  CHECK(decodes(&hmc5883l, &triple_field, image, axes));
  CHECK(up_value_encode(&hmc5883l, &triple_field, axes, back, sizeof back) == 6U && memcmp(back, image, 6U) == 0);
  CHECK(up_value_bytes(&sparse, 2U) == 6U && decodes(&sparse, &pair, image, ends));
}

/* SHT31: temperature and humidity, each with its CRC. */
static void test_sensirion(void) {
  static uint8_t image[] = {0xBEU, 0xEFU, 0x92U, 0x66U, 0x66U, 0x93U};
  const up_value_t word = {.word_bytes = 2U, .crc = UP_CRC_SENSIRION};
  const up_value_t wide = {.word_bytes = 4U, .crc = UP_CRC_SENSIRION};
  const up_field_t word_field = {"w", 6U, UP_TYPE_UINT32, UP_TO_HOST, false, 1U, 0U};
  uint16_t number = 0xBEEFU;
  const uint32_t both = 0xBEEF6666U;
  uint8_t back[6];

  CHECK(up_crc8(0x31U, 0xFFU, &image[3], 2U) == image[5]);
  CHECK(up_value_bytes(&word, 1U) == 3U && up_value_bytes(&wide, 1U) == 6U);
  CHECK(decodes(&word, &half_field, image, &number) && decodes(&wide, &word_field, image, &both));
  CHECK(up_value_encode(&wide, &word_field, &both, back, 6U) == 6U && memcmp(back, image, 6U) == 0);
  CHECK(up_value_encode(&wide, &word_field, &both, back, 5U) == 0U);
  image[5] ^= 1U;
  CHECK(decodes(&word, &half_field, image, &number) && !decodes(&wide, &word_field, image, &both));
  CHECK(up_value_decode(&wide, &word_field, image, 6U, back) == UP_WRONG_CRC);
  CHECK(!up_value_crc_is_right(&wide, 1U, image) && up_value_crc_is_right(&word, 1U, image));
  image[5] ^= 1U;
}

/* DS3231: 59 seconds, 23 hours, and a month with the century in its highest bit. */
static void test_bcd(void) {
  static const uint8_t seconds[] = {0x59U}, month[] = {0x92U}, junk[] = {0x5AU};
  const up_value_t whole = {.code = UP_CODE_BCD, .word_bytes = 1U};
  const up_value_t low = {.code = UP_CODE_BCD, .word_bytes = 1U, .bits = 5U};
  const up_value_t wide = {.code = UP_CODE_BCD, .word_bytes = 2U};
  uint8_t number = 59U, back[2];
  uint16_t year = 2026U;

  CHECK(decodes(&whole, &byte_field, seconds, &number));
  CHECK(up_value_encode(&whole, &byte_field, &number, back, 1U) == 1U && back[0] == 0x59U);
  number = 12U;
  CHECK(decodes(&low, &byte_field, month, &number));
  CHECK(up_value_decode(&whole, &byte_field, junk, 1U, &number) == UP_INVALID && number == 12U);
  number = 200U;
  CHECK(up_value_encode(&whole, &byte_field, &number, back, 1U) == 1U && back[0] == 0x99U);
  CHECK(up_value_encode(&low, &byte_field, &number, back, 1U) == 1U && back[0] == 0x19U);
  CHECK(up_value_encode(&wide, &half_field, &year, back, 2U) == 2U && back[0] == 0x20U && back[1] == 0x26U);
}

static void test_floats(void) {
  /* The example of the SCD30's interface description: 439.095 ppm. */
  static const uint8_t scd30[] = {0x43U, 0xDBU, 0xCBU, 0x8CU, 0x2EU, 0x8FU};
  static const uint8_t image[] = {0x43U, 0xDBU, 0x8CU, 0x2EU}, infinite[] = {0x7FU, 0x80U, 0U, 0U};
  const up_value_t with_crc = {.code = UP_CODE_FLOAT, .word_bytes = 4U, .crc = UP_CRC_SENSIRION};
  const up_value_t how = {.code = UP_CODE_FLOAT, .word_bytes = 4U};
  const up_field_t field = {"f", 7U, UP_TYPE_FLOAT32, UP_TO_HOST, false, 1U, 0U};
  const up_field_t wide = {"d", 8U, UP_TYPE_FLOAT64, UP_TO_HOST, false, 1U, 0U};
  float number = 0.0F;
  uint8_t back[4];

  CHECK(up_value_decode(&with_crc, &field, scd30, 6U, &number) == UP_FRESH && number > 439.09F && number < 439.10F);
  CHECK(up_value_decode(&how, &field, image, 4U, &number) == UP_FRESH && number > 439.09F && number < 439.10F);
  CHECK(up_value_encode(&how, &field, &number, back, 4U) == 4U && memcmp(back, image, 4U) == 0);
  CHECK(up_value_decode(&how, &field, image, 3U, &number) == UP_INVALID);
  CHECK(up_value_decode(&how, &field, infinite, 4U, &number) == UP_INVALID);
  CHECK(up_value_decode(&how, &wide, image, 4U, back) == UP_INVALID);
  CHECK(up_value_encode(&how, &wide, image, back, 4U) == 0U);
}

static void test_encoding(void) {
  const up_value_t pca9685 = {.word_bytes = 2U, .bits = 12U, .little_endian = true};
  const up_value_t mcp4725 = {.word_bytes = 2U, .low = 4U, .bits = 12U};
  const up_value_t five = {.word_bytes = 1U, .low = 2U, .bits = 5U, .is_signed = true};
  const up_field_t real = {"r", 7U, UP_TYPE_FLOAT32, UP_TO_BOARD, false, 1U, 0U};
  uint16_t level = 0x0ABCU;
  int16_t turn = -3;
  float number = 2.5F;
  uint8_t bytes[2];

  CHECK(up_value_encode(&pca9685, &half_field, &level, bytes, 2U) == 2U && bytes[0] == 0xBCU && bytes[1] == 0x0AU);
  CHECK(up_value_encode(&mcp4725, &half_field, &level, bytes, 2U) == 2U && bytes[0] == 0xABU && bytes[1] == 0xC0U);
  level = 5000U;
  CHECK(up_value_encode(&mcp4725, &half_field, &level, bytes, 2U) == 2U && bytes[0] == 0xFFU && bytes[1] == 0xF0U);
  CHECK(up_value_encode(&five, &signed_field, &turn, bytes, 1U) == 1U && bytes[0] == (0x1DU << 2));
  turn = -300;
  CHECK(up_value_encode(&five, &signed_field, &turn, bytes, 1U) == 1U && bytes[0] == (0x10U << 2));
  turn = 300;
  CHECK(up_value_encode(&five, &signed_field, &turn, bytes, 1U) == 1U && bytes[0] == (0x0FU << 2));
  CHECK(up_value_encode(&five, &real, &number, bytes, 1U) == 1U && bytes[0] == (3U << 2));
  turn = -1;
  CHECK(up_value_encode(&pca9685, &signed_field, &turn, bytes, 2U) == 2U && bytes[0] == 0U && bytes[1] == 0U);
}

/* Tables that make no sense decode nothing, and never read outside their own bytes. */
static void test_senseless_tables(void) {
  static const uint8_t beyond[] = {3U};
  static const uint8_t bytes[8] = {0U};
  const up_value_t tables[] = {{.word_bytes = 9U},
                               {.word_bytes = 0U},
                               {.word_bytes = 2U, .low = 16U},
                               {.code = UP_CODE_PACKED, .bits = 33U},
                               {.code = UP_CODE_PACKED, .bits = 0U},
                               {.word_bytes = 1U, .words = 3U, .elements = beyond}};
  uint8_t value = 0U;
  size_t i;

  for (i = 0U; i < sizeof tables / sizeof tables[0]; i++) {
    CHECK(up_value_decode(&tables[i], &byte_field, bytes, sizeof bytes, &value) == UP_INVALID);
    CHECK(up_value_encode(&tables[i], &byte_field, bytes, &value, 0U) == 0U);
  }
}

/* The conversion of integers and their ratios gives the same as the machine's floating point. */
static void check_real(uint64_t numerator, uint64_t denominator) {
  const double wide = (double)numerator / (double)denominator;
  const float narrow = (float)numerator;
  double stored = 0.0;
  float single = 0.0F;
  bool is_negative;

  up_store_ratio(UP_TYPE_FLOAT32, numerator, 1U, &single);
  CHECK(memcmp(&single, &narrow, sizeof single) == 0);
  if (numerator < (uint64_t)1U << 53 && denominator < (uint64_t)1U << 53) {
    up_store_ratio(UP_TYPE_FLOAT64, numerator, denominator, &stored);
    CHECK(memcmp(&stored, &wide, sizeof stored) == 0);
  }
  up_store_unsigned(UP_TYPE_FLOAT64, numerator >> 11, &stored);
  CHECK(up_load_magnitude(UP_TYPE_FLOAT64, &stored, &is_negative) == numerator >> 11 && !is_negative);
}

static void test_reals(void) {
  static const float halves[] = {0.5F, 1.5F, -2.5F, 0.49999997F, 1e30F, 8388607.5F};
  static const uint64_t rounded[] = {1U, 2U, 3U, 0U, UINT64_MAX, 8388608U};
  uint64_t numerator = 1U;
  uint32_t i;
  bool is_negative;
  float number = 0.0F;

  for (i = 0U; i < 2000U; i++) {
    numerator = numerator * 6364136223846793005U + 1442695040888963407U;
    check_real(numerator >> (i % 64U), (numerator >> 11) % 100003U + 1U);
  }
  check_real(UINT64_MAX, 1U);
  check_real(0U, 7U);
  for (i = 0U; i < sizeof halves / sizeof halves[0]; i++) {
    CHECK(up_load_magnitude(UP_TYPE_FLOAT32, &halves[i], &is_negative) == rounded[i]);
    CHECK(is_negative == (halves[i] < 0.0F));
  }
  up_store_signed(UP_TYPE_FLOAT32, -7, &number);
  CHECK(number < -6.9F && number > -7.1F);
  up_element_store(UP_TYPE_FLOAT32, 0x7FC00000U, &number);
  CHECK(up_load_magnitude(UP_TYPE_FLOAT32, &number, &is_negative) == 0U);
}

void test_values(void) {
  test_checksums();
  test_bits();
  test_elements();
  test_sensirion();
  test_bcd();
  test_floats();
  test_encoding();
  test_senseless_tables();
  test_reals();
}
