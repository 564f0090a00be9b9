#include "up_elements.h"

#define HAS_VALUE 1U
#define IS_NEW 2U

void up_elements_note(uint8_t *flags, size_t index) {
  flags[index] = HAS_VALUE | IS_NEW;
}

bool up_elements_are_due(uint8_t *flags, size_t count, bool is_complete) {
  size_t with_value = 0U;
  size_t fresh = 0U;
  size_t i;

  for (i = 0U; i < count; i++) {
    with_value += ((flags[i] & HAS_VALUE) != 0U) ? 1U : 0U;
    fresh += ((flags[i] & IS_NEW) != 0U) ? 1U : 0U;
  }
  if (with_value < count || fresh == 0U || (is_complete && fresh < count)) {
    return false;
  }
  for (i = 0U; i < count; i++) {
    flags[i] = HAS_VALUE;
  }
  return true;
}
