/* Written by SenseDSL: from the values of STM32F4DiscoveryBoard to payloads and back. */
#include "sense_model.h"

/* ---- reports, to the host ---- */

static size_t put_report(const uint8_t *due, const void *from, uint8_t *payload) {
  const sense_values_t *values = from;
  uint8_t *at = payload;
  if ((due[0] & 0x01U) != 0U) {
    at = up_put_16(up_put_8(at, 1U), values->SENSE_IRFrontRight);
  }
  if ((due[0] & 0x02U) != 0U) {
    at = up_put_16(up_put_8(at, 2U), values->SENSE_IRRearRight);
  }
  if ((due[0] & 0x04U) != 0U) {
    at = up_put_16(up_put_8(at, 3U), values->SENSE_IRRear);
  }
  if ((due[0] & 0x08U) != 0U) {
    at = up_put_16(up_put_8(at, 4U), values->SENSE_USFront);
  }
  if ((due[0] & 0x10U) != 0U) {
    at = up_put_16(up_put_8(at, 5U), values->SENSE_USFrontRight);
  }
  if ((due[0] & 0x20U) != 0U) {
    at = up_put_16(up_put_8(at, 6U), values->SENSE_USRear);
  }
  if ((due[0] & 0x40U) != 0U) {
    at = up_put_32(up_put_8(at, 7U), values->SENSE_WheelLeftA);
  }
  if ((due[0] & 0x80U) != 0U) {
    at = up_put_32(up_put_8(at, 8U), values->SENSE_WheelLeftB);
  }
  if ((due[1] & 0x01U) != 0U) {
    at = up_put_32(up_put_8(at, 9U), values->SENSE_WheelRightA);
  }
  if ((due[1] & 0x02U) != 0U) {
    at = up_put_32(up_put_8(at, 10U), values->SENSE_WheelRightB);
  }
  if ((due[1] & 0x04U) != 0U) {
    at = up_put_16(up_put_8(at, 11U), values->SENSE_RCSteering);
  }
  if ((due[1] & 0x08U) != 0U) {
    at = up_put_16(up_put_8(at, 12U), values->SENSE_RCThrottle);
  }
  if ((due[1] & 0x10U) != 0U) {
    at = up_put_16(up_put_8(at, 13U), values->SENSE_RCSwitch);
  }
  return (size_t)(at - payload);
}

UP_ROM up_wire_t sense_reports = {
    .hash = 0x64783683U,
    .values_bytes_max = 47U,
    .health_bytes = 240U,
    .payload_bytes_max = 240U,
    .head_bytes = 4U,
    .direction = UP_TO_HOST,
    .put = put_report,
};

/* ---- commands, to the board ---- */

static up_item_t command_item(uint8_t id) {
  (void)id;
  return UP_ITEM_NONE;
}

UP_ROM up_wire_t sense_commands = {
    .hash = 0x64783683U,
    .values_bytes_max = 0U,
    .payload_bytes_max = 2U,
    .head_bytes = 2U,
    .direction = UP_TO_BOARD,
    .item = command_item,
};
