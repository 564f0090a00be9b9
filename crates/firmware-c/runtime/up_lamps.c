#include "up_lamps.h"

#include <string.h>

#include "up_convert.h"

#if UP_USES_LAMPS

/* The rest behind the pulses of a frame: what so many bytes of colours would take. */
#define REST_BYTES 40U
#define LED_START_BYTES 4U
#define LED_BYTES 4U
#define LED_MARK 0xE0U
#define BRIGHTNESS_MAX 31U

static bool is_leds(UP_ROM up_value_t *how) {
  return how->code == (uint8_t)UP_CODE_LEDS;
}

size_t up_lamps_bytes(UP_ROM up_value_t *how, uint16_t count) {
  if (is_leds(how)) {
    /* Each LED delays the clock by half a period. */
    return 2U * LED_START_BYTES + (size_t)count * LED_BYTES + ((size_t)count + 15U) / 16U;
  }
  return 1U + ((size_t)count * how->words + REST_BYTES) * how->bits;
}

static uint32_t colour_of(UP_ROM up_field_t *field, const void *element) {
  bool is_negative;
  const up_unsigned_t magnitude = up_load_magnitude(field->type, element, &is_negative);

  return is_negative ? 0U : (uint32_t)magnitude;
}

static unsigned byte_of(uint32_t colour, unsigned place) {
  return (unsigned)(colour >> (8U * place)) & 0xFFU;
}

/* Sets the bits of the pulses of a byte; the others are 0 already. `at` is the first bit; the next one is returned. */
static size_t put_pulses(UP_ROM up_value_t *how, unsigned byte, uint8_t *bytes, size_t at) {
  unsigned bit, i;

  for (bit = 8U; bit > 0U; bit--) {
    const unsigned high = (((byte >> (bit - 1U)) & 1U) != 0U) ? how->word_bytes : how->low;
    for (i = 0U; i < high; i++) {
      bytes[(at + i) / 8U] = (uint8_t)(bytes[(at + i) / 8U] | (0x80U >> ((at + i) % 8U)));
    }
    at += how->bits;
  }
  return at;
}

static void put_led(UP_ROM up_value_t *how, uint32_t colour, uint8_t *bytes) {
  const unsigned brightness = byte_of(colour, 3U) & BRIGHTNESS_MAX;
  size_t i;

  bytes[0] = (uint8_t)(LED_MARK | ((brightness == 0U) ? BRIGHTNESS_MAX : brightness));
  for (i = 0U; i + 1U < LED_BYTES && i < how->words; i++) {
    bytes[1U + i] = (uint8_t)byte_of(colour, how->elements[i]);
  }
}

void up_lamps_encode(UP_ROM up_value_t *how, UP_ROM up_field_t *field, const void *value, uint8_t *bytes) {
  const size_t element_bytes = up_type_bytes(field->type);
  const uint8_t *memory = value;
  size_t at = 8U;
  size_t i, place;

  memset(bytes, 0, up_lamps_bytes(how, field->count));
  for (i = 0U; i < field->count; i++) {
    const uint32_t colour = colour_of(field, &memory[i * element_bytes]);
    if (is_leds(how)) {
      put_led(how, colour, &bytes[LED_START_BYTES + i * LED_BYTES]);
      continue;
    }
    for (place = 0U; place < how->words; place++) {
      at = put_pulses(how, byte_of(colour, how->elements[place]), bytes, at);
    }
  }
}

#endif
