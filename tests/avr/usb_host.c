/*
 * The host at USB: enumerates the device, opens its serial port, and carries bytes both ways.
 *
 * A device that does not answer is reset and begins anew, as hosts do.
 */
#include "usb.h"

#include "talk.h"

#include <string.h>

#define QUEUE 65536U
#define ROOM 512U
#define NONE UINT8_MAX
#define MS_NS 1000000U
#define DEBOUNCED_NS (100U * MS_NS)
#define RESET_NS (20U * MS_NS)
#define ANSWERS_NS (500U * MS_NS)
/* About what a packet of 64 bytes takes on a bus of 12 Mbit/s, with what is around it. */
#define PACKET_NS 60000U
#define CLOSED 2U

#define GET_DESCRIPTOR 6
#define SET_ADDRESS 5
#define SET_CONFIGURATION 9
#define SET_LINE_CODING 0x20
#define SET_LINE_STATE 0x22
#define DEVICE_DESCRIPTOR 1
#define CONFIGURATION_DESCRIPTOR 2
#define ENDPOINT_DESCRIPTOR 5
#define BULK 2
#define OWN_ADDRESS 7
/* 115,200 baud, 8N1. */
static const uint8_t CODING[] = {0x00, 0xC2, 0x01, 0x00, 0, 0, 8};

typedef enum {
  AWAY,
  COMING,
  RESETTING,
  DESCRIBING,
  ADDRESSING,
  MEASURING,
  CONFIGURING,
  CHOOSING,
  CODING_LINE,
  READY,
  OPENING
} stage_t;
typedef enum { IDLE, SETTING_UP, SENDING, RECEIVING, ENDING_IN, ENDING_OUT } phase_t;

static bool is_there;
static bool is_open;
static uint8_t told_open = CLOSED;
static stage_t stage;
static phase_t phase;
static uint8_t setup[8];
static uint8_t data[ROOM];
static size_t data_count;
static uint64_t late_cycle;
static uint8_t bulk_in = NONE;
static uint8_t bulk_out = NONE;
static uint8_t queue[QUEUE];
static size_t queue_start;
static size_t queue_count;

static avr_cycle_count_t on_step(avr_t *of, avr_cycle_count_t when, void *subject);
static avr_cycle_count_t on_frame(avr_t *of, avr_cycle_count_t when, void *subject);

static void soon(uint64_t ns) {
  alarm_at(avr->cycle + cycle_of(ns), on_step, NULL);
}

static size_t wanted(void) {
  return setup[6] | (size_t)setup[7] << 8;
}

static void request(stage_t next, uint8_t type, uint8_t what, uint16_t value, uint16_t length) {
  const uint8_t bytes[8] = {type, what, (uint8_t)value,  (uint8_t)(value >> 8),
                            0,    0,    (uint8_t)length, (uint8_t)(length >> 8)};

  memcpy(setup, bytes, sizeof setup);
  stage = next;
  phase = SETTING_UP;
  late_cycle = avr->cycle + cycle_of(ANSWERS_NS);
}

/* The endpoints that carry bytes, from the configuration's descriptors. */
static void find_endpoints(void) {
  for (size_t at = 0; at + 4 <= data_count && data[at] != 0; at += data[at]) {
    if (data[at + 1] != ENDPOINT_DESCRIPTOR || (data[at + 3] & 3U) != BULK) {
      continue;
    }
    if ((data[at + 2] & 0x80U) != 0) {
      bulk_in = data[at + 2] & 7U;
    } else {
      bulk_out = data[at + 2] & 7U;
    }
  }
}

static void next_stage(void) {
  switch (stage) {
  case DESCRIBING:
    request(ADDRESSING, 0x00, SET_ADDRESS, OWN_ADDRESS, 0);
    break;
  case ADDRESSING:
    request(MEASURING, 0x80, GET_DESCRIPTOR, CONFIGURATION_DESCRIPTOR << 8, 9);
    break;
  case MEASURING:
    request(CONFIGURING, 0x80, GET_DESCRIPTOR, CONFIGURATION_DESCRIPTOR << 8, (uint16_t)(data[2] | data[3] << 8));
    break;
  case CONFIGURING:
    find_endpoints();
    request(CHOOSING, 0x00, SET_CONFIGURATION, 1, 0);
    break;
  case CHOOSING:
    request(CODING_LINE, 0x21, SET_LINE_CODING, 0, sizeof CODING);
    memcpy(data, CODING, sizeof CODING);
    break;
  default:
    stage = READY;
    break;
  }
}

