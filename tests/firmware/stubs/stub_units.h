/* A stub: see README.md. The driver objects: each exists only if mcuconf.h enables its unit, as in the tree. */
#ifndef STUB_UNITS_H
#define STUB_UNITS_H

/* Zero if an option is TRUE; an option that is missing or FALSE does not compile. */
#define STUB_ON(option) (0U * sizeof(char[((option) == TRUE) ? 1 : -1]))
/* The driver object with this number, from the objects of its type. */
#define STUB_OBJECT(objects, number, option) objects[(number) + STUB_ON(option)]

#if HAL_USE_ICU == TRUE
extern ICUDriver stub_icud[21];
#define ICUD1 STUB_OBJECT(stub_icud, 1U, STM32_ICU_USE_TIM1)
#define ICUD2 STUB_OBJECT(stub_icud, 2U, STM32_ICU_USE_TIM2)
#define ICUD3 STUB_OBJECT(stub_icud, 3U, STM32_ICU_USE_TIM3)
#define ICUD4 STUB_OBJECT(stub_icud, 4U, STM32_ICU_USE_TIM4)
#define ICUD5 STUB_OBJECT(stub_icud, 5U, STM32_ICU_USE_TIM5)
#define ICUD8 STUB_OBJECT(stub_icud, 8U, STM32_ICU_USE_TIM8)
#define ICUD9 STUB_OBJECT(stub_icud, 9U, STM32_ICU_USE_TIM9)
#define ICUD10 STUB_OBJECT(stub_icud, 10U, STM32_ICU_USE_TIM10)
#define ICUD11 STUB_OBJECT(stub_icud, 11U, STM32_ICU_USE_TIM11)
#define ICUD12 STUB_OBJECT(stub_icud, 12U, STM32_ICU_USE_TIM12)
#define ICUD13 STUB_OBJECT(stub_icud, 13U, STM32_ICU_USE_TIM13)
#define ICUD14 STUB_OBJECT(stub_icud, 14U, STM32_ICU_USE_TIM14)
#define ICUD15 STUB_OBJECT(stub_icud, 15U, STM32_ICU_USE_TIM15)
#define ICUD16 STUB_OBJECT(stub_icud, 16U, STM32_ICU_USE_TIM16)
#define ICUD17 STUB_OBJECT(stub_icud, 17U, STM32_ICU_USE_TIM17)
#define ICUD20 STUB_OBJECT(stub_icud, 20U, STM32_ICU_USE_TIM20)
#endif

#if HAL_USE_PWM == TRUE
extern PWMDriver stub_pwmd[21];
#define PWMD1 STUB_OBJECT(stub_pwmd, 1U, STM32_PWM_USE_TIM1)
#define PWMD2 STUB_OBJECT(stub_pwmd, 2U, STM32_PWM_USE_TIM2)
#define PWMD3 STUB_OBJECT(stub_pwmd, 3U, STM32_PWM_USE_TIM3)
#define PWMD4 STUB_OBJECT(stub_pwmd, 4U, STM32_PWM_USE_TIM4)
#define PWMD5 STUB_OBJECT(stub_pwmd, 5U, STM32_PWM_USE_TIM5)
#define PWMD8 STUB_OBJECT(stub_pwmd, 8U, STM32_PWM_USE_TIM8)
#define PWMD9 STUB_OBJECT(stub_pwmd, 9U, STM32_PWM_USE_TIM9)
#define PWMD10 STUB_OBJECT(stub_pwmd, 10U, STM32_PWM_USE_TIM10)
#define PWMD11 STUB_OBJECT(stub_pwmd, 11U, STM32_PWM_USE_TIM11)
#define PWMD12 STUB_OBJECT(stub_pwmd, 12U, STM32_PWM_USE_TIM12)
#define PWMD13 STUB_OBJECT(stub_pwmd, 13U, STM32_PWM_USE_TIM13)
#define PWMD14 STUB_OBJECT(stub_pwmd, 14U, STM32_PWM_USE_TIM14)
#define PWMD15 STUB_OBJECT(stub_pwmd, 15U, STM32_PWM_USE_TIM15)
#define PWMD16 STUB_OBJECT(stub_pwmd, 16U, STM32_PWM_USE_TIM16)
#define PWMD17 STUB_OBJECT(stub_pwmd, 17U, STM32_PWM_USE_TIM17)
#define PWMD20 STUB_OBJECT(stub_pwmd, 20U, STM32_PWM_USE_TIM20)
#endif

/* On STM32H7, the first two converters share an object. */
#if HAL_USE_ADC == TRUE
extern ADCDriver stub_adcd[6];
#if STUB_ADC == 4
#define ADCD1 STUB_OBJECT(stub_adcd, 1U, STM32_ADC_USE_ADC12)
#else
#define ADCD1 STUB_OBJECT(stub_adcd, 1U, STM32_ADC_USE_ADC1)
#define ADCD2 STUB_OBJECT(stub_adcd, 2U, STM32_ADC_USE_ADC2)
#endif
#define ADCD3 STUB_OBJECT(stub_adcd, 3U, STM32_ADC_USE_ADC3)
#define ADCD4 STUB_OBJECT(stub_adcd, 4U, STM32_ADC_USE_ADC4)
#define ADCD5 STUB_OBJECT(stub_adcd, 5U, STM32_ADC_USE_ADC5)
#endif

