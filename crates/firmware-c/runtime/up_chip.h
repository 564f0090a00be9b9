/*
 * A chip on a register bus (I2C or SPI), described by tables: initialisation, identity, calibration, transfers, and the
 * readings in them.
 *
 * up_chip_step() is called once per cycle and never waits itself: it starts the chip, triggers, and reads what is
 * ready. It reports the outcome of each reading to a sink. After a failed transfer the chip is started again. A chip
 * with a wrong identity never gives values. In every cycle it is asked only for its identity until that is right; then,
 * and after every 16th failed attempt, it is started from the beginning.
 */
#ifndef UP_CHIP_H
#define UP_CHIP_H

#include "up_bus.h"
#include "up_formula.h"
#include "up_value.h"

/* One step of the initialisation: bytes, then a pause. */
typedef struct {
  UP_ROM uint8_t *bytes; /* written in one transfer; NULL for a pause only */
  uint8_t count;         /* number of bytes, 0 to 255 */
  uint16_t pause_ms;     /* least pause after them, 0 to 65535 */
} up_chip_init_t;

/* The register that identifies a part, and its contents. */
typedef struct {
  UP_ROM uint8_t *select;   /* bytes written before reading: the register */
  UP_ROM uint8_t *expected; /* `count` bytes */
  UP_ROM uint8_t *mask;     /* `count` bytes: the bits that are compared; NULL: all */
  uint8_t select_count;     /* 0 to 255 */
  uint8_t count;            /* 1 to 255 */
} up_chip_identity_t;

/* A block of calibration; blocks are stored one after the other in `calibration` of the state. */
typedef struct {
  UP_ROM uint8_t *select;
  uint8_t select_count; /* 0 to 255 */
  uint16_t count;       /* bytes read, at least 1 */
} up_chip_calibration_t;

/* Bytes that are read together. */
typedef struct {
  UP_ROM uint8_t *trigger; /* written to start a measurement; NULL: the chip measures by itself */
  UP_ROM uint8_t *select;  /* written before reading: the register, most significant byte first, including SPI's read
                            * bit. In an exchange: the bytes sent, `length` in number */
  uint32_t cycle_ms;       /* from one measurement to the next; 0, or less than the chip's: in every step */
  uint32_t wait_ms;        /* from the trigger to the reading; without a trigger, from the start of the chip or the
                            * last reading to the next */
  uint16_t length;         /* bytes read, as on the wire (including checksums), at least 1 */
  uint8_t trigger_count;   /* 0 to 255; 0: no trigger */
  uint8_t select_count;    /* 0 to 255; ignored in an exchange */
  bool exchange;           /* SPI: the bytes read are those received while `select` is sent */
} up_chip_transfer_t;

/* A value in a transfer. */
typedef struct {
  uint16_t field;   /* index into the schema's fields; its direction is UP_TO_HOST */
  uint16_t offset;  /* offset in the transfer in bytes, as on the wire (including checksums) */
  uint8_t transfer; /* index into `transfers` */
  bool computed;    /* by the chip's formula, from the raw block at `offset`; `value` is then ignored */
  uint8_t output;   /* the output of the formula */
  up_value_t value; /* the coding */
} up_chip_reading_t;

/* A value that is written. */
typedef struct {
  UP_ROM uint8_t *prefix; /* written before the value: the register, or any command */
  UP_ROM uint8_t *own;    /* the bits that it changes if other commands have bits of the same register, in as many
                           * bytes as the value has; NULL: all */
  uint16_t field;         /* index into the schema's fields; its direction is UP_TO_BOARD */
  uint16_t kept;          /* with `own`: offset of its register in `kept` of the state */
  uint8_t prefix_count;   /* 0 to 255 */
  up_value_t value;
} up_chip_command_t;

