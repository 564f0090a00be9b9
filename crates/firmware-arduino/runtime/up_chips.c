#include "up_chips.h"

#include "sense_model.h"

void up_chips_owe(UP_ROM up_served_t *served, uint8_t command) {
  served->orders[command].is_set = true;
  served->orders[command].is_owed = true;
}

/* Tells why a chip that only takes commands is not there; one with readings tells it for those. */
static void say_fault(UP_ROM up_served_t *served) {
  const up_chip_state_t *state = served->state;
  uint8_t i;

  if (state->is_running || state->is_pausing || state->fault == (uint8_t)UP_NOTHING) {
    return;
  }
  for (i = 0U; i < served->chip->commands_count; i++) {
    up_result(served->chip->commands[i].field, (up_result_t)state->fault, NULL);
  }
}

/* True if the chip takes further commands in this step. */
static bool write_command(UP_ROM up_bus_t *bus, UP_ROM up_served_t *served, uint8_t i) {
  UP_ROM up_chip_command_t *command = &served->chip->commands[i];
  up_chip_state_t *state = served->state;
  up_order_t *order = &served->orders[i];
  up_result_t result;

  if (!order->is_set || (!order->is_owed && state->counts.starts == order->starts) ||
      !up_get(command->field, up_scratch)) {
    return true;
  }
  result = up_chip_write(served->chip, state, bus, &sense_schema, command, up_scratch);
  if (result == UP_FRESH || result == UP_INVALID) {
    order->is_owed = false;
    order->starts = state->counts.starts;
  }
  if (result != UP_FRESH && result != UP_NOTHING) {
    up_result(command->field, result, NULL);
  }
  return state->is_running;
}

/* How long until the first of them has something to do; at least a millisecond. */
static uint32_t idle_ms(UP_ROM up_chips_t *work, uint32_t now_ms) {
  uint32_t least_ms = UINT32_MAX;
  uint8_t i;

  for (i = 0U; i < work->chips_count; i++) {
    const uint32_t own_ms = up_chip_idle_ms(work->chips[i].chip, work->chips[i].state, now_ms);

    least_ms = (own_ms < least_ms) ? own_ms : least_ms;
  }
  return (least_ms == 0U) ? 1U : least_ms;
}

uint32_t up_chips_cycle(UP_ROM void *work) {
  UP_ROM up_chips_t *own = work;
  uint8_t i;

  for (i = 0U; i < own->chips_count; i++) {
    UP_ROM up_served_t *served = &own->chips[i];
    uint8_t command = 0U;

    up_chip_step(served->chip, served->state, own->bus, &sense_schema, up_now_ms, &up_values);
    if (UP_USES_CHIP_COMMANDS) {
      say_fault(served);
      while (served->state->is_running && command < served->chip->commands_count &&
             write_command(own->bus, served, command)) {
        command++;
      }
    }
  }
  return idle_ms(own, up_now_ms());
}
