/*
 * Serial ports by number, as C sees them: generated, because an object of the framework takes RAM as soon as it is named.
 */
#ifndef UP_PORTS_H
#define UP_PORTS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#if defined(__cplusplus)
extern "C" {
#endif

/* Opens the ports of devices. */
void sense_ports_start(void);

/* Takes at most `size` bytes that have come; returns how many. */
size_t sense_port_read(uint8_t port, uint8_t *bytes, size_t size);

/* Sends bytes, all or none. */
bool sense_port_write(uint8_t port, const uint8_t *bytes, size_t size);

#if defined(__cplusplus)
}
#endif

#endif
