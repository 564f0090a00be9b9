/* A stub: see README.md. Registers of the core, the clock and the debug unit, by family. */
#ifndef STUB_CORE_H
#define STUB_CORE_H

/* ---- reset causes ---- */

#if defined(STUB_H7)
#define RCC_RSR_RMVF 0x10000U
#define RCC_RSR_BORRSTF 0x200000U
#define RCC_RSR_PINRSTF 0x400000U
#define RCC_RSR_PORRSTF 0x800000U
#define RCC_RSR_SFTRSTF 0x1000000U
#define RCC_RSR_IWDG1RSTF 0x4000000U
#define RCC_RSR_WWDG1RSTF 0x10000000U
#define RCC_RSR_LPWRRSTF 0x40000000U
#else
#define RCC_CSR_RMVF 0x1000000U
#define RCC_CSR_PINRSTF 0x4000000U
#define RCC_CSR_SFTRSTF 0x10000000U
#define RCC_CSR_IWDGRSTF 0x20000000U
#define RCC_CSR_WWDGRSTF 0x40000000U
#define RCC_CSR_LPWRRSTF 0x80000000U
#if defined(STUB_G0)
#define RCC_CSR_PWRRSTF 0x8000000U
#elif defined(STUB_F0) || defined(STUB_F1) || defined(STUB_F3) || defined(STUB_F4) || defined(STUB_F7)
#define RCC_CSR_PORRSTF 0x8000000U
#else
#define RCC_CSR_BORRSTF 0x8000000U
#endif
#endif
typedef struct {
  volatile uint32_t CR, CFGR;
#if defined(STUB_H7)
  volatile uint32_t RSR, APB1HENR;
#else
  volatile uint32_t CSR;
#endif
#if defined(STUB_G0)
  volatile uint32_t APBENR1;
#elif defined(STUB_G4) || defined(STUB_L4)
  volatile uint32_t APB1ENR1;
#elif !defined(STUB_H7)
  volatile uint32_t APB1ENR;
#endif
} RCC_TypeDef;
extern RCC_TypeDef stub_rcc;
#define RCC (&stub_rcc)
void NVIC_SystemReset(void);

/* ---- clock recovery from a host's frames: the MCUs with a 48 MHz oscillator ---- */

#if defined(STUB_F0) || defined(STUB_G0) || defined(STUB_G4) || defined(STUB_L4) || defined(STUB_H7)
typedef struct {
  volatile uint32_t CR, CFGR;
} CRS_TypeDef;
extern CRS_TypeDef stub_crs;
#define CRS (&stub_crs)
#define CRS_CR_AUTOTRIMEN 0x40U
#define CRS_CR_CEN 0x20U
#define CRS_CFGR_SYNCSRC 0x30000000U
#if defined(STUB_F0)
#define RCC_APB1ENR_CRSEN 0x8000000U
#elif defined(STUB_G0)
#define RCC_APBENR1_CRSEN 0x10000U
#elif defined(STUB_H7)
#define RCC_APB1HENR_CRSEN 2U
#else
#define RCC_APB1ENR1_CRSEN 0x100U
#endif
#endif

/* ---- freeze while a debugger halts the core ---- */

#if defined(STUB_G0)
typedef struct {
  volatile uint32_t APBFZ1;
} DBG_TypeDef;
extern DBG_TypeDef stub_dbg;
#define DBG (&stub_dbg)
#define DBG_APB_FZ1_DBG_IWDG_STOP 0x1000U
#else
typedef struct {
#if defined(STUB_H7)
  volatile uint32_t APB4FZ1;
#elif defined(STUB_G4) || defined(STUB_L4)
  volatile uint32_t APB1FZR1;
#elif defined(STUB_F1)
  volatile uint32_t CR;
#else
  volatile uint32_t APB1FZ;
#endif
} DBGMCU_TypeDef;
extern DBGMCU_TypeDef stub_dbgmcu;
#define DBGMCU (&stub_dbgmcu)
#if defined(STUB_H7)
#define DBGMCU_APB4FZ1_DBG_IWDG1 0x40000U
#elif defined(STUB_G4) || defined(STUB_L4)
#define DBGMCU_APB1FZR1_DBG_IWDG_STOP 0x1000U
#elif defined(STUB_F1)
#define DBGMCU_CR_DBG_IWDG_STOP 0x100U
#else
#define DBGMCU_APB1_FZ_DBG_IWDG_STOP 0x1000U
#endif
#endif
#if CORTEX_MODEL >= 3
typedef struct {
  volatile uint32_t DHCSR;
} CoreDebug_Type;
extern CoreDebug_Type stub_core_debug;
#define CoreDebug (&stub_core_debug)
#define CoreDebug_DHCSR_C_DEBUGEN_Msk 1U
#endif

/* ---- the MCU's unique identifier ---- */

#define UID_BASE ((uintptr_t)0x1FFF7000U)

#endif
