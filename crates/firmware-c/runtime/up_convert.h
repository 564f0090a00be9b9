/*
 * From hardware measurements to the return type of a sensor.
 *
 * Integers saturate instead of wrapping; bool is "not zero"; floating point is converted. The destination is in machine
 * representation and need not be aligned.
 */
#ifndef UP_CONVERT_H
#define UP_CONVERT_H

#include "up_schema.h"

/* Stores one element. */
void up_store_unsigned(uint8_t type, uint64_t raw, void *element);
void up_store_signed(uint8_t type, int64_t raw, void *element);

/* Stores numerator/denominator: rounded half away from zero for integers, to nearest for floating point. A
 * denominator of 0 stores 0. */
void up_store_ratio(uint8_t type, uint64_t numerator, uint64_t denominator, void *element);
void up_store_signed_ratio(uint8_t type, bool is_negative, uint64_t numerator, uint64_t denominator, void *element);

/* The reverse: the magnitude of one element, rounded half away from zero. NaN is 0, and a number that is too large
 * is UINT64_MAX. */
uint64_t up_load_magnitude(uint8_t type, const void *element, bool *is_negative);

/* Stores the mean of `count` samples that are `stride` apart (one column of a conversion group's buffer). */
void up_store_mean(uint8_t type, const uint16_t *samples, size_t count, size_t stride, void *element);

/* Converts the register bytes of a device to a whole value. Each element takes bytes_count/field->count bytes;
 * integers are sign-extended if the type is signed; 4 bytes for a float32 and 8 for a float64 are IEEE 754 bits,
 * fewer are an unsigned number. Bytes that do not divide evenly (or more than 8 per element) store nothing and
 * return false. */
bool up_store_bytes(UP_ROM up_field_t *field, const uint8_t *bytes, size_t bytes_count, bool little_endian,
                    void *value);

/* The reverse, for a device that is written to: the low bytes of each element. */
bool up_load_bytes(UP_ROM up_field_t *field, const void *value, uint8_t *bytes, size_t bytes_count,
                   bool little_endian);

#endif