static void begin_again(void) {
  stage = COMING;
  phase = IDLE;
  soon(DEBOUNCED_NS);
}

static bool is_early(void) {
  if (avr->cycle < late_cycle) {
    return true;
  }
  begin_again();
  return false;
}

static void receive_data(void) {
  uint8_t bytes[PACKET];
  size_t count = 0;
  const handshake_t said = device_in(0, bytes, &count);

  if (said == STALLED) {
    begin_again();
  } else if (said == TAKEN && data_count + count <= ROOM) {
    memcpy(data + data_count, bytes, count);
    data_count += count;
    if (count < PACKET || data_count >= wanted()) {
      phase = ENDING_OUT;
    }
  }
}

static void control_step(void) {
  uint8_t bytes[PACKET] = {0};
  size_t count = 0;

  switch (phase) {
  case SETTING_UP:
    if (device_setup(setup) == TAKEN) {
      data_count = 0;
      phase = (setup[0] & 0x80U) != 0 ? RECEIVING : wanted() > 0 ? SENDING : ENDING_IN;
    }
    break;
  case SENDING:
    if (device_out(0, data, wanted()) == TAKEN) {
      phase = ENDING_IN;
    }
    break;
  case RECEIVING:
    receive_data();
    break;
  case ENDING_IN:
    if (device_in(0, bytes, &count) == TAKEN) {
      phase = IDLE;
      next_stage();
    }
    break;
  default:
    if (device_out(0, bytes, 0) == TAKEN) {
      phase = IDLE;
      next_stage();
    }
    break;
  }
}

static void send_bulk(void) {
  uint8_t bytes[PACKET];
  size_t count = 0;

  for (; count < PACKET && count < queue_count; count++) {
    bytes[count] = queue[(queue_start + count) % QUEUE];
  }
  if (count > 0 && bulk_out != NONE && device_out(bulk_out, bytes, count) == TAKEN) {
    queue_start = (queue_start + count) % QUEUE;
    queue_count -= count;
  }
}

static void receive_bulk(void) {
  uint8_t bytes[PACKET];
  size_t count = 0;

  if (bulk_in != NONE && device_in(bulk_in, bytes, &count) == TAKEN) {
    for (size_t at = 0; at < count; at++) {
      tell_link(bytes[at], avr->cycle);
    }
  }
}

static void carry(void) {
  if (told_open != is_open) {
    told_open = is_open;
    request(OPENING, 0x21, SET_LINE_STATE, is_open ? 3 : 0, 0);
    return;
  }
  if (is_open) {
    send_bulk();
    receive_bulk();
  }
}

static avr_cycle_count_t on_step(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  switch (stage) {
  case COMING:
    stage = RESETTING;
    soon(RESET_NS);
    return 0;
  case RESETTING:
    device_bus_reset();
    alarm_at(avr->cycle + cycle_of(MS_NS), on_frame, NULL);
    request(DESCRIBING, 0x80, GET_DESCRIPTOR, DEVICE_DESCRIPTOR << 8, 18);
    soon(RESET_NS);
    return 0;
  case AWAY:
    return 0;
  default:
    break;
  }
  if (phase == IDLE) {
    carry();
  } else if (is_early()) {
    control_step();
  }
  if (stage != COMING) {
    soon(PACKET_NS);
  }
  return 0;
}

static avr_cycle_count_t on_frame(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)subject;
  if (stage != AWAY) {
    device_frame();
    alarm_at(when + cycle_of(MS_NS), on_frame, NULL);
  }
  return 0;
}

void host_attached(void) {
  if (is_there) {
    begin_again();
  }
}

void host_lost(void) {
  stage = AWAY;
  phase = IDLE;
  told_open = CLOSED;
  queue_count = 0;
  bulk_in = NONE;
  bulk_out = NONE;
  alarm_off(on_step, NULL);
  alarm_off(on_frame, NULL);
}

void usb_connect(void) {
  is_there = true;
}

void usb_take(const uint8_t *bytes, size_t count) {
  for (size_t at = 0; at < count && queue_count < QUEUE && stage >= READY; at++) {
    queue[(queue_start + queue_count++) % QUEUE] = bytes[at];
  }
}

void link_opened(bool opens) {
  is_open = opens;
}
