/* CAN buses, for both kinds of controllers: bxCAN and FDCAN in its classic mode. */
#include "up_can.h"

#if HAL_USE_CAN == TRUE

#include <string.h>

/* Steps of a bit: one to synchronise, those before the sample point, those after it. */
#define STEPS_MIN 8U
#define STEPS_MAX 21U
#define BEFORE_MAX 16U
#define BEHIND_MAX 8U
#if defined(CAN_MCR_ABOM)
#define PRESCALER_MAX 1024U
#else
#define PRESCALER_MAX 512U
#endif

typedef struct {
  uint32_t prescaler;
  uint32_t before;
  uint32_t behind;
} bit_time_t;

/* ---- the bit time ---- */

/* Finds the nearest bit rate, within 0.5 % as the generator allows; the sample point is at 87.5 % of the bit or as
 * little before as the steps allow, but not before 77 %. */
static bool divide(uint32_t clock_hz, uint32_t bitrate_hz, bit_time_t *time) {
  uint32_t best_error = bitrate_hz / 200U + 1U;
  uint32_t best_sample = 0U;
  uint32_t steps;

  for (steps = STEPS_MIN; steps <= STEPS_MAX; steps++) {
    const uint32_t wanted = steps * 7U / 8U - 1U;
    const uint32_t before = (wanted < BEFORE_MAX) ? wanted : BEFORE_MAX;
    const uint32_t behind = steps - 1U - before;
    const uint32_t sample = (before + 1U) * 1000U / steps;
    const uint32_t prescaler = (clock_hz + bitrate_hz * steps / 2U) / (bitrate_hz * steps);
    const uint32_t made_hz = (prescaler > 0U) ? clock_hz / (prescaler * steps) : 0U;
    const uint32_t error = (made_hz > bitrate_hz) ? made_hz - bitrate_hz : bitrate_hz - made_hz;
    const bool is_better = error < best_error || (error == best_error && sample > best_sample);

    if (is_better && prescaler <= PRESCALER_MAX && behind <= BEHIND_MAX && sample >= 770U) {
      best_error = error;
      best_sample = sample;
      time->prescaler = prescaler;
      time->before = before;
      time->behind = behind;
    }
  }
  return best_sample > 0U;
}

static uint32_t jump(const bit_time_t *time) {
  return (time->behind < 4U) ? time->behind : 4U;
}

/* ---- what differs between the controllers ---- */

#if defined(CAN_MCR_ABOM)

static void configure(CANConfig *config, const bit_time_t *time) {
  /* The controller recovers from bus-off and wakes from sleep by itself. */
  config->mcr = CAN_MCR_ABOM | CAN_MCR_AWUM | CAN_MCR_TXFP;
  config->btr =
      CAN_BTR_SJW(jump(time) - 1U) | CAN_BTR_TS2(time->behind - 1U) | CAN_BTR_TS1(time->before - 1U) |
      CAN_BTR_BRP(time->prescaler - 1U);
}

/* The kind of the last error since the previous call; 7 for none. */
static uint32_t last_error(const up_can_t *bus) {
  const uint32_t kind = (bus->driver->can->ESR & CAN_ESR_LEC_Msk) >> CAN_ESR_LEC_Pos;

  bus->driver->can->ESR = CAN_ESR_LEC_Msk;
  return (kind == 0U) ? 7U : kind;
}

static bool is_off(const up_can_t *bus) {
  return (bus->driver->can->ESR & CAN_ESR_BOFF) != 0U;
}

static bool lost_arbitration(const up_can_t *bus) {
  return (bus->driver->can->TSR & (CAN_TSR_ALST0 | CAN_TSR_ALST1 | CAN_TSR_ALST2)) != 0U;
}

static void recover(const up_can_t *bus) {
  (void)bus;
}

static uint32_t identifier_of(const CANRxFrame *frame, bool *is_extended) {
  *is_extended = frame->IDE == CAN_IDE_EXT;
  return *is_extended ? frame->EID : frame->SID;
}

static void address(CANTxFrame *frame, uint32_t identifier, bool is_extended) {
  if (is_extended) {
    frame->IDE = CAN_IDE_EXT;
    frame->EID = identifier & 0x1FFFFFFFU;
  } else {
    frame->IDE = CAN_IDE_STD;
    frame->SID = identifier & 0x7FFU;
  }
}

