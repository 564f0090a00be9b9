#include "up_parse.h"

#include "up_convert.h"

#define POWER_MAX 19U
#define MINUTES_DIGITS 9U
/* 1e-9 minutes in 1e-7 degrees. */
#define NANOMINUTES 6000U
#define NANO 1000000000U

bool up_parse_field(up_piece_t text, char separator, size_t index, up_piece_t *field) {
  size_t start = 0U, at;

  for (at = 0U; at <= text.size; at++) {
    if (at == text.size || (separator != '\0' && text.start[at] == separator)) {
      if (index == 0U) {
        field->start = &text.start[start];
        field->size = at - start;
        return true;
      }
      index--;
      start = at + 1U;
    }
  }
  return false;
}

static bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

static up_piece_t trimmed(up_piece_t text) {
  while (text.size > 0U && text.start[0] == ' ') {
    text.start++;
    text.size--;
  }
  while (text.size > 0U && text.start[text.size - 1U] == ' ') {
    text.size--;
  }
  return text;
}

#if UP_USES_WIDE
static uint64_t power_of_ten(unsigned exponent) {
  uint64_t power = 1U;

  while (exponent > 0U) {
    power *= 10U;
    exponent--;
  }
  return power;
}

static uint64_t times(uint64_t left, uint64_t right) {
  return (right != 0U && left > UINT64_MAX / right) ? UINT64_MAX : left * right;
}

static bool take_sign(up_piece_t *text) {
  const bool is_negative = text->size > 0U && text->start[0] == '-';

  if (text->size > 0U && (is_negative || text->start[0] == '+')) {
    text->start++;
    text->size--;
  }
  return is_negative;
}

/* Digits, a point, digits: the number is digits / 10^places. */
typedef struct {
  uint64_t digits;
  unsigned places;    /* 0 to places_max; further digits are cut off */
  size_t whole_count; /* digits before the point */
  bool is_too_large;
} decimal_t;

static bool take_digit(decimal_t *decimal, char c, bool is_behind, unsigned places_max) {
  const uint64_t digit = is_digit(c) ? (uint64_t)(c - '0') : 0U;
  const bool has_room = decimal->digits <= (UINT64_MAX - digit) / 10U;

  if (!is_digit(c)) {
    return false;
  }
  if (!is_behind) {
    decimal->whole_count++;
    decimal->is_too_large = decimal->is_too_large || !has_room;
  } else if (!has_room || decimal->places >= places_max) {
    return true;
  } else {
    decimal->places++;
  }
  if (has_room) {
    decimal->digits = 10U * decimal->digits + digit;
  }
  return true;
}

static bool read_decimal(up_piece_t text, unsigned places_max, decimal_t *decimal) {
  bool is_behind = false, has_digit = false;
  size_t i;

  decimal->digits = 0U;
  decimal->places = 0U;
  decimal->whole_count = 0U;
  decimal->is_too_large = false;
  for (i = 0U; i < text.size; i++) {
    if (text.start[i] == '.' && !is_behind) {
      is_behind = true;
    } else if (take_digit(decimal, text.start[i], is_behind, places_max)) {
      has_digit = true;
    } else {
      return false;
    }
  }
  return has_digit;
}

up_result_t up_parse_decimal(up_piece_t text, uint8_t decimals, uint8_t type, void *element) {
  decimal_t decimal;
  bool is_negative;

  text = trimmed(text);
  if (text.size == 0U) {
    return UP_NOTHING;
  }
  is_negative = take_sign(&text);
  if (decimals >= POWER_MAX || !read_decimal(text, POWER_MAX, &decimal)) {
    return UP_INVALID;
  }
  if (decimal.is_too_large) {
    up_store_signed_ratio(type, is_negative, UINT64_MAX, 1U, element);
  } else if (decimal.places > decimals) {
    up_store_signed_ratio(type, is_negative, decimal.digits, power_of_ten(decimal.places - decimals), element);
  } else {
    const uint64_t number = times(decimal.digits, power_of_ten(decimals - decimal.places));
    up_store_signed_ratio(type, is_negative, number, 1U, element);
  }
  return UP_FRESH;
}

/* The greatest angle of a hemisphere, and whether it is negative; 0 for an invalid letter. */
static unsigned hemisphere_degrees(up_piece_t hemisphere, bool *is_negative) {
  const char letter = (hemisphere.size == 1U) ? hemisphere.start[0] : '\0';

  *is_negative = letter == 'S' || letter == 'W';
  if (letter == 'N' || letter == 'S') {
    return 90U;
  }
  return (letter == 'E' || letter == 'W') ? 180U : 0U;
}

up_result_t up_parse_degrees(up_piece_t text, up_piece_t hemisphere, uint8_t type, void *element) {
  decimal_t decimal;
  uint64_t unit, whole, angle;
  unsigned degrees_max;
  bool is_negative;

  text = trimmed(text);
  if (text.size == 0U) {
    return UP_NOTHING;
  }
  degrees_max = hemisphere_degrees(trimmed(hemisphere), &is_negative);
  if (degrees_max == 0U || !read_decimal(text, MINUTES_DIGITS, &decimal) || decimal.whole_count < 3U ||
      decimal.whole_count > 5U) {
    return UP_INVALID;
  }
  unit = power_of_ten(decimal.places);
  whole = decimal.digits / unit;
  if (whole % 100U >= 60U) {
    return UP_INVALID;
  }
  angle = (whole / 100U * 60U + whole % 100U) * NANO + decimal.digits % unit * (NANO / unit);
  if (angle > (uint64_t)degrees_max * 60U * NANO) {
    return UP_INVALID;
  }
  up_store_signed_ratio(type, is_negative, angle, NANOMINUTES, element);
  return UP_FRESH;
}

#endif

static unsigned hex_digit(char c) {
  if (is_digit(c)) {
    return (unsigned)(c - '0');
  }
  if (c >= 'a' && c <= 'f') {
    return (unsigned)(c - 'a') + 10U;
  }
  return (c >= 'A' && c <= 'F') ? (unsigned)(c - 'A') + 10U : 16U;
}

up_result_t up_parse_hex(up_piece_t text, uint8_t type, void *element) {
  up_unsigned_t number = 0U;
  size_t i;

  text = trimmed(text);
  if (text.size == 0U) {
    return UP_NOTHING;
  }
  for (i = 0U; i < text.size; i++) {
    const unsigned digit = hex_digit(text.start[i]);
    if (digit > 15U) {
      return UP_INVALID;
    }
    number = (number > UP_UNSIGNED_MAX >> 4) ? UP_UNSIGNED_MAX : number << 4 | digit;
  }
  up_store_unsigned(type, number, element);
  return UP_FRESH;
}
