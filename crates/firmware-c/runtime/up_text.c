#include "up_text.h"

#include <string.h>

#define EXACT_MAX 9007199254740992.0 /* 2^53 */
#define DECIMALS 1000000U

static UP_ROM char true_word[] = "true";
static UP_ROM char false_word[] = "false";
#if UP_USES_REALS
static UP_ROM char nan_word[] = "nan";
static UP_ROM char large_word[] = "large";
#endif

static size_t put(char *text, UP_ROM char *word) {
  const size_t size = up_rom_length(word);

  up_rom_copy(text, word, size + 1U);
  return size;
}

static size_t put_unsigned(char *text, uint64_t number) {
  char digits[20];
  size_t count = 0U;
  size_t i;

  do {
    digits[count] = (char)('0' + (char)(number % 10U));
    number /= 10U;
    count++;
  } while (number > 0U);
  for (i = 0U; i < count; i++) {
    text[i] = digits[count - 1U - i];
  }
  text[count] = '\0';
  return count;
}

static size_t put_signed(char *text, int64_t number) {
  if (number >= 0) {
    return put_unsigned(text, (uint64_t)number);
  }
  text[0] = '-';
  return 1U + put_unsigned(&text[1], 0U - (uint64_t)number);
}

#if UP_USES_REALS
static size_t put_real(char *text, double number) {
  size_t at = 0U;
  uint64_t whole, rest, place;

  if (number != number) {
    return put(text, nan_word);
  }
  if (number < 0.0) {
    text[at] = '-';
    at++;
    number = -number;
  }
  if (number > EXACT_MAX) {
    return at + put(&text[at], large_word);
  }
  whole = (uint64_t)number;
  rest = (uint64_t)((number - (double)whole) * (double)DECIMALS + 0.5);
  if (rest >= DECIMALS) {
    whole++;
    rest -= DECIMALS;
  }
  at += put_unsigned(&text[at], whole);
  text[at] = '.';
  at++;
  for (place = DECIMALS / 10U; place > 0U; place /= 10U) {
    text[at] = (char)('0' + (char)((rest / place) % 10U));
    at++;
  }
  text[at] = '\0';
  return at;
}
#endif

static int64_t load_signed(uint8_t type, const void *element) {
  const uint64_t sign = (uint64_t)1U << (8U * up_type_bytes(type) - 1U);
  const uint64_t bits = up_element_load(type, element);
  const uint64_t extended = (bits ^ sign) - sign;
  int64_t number;

  memcpy(&number, &extended, sizeof number);
  return number;
}

#if UP_USES_REALS
static size_t put_single(char *text, const void *element) {
  float number;

  memcpy(&number, element, sizeof number);
  return put_real(text, (double)number);
}

static size_t put_double(char *text, const void *element) {
#if UP_USES_DOUBLES
  double number;

  memcpy(&number, element, sizeof number);
  return put_real(text, number);
#else
  (void)element;
  return put(text, large_word);
#endif
}
#endif

size_t up_text_element(uint8_t type, const void *element, char text[UP_TEXT_BYTES]) {
  switch ((up_type_t)type) {
  case UP_TYPE_BOOL:
    return put(text, (up_element_load(type, element) != 0U) ? true_word : false_word);
  case UP_TYPE_INT8:
  case UP_TYPE_INT16:
  case UP_TYPE_INT32:
  case UP_TYPE_INT64:
    return put_signed(text, load_signed(type, element));
#if UP_USES_REALS
  case UP_TYPE_FLOAT32:
    return put_single(text, element);
  case UP_TYPE_FLOAT64:
    return put_double(text, element);
#else
  case UP_TYPE_FLOAT32:
  case UP_TYPE_FLOAT64:
#endif
  case UP_TYPE_UINT8:
  case UP_TYPE_UINT16:
  case UP_TYPE_UINT32:
  case UP_TYPE_UINT64:
  default:
    return put_unsigned(text, up_element_load(type, element));
  }
}
