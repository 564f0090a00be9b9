/* The USB device of the ATmega32U4. */
#include "board.h"

void usb_init(void) {
}

void usb_reset(void) {
}

bool usb_take(const uint8_t *bytes, size_t count) {
  (void)bytes;
  (void)count;
  return false;
}

void usb_open(bool is_open) {
  (void)is_open;
}

void link_opened(bool is_open) {
  usb_open(is_open);
}
