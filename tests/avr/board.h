/*
 * An AVR on a board: what the files of the program share. README.md describes the whole.
 *
 * One process is one board, so its state is global. Times are cycles of the processor since the board got power; the
 * world counts nanoseconds.
 */
#ifndef BOARD_H
#define BOARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_io.h>

#define NEVER UINT64_MAX
#define COUNT_OF(array) (sizeof(array) / sizeof((array)[0]))

/* The processor. */
extern avr_t *avr;

static inline uint8_t bit(unsigned place) {
  return (uint8_t)(1U << place);
}

static inline bool is_set(uint16_t address, unsigned place) {
  return (avr->data[address] >> place & 1) != 0;
}

static inline void put(uint16_t address, unsigned place, bool is_on) {
  avr->data[address] = (uint8_t)((avr->data[address] & ~bit(place)) | (is_on ? bit(place) : 0));
}

/* parts.c: the facts of an MCU, from its data sheet. Addresses are those of data memory. */

/* A pad; the port is a letter, 0 if there is no such pad. */
typedef struct {
  char port;
  uint8_t pin;
} pad_t;

#define CHANNELS 3U
#define TIMERS 6U
#define PORTS 12U
#define PINS 8U
#define OUTSIDES 8U
#define CHANGES 3U
#define UARTS 4U
#define INPUTS 16U

typedef struct {
  bool is_there;
  bool is_wide; /* 16 bits and an input capture */
  uint16_t base;
  pad_t outputs[CHANNELS];
  pad_t capture;
  pad_t clock;
  uint8_t capture_vector;
  uint8_t compare_vectors[CHANNELS];
  uint8_t overflow_vector;
} timer_facts_t;

typedef struct {
  uint16_t base;
  /* Received, data register empty, transmitted: one after the other. */
  uint8_t vector;
} uart_facts_t;

typedef struct {
  const char *name;
  uint16_t ports[PORTS]; /* the address of PINx, 0 without that port */
  pad_t outsides[OUTSIDES];
  pad_t changes[CHANGES][PINS];
  uint8_t change_vector; /* the first one */
  timer_facts_t timers[TIMERS];
  uart_facts_t uarts[UARTS];
  pad_t inputs[INPUTS]; /* of the converter; a pad without a port is an input alone */
  uint16_t high_inputs; /* the bit MUX5 of ADCSRB, 0 if there is none */
  pad_t sda;
  pad_t scl;
  pad_t select;         /* SS of SPI */
  uint8_t watchdog_vector;
  uint8_t spi_vector;
  uint8_t adc_vector;
  uint8_t eeprom_vector;
  uint8_t twi_vector;
  uint8_t usb_vectors[2]; /* general, endpoints; 0 without USB */
  bool has_fast_timer;    /* timer 4 of the ATmega32U4 */
} part_t;

extern const part_t *part;

const part_t *part_named(const char *name);

/* clock.c: time, and the loop that runs the processor. */

uint64_t ns_of(uint64_t cycle);
/* The first cycle that is not before a time. */
uint64_t cycle_of(uint64_t ns);
/* An alarm of one kind and subject; setting it again moves it. Alarms return 0. */
void alarm_at(uint64_t cycle, avr_cycle_timer_t alarm, void *subject);
void alarm_off(avr_cycle_timer_t alarm, void *subject);
/* At the end of what is under way. */
void reset_soon(uint8_t cause);
void power(bool is_on);
void run_until_ns(uint64_t until_ns);
void board_init(void);
uint64_t cycles_asleep(void);
bool has_power(void);

#define MCUSR 0x54
#define POWER_CAUSE 0x01
#define WATCHDOG_CAUSE 0x08

/* requests.c: which interrupt is asked for, and whether it is let in. */

typedef struct {
  uint8_t vector;
  uint16_t flag_at;
  uint8_t flag;
  uint16_t mask_at;
  uint8_t mask;
  bool stays;    /* the interrupt leaves the flag alone */
  bool closes;   /* the interrupt clears the mask */
  bool is_clear; /* it asks while the flag is clear */
} request_t;

request_t *request_new(uint8_t vector, uint16_t flag_at, unsigned flag, uint16_t mask_at, unsigned mask, bool stays);
void request_raise(const request_t *request);
/* After flags or masks were changed. */
void requests_look(void);
/* Lets the first one in, if it is time; the processor stands between two instructions. */
void requests_serve(void);
/* Registers that hold nothing but flags, which are cleared by ones, or nothing but masks. */
void flags_at(uint16_t address);
void masks_at(uint16_t address);
/* The bits that the instruction under way writes: `sbi` writes a single one. */
uint8_t written_bits(uint8_t value);

/* pins.c */

typedef enum { FLOATING = -1, LOW = 0, HIGH = 1 } level_t;

void pins_init(void);
void pins_reset(void);
/* The level on a pad, whatever drives it. */
bool pin_level(pad_t pad);
/* What is around the board drives it; FLOATING if nothing does. */
level_t pin_outside(pad_t pad);
bool pin_is_output(pad_t pad);
void pin_set_outside(pad_t pad, level_t level, uint64_t next_ns, level_t next);
/* A timer has a pad from now on, or gives it back (FLOATING with a wave of its own: `has_wave`). */
void pin_take(pad_t pad, level_t level, bool has_wave);
void pin_give(pad_t pad);
/* What the program has written to the registers of a port: DDRx and PORTx; 0 without that port. */
void pins_registers(unsigned port, uint8_t *direction, uint8_t *latch);

/* timers.c, waves.c: timers 0 to 5; fast_timer.c: the timer 4 of the ATmega32U4 */

void timers_init(void);
void timers_reset(void);
void timers_pin(pad_t pad, bool is_high, uint64_t cycle);
void timers_direction(pad_t pad);
int timers_wave_level(pad_t pad);
void fast_timer_init(void);
void fast_timer_reset(void);
void fast_timer_direction(void);

/* The rest: a file each. */

void adc_init(void);
void adc_reset(void);
void eeprom_init(void);
void spi_init(void);
void spi_reset(void);
void twi_init(void);
void twi_reset(void);
void watchdog_init(void);
void watchdog_reset(bool has_bitten);
void watchdog_fed(void);
/* How long it waits for food until it resets; 0 if it does not. */
uint64_t watchdog_ns(void);

typedef struct {
  bool is_known;
  uint32_t baud;
  uint8_t data_bits;
  uint8_t parity; /* 0 none, 1 even, 2 odd */
  uint8_t stop_bits;
} serial_t;

void uarts_init(void);
void uarts_reset(void);
/* What is at the other end. */
void uart_connect(unsigned unit, serial_t setting, bool is_link);
/* Bytes of the host, which go to the link's port. */
void link_received(const uint8_t *bytes, size_t count);
void link_opened(bool is_open);

void usb_init(void);
void usb_reset(void);
/* The link's host is there. */
void usb_connect(void);
void usb_take(const uint8_t *bytes, size_t count);

#endif