#else

static void configure(CANConfig *config, const bit_time_t *time) {
  config->op_mode = OPMODE_CAN;
  config->NBTP = ((jump(time) - 1U) << 25) | ((time->prescaler - 1U) << 16) | ((time->before - 1U) << 8) |
                 (time->behind - 1U);
}

static uint32_t last_error(const up_can_t *bus) {
  const uint32_t kind = bus->driver->fdcan->PSR & 7U; /* reading it sets it to 7 */

  return (kind == 0U) ? 7U : kind;
}

static bool is_off(const up_can_t *bus) {
  return (bus->driver->fdcan->PSR & FDCAN_PSR_BO) != 0U;
}

static bool lost_arbitration(const up_can_t *bus) {
  (void)bus; /* the controller does not report it */
  return false;
}

/* After bus-off the controller stays off until software lets it rejoin the bus. */
static void recover(const up_can_t *bus) {
  bus->driver->fdcan->CCCR &= ~FDCAN_CCCR_INIT;
}

static uint32_t identifier_of(const CANRxFrame *frame, bool *is_extended) {
  *is_extended = frame->common.XTD != 0U;
  return *is_extended ? frame->ext.EID : frame->std.SID;
}

static void address(CANTxFrame *frame, uint32_t identifier, bool is_extended) {
  if (is_extended) {
    frame->common.XTD = 1U;
    frame->ext.EID = identifier & 0x1FFFFFFFU;
  } else {
    frame->std.SID = identifier & 0x7FFU;
  }
}

#endif

/* ---- start ---- */

void up_can_start(const up_can_t *bus) {
  /* The driver keeps a pointer, so each bus has its own. */
  static CANConfig configs[UP_CAN_BUSES];
  static size_t count;
  bit_time_t time = {1U, 1U, 1U};

  if (count >= UP_CAN_BUSES || !divide(bus->clock_hz, bus->bitrate_hz, &time)) {
    chSysHalt("CAN bit time");
  }
  configure(&configs[count], &time);
  (void)canStart(bus->driver, &configs[count]);
  count++;
}

/* ---- receiving ---- */

/* The bytes of a frame as a number, the first one lowest. */
static uint64_t bits_of(const uint8_t *data, size_t count) {
  uint64_t bits = 0U;

  while (count > 0U) {
    count--;
    bits = (bits << 8) | data[count];
  }
  return bits;
}

static void take(const up_can_t *bus, const CANRxFrame *frame) {
  static const up_result_t late = UP_NOTHING;
  uint64_t *value = bus->value;
  const uint32_t now_ms = up_now_ms();
  bool is_extended;
  const uint32_t identifier = identifier_of(frame, &is_extended);
  const size_t count = (frame->DLC < UP_CAN_FRAME_BYTES) ? frame->DLC : UP_CAN_FRAME_BYTES;
  uint8_t i;

  for (i = 0U; i < bus->values_count; i++) {
    const up_can_value_t *how = &bus->values[i];
    up_result_t result = late;

    if (how->identifier != identifier || how->is_extended != is_extended ||
        (how->select_mask != 0U && (bits_of(frame->data8, count) & how->select_mask) != how->select)) {
      continue;
    }
    if (how->byte < count) {
      result = up_value_decode(&how->value, &up_config.schema->fields[how->field], &frame->data8[how->byte],
                               count - how->byte, value);
    } else {
      result = UP_INVALID;
    }
    if (result != UP_FRESH || up_turn_is_next(&bus->turns[i], how->cycle_ms, now_ms)) {
      up_result(how->field, result, value);
    }
  }
}

/* ---- faults ---- */

static void say(const up_can_t *bus, up_result_t result) {
  uint8_t i;

  for (i = 0U; i < bus->values_count; i++) {
    up_result(bus->values[i].field, result, NULL);
  }
  for (i = 0U; i < bus->sent_count; i++) {
    up_result(bus->sent[i].field, result, NULL);
  }
}

