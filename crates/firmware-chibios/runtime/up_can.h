/*
 * Devices on CAN buses. A thread of each bus takes frames as they come; what the host sets goes out in frames that are
 * put together from all devices in them.
 */
#ifndef UP_CAN_H
#define UP_CAN_H

#include "up_rt.h"

#if HAL_USE_CAN == TRUE

#include "up_value.h"

#define UP_CAN_FRAME_BYTES 8U

/* A value in a frame. Bits of a frame are a number, of which byte 0 of the frame is the lowest. */
typedef struct {
  uint32_t identifier;
  uint64_t mask;        /* sent: the bits of the frame that it has; 0: all of its bytes */
  uint64_t select_mask; /* received: it is there only where these bits */
  uint64_t select;      /* are these */
  uint16_t field;
  uint8_t byte; /* where the value begins */
  bool is_extended;
  bool is_quiet; /* sent: setting it does not make the frame due, because another one with it is sent */
  uint32_t cycle_ms; /* put no more often */
  up_value_t value;
} up_can_value_t;

/* Of a frame that is repeated; all zero at the start. */
typedef struct {
  uint32_t sent_ms;
  bool is_commanded; /* by the host or as failsafe, and the host has not fallen silent since */
} up_can_kept_t;

/* A frame that is sent. */
typedef struct {
  uint32_t identifier;
  uint8_t *data; /* UP_CAN_FRAME_BYTES, kept between two values */
  bool *is_due;
  up_can_kept_t *kept; /* with resend_ms */
  uint32_t resend_ms;  /* sent again so long after it was commanded; 0: never */
  uint8_t bytes;
  bool is_extended;
} up_can_frame_t;

/* All zero at the start. */
typedef struct {
  uint32_t bus_offs;
  bool is_off;
} up_can_state_t;

/* A bus: what up_can_cycle() works on. */
typedef struct {
  CANDriver *driver;
  uint32_t clock_hz;
  uint32_t bitrate_hz;
  up_can_state_t *state;
  const up_can_value_t *values; /* that come in */
  uint64_t *value;              /* as large as the largest of these */
  uint32_t *told_ms;            /* when each was put last */
  bool *is_told;                /* at all */
  const up_can_frame_t *frames; /* that go out */
  const up_can_value_t *sent;   /* the values in them */
  uint32_t cycle_ms;
  uint8_t values_count;
  uint8_t frames_count;
  uint8_t sent_count;
} up_can_t;

/* Sets the bit time (sample point at 77 to 87.5 %) and starts. */
void up_can_start(const up_can_t *bus);

/* Takes the frames that come in the time of a cycle, and looks at what went wrong. */
void up_can_cycle(const void *work);

/* An actuator's value goes into its frame, which becomes due; where it does not fit the device's health tells. */
void up_can_set(const up_can_frame_t *frame, const up_can_value_t *how, const void *value);

/* The host is silent: nothing is repeated until it is set again, by a failsafe or by the host. */
void up_can_hush(const up_can_t *bus);

/* Sends the frames that are due or to be repeated; what finds no room stays due. From the reporter. */
void up_can_send(const up_can_t *bus);

#endif
#endif
