/*
 * The USB device of the ATmega32U4: its registers in, packets of the host out, and back. ATmega16U4/32U4, 21 and 22.
 *
 * simavr's knows five endpoints of one bank, and gives up at the sixth. Suspend and wake-up are not there: the host is
 * awake.
 */
#include "usb.h"

#include <string.h>

#define PLLCSR 0x49
#define USBCON 0xD8
#define UDCON 0xE0
#define UDINT 0xE1
#define UDIEN 0xE2
#define UDADDR 0xE3
#define UDFNUML 0xE4
#define UDFNUMH 0xE5
#define UEINTX 0xE8
#define UENUM 0xE9
#define UERST 0xEA
#define UECONX 0xEB
#define UECFG0X 0xEC
#define UECFG1X 0xED
#define UESTA0X 0xEE
#define UEIENX 0xF0
#define UEDATX 0xF1
#define UEBCLX 0xF2
#define UEINT 0xF4
/* No register is there. What a vector is for has many flags and masks, which become one of each. */
#define SUMS 0xFE
#define GENERAL_ASKS 0U
#define GENERAL_MASK 1U
#define ENDPOINT_ASKS 2U
#define ENDPOINT_MASK 3U

#define ENDPOINTS 7U
#define BANKS 2U
#define PLL_ON 1U
#define PLL_LOCKED 0U
#define USB_ON 7U
#define CLOCK_FROZEN 5U
#define DETACHED 0U
#define FRAME_FLAG 2U
#define RESET_FLAG 3U
/* UEINTX */
#define IN_READY 0U
#define STALL_SENT 1U
#define OUT_THERE 2U
#define SETUP_THERE 3U
#define MAY_GO_ON 5U
#define BANK_HELD 7U
/* UECONX */
#define ENABLED 0U
#define STALLS 5U
#define STALLS_NO_MORE 4U

typedef struct {
  uint8_t bytes[PACKET];
  size_t count;
  size_t read;
} bank_t;

typedef struct {
  uint8_t control;
  uint8_t kind;   /* UECFG0X */
  uint8_t layout; /* UECFG1X */
  uint8_t masks;
  uint8_t flags;
  bank_t banks[BANKS];
  unsigned oldest;
  unsigned full;
  bank_t in; /* of the control endpoint, whose other one is the first bank */
  bool is_in_full;
} endpoint_t;

static endpoint_t endpoints[ENDPOINTS];
static uint16_t frame;

static endpoint_t *selected(void) {
  const unsigned number = avr->data[UENUM] & 7U;

  return &endpoints[number < ENDPOINTS ? number : 0];
}

static bool is_control(const endpoint_t *of) {
  return of->kind >> 6 == 0;
}

static bool goes_in(const endpoint_t *of) {
  return (of->kind & 1U) != 0;
}

static size_t size_of(const endpoint_t *of) {
  const size_t size = (size_t)8 << (of->layout >> 4 & 7U);

  return size < PACKET ? size : PACKET;
}

static unsigned banks_of(const endpoint_t *of) {
  return (of->layout >> 2 & 3U) == 0 ? 1 : BANKS;
}

/* The bank that the program fills or empties; NULL if the host has all of them. */
static bank_t *current(endpoint_t *of) {
  if (is_control(of)) {
    return &of->banks[0];
  }
  if (goes_in(of)) {
    return of->full < banks_of(of) ? &of->banks[(of->oldest + of->full) % banks_of(of)] : NULL;
  }
  return of->full > 0 ? &of->banks[of->oldest] : NULL;
}

static void look(void) {
  uint8_t asking = 0;

  for (unsigned number = 0; number < ENDPOINTS; number++) {
    const endpoint_t *const of = &endpoints[number];

    asking |= (of->flags & of->masks & 0x5FU) != 0 ? bit(number) : 0;
  }
  avr->data[UEINT] = asking;
  put(SUMS, ENDPOINT_ASKS, asking != 0);
  put(SUMS, GENERAL_ASKS, (avr->data[UDINT] & avr->data[UDIEN]) != 0);
  requests_look();
}

static void flag(endpoint_t *of, unsigned which) {
  of->flags |= bit(which);
}

static void empty(endpoint_t *of) {
  of->oldest = 0;
  of->full = 0;
  of->is_in_full = false;
  of->in.count = 0;
  memset(of->banks, 0, sizeof of->banks);
  of->flags = is_control(of) ? bit(IN_READY) : goes_in(of) ? (uint8_t)(bit(IN_READY) | bit(BANK_HELD)) : 0;
}

static bool is_on(const endpoint_t *of) {
  return (of->control & bit(ENABLED)) != 0;
}

/* The host's side. */

bool device_is_attached(void) {
  return is_set(USBCON, USB_ON) && !is_set(USBCON, CLOCK_FROZEN) && is_set(PLLCSR, PLL_ON) && !is_set(UDCON, DETACHED);
}

