/*
 * A report of the paper's Fig. 2: with the generated code and the core (GENERATED), or written by hand for that report
 * alone (BY_HAND), or not at all. On a computer it prints the frames of all reports, on an AVR it sends one.
 */
#include <stddef.h>
#include <stdint.h>

#define FRAME_BYTES 128U
#define CHECKSUM 0xFFU

#if defined(GENERATED)
#include "sense_model.h"

typedef sense_values_t report_t;
#define front SENSE_IRFront
#define front_right SENSE_IRFrontRight
#define rear SENSE_USRear
#define wheel SENSE_WheelEncoder
#else
typedef struct {
  uint16_t front;
  uint16_t front_right;
  uint8_t rear;
  uint32_t wheel;
} report_t;
#endif

#if defined(GENERATED)
static size_t encode(uint8_t due, const report_t *report, uint8_t *frame) {
  return up_encode_values(&sense_reports, NULL, &due, report, frame, FRAME_BYTES);
}
#elif defined(BY_HAND)
static uint16_t crc_of(const uint8_t *bytes, uint8_t size) {
  uint16_t crc = 0xFFFFU;
  uint8_t i;
  uint8_t bit;

  for (i = 0U; i < size; i++) {
    crc ^= (uint16_t)((uint16_t)bytes[i] << 8);
    for (bit = 0U; bit < 8U; bit++) {
      crc = (uint16_t)((crc << 1) ^ (((crc & 0x8000U) != 0U) ? 0x1021U : 0U));
    }
  }
  return crc;
}

static uint8_t *put(uint8_t *at, uint8_t id, uint32_t value, uint8_t bytes) {
  *at++ = id;
  while (bytes > 0U) {
    bytes--;
    *at++ = (uint8_t)(value >> (8U * bytes));
  }
  return at;
}

static size_t encode(uint8_t due, const report_t *report, uint8_t *frame) {
  uint8_t payload[20];
  uint8_t *at = payload;
  uint8_t *to = frame;
  uint16_t crc;
  uint8_t size;
  uint8_t i;

  if ((due & 1U) != 0U) {
    at = put(at, 17U, report->front, 2U);
  }
  if ((due & 2U) != 0U) {
    at = put(at, 18U, report->front_right, 2U);
  }
  if ((due & 4U) != 0U) {
    at = put(at, 19U, report->rear, 1U);
  }
  if ((due & 8U) != 0U) {
    at = put(at, 20U, report->wheel, 4U);
  }
  if (at == payload) {
    return 0U;
  }
  crc = crc_of(payload, (uint8_t)(at - payload));
  at = put(at, CHECKSUM, crc, 2U);
  size = (uint8_t)(at - payload);
  if (size >= 10U) {
    *to++ = (uint8_t)('0' + size / 10U);
  }
  *to++ = (uint8_t)('0' + size % 10U);
  *to++ = ':';
  for (i = 0U; i < size; i++) {
    *to++ = payload[i];
  }
  *to++ = ',';
  return (size_t)(to - frame);
}
#else
static size_t encode(uint8_t due, const report_t *report, uint8_t *frame) {
  frame[0] = (uint8_t)(due + report->front + report->front_right + report->rear + report->wheel);
  return 1U;
}
#endif

#if defined(__AVR__)
#include <avr/io.h>

volatile uint8_t due;
volatile report_t seen;
static uint8_t frame[FRAME_BYTES];

int main(void) {
  const report_t report = {
      .front = seen.front, .front_right = seen.front_right, .rear = seen.rear, .wheel = seen.wheel};
  const size_t size = encode(due, &report, frame);
  size_t i;

  for (i = 0U; i < size; i++) {
    UDR0 = frame[i];
  }
  return 0;
}
#else
#include <stdio.h>

int main(void) {
  const report_t report = {.front = 0x1234U, .front_right = 0x0FEDU, .rear = 0xA5U, .wheel = 0xDEADBEEFU};
  uint8_t frame[FRAME_BYTES];
  uint8_t due;

  for (due = 0U; due < 16U; due++) {
    (void)fwrite(frame, 1U, encode(due, &report, frame), stdout);
  }
  return 0;
}
#endif
