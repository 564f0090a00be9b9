/*
 * A stub of ChibiOS/HAL's interface on STM32, written from our own use of it: see README.md. It compiles, it does not
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
#if !defined(HAL_USE_SPI)
#define HAL_USE_SPI FALSE
#endif

/* Eight objects of a driver, numbered from 1, as far as any MCU has them. */
#define STUB_DRIVERS(type, name)                                                                             \
  extern type name##1, name##2, name##3, name##4, name##5, name##6, name##7, name##8, name##9, name##10,     \
      name##11, name##12, name##13, name##14, name##15, name##16, name##17, name##20

/* Clocks that a board's facts may leave out: what a demo has is then not known here. */
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

void halInit(void);
void cacheBufferFlush(const void *address, size_t bytes);
void cacheBufferInvalidate(const void *address, size_t bytes);
msg_t osalThreadSuspendTimeoutS(thread_reference_t *reference, sysinterval_t timeout);
void osalSysLock(void);
void osalSysUnlock(void);

/* ---- registers of the core and the clock ---- */

typedef struct {
  volatile uint32_t CR, CFGR, CSR, RSR, APB1ENR, APB2ENR, AHBENR;
} stub_rcc_t;
extern stub_rcc_t stub_rcc;
#define RCC (&stub_rcc)
#if STUB_H7 == 1
#define RCC_RSR_RMVF 1U
#define RCC_RSR_IWDG1RSTF 2U
#define RCC_RSR_WWDG1RSTF 4U
#define RCC_RSR_SFTRSTF 8U
#define RCC_RSR_LPWRRSTF 16U
#define RCC_RSR_PORRSTF 32U
#define RCC_RSR_BORRSTF 64U
#define RCC_RSR_PINRSTF 128U
#else
#define RCC_CSR_RMVF 1U
#define RCC_CSR_IWDGRSTF 2U
#define RCC_CSR_WWDGRSTF 4U
#define RCC_CSR_SFTRSTF 8U
#define RCC_CSR_LPWRRSTF 16U
#define RCC_CSR_PORRSTF 32U
#define RCC_CSR_PINRSTF 128U
#endif
void NVIC_SystemReset(void);

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
/* The pads of STM32F1 have no alternate functions by number. */
#define PAL_MODE_STM32_ALTERNATE_PUSHPULL 16U
#define PAL_MODE_STM32_ALTERNATE_OPENDRAIN 17U
typedef struct {
  volatile uint32_t EVCR, MAPR, EXTICR[4], MAPR2;
} stub_afio_t;
extern stub_afio_t stub_afio;
#define AFIO (&stub_afio)
#else
#define PAL_MODE_ALTERNATE(n) (8U | ((uint32_t)(n) << 7))
#define PAL_STM32_OTYPE_OPENDRAIN 0x1000U
#define PAL_STM32_OSPEED_HIGHEST 0x2000U
#define PAL_STM32_PUPDR_PULLUP 0x4000U
#define PAL_STM32_PUPDR_PULLDOWN 0x8000U
#endif
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
#define STM32_TIM_EGR_UG 1U
#define STM32_TIM_SMCR_SMS(n) ((uint32_t)(n))
#define STM32_TIM_CCMR1_CC1S(n) ((uint32_t)(n))
#define STM32_TIM_CCMR1_CC2S(n) ((uint32_t)(n) << 8)
#define STM32_TIM_CCMR1_IC1F(n) ((uint32_t)(n) << 4)
#define STM32_TIM_CCMR1_IC2F(n) ((uint32_t)(n) << 12)
#define STM32_TIM_CCMR1_OC1PE 8U
#define STM32_TIM_CCMR1_OC2PE 0x800U

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
STUB_DRIVERS(ADCDriver, ADCD);
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
STUB_DRIVERS(DACDriver, DACD);
msg_t dacStart(DACDriver *driver, const DACConfig *config);
msg_t dacPutChannelX(DACDriver *driver, uint32_t channel, dacsample_t sample);
#endif

/* ---- I2C ---- */