void device_bus_reset(void) {
  memset(endpoints, 0, sizeof endpoints);
  avr->data[UDADDR] = 0;
  put(UDINT, RESET_FLAG, true);
  look();
}

void device_frame(void) {
  frame = (frame + 1) & 0x7FF;
  avr->data[UDFNUML] = (uint8_t)frame;
  avr->data[UDFNUMH] = (uint8_t)(frame >> 8);
  put(UDINT, FRAME_FLAG, true);
  look();
}

handshake_t device_setup(const uint8_t setup[8]) {
  endpoint_t *const of = &endpoints[0];

  if (!is_on(of)) {
    return REFUSED;
  }
  of->control &= (uint8_t)~bit(STALLS);
  empty(of);
  of->flags = bit(SETUP_THERE);
  memcpy(of->banks[0].bytes, setup, 8);
  of->banks[0].count = 8;
  of->banks[0].read = 0;
  look();
  return TAKEN;
}

static handshake_t stalled(endpoint_t *of) {
  flag(of, STALL_SENT);
  look();
  return STALLED;
}

handshake_t device_out(unsigned endpoint, const uint8_t *bytes, size_t count) {
  endpoint_t *const of = &endpoints[endpoint];
  bank_t *bank = &of->banks[0];

  if (is_on(of) && (of->control & bit(STALLS)) != 0) {
    return stalled(of);
  }
  if (!is_on(of) || (is_control(of) ? (of->flags & (bit(OUT_THERE) | bit(SETUP_THERE))) != 0
                                    : goes_in(of) || of->full == banks_of(of))) {
    return REFUSED;
  }
  if (!is_control(of)) {
    bank = &of->banks[(of->oldest + of->full++) % banks_of(of)];
    flag(of, BANK_HELD);
  }
  memcpy(bank->bytes, bytes, count);
  bank->count = count;
  bank->read = 0;
  flag(of, OUT_THERE);
  look();
  return TAKEN;
}

handshake_t device_in(unsigned endpoint, uint8_t bytes[PACKET], size_t *count) {
  endpoint_t *const of = &endpoints[endpoint];
  bank_t *const bank = is_control(of) ? &of->in : &of->banks[of->oldest];

  if (is_on(of) && (of->control & bit(STALLS)) != 0) {
    return stalled(of);
  }
  if (!is_on(of) || (is_control(of) ? !of->is_in_full : !goes_in(of) || of->full == 0)) {
    return REFUSED;
  }
  memcpy(bytes, bank->bytes, bank->count);
  *count = bank->count;
  bank->count = 0;
  if (is_control(of)) {
    of->is_in_full = false;
  } else {
    of->oldest = (of->oldest + 1) % banks_of(of);
    of->full--;
    flag(of, BANK_HELD);
  }
  flag(of, IN_READY);
  look();
  return TAKEN;
}

/* The program's side. */

static void release_bank(endpoint_t *of) {
  of->flags &= (uint8_t)~bit(BANK_HELD);
  if (goes_in(of)) {
    of->full++;
    if (current(of) != NULL) {
      current(of)->count = 0;
      of->flags |= (uint8_t)(bit(IN_READY) | bit(BANK_HELD));
    }
  } else if (of->full > 0) {
    of->oldest = (of->oldest + 1) % banks_of(of);
    if (--of->full > 0) {
      of->flags |= (uint8_t)(bit(OUT_THERE) | bit(BANK_HELD));
    }
  }
}

static void clear_of_control(endpoint_t *of, uint8_t cleared) {
  of->flags &= (uint8_t)~cleared;
  if ((cleared & bit(SETUP_THERE)) != 0) {
    of->banks[0].count = 0;
    flag(of, IN_READY);
  } else if ((cleared & bit(IN_READY)) != 0) {
    of->is_in_full = true;
  }
  if ((cleared & bit(OUT_THERE)) != 0) {
    of->banks[0].count = 0;
  }
}

static void write_flags(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  endpoint_t *const of = selected();
  const uint8_t cleared = of->flags & (uint8_t)~value;

  (void)avr_of;
  (void)address;
  (void)subject;
  if (is_control(of)) {
    clear_of_control(of, cleared);
  } else {
    of->flags &= (uint8_t)~(cleared & ~bit(BANK_HELD));
    if ((cleared & bit(BANK_HELD)) != 0) {
      release_bank(of);
    }
  }
  look();
}

static uint8_t read_flags(avr_t *avr_of, avr_io_addr_t address, void *subject) {
  endpoint_t *const of = selected();
  const bank_t *const bank = current(of);
  bool may_go_on = false;

  (void)avr_of;
  (void)address;
  (void)subject;
  if (bank != NULL) {
    may_go_on = goes_in(of) ? bank->count < size_of(of) : bank->read < bank->count;
  }
  return (uint8_t)(of->flags | (may_go_on ? bit(MAY_GO_ON) : 0));
}

