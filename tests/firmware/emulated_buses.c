/*
 * The user's file of the emulated application with two buses. The registers of the first bus are memory that always
 * reads as "busy"; driver calls for the second bus end here, and answer with the number of bytes requested.
 */
#include "sense_model.h"
#include "up_rt.h"

#include <string.h>

static I2C_TypeDef stuck;

static THD_WORKING_AREA(pump_stack, 256);
static THD_WORKING_AREA(wheel_stack, 512);

msg_t __real_i2cMasterTransmitTimeout(I2CDriver *driver, i2caddr_t address, const uint8_t *tx, size_t tx_count,
                                      uint8_t *rx, size_t rx_count, sysinterval_t timeout);
msg_t __wrap_i2cMasterTransmitTimeout(I2CDriver *driver, i2caddr_t address, const uint8_t *tx, size_t tx_count,
                                      uint8_t *rx, size_t rx_count, sysinterval_t timeout);

msg_t __wrap_i2cMasterTransmitTimeout(I2CDriver *driver, i2caddr_t address, const uint8_t *tx, size_t tx_count,
                                      uint8_t *rx, size_t rx_count, sysinterval_t timeout) {
  if (driver != &I2CD2) {
    return __real_i2cMasterTransmitTimeout(driver, address, tx, tx_count, rx, rx_count, timeout);
  }
  memset(rx, (int)rx_count, rx_count);
  return MSG_OK;
}

/* The emulator raises no transmit interrupt, so a thread triggers it repeatedly. */
static THD_FUNCTION(pump, argument) {
  (void)argument;
  for (;;) {
    for (int i = 0; i < 20; i++) {
      nvicSetPending(STM32_USART1_NUMBER);
    }
    chThdSleepMilliseconds(1);
  }
}

/* The wheel always has something to report: the time. */
static THD_FUNCTION(wheel, argument) {
  (void)argument;
  for (;;) {
    uint32_t now_ms = up_now_ms();
    up_put(SENSE_FIELD_Wheel, &now_ms);
    chThdSleepMilliseconds(1);
  }
}

void up_user_init(void) {
  stuck.SR2 = I2C_SR2_BUSY;
  I2CD1.i2c = &stuck;
  (void)chThdCreateStatic(pump_stack, sizeof pump_stack, NORMALPRIO + 50, pump, NULL);
  (void)chThdCreateStatic(wheel_stack, sizeof wheel_stack, NORMALPRIO + 40, wheel, NULL);
}
