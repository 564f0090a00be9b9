/*
 * The user's file of the emulated application. The emulator raises no transmit interrupt, so a thread triggers it
 * repeatedly. The hooks leave traces that the test looks for.
 */
#include "sense_model.h"
#include "up_rt.h"

static THD_WORKING_AREA(pump_stack, 256);

static THD_FUNCTION(pump, argument) {
  (void)argument;
  for (;;) {
    for (int i = 0; i < 20; i++) {
      nvicSetPending(STM32_USART1_NUMBER);
    }
    chThdSleepMilliseconds(1);
  }
}

void up_user_init(void) {
  (void)chThdCreateStatic(pump_stack, sizeof pump_stack, NORMALPRIO + 50, pump, NULL);
}

/* A wheel at rest is reported as 7. */
void sense_transform_Wheel(uint32_t *value) {
  *value += 7U;
}

/* A value that the host sets comes back incremented. */
void up_user_received(size_t field) {
  uint8_t lamp = 0U;

  if (field == SENSE_FIELD_Lamp && up_get(field, &lamp)) {
    lamp++;
    up_put(SENSE_FIELD_Echo, &lamp);
  }
}