static uint8_t read_data(avr_t *avr_of, avr_io_addr_t address, void *subject) {
  bank_t *const bank = current(selected());

  (void)avr_of;
  (void)address;
  (void)subject;
  return bank != NULL && bank->read < bank->count ? bank->bytes[bank->read++] : 0;
}

static void write_data(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  endpoint_t *const of = selected();
  bank_t *const bank = is_control(of) ? &of->in : current(of);

  (void)avr_of;
  (void)address;
  (void)subject;
  if (bank != NULL && bank->count < size_of(of)) {
    bank->bytes[bank->count++] = value;
  }
}

static uint8_t read_count(avr_t *avr_of, avr_io_addr_t address, void *subject) {
  const bank_t *const bank = current(selected());

  (void)avr_of;
  (void)address;
  (void)subject;
  return bank == NULL ? 0 : (uint8_t)(bank->count - bank->read);
}

static uint8_t *field_of(endpoint_t *of, avr_io_addr_t address) {
  switch (address) {
  case UECONX:
    return &of->control;
  case UECFG0X:
    return &of->kind;
  case UECFG1X:
    return &of->layout;
  default:
    return &of->masks;
  }
}

static void write_field(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  endpoint_t *const of = selected();
  const bool goes_on = (of->control & bit(STALLS)) != 0 && (value & bit(STALLS_NO_MORE)) == 0;
  const bool stalls = (value & bit(STALLS)) != 0 || goes_on;

  (void)avr_of;
  (void)subject;
  if (address == UECONX) {
    value = (uint8_t)((value & bit(ENABLED)) | (stalls ? bit(STALLS) : 0));
  }
  *field_of(of, address) = value;
  if (address == UECFG0X || address == UECFG1X) {
    empty(of);
  }
  look();
}

static uint8_t read_field(avr_t *avr_of, avr_io_addr_t address, void *subject) {
  (void)avr_of;
  (void)subject;
  return *field_of(selected(), address);
}

/* The layout is always found good, and the number of full banks is that. */
static uint8_t read_state(avr_t *avr_of, avr_io_addr_t address, void *subject) {
  (void)avr_of;
  (void)address;
  (void)subject;
  return (uint8_t)(0x80U | selected()->full);
}

static void write_resets(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  avr_of->data[address] = value;
  for (unsigned number = 1; number < ENDPOINTS; number++) {
    if ((value >> number & 1U) != 0) {
      empty(&endpoints[number]);
    }
  }
  look();
}

/* Flags are cleared by zeros here. */
static void write_general(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  avr_of->data[address] &= value;
  look();
}

static void write_mask(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  (void)subject;
  avr_of->data[address] = value;
  look();
}

static void write_switch(avr_t *avr_of, avr_io_addr_t address, uint8_t value, void *subject) {
  const bool was_attached = device_is_attached();

  (void)subject;
  avr_of->data[address] = value;
  put(PLLCSR, PLL_LOCKED, is_set(PLLCSR, PLL_ON));
  if (device_is_attached() != was_attached) {
    was_attached ? host_lost() : host_attached();
  }
}

void usb_reset(void) {
  if (part->usb_vectors[0] == 0) {
    return;
  }
  memset(endpoints, 0, sizeof endpoints);
  avr->data[UDCON] = bit(DETACHED);
  avr->data[USBCON] = bit(CLOCK_FROZEN);
  avr->data[SUMS] = (uint8_t)(bit(GENERAL_MASK) | bit(ENDPOINT_MASK));
  host_lost();
}

void usb_init(void) {
  static const uint16_t fields[] = {UECONX, UECFG0X, UECFG1X, UEIENX};

  if (part->usb_vectors[0] == 0) {
    return;
  }
  request_new(part->usb_vectors[0], SUMS, GENERAL_ASKS, SUMS, GENERAL_MASK, true);
  request_new(part->usb_vectors[1], SUMS, ENDPOINT_ASKS, SUMS, ENDPOINT_MASK, true);
  for (size_t at = 0; at < COUNT_OF(fields); at++) {
    avr_register_io_write(avr, fields[at], write_field, NULL);
    avr_register_io_read(avr, fields[at], read_field, NULL);
  }
  avr_register_io_write(avr, UEINTX, write_flags, NULL);
  avr_register_io_read(avr, UEINTX, read_flags, NULL);
  avr_register_io_write(avr, UEDATX, write_data, NULL);
  avr_register_io_read(avr, UEDATX, read_data, NULL);
  avr_register_io_read(avr, UEBCLX, read_count, NULL);
  avr_register_io_read(avr, UESTA0X, read_state, NULL);
  avr_register_io_write(avr, UERST, write_resets, NULL);
  avr_register_io_write(avr, UDINT, write_general, NULL);
  avr_register_io_write(avr, UDIEN, write_mask, NULL);
  avr_register_io_write(avr, UDCON, write_switch, NULL);
  avr_register_io_write(avr, USBCON, write_switch, NULL);
  avr_register_io_write(avr, PLLCSR, write_switch, NULL);
}
