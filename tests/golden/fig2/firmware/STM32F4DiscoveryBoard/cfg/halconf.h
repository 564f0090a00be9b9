/* Written by SenseDSL: the drivers in use, as changes to the demo's file in your ChibiOS tree. */
#ifndef SENSE_HALCONF_H
#define SENSE_HALCONF_H

/* First, because the demo's file would include its own sibling. */
#include "mcuconf.h"

#define HAL_USE_PAL TRUE
#define HAL_USE_ADC TRUE
#define HAL_USE_DAC FALSE
#define HAL_USE_I2C TRUE
#define HAL_USE_SPI FALSE
#define HAL_USE_ICU TRUE
#define HAL_USE_PWM FALSE
#define HAL_USE_SERIAL FALSE
#define HAL_USE_SERIAL_USB TRUE
#define HAL_USE_USB TRUE
#define HAL_USE_WDG TRUE
#define HAL_USE_CAN FALSE
#define HAL_USE_CRY FALSE
#define HAL_USE_EFL FALSE
#define HAL_USE_GPT FALSE
#define HAL_USE_I2S FALSE
#define HAL_USE_MAC FALSE
#define HAL_USE_MMC_SPI FALSE
#define HAL_USE_RTC FALSE
#define HAL_USE_SDC FALSE
#define HAL_USE_SIO FALSE
#define HAL_USE_TRNG FALSE
#define HAL_USE_UART FALSE
#define HAL_USE_WSPI FALSE
#define ADC_USE_WAIT TRUE
#define ADC_USE_MUTUAL_EXCLUSION TRUE
#define ADC_DRIVER_EXT_FIELDS uint32_t up_errors;
#define I2C_USE_MUTUAL_EXCLUSION TRUE
#define SPI_USE_WAIT TRUE
#define SPI_USE_MUTUAL_EXCLUSION TRUE
#define SPI_SELECT_MODE SPI_SELECT_MODE_LINE
#define SPI_USE_ASSERT_ON_ERROR FALSE
#define ICU_USE_OVERFLOW_SCALING FALSE
#define PAL_USE_CALLBACKS FALSE
#define PAL_USE_WAIT FALSE

#include UP_BASE_HALCONF

#endif
