/*
 * A stub of ChibiOS/HAL's interface on STM32, written from our own use of it: see README.md. It compiles but does not
 * run, and it proves nothing about ChibiOS.
 */
#ifndef HAL_H
#define HAL_H

#include "ch.h"

#include "halconf.h"
#include "mcuconf.h"

#if !defined(HAL_USE_ADC)
#define HAL_USE_ADC FALSE
#endif
#if !defined(HAL_USE_CAN)
#define HAL_USE_CAN FALSE
#endif
#if !defined(HAL_USE_DAC)
#define HAL_USE_DAC FALSE
#endif
#if !defined(HAL_USE_I2C)
#define HAL_USE_I2C FALSE
#endif
#if !defined(HAL_USE_ICU)
#define HAL_USE_ICU FALSE
#endif
#if !defined(HAL_USE_PWM)
#define HAL_USE_PWM FALSE
#endif
#if !defined(HAL_USE_SERIAL)
#define HAL_USE_SERIAL FALSE
#endif
#if !defined(HAL_USE_SERIAL_USB)
#define HAL_USE_SERIAL_USB FALSE
#endif
#if !defined(HAL_USE_SPI)
#define HAL_USE_SPI FALSE
#endif
#if !defined(HAL_USE_USB)
#define HAL_USE_USB FALSE
#endif
#if !defined(PAL_USE_CALLBACKS)
#define PAL_USE_CALLBACKS FALSE
#endif

/* Clocks that a board's facts may leave out; the values of a demo are then not known here. */
#if !defined(STM32_HCLK)
#define STM32_HCLK 64000000U
#endif
#if !defined(STM32_TIM1CLK)
#define STM32_TIM1CLK 64000000U
#endif
#if !defined(STM32_TIMCLK1)
#define STM32_TIMCLK1 64000000U
#endif
#if !defined(STM32_TIMCLK2)
#define STM32_TIMCLK2 64000000U
#endif
#if defined(STUB_FDCAN) && !defined(STM32_FDCANCLK)
#define STM32_FDCANCLK 80000000U
#endif
#if defined(STUB_H7) && !defined(STM32_CORE_CK)
#define STM32_CORE_CK 400000000U
#endif

/* The clock sources of buses, as the demos choose them; by family, without the constants for the bus's own clock. */
#if defined(STUB_G0)
#define STM32_I2C1SEL_PCLK 0U
#define STM32_I2C1SEL STM32_I2C1SEL_PCLK
#elif defined(STUB_G4)
#define STM32_I2C1SEL_PCLK1 0U
#define STM32_I2C1SEL STM32_I2C1SEL_PCLK1
#define STM32_I2C2SEL_PCLK1 0U
#define STM32_I2C2SEL STM32_I2C2SEL_PCLK1
#define STM32_I2C3SEL_PCLK1 0U
#define STM32_I2C3SEL STM32_I2C3SEL_PCLK1
#define STM32_I2C4SEL_PCLK1 0U
#define STM32_I2C4SEL STM32_I2C4SEL_PCLK1
#elif defined(STUB_L4) && STUB_I2C == 4
#define STM32_I2C1SEL_SYSCLK 1U
#define STM32_I2C1SEL STM32_I2C1SEL_SYSCLK
#define STM32_I2C2SEL_SYSCLK 1U
#define STM32_I2C2SEL STM32_I2C2SEL_SYSCLK
#define STM32_I2C3SEL_SYSCLK 1U
#define STM32_I2C3SEL STM32_I2C3SEL_SYSCLK
#define STM32_I2C4SEL_SYSCLK 1U
#define STM32_I2C4SEL STM32_I2C4SEL_SYSCLK
#endif

void halInit(void);
void cacheBufferFlush(const void *address, size_t bytes);
void cacheBufferInvalidate(const void *address, size_t bytes);
msg_t osalThreadSuspendTimeoutS(thread_reference_t *reference, sysinterval_t timeout);
void osalSysLock(void);
void osalSysUnlock(void);

