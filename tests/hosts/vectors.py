"""Runs wire vectors through the decoder and encoder of the Python host: what `vectors.cpp` does for C++.

Arguments: the folder of the generated package's runtime, checksum, `stamp` or `-`, then an item each: `ID,KIND,NAME,TYPE,LENGTH`.
A stream is decoded at once, byte by byte, as given and cut at each place; `differs` says that two did not agree.
"""

import importlib.util
import sys

spec = importlib.util.spec_from_file_location("wire", sys.argv[1] + "/wire.py")
wire = importlib.util.module_from_spec(spec)
sys.modules["wire"] = wire
spec.loader.exec_module(wire)


def item(text):
    number, kind, name, type_, length = text.split(",")
    return wire.Item(int(number), name, kind == "sensor", type_, int(length) if length else None)


schema = wire.Schema([item(text) for text in sys.argv[4:]], sys.argv[2], sys.argv[3] == "stamp")
items = {one.id: one for one in schema.items}


def shown(id_, value):
    if items[id_].type == "bool":
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else str(value)


def health_words(health):
    load = 255 if health.load_percent is None else health.load_percent
    stack = 65535 if health.stack_left_bytes is None else health.stack_left_bytes
    words = [health.uptime_ms, health.reset_cause, health.reset_device, health.reports_sent,
             health.reports_refused, load, stack]
    for device in health.devices:
        age = 0xFFFFFFFF if device.age_ms is None else device.age_ms
        words.append("%d=%s" % (device.id, "/".join(map(str, (device.status, age) + device.failures))))
    return " ".join(map(str, words))


def line(frame):
    if isinstance(frame, wire.Hello):
        return "got hello 0x%08x" % frame.hash
    if isinstance(frame, wire.HelloRequest):
        return "got hello-request"
    if isinstance(frame, wire.HealthRequest):
        return "got health-request"
    if isinstance(frame, wire.OtherHealth):
        return "got health-version %d" % frame.version
    if isinstance(frame, wire.Health):
        return "got health " + health_words(frame)
    stamp = "" if frame.stamp is None else " stamp=%d/%d" % frame.stamp
    values = "".join(" %d=%s" % (id_, ",".join(shown(id_, one) for one in value)) for id_, value in frame.values)
    return "got" + stamp + values


def decode(sensors, pieces):
    decoder = wire.Decoder(schema, sensors)
    lines = [line(frame) for piece in pieces for frame in decoder.feed(piece)]
    return lines + ["dropped %d" % decoder.dropped_bytes]


def decoded(sensors, pieces):
    whole = b"".join(pieces)
    result = decode(sensors, [whole])
    ways = [pieces, [whole[at:at + 1] for at in range(len(whole))]]
    ways += [[whole[:at], whole[at:]] for at in range(len(whole) if len(whole) < 400 else 0)]
    return result if all(decode(sensors, way) == result for way in ways) else result + ["differs"]


def scalar(type_, text):
    if type_ == "bool":
        return text in ("1", "true")
    return float(text) if type_.startswith("float") else int(text)


def encoded(sensors, words):
    stamp, values = None, {}
    for word in words:
        key, list_ = word.split("=")
        if key == "stamp":
            time_us, counter = list_.split("/")
            stamp = wire.Stamp(int(time_us), int(counter))
        else:
            values[int(key)] = tuple(scalar(items[int(key)].type, text) for text in list_.split(","))
    return wire.encode_report(schema, sensors, values, stamp)


def encoded_health(words):
    numbers = [int(word) for word in words[:7]]
    devices = []
    for word in words[7:]:
        id_, list_ = word.split("=")
        status, age, *failures = [int(number) for number in list_.split("/")]
        devices.append(wire.DeviceHealth(int(id_), status, None if age == 0xFFFFFFFF else age, tuple(failures)))
    load, stack = numbers[5], numbers[6]
    return wire.encode_health(schema, wire.Health(
        *numbers[:5], None if load == 255 else load, None if stack == 65535 else stack, tuple(devices)))


for asked in sys.stdin:
    command, *words = asked.split()
    if command == "hash":
        answer = ["hello " + wire.encode_hello(schema).hex(),
                  "hello-request " + wire.encode_hello_request(schema).hex(),
                  "health-request " + wire.encode_health_request(schema).hex()]
    elif command == "decode":
        answer = decoded(words[0] == "sensors", [bytes.fromhex(word) for word in words[1:]])
    elif command == "encode":
        answer = ["frame " + encoded(words[0] == "sensors", words[1:]).hex()]
    else:
        answer = ["frame " + encoded_health(words).hex()]
    print("\n".join(answer + ["end"]))
