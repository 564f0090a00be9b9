/* Sends the causes of its start, and how many there were, from the EEPROM; feeds the watchdog for 200 ms, then not. */
#include "program.h"

#include <avr/eeprom.h>
#include <avr/wdt.h>
#include <util/delay.h>

int main(void) {
  const uint8_t causes = MCUSR;
  uint8_t starts;

  MCUSR = 0;
  wdt_disable();
  serial_begin();
  starts = (uint8_t)(eeprom_read_byte((const uint8_t *)5) + 1);
  eeprom_write_byte((uint8_t *)5, starts);
  serial_send(causes);
  serial_send(starts);
  wdt_enable(WDTO_60MS);
  for (uint8_t tens = 0; tens < 20; tens++) {
    _delay_ms(10);
    wdt_reset();
  }
  for (;;) {
  }
}