#include "stub_core.h"

/* ---- pads ---- */

typedef uint32_t ioline_t;
typedef uint32_t iomode_t;
typedef uint32_t ioeventmode_t;
typedef void (*palcallback_t)(void *parameter);
#define STUB_PORT(n) (0x48000000U + 0x400U * (n))
#define GPIOA STUB_PORT(0U)
#define GPIOB STUB_PORT(1U)
#define GPIOC STUB_PORT(2U)
#define GPIOD STUB_PORT(3U)
#define GPIOE STUB_PORT(4U)
#define GPIOF STUB_PORT(5U)
#define GPIOG STUB_PORT(6U)
#define GPIOH STUB_PORT(7U)
#define GPIOI STUB_PORT(8U)
#define GPIOJ STUB_PORT(9U)
#define GPIOK STUB_PORT(10U)
#define PAL_LINE(port, pad) ((ioline_t)((port) | (uint32_t)(pad)))
#define PAL_LOW 0U
#define PAL_HIGH 1U
#define PAL_MODE_INPUT 1U
#define PAL_MODE_INPUT_PULLUP 2U
#define PAL_MODE_INPUT_PULLDOWN 3U
#define PAL_MODE_INPUT_ANALOG 4U
#define PAL_MODE_OUTPUT_PUSHPULL 5U
#define PAL_MODE_OUTPUT_OPENDRAIN 6U
#define PAL_EVENT_MODE_RISING_EDGE 1U
#define PAL_EVENT_MODE_FALLING_EDGE 2U
#define PAL_EVENT_MODE_BOTH_EDGES 3U
#if STUB_GPIO == 1
/* The pads of STM32F1 have no numbered alternate functions. */
#define PAL_MODE_STM32_ALTERNATE_PUSHPULL 16U
#define PAL_MODE_STM32_ALTERNATE_OPENDRAIN 17U
typedef struct {
  volatile uint32_t EVCR, MAPR, EXTICR[4], MAPR2;
} AFIO_TypeDef;
extern AFIO_TypeDef stub_afio;
#define AFIO (&stub_afio)
#define AFIO_MAPR_SWJ_CFG 0x7000000U
#define AFIO_MAPR_SWJ_CFG_JTAGDISABLE 0x2000000U
/* A field, with its width and position. */
#define STUB_FIELD(bits, position) ((uint32_t)(bits) << (position))
#define AFIO_MAPR_SPI1_REMAP_Pos 0U
#define AFIO_MAPR_SPI1_REMAP STUB_FIELD(1U, AFIO_MAPR_SPI1_REMAP_Pos)
#define AFIO_MAPR_I2C1_REMAP_Pos 1U
#define AFIO_MAPR_I2C1_REMAP STUB_FIELD(1U, AFIO_MAPR_I2C1_REMAP_Pos)
#define AFIO_MAPR_USART1_REMAP_Pos 2U
#define AFIO_MAPR_USART1_REMAP STUB_FIELD(1U, AFIO_MAPR_USART1_REMAP_Pos)
#define AFIO_MAPR_USART2_REMAP_Pos 3U
#define AFIO_MAPR_USART2_REMAP STUB_FIELD(1U, AFIO_MAPR_USART2_REMAP_Pos)
#define AFIO_MAPR_USART3_REMAP_Pos 4U
#define AFIO_MAPR_USART3_REMAP STUB_FIELD(3U, AFIO_MAPR_USART3_REMAP_Pos)
#define AFIO_MAPR_TIM1_REMAP_Pos 6U
#define AFIO_MAPR_TIM1_REMAP STUB_FIELD(3U, AFIO_MAPR_TIM1_REMAP_Pos)
#define AFIO_MAPR_TIM2_REMAP_Pos 8U
#define AFIO_MAPR_TIM2_REMAP STUB_FIELD(3U, AFIO_MAPR_TIM2_REMAP_Pos)
#define AFIO_MAPR_TIM3_REMAP_Pos 10U
#define AFIO_MAPR_TIM3_REMAP STUB_FIELD(3U, AFIO_MAPR_TIM3_REMAP_Pos)
#define AFIO_MAPR_TIM4_REMAP_Pos 12U
#define AFIO_MAPR_TIM4_REMAP STUB_FIELD(1U, AFIO_MAPR_TIM4_REMAP_Pos)
#define AFIO_MAPR_CAN_REMAP_Pos 13U
#define AFIO_MAPR_CAN_REMAP STUB_FIELD(3U, AFIO_MAPR_CAN_REMAP_Pos)
#else
#define PAL_MODE_ALTERNATE(n) (8U | ((uint32_t)(n) << 7))
#define PAL_STM32_OTYPE_OPENDRAIN 0x1000U
#define PAL_STM32_OSPEED_HIGHEST 0x2000U
#define PAL_STM32_PUPDR_PULLUP 0x4000U
#define PAL_STM32_PUPDR_PULLDOWN 0x8000U
#endif
#define PAL_NOLINE 0U
void palSetLineMode(ioline_t line, iomode_t mode);
void palSetLine(ioline_t line);
void palClearLine(ioline_t line);
void palToggleLine(ioline_t line);
void palWriteLine(ioline_t line, uint8_t bit);
uint8_t palReadLine(ioline_t line);
void palSetLineCallback(ioline_t line, palcallback_t callback, void *parameter);
void palEnableLineEvent(ioline_t line, ioeventmode_t mode);
void palDisableLineEvent(ioline_t line);

