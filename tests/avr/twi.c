/*
 * TWI as master of an I2C bus: what the program orders in, events of the bus out, and states back.
 *
 * simavr's has no time and no bus that is held. Here each event is at the end of its bits, a start waits for wires that
 * are high, and a bus that holds still never ends what is under way.
 */
#include "talk.h"

#define TWBR 0xB8
#define TWSR 0xB9
#define TWDR 0xBB
#define TWCR 0xBC
#define FLAG 7U
#define ACKNOWLEDGES 6U
#define STARTS 5U
#define STOPS 4U
#define COLLISION 3U
#define ENABLED 2U
#define MASK 0U
#define NO_STATE 0xF8
/* ATmega328P, tables 22-3 and 22-4, states of a master. */
#define STARTED 0x08
#define STARTED_AGAIN 0x10
#define WRITE_TAKEN 0x18
#define WRITE_REFUSED 0x20
#define DATA_TAKEN 0x28
#define DATA_REFUSED 0x30
#define READ_TAKEN 0x40
#define READ_REFUSED 0x48
#define DATA_ACKNOWLEDGED 0x50
#define DATA_ENDED 0x58
#define BYTE_BITS 9U
#define POLL_NS 20000U

typedef enum { IDLE, START, ADDRESS, WRITING, READING, STOPPING } step_t;

static const request_t *request;
static step_t step;
static bool owns_bus;
static uint32_t told_hz;

static uint64_t bit_cycles(void) {
  return 16 + ((uint64_t)avr->data[TWBR] << (2 * (avr->data[TWSR] & 3U) + 1));
}

static void set_state(uint8_t state) {
  avr->data[TWSR] = (uint8_t)((avr->data[TWSR] & 7U) | state);
}

static uint8_t state(void) {
  return avr->data[TWSR] & NO_STATE;
}

static bool is_held(void) {
  return pin_outside(part->sda) == LOW || pin_outside(part->scl) == LOW;
}

static void end_with(uint8_t new_state) {
  step = IDLE;
  set_state(new_state);
  request_raise(request);
}

static avr_cycle_count_t on_step(avr_t *of, avr_cycle_count_t when, void *subject);

static void begin(step_t next, unsigned bits) {
  step = next;
  alarm_at(avr->cycle + bits * bit_cycles(), on_step, NULL);
}

/* Something holds a wire; what is under way ends when it lets go. */
static void wait(void) {
  alarm_at(avr->cycle + cycle_of(POLL_NS), on_step, NULL);
}

static void on_start(void) {
  if (is_held()) {
    wait();
    return;
  }
  end_with(owns_bus ? STARTED_AGAIN : STARTED);
  owns_bus = true;
}

/* A bus that is stuck says nothing more, and the flag never comes. */
static void on_byte(uint64_t cycle) {
  const uint8_t data = avr->data[TWDR];
  const bool acknowledges = is_set(TWCR, ACKNOWLEDGES);
  const bool reads = (data & 1U) != 0;
  uint8_t byte = 0;
  i2c_reply_t reply;

  if (pin_outside(part->scl) == LOW) {
    wait();
    return;
  }
  if (step == ADDRESS) {
    reply = ask_i2c(I2C_START, data >> 1, reads, cycle, &byte);
  } else if (step == WRITING) {
    reply = ask_i2c(I2C_WRITE, data, false, cycle, &byte);
  } else {
    reply = ask_i2c(I2C_READ, 0, acknowledges, cycle, &byte);
  }
  if (reply == I2C_SILENT) {
    wait();
  } else if (reply == I2C_STUCK) {
    step = IDLE;
  } else if (step == ADDRESS && reads) {
    end_with(reply == I2C_ACK ? READ_TAKEN : READ_REFUSED);
  } else if (step == ADDRESS) {
    end_with(reply == I2C_ACK ? WRITE_TAKEN : WRITE_REFUSED);
  } else if (step == WRITING) {
    end_with(reply == I2C_ACK ? DATA_TAKEN : DATA_REFUSED);
  } else {
    avr->data[TWDR] = byte;
    end_with(acknowledges ? DATA_ACKNOWLEDGED : DATA_ENDED);
  }
}

static void on_stop(uint64_t cycle) {
  uint8_t byte;
  const i2c_reply_t reply = is_held() ? I2C_STUCK : ask_i2c(I2C_STOP, 0, false, cycle, &byte);

  if (reply == I2C_STUCK || reply == I2C_SILENT) {
    wait();
    return;
  }
  owns_bus = false;
  step = IDLE;
  put(TWCR, STOPS, false);
  set_state(NO_STATE);
  if (is_set(TWCR, STARTS)) {
    begin(START, 1);
  }
}

static avr_cycle_count_t on_step(avr_t *of, avr_cycle_count_t when, void *subject) {
  (void)of;
  (void)subject;
  switch (step) {
  case START:
    on_start();
    break;
  case ADDRESS:
  case WRITING:
  case READING:
    on_byte(when);
    break;
  case STOPPING:
    on_stop(when);
    break;
  default:
    break;
  }
  return 0;
}

static void tell_clock(void) {
  const uint32_t hz = (uint32_t)(avr->frequency / bit_cycles());

  if (hz != told_hz) {
    told_hz = hz;
    tell_setting('i', 1, hz, 0, 0, 0);
  }
}

/* What the bus does next, after the flag was cleared. */
static void go_on(void) {
  if (is_set(TWCR, STOPS)) {
    begin(STOPPING, 1);
  } else if (is_set(TWCR, STARTS)) {
    tell_clock();
    begin(START, 1);
  } else if (state() == STARTED || state() == STARTED_AGAIN) {
    begin(ADDRESS, BYTE_BITS);
  } else if (state() == WRITE_TAKEN || state() == DATA_TAKEN || state() == WRITE_REFUSED || state() == DATA_REFUSED) {
    begin(WRITING, BYTE_BITS);
  } else if (state() == READ_TAKEN || state() == DATA_ACKNOWLEDGED) {
    begin(READING, BYTE_BITS);
  }
}

static void write_control(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  const uint8_t kept = of->data[address] & bit(FLAG);
  const uint8_t settings = (uint8_t)(value & (bit(ACKNOWLEDGES) | bit(STARTS) | bit(STOPS) | bit(ENABLED) | bit(MASK)));
  const bool clears = (value & bit(FLAG)) != 0;

  (void)subject;
  of->data[address] = (uint8_t)(settings | (clears ? 0 : kept));
  if (!is_set(TWCR, ENABLED)) {
    /* The bus is let go, whatever was under way. */
    alarm_off(on_step, NULL);
    step = IDLE;
    owns_bus = false;
    put(TWCR, STOPS, false);
    put(TWCR, FLAG, false);
    set_state(NO_STATE);
  } else if (clears && step == IDLE) {
    go_on();
  }
  requests_look();
}

static void write_status(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  of->data[address] = (uint8_t)((of->data[address] & NO_STATE) | (value & 3U));
}

static void write_data(avr_t *of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  if (step != IDLE) {
    put(TWCR, COLLISION, true);
    return;
  }
  of->data[address] = value;
}

void twi_reset(void) {
  step = IDLE;
  owns_bus = false;
  told_hz = 0;
  avr->data[TWDR] = UINT8_MAX;
  set_state(NO_STATE);
}

void twi_init(void) {
  request = request_new(part->twi_vector, TWCR, FLAG, TWCR, MASK, true);
  avr_register_io_write(avr, TWCR, write_control, NULL);
  avr_register_io_write(avr, TWSR, write_status, NULL);
  avr_register_io_write(avr, TWDR, write_data, NULL);
}
