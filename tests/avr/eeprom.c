/*
 * The EEPROM: what the program writes in, the same after a reset out.
 */
#include "board.h"

#include <string.h>

#define EECR 0x3F
#define EEDR 0x40
#define EEARL 0x41
#define EEARH 0x42
#define READS 0U
#define WRITES 1U
#define MAY_WRITE 2U
#define MASK 3U
#define MODES 4U
#define ERASES_ONLY 1U
#define WRITES_ONLY 2U
#define ROOM 4096U
#define MAY_CYCLES 4U
/* ATmega328P, table 8-1, EEPROM mode bits. */
#define WHOLE_NS 3400000U
#define HALF_NS 1800000U

static uint8_t memory[ROOM];

static uint16_t address_now(void) {
  return (uint16_t)((avr->data[EEARL] | avr->data[EEARH] << 8) & avr->e2end);
}

static avr_cycle_count_t on_end(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  put(EECR, WRITES, false);
  requests_look();
  return 0;
}

static avr_cycle_count_t on_late(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)when;
  (void)subject;
  put(EECR, MAY_WRITE, false);
  return 0;
}

static void write_memory(void) {
  const unsigned mode = avr->data[EECR] >> MODES & 3U;
  uint8_t *const byte = &memory[address_now()];

  if (mode == ERASES_ONLY) {
    *byte = UINT8_MAX;
  } else if (mode == WRITES_ONLY) {
    *byte &= avr->data[EEDR];
  } else {
    *byte = avr->data[EEDR];
  }
  put(EECR, WRITES, true);
  put(EECR, MAY_WRITE, false);
  alarm_at(avr->cycle + cycle_of(mode == 0 ? WHOLE_NS : HALF_NS), on_end, NULL);
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const uint8_t before = of->data[address];
  const bool is_busy = is_set(EECR, WRITES);
  const uint8_t modes = (uint8_t)(3U << MODES);
  const uint8_t kept = (uint8_t)(before & (bit(WRITES) | bit(MAY_WRITE) | (is_busy ? modes : 0)));

  (void)subject;
  of->data[address] = (uint8_t)(kept | (value & (bit(MASK) | (is_busy ? 0 : modes))));
  if ((value & bit(WRITES)) != 0 && is_set(EECR, MAY_WRITE) && !is_busy) {
    write_memory();
  } else if ((value & bit(MAY_WRITE)) != 0) {
    put(EECR, MAY_WRITE, true);
    alarm_at(of->cycle + MAY_CYCLES + 2, on_late, NULL);
  }
  if ((value & bit(READS)) != 0 && !is_busy) {
    of->data[EEDR] = memory[address_now()];
    /* The processor waits. */
    of->cycle += 4;
  }
  requests_look();
}

void eeprom_init(void) {
  request_t *const ready = request_new(part->eeprom_vector, EECR, WRITES, EECR, MASK, true);

  ready->is_clear = true;
  memset(memory, UINT8_MAX, sizeof memory);
  avr_register_io_write(avr, EECR, write_control, NULL);
}
