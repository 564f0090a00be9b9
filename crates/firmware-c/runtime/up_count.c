#include "up_count.h"

#include "up_convert.h"

void up_count_step(up_count_t *count, uint16_t now) {
  const uint16_t moved = (uint16_t)(now - count->last);

  /* Extends the sign of the 16 bits into the upper ones. */
  count->total += ((moved & 0x8000U) != 0U) ? (0xFFFF0000U | moved) : moved;
  count->last = now;
}

int32_t up_count_total(const up_count_t *count) {
  return (int32_t)count->total;
}

void up_count_store(uint8_t type, up_signed_t count, void *element) {
  switch ((up_type_t)type) {
  case UP_TYPE_BOOL:
  case UP_TYPE_FLOAT32:
  case UP_TYPE_FLOAT64:
    up_store_signed(type, count, element);
    break;
  case UP_TYPE_UINT8:
  case UP_TYPE_INT8:
  case UP_TYPE_UINT16:
  case UP_TYPE_INT16:
  case UP_TYPE_UINT32:
  case UP_TYPE_INT32:
  case UP_TYPE_UINT64:
  case UP_TYPE_INT64:
  default:
    up_element_store(type, (up_unsigned_t)count, element);
    break;
  }
}

bool up_repeat_is_due(up_repeat_t *repeat, bool has_changed, uint32_t repeat_ms, uint32_t now_ms) {
  if (repeat->has_reported && !has_changed && (uint32_t)(now_ms - repeat->reported_ms) < repeat_ms) {
    return false;
  }
  repeat->has_reported = true;
  repeat->reported_ms = now_ms;
  return true;
}

bool up_turn_is_next(up_turn_t *turn, uint32_t cycle_ms, uint32_t now_ms) {
  const uint32_t since_ms = now_ms + cycle_ms / 4U - turn->last_ms;

  if (turn->has_taken && since_ms < cycle_ms) {
    return false;
  }
  turn->last_ms = (turn->has_taken && since_ms - cycle_ms < cycle_ms) ? turn->last_ms + cycle_ms : now_ms;
  turn->has_taken = true;
  return true;
}