static void look_for_faults(const up_can_t *bus) {
  /* Indexed by the controllers' number for the last error. */
  static const up_result_t kinds[] = {UP_NOTHING,   UP_BUS_ERROR, UP_BUS_ERROR, UP_NOT_ACKNOWLEDGED,
                                      UP_BUS_ERROR, UP_BUS_ERROR, UP_WRONG_CRC, UP_NOTHING};
  const bool was_off = bus->state->is_off;
  const up_result_t result = kinds[last_error(bus) & 7U];

  bus->state->is_off = is_off(bus);
  if (bus->state->is_off) {
    bus->state->bus_offs += was_off ? 0U : 1U;
    recover(bus);
  }
  if (result != UP_NOTHING) {
    say(bus, result);
  } else if (lost_arbitration(bus)) {
    say(bus, UP_ARBITRATION_LOST);
  }
}

void up_can_cycle(const void *work) {
  const up_can_t *bus = work;
  const uint32_t begin_ms = up_now_ms();
  uint32_t passed_ms = 0U;

  look_for_faults(bus);
  /* For the whole cycle: the controller holds three frames, and a burst of more may come at any time. */
  while (passed_ms < bus->cycle_ms) {
    CANRxFrame frame;

    if (canReceiveTimeout(bus->driver, CAN_ANY_MAILBOX, &frame, UP_MS2I(bus->cycle_ms - passed_ms)) ==
        MSG_OK) {
      take(bus, &frame);
    }
    passed_ms = up_now_ms() - begin_ms;
  }
}

/* ---- sending ---- */

void up_can_set(const up_can_frame_t *frame, const up_can_value_t *how, const void *value) {
  uint8_t coded[UP_CAN_FRAME_BYTES] = {0U};
  const size_t count = up_value_encode(&how->value, &up_config.schema->fields[how->field], value, &coded[how->byte],
                                       (size_t)frame->bytes - how->byte);
  size_t i;

  if (count == 0U) {
    up_result(how->field, UP_BUS_ERROR, NULL);
    return;
  }
  for (i = how->byte; i < how->byte + count; i++) {
    const uint8_t mask = (how->mask == 0U) ? 0xFFU : (uint8_t)(how->mask >> (8U * i));
    frame->data[i] = (uint8_t)((frame->data[i] & (uint8_t)~mask) | coded[i]);
  }
  if (how->is_quiet) {
    return;
  }
  *frame->is_due = true;
  if (frame->resend_ms > 0U) {
    frame->kept->is_commanded = true;
  }
}

void up_can_hush(const up_can_t *bus) {
  uint8_t i;

  for (i = 0U; i < bus->frames_count; i++) {
    if (bus->frames[i].resend_ms > 0U) {
      bus->frames[i].kept->is_commanded = false;
      *bus->frames[i].is_due = false;
    }
  }
}

/* Whether a frame must be sent now. */
static bool is_wanted(const up_can_frame_t *how, uint32_t now_ms) {
  const bool is_repeated = how->resend_ms > 0U && how->kept->is_commanded;

  return *how->is_due || (is_repeated && now_ms - how->kept->sent_ms >= how->resend_ms);
}

/* The next frame is due a period after this one was, however late this one is. */
static void sent(const up_can_frame_t *how, uint32_t now_ms) {
  if (how->resend_ms > 0U) {
    const uint32_t late_ms = now_ms - how->kept->sent_ms - how->resend_ms;
    const bool is_in_turn = !*how->is_due && late_ms < how->resend_ms;

    how->kept->sent_ms = is_in_turn ? now_ms - late_ms : now_ms;
  }
  *how->is_due = false;
}

void up_can_send(const up_can_t *bus) {
  const uint32_t now_ms = up_now_ms();
  uint8_t i;

  for (i = 0U; i < bus->frames_count; i++) {
    const up_can_frame_t *how = &bus->frames[i];
    CANTxFrame frame;

    if (!is_wanted(how, now_ms)) {
      continue;
    }
    memset(&frame, 0, sizeof frame);
    address(&frame, how->identifier, how->is_extended);
    frame.DLC = how->bytes & 15U;
    memcpy(frame.data8, how->data, how->bytes);
    if (canTransmitTimeout(bus->driver, CAN_ANY_MAILBOX, &frame, TIME_IMMEDIATE) != MSG_OK) {
      return;
    }
    sent(how, now_ms);
  }
}

#endif
