#include "up_chips.h"

#include "up_rt.h"

/* Reports why a chip that only takes commands is not there; a chip with readings reports it for those. */
static void say_fault(const up_served_t *served) {
  const up_chip_state_t *state = served->state;
  uint8_t i;

  if (state->is_running || state->is_pausing || state->fault == (uint8_t)UP_NOTHING) {
    return;
  }
  for (i = 0U; UP_USES_CHIP_COMMANDS && i < served->chip->commands_count; i++) {
    up_result(served->chip->commands[i].field, (up_result_t)state->fault, NULL);
  }
}

/* True if the chip accepts further commands in this step. */
static bool write_command(const up_bus_t *bus, const up_served_t *served, size_t i) {
  const up_chip_command_t *command = &served->chip->commands[i];
  up_chip_state_t *state = served->state;
  up_written_t *written = &served->written[i];
  const uint32_t sequence = up_sequence(command->field);
  up_result_t result;

  if (sequence == 0U || (sequence == written->sequence && state->counts.starts == written->starts) ||
      !up_get(command->field, state->scratch)) {
    return true;
  }
  result = up_chip_write(served->chip, state, bus, up_config.schema, command, state->scratch);
  if (result == UP_FRESH || result == UP_INVALID) {
    written->sequence = sequence;
    written->starts = state->counts.starts;
  }
  if (result != UP_FRESH && result != UP_NOTHING) {
    up_result(command->field, result, NULL);
  }
  return state->is_running;
}

static void step(const up_chips_t *work) {
  uint8_t i;

  for (i = 0U; i < work->chips_count; i++) {
    const up_served_t *served = &work->chips[i];
    size_t command = 0U;

    up_chip_step(served->chip, served->state, work->bus, up_config.schema, up_now_ms, &up_values);
    say_fault(served);
    while (UP_USES_CHIP_COMMANDS && served->state->is_running && command < served->chip->commands_count &&
           write_command(work->bus, served, command)) {
      command++;
    }
  }
}

/* How long until the first of them has something to do; at least a millisecond. */
static uint32_t idle_ms(const up_chips_t *work, uint32_t now_ms) {
  uint32_t least_ms = work->cycle_ms;
  uint8_t i;

  for (i = 0U; i < work->chips_count; i++) {
    const uint32_t own_ms = up_chip_idle_ms(work->chips[i].chip, work->chips[i].state, now_ms);

    if (own_ms < least_ms) {
      least_ms = own_ms;
    }
  }
  return (least_ms == 0U) ? 1U : least_ms;
}

void up_chips_cycle(const void *work) {
  const up_chips_t *chips = work;
  const uint32_t start_ms = up_now_ms();

  for (;;) {
    uint32_t now_ms;
    uint32_t wait_ms;

    step(chips);
    now_ms = up_now_ms();
    wait_ms = idle_ms(chips, now_ms);
    if (now_ms - start_ms + wait_ms >= chips->cycle_ms) {
      return;
    }
    chThdSleep(UP_MS2I(wait_ms));
  }
}