#if HAL_USE_I2C == TRUE
typedef uint16_t i2caddr_t;
typedef uint32_t i2cflags_t;
typedef struct stub_i2c {
  int state;
} I2CDriver;
typedef struct {
#if STUB_I2C == 1
  int op_mode;
  uint32_t clock_speed;
  int duty_cycle;
#else
  uint32_t timingr, cr1, cr2;
#endif
} I2CConfig;
#define OPMODE_I2C 1
#define STD_DUTY_CYCLE 1
#define FAST_DUTY_CYCLE_2 2
#define FAST_DUTY_CYCLE_16_9 3
#define STM32_TIMINGR_PRESC(n) ((uint32_t)(n) << 28)
#define STM32_TIMINGR_SCLDEL(n) ((uint32_t)(n) << 20)
#define STM32_TIMINGR_SDADEL(n) ((uint32_t)(n) << 16)
#define STM32_TIMINGR_SCLH(n) ((uint32_t)(n) << 8)
#define STM32_TIMINGR_SCLL(n) ((uint32_t)(n))
#define I2C_NO_ERROR 0U
#define I2C_BUS_ERROR 1U
#define I2C_ARBITRATION_LOST 2U
#define I2C_ACK_FAILURE 4U
#define I2C_OVERRUN 8U
#define I2C_TIMEOUT 32U
STUB_DRIVERS(I2CDriver, I2CD);
msg_t i2cStart(I2CDriver *driver, const I2CConfig *config);
void i2cStop(I2CDriver *driver);
i2cflags_t i2cGetErrors(I2CDriver *driver);
msg_t i2cMasterTransmitTimeout(I2CDriver *driver, i2caddr_t address, const uint8_t *out, size_t out_bytes,
                               uint8_t *in, size_t in_bytes, sysinterval_t timeout);
msg_t i2cMasterReceiveTimeout(I2CDriver *driver, i2caddr_t address, uint8_t *in, size_t in_bytes,
                              sysinterval_t timeout);
void i2cAcquireBus(I2CDriver *driver);
void i2cReleaseBus(I2CDriver *driver);
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
STUB_DRIVERS(ICUDriver, ICUD);
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
STUB_DRIVERS(PWMDriver, PWMD);
msg_t pwmStart(PWMDriver *driver, const PWMConfig *config);
void pwmEnableChannel(PWMDriver *driver, pwmchannel_t channel, pwmcnt_t width);
void pwmEnableChannelI(PWMDriver *driver, pwmchannel_t channel, pwmcnt_t width);
#endif

/* ---- SPI ---- */

#if HAL_USE_SPI == TRUE
typedef struct stub_spi {
  int state;
} SPIDriver;
typedef struct {
  bool circular, slave;
  void (*data_cb)(SPIDriver *driver);
  void (*error_cb)(SPIDriver *driver);
  ioline_t ssline;
#if STUB_SPI == 3
  uint32_t cfg1, cfg2;
#else
  uint32_t cr1, cr2;
#endif
} SPIConfig;
#define SPI_SELECT_MODE_LINE 2
#define SPI_CR1_CPHA 1U
#define SPI_CR1_CPOL 2U
#define SPI_CR1_BR_Pos 3U
STUB_DRIVERS(SPIDriver, SPID);
msg_t spiStart(SPIDriver *driver, const SPIConfig *config);
void spiSelect(SPIDriver *driver);
void spiUnselect(SPIDriver *driver);
msg_t spiExchange(SPIDriver *driver, size_t bytes, const void *out, void *in);
msg_t spiSend(SPIDriver *driver, size_t bytes, const void *out);
msg_t spiReceive(SPIDriver *driver, size_t bytes, void *in);
void spiAcquireBus(SPIDriver *driver);
void spiReleaseBus(SPIDriver *driver);
#endif

#include "stub_links.h"

/* ---- CAN ---- */

#if HAL_USE_CAN == TRUE
typedef struct stub_can {
  int state;
} CANDriver;
#if STUB_CAN == 1
typedef struct {
  uint32_t mcr, btr;
} CANConfig;
typedef struct {
  uint8_t DLC, RTR, IDE;
  union {
    uint32_t SID, EID;
  };
  union {
    uint8_t data8[8];
    uint32_t data32[2];
  };
} CANTxFrame, CANRxFrame;
#else
typedef struct {
  uint32_t NBTP, DBTP, CCCR, TEST, GFC, RXGFC;
} CANConfig;
typedef struct {
  struct {
    union {
      struct {
        uint32_t EID : 29, RTR : 1, XTD : 1, ESI : 1;
      } ext;
      struct {
        uint32_t stub : 18, SID : 11, RTR : 1, XTD : 1, ESI : 1;
      } std;
      struct {
        uint32_t stub : 29, RTR : 1, XTD : 1, ESI : 1;
      } common;
    };
    uint32_t DLC, BRS, FDF;
  };
  union {
    uint8_t data8[64];
    uint32_t data32[16];
  };
} CANTxFrame, CANRxFrame;
#endif
#define CAN_ANY_MAILBOX 0U
STUB_DRIVERS(CANDriver, CAND);
msg_t canStart(CANDriver *driver, const CANConfig *config);
msg_t canTransmitTimeout(CANDriver *driver, uint32_t mailbox, const CANTxFrame *frame, sysinterval_t timeout);
msg_t canReceiveTimeout(CANDriver *driver, uint32_t mailbox, CANRxFrame *frame, sysinterval_t timeout);
#endif

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

#endif
