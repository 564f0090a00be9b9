/*
 * The outcome of a reading, a message or a transfer.
 */
#ifndef UP_RESULT_H
#define UP_RESULT_H

/* In each step, one of these is reported for each value. */
typedef enum {
  UP_NOTHING,          /* not due, not ready, not measured: the last value remains valid */
  UP_FRESH,            /* a new value, or a transfer that succeeded */
  UP_INVALID,          /* the device answered with something that is not a measurement */
  UP_WRONG_CRC,        /* the answer was damaged on the way: the device's own checksum is wrong */
  UP_NOT_ACKNOWLEDGED, /* no device has the address, or a byte was refused */
  UP_BUS_ERROR,        /* a misplaced start or stop, an overrun, a DMA failure, or an impossible transfer */
  UP_ARBITRATION_LOST, /* another master took the bus */
  UP_TIMED_OUT,        /* a time-out, or the bus hangs */
  UP_WRONG_IDENTITY    /* another device answered */
} up_result_t;
#define UP_RESULTS 9U

#endif
