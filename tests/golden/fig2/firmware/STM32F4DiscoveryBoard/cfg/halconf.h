/* Written by SenseDSL: the drivers in use, as changes to the demo's file in your ChibiOS tree. */
#ifndef SENSE_HALCONF_H
#define SENSE_HALCONF_H

/* First, because the demo's file would include its own sibling. */
#include "mcuconf.h"

#define HAL_USE_PAL TRUE
#define HAL_USE_ADC TRUE
#define HAL_USE_DAC FALSE
#define HAL_USE_I2C TRUE
#define HAL_USE_ICU TRUE
#define HAL_USE_SERIAL FALSE
#define HAL_USE_SERIAL_USB TRUE
#define HAL_USE_USB TRUE
#define ADC_USE_WAIT TRUE
#define ADC_USE_MUTUAL_EXCLUSION TRUE
#define ADC_DRIVER_EXT_FIELDS uint32_t up_errors;
#define I2C_USE_MUTUAL_EXCLUSION TRUE
#define ICU_USE_OVERFLOW_SCALING FALSE

#include UP_BASE_HALCONF

#endif
