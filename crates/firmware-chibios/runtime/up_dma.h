/*
 * Memory for the buffers of DMA controllers.
 *
 * A buffer that a DMA fills or empties is static and marked:
 *
 *   static UP_DMA_BUFFER uint8_t i2c1_work[16];    any DMA controller
 *   static UP_BDMA_BUFFER uint8_t i2c4_work[16];   the basic one of STM32H7: ADC3, I2C4, SPI6, LPUART1
 *
 * Nothing else has to be done: there is nothing to clean or to invalidate, and no alignment to cache lines, because no
 * cache stands before this memory. On STM32F7 it is the tightly coupled memory, which DMA controllers reach and which
 * is never cached; on STM32H7 it is SRAM of the domains D2 and D3, which mcuconf.h takes from the cache
 * (STM32_NOCACHE_ENABLE); on MCUs without a data cache it is where all data are.
 *
 * It is NOT zero at the start: whoever reads from a buffer has filled it before. It cannot be initialised. What is sent
 * has to be copied into such a buffer: the basic controller reaches neither flash nor stacks.
 *
 * UP_DMA_SECTION and UP_BDMA_SECTION are names of sections of the tree's linker scripts; up_conf.h has them from the
 * profile where the MCU needs them.
 */
#ifndef UP_DMA_H
#define UP_DMA_H

#include "up_conf.h"

#if defined(UP_DMA_SECTION)
#define UP_DMA_BUFFER __attribute__((section(UP_DMA_SECTION), aligned(4)))
#else
#define UP_DMA_BUFFER __attribute__((aligned(4)))
#endif

#if defined(UP_BDMA_SECTION)
#define UP_BDMA_BUFFER __attribute__((section(UP_BDMA_SECTION), aligned(4)))
#else
#define UP_BDMA_BUFFER UP_DMA_BUFFER
#endif

#endif