/* ---- timers ---- */

typedef struct {
  volatile uint32_t CR1, CR2, SMCR, DIER, SR, EGR, CCMR1, CCMR2, CCER, CNT, PSC, ARR, RCR, CCR[4], BDTR;
} stm32_tim_t;
extern stm32_tim_t stub_timers[21];
#define STM32_TIM1 (&stub_timers[1])
#define STM32_TIM2 (&stub_timers[2])
#define STM32_TIM3 (&stub_timers[3])
#define STM32_TIM4 (&stub_timers[4])
#define STM32_TIM5 (&stub_timers[5])
#define STM32_TIM8 (&stub_timers[8])
#define STM32_TIM9 (&stub_timers[9])
#define STM32_TIM12 (&stub_timers[12])
#define STM32_TIM15 (&stub_timers[15])
#define STM32_TIM20 (&stub_timers[20])
#define STM32_TIM1_CHANNELS 6
#define STM32_TIM2_CHANNELS 4
#define STM32_TIM3_CHANNELS 4
#define STM32_TIM4_CHANNELS 4
#define STM32_TIM5_CHANNELS 4
#define STM32_TIM8_CHANNELS 6
#define STM32_TIM9_CHANNELS 2
#define STM32_TIM10_CHANNELS 1
#define STM32_TIM11_CHANNELS 1
#define STM32_TIM12_CHANNELS 2
#define STM32_TIM13_CHANNELS 1
#define STM32_TIM14_CHANNELS 1
#define STM32_TIM15_CHANNELS 2
#define STM32_TIM16_CHANNELS 2
#define STM32_TIM17_CHANNELS 2
#define STM32_TIM20_CHANNELS 6
#define STM32_TIM_CR1_CEN 1U
#define STM32_TIM_CR1_UDIS 2U
#define STM32_TIM_CR1_URS 4U
#define STM32_TIM_CR1_OPM 8U
#define STM32_TIM_EGR_UG 1U
#define STM32_TIM_SMCR_SMS(n) ((uint32_t)(n))
#define STM32_TIM_CCMR1_CC1S(n) ((uint32_t)(n))
#define STM32_TIM_CCMR1_CC2S(n) ((uint32_t)(n) << 8)
#define STM32_TIM_CCMR1_IC1F(n) ((uint32_t)(n) << 4)
#define STM32_TIM_CCMR1_IC2F(n) ((uint32_t)(n) << 12)
#define STM32_TIM_CCMR1_OC1PE 8U
#define STM32_TIM_CCMR1_OC2PE 0x800U

