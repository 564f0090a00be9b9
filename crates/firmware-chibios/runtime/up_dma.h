/*
 * Memory for the buffers of DMA controllers.
 *
 * A buffer that a DMA fills or empties must be static and marked:
 *
 *   static UP_DMA_BUFFER uint8_t i2c1_work[16];    any DMA controller
 *   static UP_BDMA_BUFFER uint8_t i2c4_work[16];   the basic one of STM32H7: ADC3, I2C4, SPI6, LPUART1
 *
 * Nothing else is needed: there is nothing to clean or invalidate, and no alignment to cache lines, because this memory
 * is not cached. On STM32F7 it is the tightly coupled memory, which DMA controllers reach and which is never cached; on
 * STM32H7 it is SRAM of the domains D2 and D3, which mcuconf.h excludes from the cache (STM32_NOCACHE_ENABLE); on MCUs
 * without a data cache it is the memory of all data.
 *
 * It is NOT zero at the start and cannot be initialised: a buffer must be filled before it is read. Bytes to send must
 * be copied into such a buffer, because the basic controller reaches neither flash nor stacks.
 *
 * UP_DMA_SECTION and UP_BDMA_SECTION are names of sections in the tree's linker scripts; up_conf.h has them from the
 * profile if the MCU needs them.
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
