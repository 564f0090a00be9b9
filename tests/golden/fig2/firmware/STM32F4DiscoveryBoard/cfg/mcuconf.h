/* Written by SenseDSL: clocks stay the demo's; units, DMA streams and the kernel's timer are this wiring's.
 * The kernel's time comes from TIM2. */
#ifndef SENSE_MCUCONF_H
#define SENSE_MCUCONF_H

#include UP_BASE_MCUCONF

#if !defined(STM32F407_MCUCONF)
#error "the demo's mcuconf.h in the ChibiOS tree does not say STM32F407_MCUCONF"
#endif

#undef STM32_SERIAL_USE_USART2
#define STM32_SERIAL_USE_USART2 FALSE

#undef STM32_ST_USE_TIMER
#define STM32_ST_USE_TIMER 2

#undef STM32_USB_USE_OTG1
#define STM32_USB_USE_OTG1 TRUE

#undef STM32_CLOCK48_REQUIRED
#define STM32_CLOCK48_REQUIRED TRUE

#undef STM32_ADC_USE_ADC1
#define STM32_ADC_USE_ADC1 TRUE

#undef STM32_I2C_USE_I2C3
#define STM32_I2C_USE_I2C3 TRUE

#undef STM32_ICU_USE_TIM3
#define STM32_ICU_USE_TIM3 TRUE

#undef STM32_ADC_ADC1_DMA_STREAM
#define STM32_ADC_ADC1_DMA_STREAM STM32_DMA_STREAM_ID(2, 4)

#undef STM32_I2C_I2C3_RX_DMA_STREAM
#define STM32_I2C_I2C3_RX_DMA_STREAM STM32_DMA_STREAM_ID(1, 2)

#undef STM32_I2C_I2C3_TX_DMA_STREAM
#define STM32_I2C_I2C3_TX_DMA_STREAM STM32_DMA_STREAM_ID(1, 4)

#endif
