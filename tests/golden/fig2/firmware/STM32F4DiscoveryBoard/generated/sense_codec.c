/* Written by SenseDSL: from the values of STM32F4DiscoveryBoard to payloads and back. */
#include "sense_model.h"

/* ---- reports, to the host ---- */

static size_t put_report(const uint8_t *due, const void *from, uint8_t *payload) {
  const sense_values_t *values = from;
  uint8_t *at = payload;
  if ((due[0] & 0x01U) != 0U) {
    at = up_put_16(up_put_8(at, 17U), values->SENSE_IRFront);
  }
  if ((due[0] & 0x02U) != 0U) {
    at = up_put_16(up_put_8(at, 18U), values->SENSE_IRFrontRight);
  }
  if ((due[0] & 0x04U) != 0U) {
    at = up_put_8(up_put_8(at, 19U), values->SENSE_USRear);
  }
  if ((due[0] & 0x08U) != 0U) {
    at = up_put_32(up_put_8(at, 20U), values->SENSE_WheelEncoder);
  }
  return (size_t)(at - payload);
}

UP_ROM up_wire_t sense_reports = {
    .hash = 0xb2d2a70bU,
    .values_bytes_max = 13U,
    .health_bytes = 87U,
    .payload_bytes_max = 87U,
    .head_bytes = 3U,
    .direction = UP_TO_HOST,
    .put = put_report,
};

/* ---- commands, to the board ---- */

static up_item_t command_item(uint8_t id) {
  (void)id;
  return UP_ITEM_NONE;
}

UP_ROM up_wire_t sense_commands = {
    .hash = 0xb2d2a70bU,
    .values_bytes_max = 0U,
    .payload_bytes_max = 2U,
    .head_bytes = 2U,
    .direction = UP_TO_BOARD,
    .item = command_item,
};
