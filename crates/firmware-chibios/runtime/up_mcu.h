/*
 * What the STM32 families have in common but spell differently: reset flags, and the watchdog under a debugger.
 */
#ifndef UP_MCU_H
#define UP_MCU_H

#include "hal.h"

/* ---- why the MCU started: flags of one register, which stay until they are cleared ---- */

#if defined(RCC_RSR_RMVF)
#define UP_RESET_REGISTER RCC->RSR
#define UP_RESET_CLEAR RCC_RSR_RMVF
#define UP_RESET_WATCHDOG RCC_RSR_IWDG1RSTF
#define UP_RESET_WINDOW_WATCHDOG RCC_RSR_WWDG1RSTF
#if defined(RCC_RSR_SFTRSTF)
#define UP_RESET_SOFTWARE RCC_RSR_SFTRSTF
#define UP_RESET_LOW_POWER RCC_RSR_LPWRRSTF
#else /* of two cores, the first */
#define UP_RESET_SOFTWARE RCC_RSR_SFT1RSTF
#define UP_RESET_LOW_POWER RCC_RSR_LPWR1RSTF
#endif
#define UP_RESET_POWER (RCC_RSR_PORRSTF | RCC_RSR_BORRSTF)
#define UP_RESET_PIN RCC_RSR_PINRSTF
#else
#define UP_RESET_REGISTER RCC->CSR
#define UP_RESET_CLEAR RCC_CSR_RMVF
#define UP_RESET_WATCHDOG RCC_CSR_IWDGRSTF
#define UP_RESET_WINDOW_WATCHDOG RCC_CSR_WWDGRSTF
#define UP_RESET_SOFTWARE RCC_CSR_SFTRSTF
#define UP_RESET_LOW_POWER RCC_CSR_LPWRRSTF
#if defined(RCC_CSR_PWRRSTF)
#define UP_RESET_POWER RCC_CSR_PWRRSTF
#elif defined(RCC_CSR_PORRSTF)
#define UP_RESET_POWER RCC_CSR_PORRSTF
#else
#define UP_RESET_POWER RCC_CSR_BORRSTF
#endif
#define UP_RESET_PIN RCC_CSR_PINRSTF
#endif

/* ---- the watchdog stops while a debugger halts the core ---- */

#if defined(DBGMCU_APB4FZ1_DBG_IWDG1)
#define UP_FREEZE_WATCHDOG() (DBGMCU->APB4FZ1 |= DBGMCU_APB4FZ1_DBG_IWDG1)
#elif defined(DBGMCU_APB1FZR1_DBG_IWDG_STOP)
#define UP_FREEZE_WATCHDOG() (DBGMCU->APB1FZR1 |= DBGMCU_APB1FZR1_DBG_IWDG_STOP)
#elif defined(DBG_APB_FZ1_DBG_IWDG_STOP)
#define UP_FREEZE_WATCHDOG() (DBG->APBFZ1 |= DBG_APB_FZ1_DBG_IWDG_STOP)
#elif defined(DBGMCU_CR_DBG_IWDG_STOP)
#define UP_FREEZE_WATCHDOG() (DBGMCU->CR |= DBGMCU_CR_DBG_IWDG_STOP)
#elif defined(DBGMCU_APB1_FZ_DBG_IWDG_STOP)
#define UP_FREEZE_WATCHDOG() (DBGMCU->APB1FZ |= DBGMCU_APB1_FZ_DBG_IWDG_STOP)
#else
#define UP_FREEZE_WATCHDOG() ((void)0)
#endif

#endif
