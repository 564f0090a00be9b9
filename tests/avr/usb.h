/*
 * What USB's device (usb.c) and its host (usb_host.c) want of each other.
 */
#ifndef USB_H
#define USB_H

#include "board.h"

#define PACKET 64U

typedef enum { TAKEN, REFUSED, STALLED } handshake_t;

/* The device, as the host sees it. Endpoints are numbers without directions. */
bool device_is_attached(void);
void device_bus_reset(void);
void device_frame(void);
handshake_t device_setup(const uint8_t setup[8]);
handshake_t device_out(unsigned endpoint, const uint8_t *bytes, size_t count);
handshake_t device_in(unsigned endpoint, uint8_t bytes[PACKET], size_t *count);

/* The host: the device was attached, or is gone. */
void host_attached(void);
void host_lost(void);

#endif
