"""Drivers as they are written, and what they make of bytes: parser, values, formulas, messages.

A second reading of the data language, which shares no code with the tool or the runtime. `check.py` uses it.
"""

import math
import re
import struct

UNITS = {"us": 1e-6, "ms": 1e-3, "s": 1, "Hz": 1, "kHz": 1e3, "MHz": 1e6, "V": 1, "mV": 1e-3, "Ohm": 1, "kOhm": 1e3}
TOKEN = re.compile(r"//[^\n]*|\s+|\.\.|0x[0-9A-Fa-f]+|0b[01]+|\d+(?:\.\d+)?(?:[eE][+-]?\d+)?"
                   r"|[A-Za-z]\w*|\"(?:[^\"\\]|\\.)*\"|[{}\[\]()=;,+*/-]")
SIZES = {"bool": 1, "uint8": 1, "int8": 1, "uint16": 2, "int16": 2, "uint32": 4, "int32": 4, "uint64": 8, "int64": 8,
         "float32": 4}
NOTHING = object()


class Parser:
    """The part of the language that a driver is written in."""

    def __init__(self, text, name):
        self.tokens, at = [], 0
        while at < len(text):
            match = TOKEN.match(text, at)
            if not match:
                raise SyntaxError(f"{name}: {text[at:at + 20]!r}")
            at = match.end()
            if not match[0].isspace() and not match[0].startswith("//"):
                self.tokens.append(match[0])
        self.at, self.name = 0, name

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self, *wanted):
        token = self.peek()
        if wanted and token not in wanted:
            raise SyntaxError(f"{self.name}: {wanted} wanted, {' '.join(self.tokens[self.at - 5:self.at + 3])} found")
        self.at += 1
        return token

    def drivers(self):
        while self.peek():
            self.take("driver")
            driver = {"name": self.take(), "kind": None, "parts": {}}
            if self.peek() == "for":
                self.take()
                driver["kind"] = self.take()
            self.block(driver, driver["parts"])
            yield driver

    def block(self, owner, parts=None):
        self.take("{")
        owner["properties"] = {}
        while self.peek() != "}":
            word = self.take()
            if parts is not None and word in ("connection", "reading", "command") and self.peek() != "=":
                part = {"what": word, "name": self.take()}
                part["type"] = {"connection": "for", "reading": "returns", "command": "accepts"}[word]
                self.take(part["type"])
                part["type"], part["count"] = self.take(), 1
                if self.peek() == "[":
                    self.take()
                    part["count"] = int(self.take())
                    self.take("]")
                if part["name"] in parts:
                    raise SyntaxError(f"{self.name}: {part['name']} twice")
                self.block(part)
                parts[part["name"]] = part
            else:
                if word in owner["properties"]:
                    raise SyntaxError(f"{self.name}: {word} twice")
                self.take("=")
                owner["properties"][word] = self.value()
                self.take(";")
        self.take("}")

    def value(self):
        low = self.sum()
        if self.peek() == "..":
            self.take()
            return (low, self.sum())
        return low

    def sum(self):
        left = self.product()
        while self.peek() in ("+", "-"):
            left = left + self.product() if self.take() == "+" else left - self.product()
        return left

    def product(self):
        left = self.factor()
        while self.peek() in ("*", "/"):
            left = left * self.factor() if self.take() == "*" else left / self.factor()
        return left

    def factor(self):
        token = self.take()
        if token in ("+", "-"):
            return self.factor() * (-1 if token == "-" else 1)
        if token == "(":
            inner = self.sum()
            self.take(")")
            return inner
        if token == "[":
            items = []
            while self.peek() != "]":
                items.append(self.value())
                if self.peek() != "]":
                    self.take(",")
            self.take("]")
            return items
        if token.startswith('"'):
            return Text(token[1:-1].encode().decode("unicode_escape"))
        if token[0].isdigit():
            number = int(token, 0) if re.fullmatch(r"0[xb]\w+|\d+", token) else float(token)
            if self.peek() in UNITS:
                unit = self.take()
                return Quantity(number * UNITS[unit], unit)
            return number
        if token == "raw":
            return self.factor()
        return Word(token)


class Text(str):
    """A text in quotes."""


class Word(str):
    """A name."""


