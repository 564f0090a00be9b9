/*
 * The interface of ChibiOS' drivers for converters and outputs, for a test: the test decides how a conversion ends, and
 * locks are counted.
 */
#ifndef HAL_H
#define HAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TRUE 1
#define FALSE 0
#define HAL_USE_ADC TRUE
#define HAL_USE_DAC TRUE
#define HAL_USE_I2C FALSE
#define HAL_USE_ICU FALSE
#define CH_CFG_ST_FREQUENCY 1000

typedef int msg_t;
typedef uint32_t ioline_t, iomode_t, sysinterval_t, adcerror_t;
typedef uint16_t adcsample_t, dacsample_t;
typedef void *thread_reference_t;
typedef struct ADCDriver ADCDriver;

typedef struct {
  bool circular;
  uint16_t num_channels;
  void (*error_cb)(ADCDriver *driver, adcerror_t errors);
} ADCConversionGroup;

typedef enum { ADC_READY, ADC_ACTIVE } adcstate_t;

struct ADCDriver {
  adcstate_t state;
  thread_reference_t thread;
  const ADCConversionGroup *group;
  uint32_t up_errors;
  int locks; /* 1 while the unit is locked */
};

typedef struct {
  uint32_t channel, code;
} DACDriver;

void adcAcquireBus(ADCDriver *driver);
void adcReleaseBus(ADCDriver *driver);
void adcStartConversion(ADCDriver *driver, const ADCConversionGroup *group, adcsample_t *samples, size_t depth);
void adcStopConversion(ADCDriver *driver);
msg_t osalThreadSuspendTimeoutS(thread_reference_t *thread, sysinterval_t timeout);
void osalSysLock(void);
void osalSysUnlock(void);
msg_t dacPutChannelX(DACDriver *driver, uint32_t channel, dacsample_t sample);

#endif