typedef struct {
  UP_ROM up_chip_init_t *init;
  UP_ROM up_chip_identity_t *identity; /* NULL: any part that answers is right */
  UP_ROM up_chip_calibration_t *calibration;
  UP_ROM up_chip_transfer_t *transfers;
  UP_ROM up_chip_reading_t *readings;
  UP_ROM up_chip_command_t *commands;
  UP_ROM up_formula_t *formula;  /* NULL for none */
  UP_ROM int32_t *parameters;    /* parameters_count parameters of the formula */
  uint32_t cycle_ms;             /* how often up_chip_step() is called: a transfer is made in the first step at or
                                  * after its time, or at most an eighth of this before it (clocks round) */
  uint8_t address;               /* as in up_bus_t */
  uint8_t init_count;
  uint8_t calibration_count;
  uint8_t transfers_count; /* 0 to 254 */
  uint8_t readings_count;
  uint8_t commands_count;
} up_chip_t;

/* Event counts since the start of the board; they wrap. */
typedef struct {
  up_events_t starts;             /* starts that were completed: initialised, identified and calibrated */
  up_events_t written;            /* commands that succeeded */
  up_events_t causes[UP_RESULTS]; /* by up_result_t: values that are fresh, invalid or have a wrong checksum;
                                   * transfers that failed; identities that were wrong */
} up_chip_counts_t;

/* The state of one transfer. */
typedef struct {
  uint32_t due_ms;   /* when it is due: for its trigger, or without one for reading; the clock may wrap */
  uint32_t ready_ms; /* when it can be read */
} up_chip_transfer_state_t;

/* All zero except the first five members, which a table provides; only these functions change the rest. */
typedef struct {
  up_chip_transfer_state_t *transfers; /* transfers_count */
  uint8_t *calibration;                /* the calibration blocks; NULL for none */
  uint8_t *work;                       /* up_chip_work_bytes(); may be shared with chips of the same thread */
  uint64_t *scratch;                   /* as large as the largest value of a reading; may be shared in the same way */
  uint8_t *kept;                       /* the last contents of the registers that commands share; NULL for none */
  up_chip_counts_t counts;
  uint32_t pause_until_ms;
  uint8_t fault;         /* up_result_t: the fault found by the last step that read anything (a start counts once it
                          * is complete); UP_NOTHING if there is none */
  uint8_t identity_seen; /* the first wrong byte of the last identity read */
  uint8_t init_at;       /* the next step of the initialisation */
  uint8_t in_flight;     /* 1 + index of the triggered transfer that has not been fetched yet; 0 for none */
  bool is_pausing;       /* until pause_until_ms */
  bool is_running;       /* started: transfers are made and commands are accepted */
  bool has_wrong_identity;      /* the last identity read was wrong */
} up_chip_state_t;

/* The size of the work buffer: the most bytes that any transfer or command writes and reads together. */
size_t up_chip_work_bytes(UP_ROM up_chip_t *chip, UP_ROM up_schema_t *schema);

/* Milliseconds since any time in the past; wraps at 2^32. */
typedef uint32_t (*up_clock_t)(void);

/* Runs one cycle, on a grid from the time at which it begins; pauses and conversions count from the end of the
 * transfer before them, which takes time on the bus. Reports one result for each reading of a transfer that was read
 * or failed, and the cause for all readings if the chip could not be started; reports nothing for the others. Of the
 * transfers with a trigger only one is under way at a time, the one that has been due for longest, because they
 * share the chip's converter. */
void up_chip_step(UP_ROM up_chip_t *chip, up_chip_state_t *state, UP_ROM up_bus_t *bus, UP_ROM up_schema_t *schema,
                  up_clock_t clock, const up_value_sink_t *sink);

/* How long from now until a step has something to do: 0 for at once, a cycle after a failure. A system may call the
 * next step then instead of a cycle later: the initialisation takes only its pauses, and values are younger. Calls
 * between the cycles disturb nothing. */
uint32_t up_chip_idle_ms(UP_ROM up_chip_t *chip, const up_chip_state_t *state, uint32_t now_ms);

/* Writes a value. UP_FRESH: it is written. UP_NOTHING: the chip is not started, so ask again after the next step.
 * UP_INVALID: it does not fit into the command. Another cause: the write failed, and the chip will be started again.
 * A restart loses what was written to the chip before: when counts.starts has changed, the caller must write all
 * commands again. */
up_result_t up_chip_write(UP_ROM up_chip_t *chip, up_chip_state_t *state, UP_ROM up_bus_t *bus,
                          UP_ROM up_schema_t *schema, UP_ROM up_chip_command_t *command, const void *value);

#endif
