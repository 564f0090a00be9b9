/*
 * A complete simulated board: two chips on a bus, a capture, a serial device, the reporter and its link, and the host
 * at the other end. Time is a number of milliseconds; the measured values are the time, so that each value shows its
 * own age.
 */
#ifndef RIG_H
#define RIG_H

#include "rig_model.h"
#include "up_capture.h"
#include "up_chip.h"
#include "up_message.h"
#include "up_reporter.h"

enum { RANGE, AXES, WHEEL, LEVEL, MOTOR, LAMP, RIG_FIELDS };

#define RIG_RANGE_ADDRESS 0x70U
#define RIG_AXES_ADDRESS 0x68U
#define RIG_CHIP_MS 20U
#define RIG_LEVEL_MS 50U
#define RIG_REPORT_MS 10U
#define RIG_SILENCE_MS 500U
#define RIG_QUEUE_BYTES 256U

/* A fault that lasts from one time to another. */
typedef struct {
  uint32_t from_ms, to_ms;
  uint8_t address;       /* transfers to this chip fail; 0xFF: to all chips */
  uint8_t phase;         /* the phase of a transfer from which on it fails: 0 address, 1 write, 2 read */
  up_bus_result_t bus;   /* UP_BUS_DONE: the bus is not faulty */
  uint32_t hangs_ms;     /* the time that a failing transfer takes */
  bool capture_is_silent;
  bool serial_is_garbage;
  bool serial_is_silent;
  bool host_does_not_read;
  bool host_sends_rubbish;
  bool host_is_silent;
  bool is_unplugged;
} rig_fault_t;

typedef struct {
  const rig_fault_t *fault;
  uint32_t baud; /* of the link; 0: USB */
  uint32_t now_ms;
  uint32_t seed;
  /* The board. */
  rig_values_t values, received;
  up_store_t store;
  up_health_device_t devices[RIG_FIELDS];
  up_health_t health;
  up_reporter_t reporter;
  up_reporter_config_t config;
  up_channel_t channel;
  uint8_t frame[RIG_REPORT_FRAME_BYTES], buffer[RIG_COMMAND_BUFFER_BYTES];
  up_bus_t bus;
  up_chip_state_t chips[2];
  up_chip_transfer_state_t transfers[2];
  uint8_t work[16];
  uint64_t scratch[2];
  uint32_t bus_busy_until_ms, triggered_ms;
  up_capture_raw_t raw;
  up_capture_state_t capture;
  up_message_state_t message;
  uint8_t message_buffer[4];
  uint64_t message_scratch[1];
  unsigned failsafes, applied;
  int16_t motor;
  bool lamp;
  /* The wire. */
  uint8_t queue[RIG_QUEUE_BYTES];
  size_t queued;
  uint32_t bits; /* that the line could have sent since its last byte */
  uint8_t to_board[512];
  size_t to_board_size;
  /* The host. */
  up_decoder_t decoder;
  up_sink_t sink;
  uint8_t host_buffer[RIG_REPORT_BUFFER_BYTES];
  unsigned reports, reports_in_second[10], late_reports, old_values, hellos, lost, commands;
  uint8_t next_counter;
  bool has_counter;
  uint32_t last_report_ms, longest_gap_ms;
  bool has_health;
  up_health_row_t rows[RIG_FIELDS];
  up_health_board_t board;
  int16_t commanded;
} rig_t;

void rig_start(rig_t *rig, const rig_fault_t *fault, uint32_t baud);

/* Lets time pass. */
void rig_run(rig_t *rig, uint32_t until_ms);

#endif
