/* Bits of a timer that our code sets; see README.md. */
#ifndef STUB_STM32_TIM_H
#define STUB_STM32_TIM_H

#include "hal.h"

#define STM32_TIM_CCMR1_CC1S(n) ((uint32_t)(n))
#define STM32_TIM_CCMR1_CC2S(n) ((uint32_t)(n) << 8)
#define STM32_TIM_CCMR1_IC1F(n) ((uint32_t)(n) << 4)
#define STM32_TIM_CCMR1_IC2F(n) ((uint32_t)(n) << 12)
#define STM32_TIM_SMCR_SMS(n) ((uint32_t)(n))
#define STM32_TIM_EGR_UG 1U
#define STM32_TIM_CR1_CEN 1U

#endif
