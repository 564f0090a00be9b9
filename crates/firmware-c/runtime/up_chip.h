/*
 * A chip on a register bus (I2C or SPI), described by tables: initialisation, identity, calibration, transfers, and the
 * readings in them.
 *
 * up_chip_step() is called once a cycle and never waits itself: it starts the chip, triggers, and reads what is ready.
 * What it says of each reading goes to a sink. After a failed transfer the chip is started again. A chip that is not
 * the one it should be never gives values. It is asked for nothing but its identity, in every cycle, until it is the
 * right one; then, and after each 16th look in vain, it is started again from the beginning.
 */
#ifndef UP_CHIP_H
#define UP_CHIP_H

#include "up_bus.h"
#include "up_formula.h"
#include "up_value.h"

/* One step of the initialisation: bytes, then a pause. */
typedef struct {
  const uint8_t *bytes; /* written in one transfer; NULL where there is only a pause */
  uint8_t count;        /* of the bytes, 0 to 255 */
  uint16_t pause_ms;    /* waited at least after them, 0 to 65535 */
} up_chip_init_t;

/* What must be read where. */
typedef struct {
  const uint8_t *select;   /* bytes that are written before reading: the register */
  const uint8_t *expected; /* `count` bytes */
  const uint8_t *mask;     /* `count` bytes: bits that are compared; NULL: all */
  uint8_t select_count;    /* 0 to 255 */
  uint8_t count;           /* 1 to 255 */
} up_chip_identity_t;

/* A block of calibration; blocks lie one behind the other in `calibration` of the state. */
typedef struct {
  const uint8_t *select;
  uint8_t select_count; /* 0 to 255 */
  uint16_t count;       /* bytes read, at least 1 */
} up_chip_calibration_t;

/* Bytes that are read together. */
typedef struct {
  const uint8_t *trigger; /* written to start a measurement; NULL: the chip measures by itself */
  const uint8_t *select;  /* written before reading: the register, most significant byte first, SPI's read bit in it.
                           * In an exchange: what is sent, `length` bytes */
  uint32_t cycle_ms;      /* from one measurement to the next; 0, or less than the chip's: in every step */
  uint32_t wait_ms;       /* from the trigger to the reading; without one, from the start of the chip or the last
                           * reading to the next */
  uint16_t length;        /* bytes read, as on the wire (with checksums), at least 1 */
  uint8_t trigger_count;  /* 0 to 255; 0 is no trigger */
  uint8_t select_count;   /* 0 to 255; of no meaning in an exchange */
  bool exchange;          /* SPI: what is received while `select` is sent is what is read */
} up_chip_transfer_t;

/* A value in a transfer. */
typedef struct {
  uint16_t field;   /* index of the schema's fields; its direction is UP_TO_HOST */
  uint16_t offset;  /* where it begins in the transfer: bytes, as on the wire (with checksums) */
  uint8_t transfer; /* index of `transfers` */
  bool computed;    /* by the chip's formula, from the raw block at `offset`; `value` is then of no meaning */
  uint8_t output;   /* which output of the formula */
  up_value_t value; /* how it is coded */
} up_chip_reading_t;

/* A value that is written. */
typedef struct {
  const uint8_t *prefix; /* written in front of the value: the register, or any command */
  const uint8_t *own;    /* the bits of the value's bytes that it changes, where other commands have the others: as
                          * many bytes as the value; NULL: all */
  uint16_t field;        /* index of the schema's fields; its direction is UP_TO_BOARD */
  uint16_t kept;         /* with `own`: where the bytes of its register begin in `kept` of the state */
  uint8_t prefix_count;  /* 0 to 255 */
  up_value_t value;
} up_chip_command_t;

