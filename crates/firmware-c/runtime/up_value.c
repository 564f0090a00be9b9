#include "up_value.h"

#include <string.h>

#include "up_checksum.h"
#include "up_convert.h"
#include "up_lamps.h"
#include "up_letters.h"

#define SENSIRION_POLYNOMIAL 0x31U
#define SENSIRION_START 0xFFU
/* With the bits that stand beside them in their first byte. */
#define PACKED_BITS_MAX (UP_USES_WIDE ? 32U : 25U)

static size_t words_of(UP_ROM up_value_t *how, uint16_t count) {
  return (how->words != 0U) ? how->words : count;
}

/* All codes except integers can be left out. */
static bool is_code(UP_ROM up_value_t *how, up_code_t code) {
  return UP_USES_CODES && how->code == (uint8_t)code;
}

static bool has_crc(UP_ROM up_value_t *how) {
  return UP_USES_WORD_CRC && how->crc == (uint8_t)UP_CRC_SENSIRION;
}

static bool is_lamps(UP_ROM up_value_t *how) {
  return UP_USES_LAMPS && (how->code == (uint8_t)UP_CODE_PULSES || how->code == (uint8_t)UP_CODE_LEDS);
}

static bool is_letters(UP_ROM up_value_t *how) {
  return UP_USES_LETTERS && how->code == (uint8_t)UP_CODE_TEXT;
}

/* The size of the words alone. */
static size_t data_bytes(UP_ROM up_value_t *how, uint16_t count) {
  const size_t words = words_of(how, count);

  return is_code(how, UP_CODE_PACKED) ? (words * how->bits + 7U) / 8U : words * how->word_bytes;
}

size_t up_value_bytes(UP_ROM up_value_t *how, uint16_t count) {
  const size_t data = data_bytes(how, count);

  if (is_lamps(how)) {
    return up_lamps_bytes(how, count);
  }
  if (is_letters(how)) {
    return (size_t)count * UP_LETTER_COLUMNS;
  }
  return has_crc(how) ? data + data / 2U : data;
}

/* The place of byte `at` of the words on the wire. */
static size_t place(UP_ROM up_value_t *how, size_t at) {
  return has_crc(how) ? at + at / 2U : at;
}

bool up_value_crc_is_right(UP_ROM up_value_t *how, uint16_t count, const uint8_t *bytes) {
  const size_t bytes_count = up_value_bytes(how, count);
  size_t at;

  if (has_crc(how)) {
    for (at = 0U; at + 3U <= bytes_count; at += 3U) {
      if (up_crc8(SENSIRION_POLYNOMIAL, SENSIRION_START, &bytes[at], 2U) != bytes[at + 2U]) {
        return false;
      }
    }
  }
  return true;
}

static up_unsigned_t mask_of(unsigned bits) {
  return (bits >= UP_UNSIGNED_BITS) ? UP_UNSIGNED_MAX : ((up_unsigned_t)1U << bits) - 1U;
}

/* The number of significant bits of a word; 0 if the table makes no sense. */
static unsigned bits_of(UP_ROM up_value_t *how) {
  const unsigned word_bits = 8U * how->word_bytes;
  /* Of a strip these bytes are not those of a number. */
  const size_t bytes_max = is_lamps(how) ? 8U : sizeof(up_unsigned_t);

  if (is_code(how, UP_CODE_PACKED)) {
    return (how->bits <= PACKED_BITS_MAX) ? how->bits : 0U;
  }
  if (how->word_bytes == 0U || how->word_bytes > bytes_max) {
    return 0U;
  }
  if (!UP_USES_WORD_BITS) {
    return word_bits;
  }
  if (how->low >= word_bits) {
    return 0U;
  }
  return (how->bits == 0U || how->bits > word_bits - how->low) ? word_bits - how->low : how->bits;
}

/* The index of an element's word; at least `words` if it has none. */
static size_t word_of_element(UP_ROM up_value_t *how, size_t element) {
  return (how->elements != UP_ROM_NULL) ? how->elements[element] : element;
}

/* ---- decoding ---- */

static up_unsigned_t packed_word(UP_ROM up_value_t *how, const uint8_t *bytes, size_t word, unsigned bits) {
  const size_t first = word * bits;
  const size_t last = first + bits - 1U;
  up_unsigned_t gathered = 0U;
  size_t at;

  for (at = last / 8U + 1U; at > first / 8U; at--) {
    gathered = (gathered << 8) | bytes[place(how, at - 1U)];
  }
  return gathered >> (first % 8U);
}