void rccEnableTIM1(bool in_sleep);
void rccResetTIM1(void);
void rccEnableTIM2(bool in_sleep);
void rccResetTIM2(void);
void rccEnableTIM3(bool in_sleep);
void rccResetTIM3(void);
void rccEnableTIM4(bool in_sleep);
void rccResetTIM4(void);
void rccEnableTIM5(bool in_sleep);
void rccResetTIM5(void);
void rccEnableTIM8(bool in_sleep);
void rccResetTIM8(void);
void rccEnableTIM20(bool in_sleep);
void rccResetTIM20(void);

/* ---- DMA ---- */

#define STM32_DMA_STREAM_ID(controller, stream) (8U * ((controller) - 1U) + (stream))
#define STM32_DMA_STREAM_ID_ANY 255U
#define STM32_DMA_STREAM_ID_MSK(controller, stream) (1U << STM32_DMA_STREAM_ID(controller, stream))

/* ---- analog in ---- */

#include "stub_adc.h"

#if HAL_USE_ADC == TRUE
typedef uint16_t adcsample_t;
typedef uint16_t adc_channels_num_t;
typedef uint32_t adcerror_t;
#define ADC_ACTIVE 3
typedef struct stub_adc ADCDriver;
typedef void (*adccallback_t)(ADCDriver *driver);
typedef void (*adcerrorcallback_t)(ADCDriver *driver, adcerror_t error);
typedef struct {
  uint32_t difsel;
} ADCConfig;
typedef struct {
  bool circular;
  adc_channels_num_t num_channels;
  adccallback_t end_cb;
  adcerrorcallback_t error_cb;
#if STUB_ADC == 2 /* and STM32F1's own, which has no first control register of ours */
  uint32_t cr1, cr2, smpr1, smpr2, sqr1, sqr2, sqr3;
#elif STUB_ADC == 3
  uint32_t cfgr, cfgr2, tr1, tr2, tr3, awd2cr, awd3cr, smpr[2], sqr[4];
#elif STUB_ADC == 4
  uint32_t cfgr, cfgr2, ccr, pcsel, ltr1, htr1, ltr2, htr2, ltr3, htr3, awd2cr, awd3cr, smpr[2], sqr[4];
#else
  uint32_t cfgr1, cfgr2, tr, tr1, tr2, tr3, smpr, chselr;
#endif
} ADCConversionGroup;
struct stub_adc {
  int state;
  thread_reference_t thread;
#if defined(ADC_DRIVER_EXT_FIELDS)
  ADC_DRIVER_EXT_FIELDS
#endif
};
msg_t adcStart(ADCDriver *driver, const ADCConfig *config);
msg_t adcConvert(ADCDriver *driver, const ADCConversionGroup *group, adcsample_t *samples, size_t depth);
void adcStartConversion(ADCDriver *driver, const ADCConversionGroup *group, adcsample_t *samples, size_t depth);
void adcStartConversionI(ADCDriver *driver, const ADCConversionGroup *group, adcsample_t *samples, size_t depth);
void adcStopConversion(ADCDriver *driver);
void adcAcquireBus(ADCDriver *driver);
void adcReleaseBus(ADCDriver *driver);
#endif

/* ---- analog out ---- */

#if HAL_USE_DAC == TRUE
typedef struct stub_dac {
  int state;
} DACDriver;
typedef uint16_t dacsample_t;
typedef enum { DAC_DHRM_12BIT_RIGHT = 0, DAC_DHRM_12BIT_LEFT = 1 } dacdhrmode_t;
typedef struct {
  dacsample_t init;
  dacdhrmode_t datamode;
  uint32_t cr;
} DACConfig;
msg_t dacStart(DACDriver *driver, const DACConfig *config);
msg_t dacPutChannelX(DACDriver *driver, uint32_t channel, dacsample_t sample);
#endif

/* ---- capture and pulses ---- */

