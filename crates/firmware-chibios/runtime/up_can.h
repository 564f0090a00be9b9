/*
 * Devices on CAN buses. A thread of each bus takes frames as they come; what the host sets is sent in frames that
 * combine all their devices.
 */
#ifndef UP_CAN_H
#define UP_CAN_H

#include "up_rt.h"

#if HAL_USE_CAN == TRUE

#include "up_count.h"
#include "up_value.h"

#define UP_CAN_FRAME_BYTES 8U

/* A value in a frame. The bits of a frame are numbered as in an integer whose lowest byte is byte 0 of the frame. */
typedef struct {
  uint32_t identifier;
  uint64_t mask;        /* sent: its bits in the frame; 0: all of its bytes */
  uint64_t select_mask; /* received: it is there only if these bits */
  uint64_t select;      /* have these values */
  uint16_t field;
  uint8_t byte; /* offset of the value */
  bool is_extended;
  bool is_quiet; /* sent: setting it does not make the frame due, because another frame that contains it is sent */
  uint32_t cycle_ms; /* the least time between two values */
  up_value_t value;
} up_can_value_t;

/* The state of a frame that is repeated; all zero at the start. */
typedef struct {
  uint32_t sent_ms;
  bool is_commanded; /* by the host or the failsafe, and the host has not fallen silent since */
} up_can_kept_t;

/* A frame that is sent. */
typedef struct {
  uint32_t identifier;
  uint8_t *data; /* UP_CAN_FRAME_BYTES, kept from one value to the next */
  bool *is_due;
  up_can_kept_t *kept; /* with resend_ms */
  uint32_t resend_ms;  /* time after which a command's frame is repeated; 0: never */
  uint8_t bytes;
  bool is_extended;
} up_can_frame_t;

/* All zero at the start. */
typedef struct {
  uint32_t bus_offs;
  bool is_off;
} up_can_state_t;

/* A bus, the argument of up_can_cycle(). */
typedef struct {
  CANDriver *driver;
  uint32_t clock_hz;
  uint32_t bitrate_hz;
  up_can_state_t *state;
  const up_can_value_t *values; /* that are received */
  uint64_t *value;              /* as large as the largest of them */
  up_turn_t *turns;             /* which of each is stored */
  const up_can_frame_t *frames; /* that are sent */
  const up_can_value_t *sent;   /* the values in them */
  uint32_t cycle_ms;
  uint8_t values_count;
  uint8_t frames_count;
  uint8_t sent_count;
} up_can_t;

/* Sets the bit time (sample point at 77 to 87.5 %) and starts the bus. */
void up_can_start(const up_can_t *bus);

/* Takes the frames that come during a cycle, and checks for faults. */
void up_can_cycle(const void *work);

/* Puts an actuator's value into its frame, which becomes due; if it does not fit, the device's health shows it. */
void up_can_set(const up_can_frame_t *frame, const up_can_value_t *how, const void *value);

/* The host is silent: nothing is repeated until it is set again, by a failsafe or by the host. */
void up_can_hush(const up_can_t *bus);

/* Sends the frames that are due or must be repeated; a frame without room stays due. From the reporter. */
void up_can_send(const up_can_t *bus);

#endif
#endif
