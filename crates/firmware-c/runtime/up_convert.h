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
void up_store_unsigned(uint8_t type, up_unsigned_t raw, void *element);
void up_store_signed(uint8_t type, up_signed_t raw, void *element);

/* Stores what a formula has computed, which has 64 bits also where no field has. */
#if UP_USES_WIDE
static inline void up_store_output(uint8_t type, int64_t output, void *element) {
  up_store_signed(type, output, element);
}
#else
void up_store_output(uint8_t type, int64_t output, void *element);
#endif

/* Stores numerator/denominator: rounded half away from zero for integers, to nearest for floating point. A
 * denominator of 0 stores 0. */
void up_store_ratio(uint8_t type, up_unsigned_t numerator, up_unsigned_t denominator, void *element);
void up_store_signed_ratio(uint8_t type, bool is_negative, up_unsigned_t numerator, up_unsigned_t denominator,
                           void *element);

/* number*factor/divisor, rounded half up; saturates. The product may have 64 bits, and no division of so many is linked.
 * A divisor of 0 gives 0. */
uint32_t up_scale(uint32_t number, uint32_t factor, uint32_t divisor);

/* Stores number*factor/divisor as a ratio. */
static inline void up_store_scaled(uint8_t type, uint32_t number, uint32_t factor, uint32_t divisor, void *element) {
#if UP_USES_WIDE
  up_store_ratio(type, (uint64_t)number * factor, divisor, element);
#else
  up_store_unsigned(type, up_scale(number, factor, divisor), element);
#endif
}

/* The reverse: the magnitude of one element, rounded half away from zero. NaN is 0, and a number that is too large
 * is UP_UNSIGNED_MAX. */
up_unsigned_t up_load_magnitude(uint8_t type, const void *element, bool *is_negative);

/* Stores the mean of `count` samples that are `stride` apart (one column of a conversion group's buffer). */
void up_store_mean(uint8_t type, const uint16_t *samples, size_t count, size_t stride, void *element);

/* Converts the register bytes of a device to a whole value. Each element takes bytes_count/field->count bytes;
 * integers are sign-extended if the type is signed; 4 bytes for a float32 and 8 for a float64 are IEEE 754 bits,
 * fewer are an unsigned number. Bytes that do not divide evenly (or more per element than an up_unsigned_t has) store
 * nothing and return false. */
bool up_store_bytes(UP_ROM up_field_t *field, const uint8_t *bytes, size_t bytes_count, bool little_endian,
                    void *value);

/* The reverse, for a device that is written to: the low bytes of each element. */
bool up_load_bytes(UP_ROM up_field_t *field, const void *value, uint8_t *bytes, size_t bytes_count,
                   bool little_endian);

#endif