class Quantity(float):
    """A number with a unit, in seconds, hertz, volts or ohms."""

    def __new__(cls, value, unit):
        self = float.__new__(cls, value)
        self.unit = unit
        return self


def bytes_of(value):
    """A list of bytes, in which a text stands for its own."""
    if isinstance(value, str):
        return value.encode("latin-1")
    if not isinstance(value, list):
        return bytes([value])
    return b"".join(bytes_of(one) for one in value)


def unfractional(value):
    """A floating-point number of a vector, which has no fraction."""
    if value != int(value):
        raise ValueError(f"{value} is not whole")
    return int(value)


def signed(value, bits):
    return value - (1 << bits) if value >> (bits - 1) & 1 else value


# Reading a value out of bytes.

def get(part, driver, name, default=None):
    return part["properties"].get(name, driver["properties"].get(name, default))


def sensirion(data):
    crc = 0xFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = (crc << 1 ^ 0x31) & 0xFF if crc & 0x80 else crc << 1
    return crc


def slots(part, driver, length):
    """How many words the transfer has, and where the elements of the value stand."""
    places = get(part, driver, "elements", list(range(part["count"])))
    count = length // SIZES[part["type"]] if get(part, driver, "elements") else part["count"]
    return count, places


def decode(part, driver, data):
    """The elements of a value from the bytes that are its own."""
    order = "little" if get(part, driver, "order") == "little" else "big"
    is_signed = part["type"].startswith("int")
    packed = get(part, driver, "packed")
    if packed:
        whole = int.from_bytes(data, "little")
        words = [(whole >> packed * i & (1 << packed) - 1, packed) for i in range(part["count"])]
    else:
        count, places = slots(part, driver, len(data))
        width = len(data) // count
        words = [(int.from_bytes(data[i * width:(i + 1) * width], order), 8 * width) for i in places]
    values = []
    for word, bits in words:
        span = get(part, driver, "bits")
        if span:
            high, low = span if isinstance(span, tuple) else (span, span)
            word, bits = word >> low & (1 << (high - low + 1)) - 1, high - low + 1
        if part["type"] == "float32":
            word = unfractional(struct.unpack(">f", word.to_bytes(4, "big"))[0])
        elif get(part, driver, "format") == "bcd":
            word = int(f"{word:x}")
        elif get(part, driver, "format") == "sign_magnitude":
            word = -(word & (1 << bits - 1) - 1) if word >> bits - 1 else word
        elif is_signed:
            word = signed(word, bits)
        values.append(int(word != 0) if part["type"] == "bool" else word)
    return values


def is_invalid(rule, value):
    if isinstance(rule, list):
        return any(is_invalid(one, value) for one in rule)
    return rule[0] <= value <= rule[1] if isinstance(rule, tuple) else value == rule


def judged(part, driver, values):
    rule = get(part, driver, "invalid")
    if rule is not None and any(is_invalid(rule, value) for value in values):
        return "invalid"
    return values


# Formulas, from the data sheets.

def bosch(image, raw, with_humidity):
    t1, t2, t3, p1, p2, p3, p4, p5, p6, p7, p8, p9 = struct.unpack("<HhhHhhhhhhhh", image[:24])
    adc_p, adc_t = int.from_bytes(raw[0:3], "big") >> 4, int.from_bytes(raw[3:6], "big") >> 4
    if adc_t == 0x80000:
        return {}
    first = ((adc_t >> 3) - (t1 << 1)) * t2 >> 11
    second = (((adc_t >> 4) - t1) * ((adc_t >> 4) - t1) >> 12) * t3 >> 14
    fine = first + second
    out = {"temperature": fine * 5 + 128 >> 8}
    a = fine - 128000
    b = a * a * p6 + (a * p5 << 17) + (p4 << 35)
    a = (a * a * p3 >> 8) + (a * p2 << 12)
    a = ((1 << 47) + a) * p1 >> 33
    if a and adc_p != 0x80000:
        p = ((1048576 - adc_p << 31) - b) * 3125
        p = p // a if p >= 0 else -(-p // a)
        p = p + (p9 * (p >> 13) * (p >> 13) >> 25) + (p8 * p >> 19) >> 8
        out["pressure"] = p + (p7 << 4)
    if with_humidity:
        h1, h2, h3, h4, h45, h5, h6 = struct.unpack("<BhBbBbb", image[24:32])
        h4, h5 = h4 << 4 | h45 & 15, h5 << 4 | h45 >> 4
        adc = int.from_bytes(raw[6:8], "big")
        x = fine - 76800
        x = ((adc << 14) - (h4 << 20) - h5 * x + 16384 >> 15) * (
            (((x * h6 >> 10) * ((x * h3 >> 11) + 32768) >> 10) + 2097152) * h2 + 8192 >> 14)
        x = x - (((x >> 15) * (x >> 15) >> 7) * h1 >> 4)
        if adc != 0x8000:
            out["humidity"] = min(max(x, 0), 419430400) >> 12
    return out


