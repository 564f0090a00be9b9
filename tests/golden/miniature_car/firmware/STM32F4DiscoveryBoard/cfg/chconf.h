/* Written by SenseDSL: the kernel's settings, as changes to the demo's file in your ChibiOS tree. */
#ifndef SENSE_CHCONF_H
#define SENSE_CHCONF_H

/* The kernel's time: TIM5, which counts 32 bits and wakes the kernel when something is due. */
#define CH_CFG_ST_TIMEDELTA 2
#define CH_CFG_ST_RESOLUTION 32
#define CH_CFG_ST_FREQUENCY 10000
#define CH_CFG_INTERVALS_SIZE 32

/* What is still filled shows how much of each stack was ever used. */
#define CH_DBG_FILL_THREADS TRUE

/* For development the kernel checks itself and whoever calls it. */
#if !defined(UP_SHELL) || UP_SHELL
#define CH_DBG_SYSTEM_STATE_CHECK TRUE
#define CH_DBG_ENABLE_CHECKS TRUE
#define CH_DBG_ENABLE_ASSERTS TRUE
#define CH_DBG_ENABLE_STACK_CHECK TRUE
#endif

/* Parts of the kernel that neither the runtime nor the drivers call; -DCH_CFG_USE_...=TRUE in user/user.mk brings one
 * back. */
#if !defined(CH_CFG_USE_TM)
#define CH_CFG_USE_TM FALSE
#endif
#if !defined(CH_CFG_USE_FACTORY)
#define CH_CFG_USE_FACTORY FALSE
#endif

#include UP_BASE_CHCONF

#if !defined(_FROM_ASM_)
void up_on_idle_enter(void);
void up_on_idle_leave(void);
void up_on_interrupt_enter(void);
void up_on_interrupt_leave(void);
void up_on_halt(const char *why);
void up_on_switch(const void *next);
#endif
#undef CH_CFG_IDLE_ENTER_HOOK
#define CH_CFG_IDLE_ENTER_HOOK() up_on_idle_enter()
#undef CH_CFG_IDLE_LEAVE_HOOK
#define CH_CFG_IDLE_LEAVE_HOOK() up_on_idle_leave()
#undef CH_CFG_IRQ_PROLOGUE_HOOK
#define CH_CFG_IRQ_PROLOGUE_HOOK() up_on_interrupt_enter()
#undef CH_CFG_IRQ_EPILOGUE_HOOK
#define CH_CFG_IRQ_EPILOGUE_HOOK() up_on_interrupt_leave()
#undef CH_CFG_SYSTEM_HALT_HOOK
#define CH_CFG_SYSTEM_HALT_HOOK(reason) up_on_halt(reason)
#undef CH_CFG_CONTEXT_SWITCH_HOOK
#define CH_CFG_CONTEXT_SWITCH_HOOK(ntp, otp) up_on_switch(ntp)

#endif
