/*
 * What a reading, a message or a transfer came to, and why.
 */
#ifndef UP_RESULT_H
#define UP_RESULT_H

/* Whoever makes values says one of these for each in each step. */
typedef enum {
  UP_NOTHING,          /* not due, not ready, not measured: the last value stands */
  UP_FRESH,            /* a new value */
  UP_INVALID,          /* the device answered with something that is not a measurement */
  UP_WRONG_CRC,        /* its answer was damaged on the way: the device's own checksum does not fit */
  UP_NOT_ACKNOWLEDGED, /* nobody has its address, or a byte was refused */
  UP_BUS_ERROR,        /* a misplaced start or stop, an overrun, a DMA's failure, no such transfer */
  UP_ARBITRATION_LOST, /* somebody else drove the bus */
  UP_TIMED_OUT,        /* it did not end in time, or the bus hangs */
  UP_WRONG_IDENTITY    /* another device answers */
} up_result_t;
#define UP_RESULTS 9U

#endif