def ntc(parameters, raw):
    beta, at_25, series = parameters
    if raw in (0, 4095):
        return {}
    ratio = series * raw / (4095 - raw) / at_25
    return {"temperature": round(100 / (1 / 298.15 + math.log(ratio) / beta) - 27315)}


def tsl2561(raw):
    both, infrared = struct.unpack("<HH", raw)
    if 0xFFFF in (both, infrared):
        return {}
    ratio = ((infrared << 10) // both + 1) >> 1 if both else 0
    table = [(0x40, 0x1F2, 0x1BE), (0x80, 0x214, 0x2D1), (0xC0, 0x23F, 0x37B), (0x100, 0x270, 0x3FE),
             (0x138, 0x16F, 0x1FC), (0x19A, 0xD2, 0xFB), (0x29A, 0x18, 0x12), (1 << 32, 0, 0)]
    b, m = next((b, m) for limit, b, m in table if ratio <= limit)
    return {"illuminance": max(0, both * b - infrared * m) * 1000 >> 14}


def hx711(raw):
    """Two bits a clock, the second of which counts; ready before them, high after them."""
    bits = f"{int.from_bytes(raw, 'big'):064b}"
    if "1" in bits[:8] or "0" in bits[57:]:
        return {}
    return {"load": signed(int(bits[9:56:2], 2), 24)}


# Messages on a serial port.

def checksum(kind, body):
    """The bytes of the checksum over `body`."""
    if kind == "sum8":
        return bytes([sum(body) & 0xFF])
    if kind == "sum7":
        return bytes([sum(body) & 0x7F])
    if kind == "not_sum8":
        return bytes([~sum(body) & 0xFF])
    if kind == "neg_sum8":
        return bytes([-sum(body) & 0xFF])
    if kind == "neg_sum16":
        return (-sum(body) & 0xFFFF).to_bytes(2, "big")
    if kind in ("crc16_umts", "crc16_xmodem"):
        rest = int.from_bytes(body + bytes(2), "big")
        polynomial = 0x18005 if kind == "crc16_umts" else 0x11021
        for bit in range(8 * len(body) + 15, 15, -1):
            rest ^= (rest >> bit & 1) * polynomial << bit - 16
        return rest.to_bytes(2, "little" if kind == "crc16_umts" else "big")
    if kind == "none":
        return b""
    if kind == "ibus":
        return (0xFFFF - sum(body)).to_bytes(2, "little")
    if kind == "sum16":
        return (sum(body) & 0xFFFF).to_bytes(2, "big")
    value, polynomial = 0, {"crc8_dvb_s2": 0xD5, "crc8_ld06": 0x4D}.get(kind)
    for byte in body:
        value ^= byte
        for _ in range(8 if polynomial else 0):
            value = (value << 1 ^ polynomial) & 0xFF if value & 0x80 else value << 1
    return bytes([value]) if kind != "nmea" else b"%02X" % value


def capsules(stream, size):
    """The capsules of a SLAMTEC scanner: A and 5 are the high halves of the first two bytes, the low ones are a sum."""
    at = 0
    while at + size <= len(stream):
        one, announced = stream[at:at + size], bytes([0xA5, 0x5A, size, 0, 0, 0x40])
        if one.startswith(announced) or one[:2].hex()[::2] != "a5":
            at += 1
            continue
        total = 0
        for byte in one[2:]:
            total ^= byte
        is_whole = f"{total:02x}" == one[:2].hex()[:0:-2]
        yield one if is_whole else None
        at += size if is_whole else 1


def messages(driver, stream):
    """The messages in the stream: their bytes between start and checksum or end; None where the checksum is wrong."""
    give = driver["properties"].get
    start, end = bytes_of(give("start", [])), bytes_of(give("end", []))
    kind = str(give("checksum", "none"))
    if kind == "slamtec":
        yield from capsules(stream, give("length", 0))
        return
    at = 0
    while (at := stream.find(start, at)) >= 0:
        first = at + len(start)
        if end and (kind == "nmea" or "length" not in driver["properties"]):
            last = stream.find(end, first)
            if last < 0:
                return
            body, at = stream[first:last], last + len(end)
            if kind == "nmea":
                body, star, said = body.rpartition(b"*")
                if not star or said.upper() != checksum(kind, body):
                    yield None
                    continue
            yield body
            continue
        last = first + give("length", 0)
        body = stream[first:last]
        if len(body) < give("length", 0):
            return
        if kind != "none":
            wanted = checksum(kind, (start + body)[give("checksum_from", 0):])
            if stream[last:last + len(wanted)] != wanted:
                yield None
                at += 1
                continue
            last += len(wanted)
        if stream[last:last + len(end)] != end:
            at += 1
            continue
        at = last + len(end)
        yield body


def with_address(value, address):
    """The bytes of a list in which the word `address` stands for the part's own."""
    if isinstance(value, list):
        return bytes(address if str(one) == "address" else one for one in value)
    return bytes_of(value)


def asked(part, driver):
    """The bytes that ask for a reading, the message that its answer must be, and how it is bounded."""
    give = lambda name, default: get(part, driver, name, default)
    address = give("address", None)
    first = give("checksum_from", 0)
    request = with_address(part["properties"]["request"], address)
    kind = str(give("checksum", "none"))
    request += checksum(str(give("request_checksum", kind)), request[first:]) + bytes_of(give("request_end", []))
    start = with_address(part["properties"].get("start", []), address)
    return request, start, kind, first


def answered(part, driver, answer):
    """The body of an answer: None where it is damaged, NOTHING where it is none."""
    request, start, kind, first = asked(part, driver)
    end = bytes_of(get(part, driver, "end", []))
    body = part["properties"].get("body")
    if not answer.startswith(start):
        return NOTHING
    if body is None:
        return answer[len(start):-len(end)] if answer.endswith(end) else NOTHING
    last = len(start) + body
    before = (request if str(get(part, driver, "sums_request", "false")) == "true" else b"") + answer[:last]
    if len(answer) < last + len(checksum(kind, before)) + len(end):
        return NOTHING
    return answer[len(start):last] if answer[last:] == checksum(kind, before[first:]) + end else None


def told(part, driver, data):
    """The message of a command."""
    give = lambda name, default: get(part, driver, name, default)
    address = give("address", None)
    message = with_address(give("start", []), address) + data + with_address(give("behind", []), address)
    message += checksum(str(give("checksum", "none")), message[give("checksum_from", 0):])
    return message + bytes_of(give("end", []))


def number(text, decimals):
    if not re.fullmatch(r"[+-]?\d+(\.\d*)?", text):
        return None
    sign, text = (-1, text[1:]) if text[0] == "-" else (1, text.lstrip("+"))
    whole, _, part = text.partition(".")
    scaled = int(whole + (part + "0" * (decimals + 1))[:decimals + 1])
    return sign * ((scaled + 5) // 10)


def field(part, driver, body):
    """The value of a reading from a line of text, or None where the line does not have it."""
    give = part["properties"].get
    fields = body.decode("latin-1").split(driver["properties"].get("separator", ","))
    if "sentence" in part["properties"]:
        if fields[0][-3:] != give("sentence") or fields[0].startswith("P"):
            return NOTHING
        fields = fields[1:]
    text = fields[give("field")] if give("field") < len(fields) else ""
    if text == "":
        return "nothing"
    if give("format") == "degrees":
        point = text.index(".") if "." in text else len(text)
        minutes = number(text[point - 2:], 7)
        value = int(text[:point - 2] or 0) * 10**7 + (2 * minutes + 60) // 120
        return [-value if fields[give("field") + 1] in "SW" else value]
    value = number(text, give("decimals", 0))
    return "invalid" if value is None else [value]
