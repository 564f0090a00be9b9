/*
 * Voltages of DAC outputs on ChibiOS.
 */
#ifndef UP_DAC_H
#define UP_DAC_H

#include "hal.h"

#if HAL_USE_DAC == TRUE

/* Outputs an element of a field's value: the code itself, 0 to 4095 (the reference). Values beyond become the
 * nearest code, and a number with a fraction is rounded. */
void up_dac_set(DACDriver *driver, size_t field, const void *value, uint16_t element);

#endif

#endif
