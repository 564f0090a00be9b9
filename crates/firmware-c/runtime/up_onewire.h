/*
 * Answers on one wire: the checksum of 1-Wire, and the burst of a DHT22 or DHT11.
 *
 * A system makes the slots and takes the times; nothing here waits.
 */
#ifndef UP_ONEWIRE_H
#define UP_ONEWIRE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "up_result.h"

/* The commands by which a 1-Wire part is addressed. */
#define UP_ONEWIRE_READ_ROM 0x33U
#define UP_ONEWIRE_MATCH_ROM 0x55U
#define UP_ONEWIRE_SKIP_ROM 0xCCU

/* Bytes of a burst, and its falling edges: that of the answer, that before the first bit, and one after each bit. */
#define UP_BURST_BYTES 5U
#define UP_BURST_FALLS (2U + 8U * UP_BURST_BYTES)

/* What `count` bytes of a 1-Wire part are, the last of which is their checksum. UP_FRESH; UP_NOT_ACKNOWLEDGED if the
 * wire was left alone or held all the time; UP_WRONG_CRC. */
up_result_t up_onewire_check(const uint8_t *bytes, size_t count);

/* The bytes of a burst from the times of its falling edges, in microseconds from any moment; they may wrap. UP_FRESH;
 * UP_NOT_ACKNOWLEDGED without any edge; UP_TIMED_OUT if there are not UP_BURST_FALLS; UP_BUS_ERROR if a time is that
 * of no bit, because an edge came or was seen late; UP_WRONG_CRC. */
up_result_t up_burst_decode(const uint32_t *falls_us, size_t falls_count, uint8_t bytes[UP_BURST_BYTES]);

#endif
