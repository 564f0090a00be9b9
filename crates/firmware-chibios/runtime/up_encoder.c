/* Quadrature encoders: a timer counts, and its 16 bits are extended to 32 before they wrap. */
#include "up_encoder.h"
#include "up_rt.h"

/* How often a 16-bit counter is read: 32767 counts in 10 ms are 3.2 million per second. */
#define STEP_MS 10U
/* How often a wheel at rest is reported. */
#define REPEAT_MS 1000U

static int32_t step(const up_encoder_counter_t *counter) {
  up_encoder_state_t *state = counter->state;

  if (counter->is_wide) {
    return (int32_t)counter->timer->CNT;
  }
  up_count_step(&state->count, (uint16_t)counter->timer->CNT);
  return up_count_total(&state->count);
}

static void on_step(virtual_timer_t *timer, void *argument) {
  const up_encoder_counter_t *counter = argument;

  (void)timer;
  chSysLockFromISR();
  (void)step(counter);
  chSysUnlockFromISR();
}

void up_encoder_start(const up_encoder_counter_t *counter) {
  stm32_tim_t *timer = counter->timer;

  timer->CR1 = 0U;
  timer->CCER = 0U; /* both tracks not inverted: A before B counts up */
  timer->CCMR1 = STM32_TIM_CCMR1_CC1S(1U) | STM32_TIM_CCMR1_CC2S(1U) |
                 STM32_TIM_CCMR1_IC1F((uint32_t)counter->filter) | STM32_TIM_CCMR1_IC2F((uint32_t)counter->filter);
  timer->SMCR = STM32_TIM_SMCR_SMS(3U); /* encoder mode 3: every edge of both tracks */
  timer->PSC = 0U;
  timer->ARR = counter->is_wide ? 0xFFFFFFFFU : 0xFFFFU;
  timer->EGR = STM32_TIM_EGR_UG;
  timer->CNT = 0U;
  timer->CR1 = STM32_TIM_CR1_CEN;
  if (!counter->is_wide) {
    chVTObjectInit(&counter->state->timer);
    /* The argument is a const table, but the kernel's signature has only void pointers. */
    chVTSetContinuous(&counter->state->timer, TIME_MS2I(STEP_MS), on_step, (void *)(uintptr_t)counter);
  }
}

void up_encoder_poll(const up_encoder_t *encoder) {
  const uint8_t type = up_config.schema->fields[encoder->field].type;
  const size_t element_bytes = up_type_bytes(type);
  uint8_t *value = (uint8_t *)encoder->value;
  bool has_changed = false;
  size_t i;

  for (i = 0U; i < encoder->counters_count; i++) {
    const up_encoder_counter_t *counter = &encoder->counters[i];
    int32_t total;

    chSysLock();
    total = step(counter);
    chSysUnlock();
    has_changed = has_changed || total != counter->state->reported;
    counter->state->reported = total;
    up_count_store(type, total, &value[i * element_bytes]);
  }
  if (up_repeat_is_due(encoder->repeat, has_changed, REPEAT_MS, up_now_ms())) {
    up_result(encoder->field, UP_FRESH, value);
  }
}