static up_unsigned_t whole_word(UP_ROM up_value_t *how, const uint8_t *bytes, size_t word) {
  const size_t first = word * how->word_bytes;
  up_unsigned_t gathered = 0U;
  size_t i;

  for (i = 0U; i < how->word_bytes; i++) {
    const size_t at = how->little_endian ? (size_t)how->word_bytes - 1U - i : i;
    gathered = (gathered << 8) | bytes[place(how, first + at)];
  }
  return UP_USES_WORD_BITS ? gathered >> how->low : gathered;
}

static bool store_bcd(uint8_t type, up_unsigned_t digits, void *element) {
  up_unsigned_t number = 0U;
  unsigned shift;

  for (shift = UP_UNSIGNED_BITS; shift > 0U; shift -= 4U) {
    const unsigned digit = (unsigned)(digits >> (shift - 4U)) & 0xFU;
    if (digit > 9U) {
      return false;
    }
    number = 10U * number + digit;
  }
  up_store_unsigned(type, number, element);
  return true;
}

/* Stores IEEE 754 bits as they are; an exponent of all ones is not a number. */
static bool store_float(uint8_t type, up_unsigned_t bits, unsigned word_bytes, void *element) {
  const up_unsigned_t exponent =
      (word_bytes == 4U) ? 0x7F800000U : (up_unsigned_t)0x7FF00000U << (UP_UNSIGNED_BITS - 32U);

  if (word_bytes != up_type_bytes(type) || (bits & exponent) == exponent) {
    return false;
  }
  up_element_store(type, bits, element);
  return true;
}

static void store_integer(UP_ROM up_value_t *how, uint8_t type, up_unsigned_t number, unsigned bits, void *element) {
  const up_unsigned_t sign = (up_unsigned_t)1U << (bits - 1U);
  up_signed_t extended;

  if (how->is_signed) {
    number = (number ^ sign) - sign;
    memcpy(&extended, &number, sizeof extended);
    up_store_signed(type, extended, element);
  } else {
    up_store_unsigned(type, number, element);
  }
}

static void store_magnitude(uint8_t type, up_unsigned_t number, unsigned bits, void *element) {
  const up_unsigned_t sign = (up_unsigned_t)1U << (bits - 1U);
  const up_signed_t magnitude = (up_signed_t)(number & ~sign & UP_SIGNED_MAX);

  up_store_signed(type, ((number & sign) != 0U) ? -magnitude : magnitude, element);
}

static bool decode_element(UP_ROM up_value_t *how, uint8_t type, const uint8_t *bytes, size_t word, void *element) {
  const unsigned bits = bits_of(how);
  up_unsigned_t number;

  if (bits == 0U) {
    return false;
  }
  number = is_code(how, UP_CODE_PACKED) ? packed_word(how, bytes, word, bits) : whole_word(how, bytes, word);
  if (UP_USES_WORD_BITS) {
    number &= mask_of(bits);
  }
  if (is_code(how, UP_CODE_BCD)) {
    return store_bcd(type, number, element);
  }
  if (is_code(how, UP_CODE_FLOAT)) {
    return store_float(type, number, how->word_bytes, element);
  }
  if (is_code(how, UP_CODE_MAGNITUDE)) {
    store_magnitude(type, number, bits, element);
    return true;
  }
  store_integer(how, type, number, bits, element);
  return true;
}

up_result_t up_value_decode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const uint8_t *bytes, size_t bytes_count,
                            void *value) {
  const size_t element_bytes = up_type_bytes(field->type);
  uint8_t *memory = value;
  size_t i;

  if (bytes_count < up_value_bytes(how, field->count)) {
    return UP_INVALID;
  }
  if (!up_value_crc_is_right(how, field->count, bytes)) {
    return UP_WRONG_CRC;
  }
  for (i = 0U; i < field->count; i++) {
    const size_t word = word_of_element(how, i);
    if (word >= words_of(how, field->count) ||
        !decode_element(how, field->type, bytes, word, &memory[i * element_bytes])) {
      return UP_INVALID;
    }
  }
  return UP_FRESH;
}

/* ---- encoding ---- */