#if HAL_USE_ICU == TRUE
typedef uint32_t icufreq_t;
typedef uint32_t icucnt_t;
typedef struct stub_icu ICUDriver;
typedef void (*icucallback_t)(ICUDriver *driver);
typedef enum { ICU_INPUT_ACTIVE_HIGH, ICU_INPUT_ACTIVE_LOW } icumode_t;
typedef enum { ICU_CHANNEL_1, ICU_CHANNEL_2 } icuchannel_t;
typedef enum { ICU_UNINIT, ICU_STOP, ICU_READY, ICU_WAITING, ICU_ACTIVE } icustate_t;
typedef struct {
  icumode_t mode;
  icufreq_t frequency;
  icucallback_t width_cb, period_cb, overflow_cb;
  icuchannel_t channel;
  uint32_t dier, arr;
} ICUConfig;
struct stub_icu {
  icustate_t state;
  const ICUConfig *config;
  stm32_tim_t *tim;
};
msg_t icuStart(ICUDriver *driver, const ICUConfig *config);
void icuStartCapture(ICUDriver *driver);
void icuEnableNotifications(ICUDriver *driver);
icucnt_t icuGetWidthX(ICUDriver *driver);
icucnt_t icuGetPeriodX(ICUDriver *driver);
#endif

#if HAL_USE_PWM == TRUE
typedef uint32_t pwmcnt_t;
typedef uint32_t pwmmode_t;
typedef uint8_t pwmchannel_t;
typedef struct stub_pwm PWMDriver;
typedef void (*pwmcallback_t)(PWMDriver *driver);
typedef struct {
  pwmmode_t mode;
  pwmcallback_t callback;
} PWMChannelConfig;
#define PWM_CHANNELS 6
typedef struct {
  uint32_t frequency;
  pwmcnt_t period;
  pwmcallback_t callback;
  PWMChannelConfig channels[PWM_CHANNELS];
  uint32_t cr2, bdtr, dier;
} PWMConfig;
struct stub_pwm {
  int state;
  const PWMConfig *config;
  stm32_tim_t *tim;
};
#define PWM_OUTPUT_DISABLED 0U
#define PWM_OUTPUT_ACTIVE_HIGH 1U
#define PWM_OUTPUT_ACTIVE_LOW 2U
#define PWM_COMPLEMENTARY_OUTPUT_ACTIVE_HIGH 16U
#define PWM_COMPLEMENTARY_OUTPUT_ACTIVE_LOW 32U
msg_t pwmStart(PWMDriver *driver, const PWMConfig *config);
void pwmEnableChannel(PWMDriver *driver, pwmchannel_t channel, pwmcnt_t width);
void pwmEnableChannelI(PWMDriver *driver, pwmchannel_t channel, pwmcnt_t width);
void pwmEnablePeriodicNotification(PWMDriver *driver);
#endif

#include "stub_buses.h"
#include "stub_links.h"

/* ---- watchdog ---- */

#define STM32_IWDG_IS_WINDOWED STUB_WINDOWED
#define STM32_IWDG_WIN_DISABLED 0xFFFU
typedef struct stub_wdg {
  int state;
} WDGDriver;
typedef struct {
  uint32_t pr, rlr;
#if STUB_WINDOWED == 1
  uint32_t winr;
#endif
} WDGConfig;
extern WDGDriver WDGD1;
msg_t wdgStart(WDGDriver *driver, const WDGConfig *config);
void wdgReset(WDGDriver *driver);

#include "stub_units.h"

/* The core's own timer, which CMSIS has. */
typedef struct {
  volatile uint32_t CTRL;
  volatile uint32_t LOAD;
  volatile uint32_t VAL;
} stub_systick_t;
extern stub_systick_t stub_systick;
#define SysTick (&stub_systick)
#define SysTick_CTRL_ENABLE_Msk 1U
#define SysTick_CTRL_CLKSOURCE_Msk 4U
#define SysTick_LOAD_RELOAD_Msk 0xFFFFFFU

#endif