/* Each DAC output has an object. */
#if HAL_USE_DAC == TRUE
extern DACDriver stub_dacd[5];
#define DACD1 STUB_OBJECT(stub_dacd, 1U, STM32_DAC_USE_DAC1_CH1)
#define DACD2 STUB_OBJECT(stub_dacd, 2U, STM32_DAC_USE_DAC1_CH2)
#define DACD3 STUB_OBJECT(stub_dacd, 3U, STM32_DAC_USE_DAC2_CH1)
#define DACD4 STUB_OBJECT(stub_dacd, 4U, STM32_DAC_USE_DAC2_CH2)
#endif

#if HAL_USE_I2C == TRUE
extern I2CDriver stub_i2cd[5];
#define I2CD1 STUB_OBJECT(stub_i2cd, 1U, STM32_I2C_USE_I2C1)
#define I2CD2 STUB_OBJECT(stub_i2cd, 2U, STM32_I2C_USE_I2C2)
#define I2CD3 STUB_OBJECT(stub_i2cd, 3U, STM32_I2C_USE_I2C3)
#define I2CD4 STUB_OBJECT(stub_i2cd, 4U, STM32_I2C_USE_I2C4)
#endif

#if HAL_USE_SPI == TRUE
extern SPIDriver stub_spid[7];
#define SPID1 STUB_OBJECT(stub_spid, 1U, STM32_SPI_USE_SPI1)
#define SPID2 STUB_OBJECT(stub_spid, 2U, STM32_SPI_USE_SPI2)
#define SPID3 STUB_OBJECT(stub_spid, 3U, STM32_SPI_USE_SPI3)
#define SPID4 STUB_OBJECT(stub_spid, 4U, STM32_SPI_USE_SPI4)
#define SPID5 STUB_OBJECT(stub_spid, 5U, STM32_SPI_USE_SPI5)
#define SPID6 STUB_OBJECT(stub_spid, 6U, STM32_SPI_USE_SPI6)
#endif

#if HAL_USE_CAN == TRUE
extern CANDriver stub_cand[4];
#if defined(STUB_FDCAN)
#define CAND1 STUB_OBJECT(stub_cand, 1U, STM32_CAN_USE_FDCAN1)
#define CAND2 STUB_OBJECT(stub_cand, 2U, STM32_CAN_USE_FDCAN2)
#define CAND3 STUB_OBJECT(stub_cand, 3U, STM32_CAN_USE_FDCAN3)
#else
#define CAND1 STUB_OBJECT(stub_cand, 1U, STM32_CAN_USE_CAN1)
#define CAND2 STUB_OBJECT(stub_cand, 2U, STM32_CAN_USE_CAN2)
#define CAND3 STUB_OBJECT(stub_cand, 3U, STM32_CAN_USE_CAN3)
#endif
#endif

#if HAL_USE_SERIAL == TRUE
extern SerialDriver stub_sd[13];
#define SD1 STUB_OBJECT(stub_sd, 1U, STM32_SERIAL_USE_USART1)
#define SD2 STUB_OBJECT(stub_sd, 2U, STM32_SERIAL_USE_USART2)
#define SD3 STUB_OBJECT(stub_sd, 3U, STM32_SERIAL_USE_USART3)
#define SD4 STUB_OBJECT(stub_sd, 4U, STM32_SERIAL_USE_UART4)
#define SD5 STUB_OBJECT(stub_sd, 5U, STM32_SERIAL_USE_UART5)
#define SD6 STUB_OBJECT(stub_sd, 6U, STM32_SERIAL_USE_USART6)
#define SD7 STUB_OBJECT(stub_sd, 7U, STM32_SERIAL_USE_UART7)
#define SD8 STUB_OBJECT(stub_sd, 8U, STM32_SERIAL_USE_UART8)
#define SD9 STUB_OBJECT(stub_sd, 9U, STM32_SERIAL_USE_UART9)
#if defined(STM32_SERIAL_USE_UART10)
#define SD10 STUB_OBJECT(stub_sd, 10U, STM32_SERIAL_USE_UART10)
#else
#define SD10 STUB_OBJECT(stub_sd, 10U, STM32_SERIAL_USE_USART10)
#endif
#define LPSD1 STUB_OBJECT(stub_sd, 11U, STM32_SERIAL_USE_LPUART1)
#define LPSD2 STUB_OBJECT(stub_sd, 12U, STM32_SERIAL_USE_LPUART2)
#endif

#if HAL_USE_USB == TRUE
extern USBDriver stub_usbd[3];
#if defined(STM32_USB_USE_OTG1) || defined(STM32_USB_USE_OTG2)
#define USBD1 STUB_OBJECT(stub_usbd, 1U, STM32_USB_USE_OTG1)
#define USBD2 STUB_OBJECT(stub_usbd, 2U, STM32_USB_USE_OTG2)
#else
#define USBD1 STUB_OBJECT(stub_usbd, 1U, STM32_USB_USE_USB1)
#endif
#endif

#endif
