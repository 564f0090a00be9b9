/*
 * The checksums of devices (those of frames are in up_encode.h).
 */
#ifndef UP_CHECKSUM_H
#define UP_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

/* The low byte of the sum of all bytes. */
uint8_t up_sum8(const uint8_t *bytes, size_t count);

/* The exclusive or of all bytes. */
uint8_t up_xor8(const uint8_t *bytes, size_t count);

/* The sum of all bytes, modulo 2^16. */
uint16_t up_sum16(const uint8_t *bytes, size_t count);

/* CRC-8, most significant bit first, not reflected, no final XOR. Polynomial 0x31 from 0xFF: Sensirion; 0xD5 from 0:
 * DVB-S2; 0x4D
 * from 0: LD06. */
uint8_t up_crc8(uint8_t polynomial, uint8_t start, const uint8_t *bytes, size_t count);

/* CRC-16 from 0, most significant bit first, not reflected, no final XOR. Polynomial 0x8005: UMTS; 0x1021: XMODEM. */
uint16_t up_crc16_of(uint16_t polynomial, const uint8_t *bytes, size_t count);

#endif
