/*
 * SPI as master: bytes of the program in, those of the chip that is selected out, in the time that its clock takes.
 */
#include "talk.h"

#define SPCR 0x4C
#define SPSR 0x4D
#define SPDR 0x4E
#define MASK 7U
#define ENABLED 6U
#define LOW_FIRST 5U
#define MASTER 4U
#define FLAG 7U
#define COLLISION 6U
#define DOUBLED 0U
#define BITS 8U

static const request_t *request;
static bool is_busy;
static bool has_seen; /* the flag, by reading it */
static uint8_t shifted;
static uint8_t received;
static uint32_t told_hz;
static uint8_t told_mode;

static uint8_t turned(uint8_t byte) {
  uint8_t value = 0;

  for (unsigned place = 0; place < BITS; place++) {
    value |= (uint8_t)((byte >> place & 1U) << (BITS - 1 - place));
  }
  return is_set(SPCR, LOW_FIRST) ? value : byte;
}

static uint32_t bit_cycles(void) {
  static const uint8_t dividers[] = {4, 16, 64, 128};

  return (uint32_t)dividers[avr->data[SPCR] & 3U] >> is_set(SPSR, DOUBLED);
}

static avr_cycle_count_t on_end(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)subject;
  is_busy = false;
  has_seen = false;
  received = turned(ask_spi(turned(shifted), when));
  request_raise(request);
  return 0;
}

/* ATmega328P, 19.3.2, master mode: an input that is low makes a slave of it. */
static bool is_master(void) {
  if (is_set(SPCR, MASTER) && !pin_is_output(part->select) && !pin_level(part->select)) {
    put(SPCR, MASTER, false);
    request_raise(request);
  }
  return is_set(SPCR, MASTER);
}

static void tell_clock(void) {
  const uint32_t hz = avr->frequency / bit_cycles();
  const uint8_t mode = avr->data[SPCR] >> 2 & 3U;

  if (hz != told_hz || mode != told_mode) {
    told_hz = hz;
    told_mode = mode;
    tell_setting('s', 1, hz, mode, 0, 0);
  }
}

static void clear_flag(void) {
  if (has_seen) {
    put(SPSR, FLAG, false);
    put(SPSR, COLLISION, false);
  }
  has_seen = false;
}

static void write_data(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)address;
  (void)subject;
  clear_flag();
  if (is_busy) {
    put(SPSR, COLLISION, true);
  } else if (is_set(SPCR, ENABLED) && is_master()) {
    is_busy = true;
    shifted = value;
    tell_clock();
    tell_levels(turned(value), of->cycle, bit_cycles());
    alarm_at(of->cycle + (uint64_t)BITS * bit_cycles(), on_end, NULL);
  }
}

static uint8_t read_data(avr_t *of, avr_io_addr_t address, void *subject) {
  (void)of;
  (void)address;
  (void)subject;
  clear_flag();
  return received;
}

static uint8_t read_status(avr_t *of, avr_io_addr_t address, void *subject) {
  (void)subject;
  has_seen = is_set(SPSR, FLAG) || is_set(SPSR, COLLISION);
  return of->data[address];
}

static void write_status(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = (uint8_t)((of->data[address] & ~bit(DOUBLED)) | (value & bit(DOUBLED)));
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = value;
  if (!is_set(SPCR, ENABLED)) {
    is_busy = false;
    alarm_off(on_end, NULL);
  }
  requests_look();
}

void spi_reset(void) {
  is_busy = false;
  has_seen = false;
  told_hz = 0;
}

void spi_init(void) {
  request = request_new(part->spi_vector, SPSR, FLAG, SPCR, MASK, false);
  avr_register_io_write(avr, SPDR, write_data, NULL);
  avr_register_io_read(avr, SPDR, read_data, NULL);
  avr_register_io_write(avr, SPSR, write_status, NULL);
  avr_register_io_read(avr, SPSR, read_status, NULL);
  avr_register_io_write(avr, SPCR, write_control, NULL);
}