typedef struct {
  const up_chip_init_t *init;
  const up_chip_identity_t *identity; /* NULL: whoever answers is right */
  const up_chip_calibration_t *calibration;
  const up_chip_transfer_t *transfers;
  const up_chip_reading_t *readings;
  const up_chip_command_t *commands;
  const up_formula_t *formula;  /* NULL for none */
  const int32_t *parameters;    /* of the formula: parameters_count of them */
  uint32_t cycle_ms;            /* how often up_chip_step() is called: a transfer is made in the first step that comes
                                 * at its time, or too early by at most an eighth of this (clocks round) */
  uint8_t address;              /* see up_bus_t */
  uint8_t init_count;
  uint8_t calibration_count;
  uint8_t transfers_count; /* 0 to 254 */
  uint8_t readings_count;
  uint8_t commands_count;
} up_chip_t;

/* How often, since the start of the board; each wraps at 2^32. */
typedef struct {
  uint32_t starts;             /* initialised, identified and calibrated to the end */
  uint32_t written;            /* commands that went through */
  uint32_t causes[UP_RESULTS]; /* by up_result_t: values that are fresh, invalid or have a wrong checksum; transfers
                                * that failed; identities that were not the expected one */
} up_chip_counts_t;

/* Of one transfer. */
typedef struct {
  uint32_t due_ms;   /* when it is to be triggered, or read; the clock may wrap */
  uint32_t ready_ms; /* when it may be read */
} up_chip_transfer_state_t;

/* All zero but the first five members, which a table gives; nobody but these functions changes the rest. */
typedef struct {
  up_chip_transfer_state_t *transfers; /* transfers_count */
  uint8_t *calibration;                /* the bytes of all calibration blocks; NULL for none */
  uint8_t *work;                       /* up_chip_work_bytes(); may be shared with chips of the same thread */
  uint64_t *scratch;                   /* as large as the largest value of a reading; may be shared likewise */
  uint8_t *kept;                       /* of the registers that commands share, what they were told last; NULL for none */
  up_chip_counts_t counts;
  uint32_t pause_until_ms;
  uint8_t fault;         /* up_result_t: what is the matter since the last step that read anything (a start counts when
                          * it is done); UP_NOTHING when all is well */
  uint8_t identity_seen; /* the first byte that was wrong of the identity read last */
  uint8_t init_at;       /* which step of the initialisation is next */
  uint8_t in_flight;     /* 1 + index of the triggered transfer that has not been read; 0 for none */
  bool is_pausing;       /* until pause_until_ms */
  bool is_running;       /* started: transfers are made and commands are taken */
  bool is_stranger;      /* the identity read last was wrong */
} up_chip_state_t;

/* Bytes of work buffer: the most that any transfer writes and reads together, a command's bytes included. */
size_t up_chip_work_bytes(const up_chip_t *chip, const up_schema_t *schema);

/* Milliseconds since any time in the past; wraps at 2^32. */
typedef uint32_t (*up_clock_t)(void);

/* One cycle, in the grid of the time at which it begins; pauses and conversions are counted from the transfer before
 * them, which takes its time on the bus. Says one result for each reading of a transfer that was read or failed, and the cause for all readings
 * when the chip could not be started; says nothing of the others. Of transfers with a trigger one is under way at a
 * time, the one that has been due for longest: their converter is one. */
void up_chip_step(const up_chip_t *chip, up_chip_state_t *state, const up_bus_t *bus, const up_schema_t *schema,
                  up_clock_t clock, const up_value_sink_t *sink);

/* How long from now until a step has something to do; 0 for at once, a cycle after a failure. A system may call the
 * next step so soon instead of a cycle later: then initialisation takes its pauses and no more, and values are younger.
 * Calls between the cycles take nothing out of step. */
uint32_t up_chip_idle_ms(const up_chip_t *chip, const up_chip_state_t *state, uint32_t now_ms);

/* Writes a value. UP_FRESH: it is written. UP_NOTHING: the chip is not started, ask again after the next step.
 * UP_INVALID: it has no place in the command. Another cause: it did not go through, and the chip will be started again.
 * What was written before a start is lost in the chip: when counts.starts has changed, all commands are written anew by
 * whoever calls. */
up_result_t up_chip_write(const up_chip_t *chip, up_chip_state_t *state, const up_bus_t *bus,
                          const up_schema_t *schema, const up_chip_command_t *command, const void *value);

#endif