/* Binary-coded decimal in the bits of `mask`; saturates. */
static up_unsigned_t to_bcd(up_unsigned_t number, up_unsigned_t mask) {
  up_unsigned_t rest = number, digits = 0U, greatest = 0U;
  unsigned shift;

  for (shift = 0U; shift < UP_UNSIGNED_BITS; shift += 4U) {
    const up_unsigned_t most = (mask >> shift) & 0xFU;
    digits |= (rest % 10U) << shift;
    greatest |= ((most > 9U) ? 9U : most) << shift;
    rest /= 10U;
  }
  return (rest > 0U || digits > mask) ? greatest : digits;
}

static up_unsigned_t encode_element(UP_ROM up_value_t *how, uint8_t type, const void *element, unsigned bits) {
  const up_unsigned_t mask = mask_of(bits);
  const up_unsigned_t greatest = how->is_signed ? mask >> 1 : mask;
  bool is_negative;
  const up_unsigned_t magnitude = up_load_magnitude(type, element, &is_negative);

  if (is_code(how, UP_CODE_FLOAT)) {
    return up_element_load(type, element);
  }
  if (is_code(how, UP_CODE_BCD)) {
    return is_negative ? 0U : to_bcd(magnitude, mask);
  }
  if (is_code(how, UP_CODE_MAGNITUDE)) {
    return ((magnitude > mask >> 1) ? mask >> 1 : magnitude) | (is_negative ? mask ^ (mask >> 1) : 0U);
  }
  if (!is_negative) {
    return (magnitude > greatest) ? greatest : magnitude;
  }
  if (!how->is_signed) {
    return 0U;
  }
  return (0U - ((magnitude > greatest + 1U) ? greatest + 1U : magnitude)) & mask;
}

static void put_packed(uint8_t *bytes, size_t word, unsigned bits, up_unsigned_t number) {
  unsigned i;

  for (i = 0U; i < bits; i++) {
    const size_t at = word * bits + i;
    bytes[at / 8U] = (uint8_t)(bytes[at / 8U] | (((number >> i) & 1U) << (at % 8U)));
  }
}

static void put_word(UP_ROM up_value_t *how, uint8_t *bytes, size_t word, up_unsigned_t number) {
  const size_t first = word * how->word_bytes;
  size_t i;

  for (i = 0U; i < how->word_bytes; i++) {
    const size_t at = how->little_endian ? i : (size_t)how->word_bytes - 1U - i;
    bytes[place(how, first + at)] = (uint8_t)number;
    number >>= 8;
  }
}

/* What is no words. */
static void encode_dots(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes) {
#if UP_USES_LAMPS
  if (is_lamps(how)) {
    up_lamps_encode(how, field, value, bytes);
  }
#endif
#if UP_USES_LETTERS
  if (is_letters(how)) {
    up_letters_encode(field, value, bytes);
  }
#endif
  (void)how;
  (void)field;
  (void)value;
  (void)bytes;
}

size_t up_value_encode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes,
                       size_t bytes_room) {
  const size_t bytes_count = up_value_bytes(how, field->count);
  const size_t element_bytes = up_type_bytes(field->type);
  const unsigned bits = bits_of(how);
  const uint8_t *memory = value;
  size_t i;

  if (bits == 0U || bytes_count > bytes_room || (is_code(how, UP_CODE_FLOAT) && how->word_bytes != element_bytes)) {
    return 0U;
  }
  if (is_lamps(how) || is_letters(how)) {
    encode_dots(how, field, value, bytes);
    return bytes_count;
  }
  memset(bytes, 0, bytes_count);
  for (i = 0U; i < field->count; i++) {
    const size_t word = word_of_element(how, i);
    const up_unsigned_t number = encode_element(how, field->type, &memory[i * element_bytes], bits);
    if (word >= words_of(how, field->count)) {
      return 0U;
    }
    if (is_code(how, UP_CODE_PACKED)) {
      put_packed(bytes, word, bits, number);
    } else {
      put_word(how, bytes, word, number << how->low);
    }
  }
  if (has_crc(how)) {
    for (i = 0U; i + 3U <= bytes_count; i += 3U) {
      bytes[i + 2U] = up_crc8(SENSIRION_POLYNOMIAL, SENSIRION_START, &bytes[i], 2U);
    }
  }
  return bytes_count;
}
