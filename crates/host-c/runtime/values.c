/* Second: raw values, shown values, and how one becomes the other. */

/* Copies between the order of the wire and the processor's own. */
static void turn(uint8_t *to, const uint8_t *from, size_t bytes) {
    const uint16_t probe = 1;
    uint8_t first;
    size_t i;
    memcpy(&first, &probe, 1);
    for (i = 0; i < bytes; ++i) {
        to[i] = from[first == 1 ? bytes - 1 - i : i];
    }
}

static size_t element_bytes(const sensedsl_device *device) { return sensedsl_bytes(device) / device->count; }

/* The fastest types are as wide as those of the wire, so bytes are copied in place; a `bool` may be wider. */
void sensedsl_load(const sensedsl_device *device, const uint8_t *bytes, void *raw) {
    const size_t each = element_bytes(device);
    size_t i;
    for (i = 0; i < device->count; ++i) {
        if (device->type == SENSEDSL_BOOL) {
            ((bool *)raw)[i] = bytes[i] != 0;
        } else {
            turn((uint8_t *)raw + each * i, bytes + each * i, each);
        }
    }
}

/* The elements of a value, as they travel. */
static void put_value(const sensedsl_device *device, const void *raw, uint8_t *out) {
    const size_t each = element_bytes(device);
    size_t i;
    for (i = 0; i < device->count; ++i) {
        if (device->type == SENSEDSL_BOOL) {
            out[i] = ((const bool *)raw)[i] ? 1 : 0;
        } else {
            turn(out + each * i, (const uint8_t *)raw + each * i, each);
        }
    }
}

sensedsl_real sensedsl_number(const sensedsl_device *device, const void *raw, size_t element) {
    switch (device->type) {
    case SENSEDSL_BOOL:
        return (sensedsl_real)(((const bool *)raw)[element] ? 1 : 0);
    case SENSEDSL_UINT8:
        return (sensedsl_real)((const uint8_t *)raw)[element];
    case SENSEDSL_INT8:
        return (sensedsl_real)((const int8_t *)raw)[element];
    case SENSEDSL_UINT16:
        return (sensedsl_real)((const uint16_t *)raw)[element];
    case SENSEDSL_INT16:
        return (sensedsl_real)((const int16_t *)raw)[element];
    case SENSEDSL_UINT32:
        return (sensedsl_real)((const uint32_t *)raw)[element];
    case SENSEDSL_INT32:
        return (sensedsl_real)((const int32_t *)raw)[element];
    case SENSEDSL_UINT64:
        return (sensedsl_real)((const uint64_t *)raw)[element];
    case SENSEDSL_INT64:
        return (sensedsl_real)((const int64_t *)raw)[element];
    case SENSEDSL_FLOAT32:
        return (sensedsl_real)((const float *)raw)[element];
    case SENSEDSL_FLOAT64:
        return (sensedsl_real)((const double *)raw)[element];
    }
    return (sensedsl_real)0;
}

sensedsl_real sensedsl_shown(const sensedsl_device *device, sensedsl_real raw) {
    const sensedsl_point *curve = device->curve;
    const sensedsl_real x = device->scale * raw + device->offset;
    uint16_t i;
    if (!device->is_scaled) {
        return raw;
    }
    if (device->points == 0) {
        return x;
    }
    if (x <= curve[0].x) {
        return curve[0].y;
    }
    for (i = 1; i < device->points; ++i) {
        if (x < curve[i].x) {
            return curve[i - 1].y +
                   (x - curve[i - 1].x) * (curve[i].y - curve[i - 1].y) / (curve[i].x - curve[i - 1].x);
        }
    }
    return x >= curve[0].x ? curve[device->points - 1].y : x; /* not a number stays one */
}

bool sensedsl_is_within(const sensedsl_device *device, sensedsl_real shown) {
    return !(device->has_min && shown < device->min) && !(device->has_max && shown > device->max);
}

/* The raw number of a shown one, before rounding; false if no raw number is shown so. */
static bool unshown(const sensedsl_device *device, sensedsl_real shown, sensedsl_real *raw) {
    const sensedsl_point *curve = device->curve;
    bool is_there = device->points == 0;
    sensedsl_real x = shown;
    uint16_t i;
    if (!device->is_scaled) {
        *raw = shown;
        return true;
    }
    for (i = 1; i < device->points && !is_there; ++i) {
        const sensedsl_real one = curve[i - 1].y;
        const sensedsl_real other = curve[i].y;
        if ((one <= shown && shown <= other) || (other <= shown && shown <= one)) {
            is_there = true;
            x = curve[i - 1].x;
            if (one < other || other < one) {
                x += (shown - one) * (curve[i].x - curve[i - 1].x) / (other - one);
            }
        }
    }
    *raw = (x - device->offset) / device->scale;
    return is_there;
}

/* The least and the greatest code of integer types; those of 64 bits are the nearest numbers within them. */
static bool is_of_type(sensedsl_type type, sensedsl_real raw) {
    static const double least[] = {0, 0, -128, 0, -32768, 0, -2147483648.0, 0, -9223372036854775808.0};
    static const double greatest[] = {
        1, 255, 127, 65535, 32767, 4294967295.0, 2147483647.0, 18446744073709549568.0, 9223372036854774784.0};
    const double number = (double)raw;
    if (type == SENSEDSL_FLOAT32) {
        return number >= -3.4028234663852886e38 && number <= 3.4028234663852886e38;
    }
    if (type == SENSEDSL_FLOAT64) {
        return number - number >= 0; /* finite */
    }
    return number > least[type] - 0.5 && number < greatest[type] + 0.5;
}

/* Half way goes away from zero. */
static uint64_t rounded(sensedsl_real number) {
    const uint64_t whole = (uint64_t)number;
    return number - (sensedsl_real)whole >= (sensedsl_real)0.5 ? whole + 1 : whole;
}

bool sensedsl_code(const sensedsl_device *device, sensedsl_real shown, void *raw, size_t element) {
    const size_t each = element_bytes(device);
    uint8_t *out = (uint8_t *)raw + each * element;
    sensedsl_real number;
    uint64_t code;
    uint8_t bytes[8];
    size_t i;
    if (!sensedsl_is_within(device, shown) || !unshown(device, shown, &number) || !is_of_type(device->type, number)) {
        return false;
    }
    if (device->type == SENSEDSL_BOOL) {
        ((bool *)raw)[element] = number >= (sensedsl_real)0.5;
    } else if (device->type == SENSEDSL_FLOAT32) {
        const float value = (float)number;
        memcpy(out, &value, sizeof value);
    } else if (device->type == SENSEDSL_FLOAT64) {
        const double value = (double)number;
        memcpy(out, &value, sizeof value);
    } else {
        code = number < 0 ? 0U - rounded(-number) : rounded(number);
        for (i = 0; i < 8; ++i) {
            bytes[i] = (uint8_t)((code >> (56 - 8 * i)) & 0xFFU);
        }
        turn(out, bytes + 8 - each, each);
    }
    return true;
}
