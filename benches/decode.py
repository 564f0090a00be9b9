"""How fast the decoders are, beside memcpy and a plain reader in Python, in one run.

    python3 benches/decode.py [MIB [PIECE...]]

Compiles the decoders in C and C++ (`gcc`, `g++ -O2`) and in Rust (`cargo`, release) and prints a table in
Markdown: MB/s by stream and size of the pieces that the stream is fed in. What is hard for a decoder is
among the streams: what looks like a frame and is none, frame within frame.
"""
import binascii
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
TYPES = ["bool", "uint8", "int8", "uint16", "int16", "uint32", "int32", "uint64", "int64", "float32", "float64"]
CODES = dict(zip(TYPES, "?BbHhIiQqfd"))
FIG2 = [(17, "uint16", 1), (18, "uint16", 1), (19, "uint8", 1), (20, "uint32", 1)]
BYTES_26 = [(1, "bool", 1), (2, "int16", 3), (3, "float32", 1), (4, "uint32", 1), (5, "uint8", 2)]
ARRAY = 3000
DEEP = [(ord("a"), "uint8", ARRAY), *((i, "uint8", 1) for i in range(100, 200))]
WIDE = [(i, "uint8", 2500 if i == ord("a") else 1) for i in range(1, 255)]


def value_bytes(item):
    return struct.calcsize(CODES[item[1]]) * item[2]


def frame(payload, crc):
    if crc:
        payload += b"\xff" + struct.pack(">H", binascii.crc_hqx(payload, 0xFFFF))
    return b"%d:%s," % (len(payload), payload)


def reports(items, crc):
    def payload():
        for item in items:
            yield bytes([item[0]])
            is_bool = item[1] == "bool"
            yield bytes(random.randrange(2 if is_bool else 256) for _ in range(value_bytes(item)))

    return b"".join(frame(b"".join(payload()), crc) for _ in range(3000))


def bad_commas():
    """Frames of 3 kB right up to the comma, full of shorter ones that are wrong in the same way."""
    value = (b"3001:a" * ARRAY)[:ARRAY]
    return (frame(b"a" + value, False)[:-1] + b";") * 20


def bad_sums():
    """Each candidate, six bytes apart, is a frame of 3 kB that is right but for its checksum."""
    candidates, region_bytes = 33, 200
    period = 6 * candidates + region_bytes + 4
    # The value of `a` ends where the region of a later period begins.
    array = 7 * period + 6 * candidates - 5 - 1
    region = b"".join(bytes([100 + i, 7]) for i in range(region_bytes // 2)) + b"\xff\0\0,"
    heads = b""
    for i in range(candidates):
        heads += b"%d:a" % (array + 1 + region_bytes - 6 * i + 3)
    assert len(heads) == 6 * candidates
    return (heads + region) * 60, array


def long_walks():
    """Each candidate goes through up to 253 identifiers until it ends wrong."""
    pad = bytes(b for i in range(1, 255) if i != ord("a") for b in (i, ord(",")))
    # The length ends at a value that is a comma, one byte behind an identifier.
    heads = b"2998:a" * (2500 // 6)
    return (heads + pad * 6) * 12


def python_reader(items, crc, stream, piece):
    """What one writes for the purpose."""
    codes = {item[0]: struct.Struct(">%d%s" % (item[2], CODES[item[1]])) for item in items}
    held, values = b"", {}
    for at in range(0, len(stream), piece):
        held += stream[at : at + piece]
        while True:
            colon = held.find(b":")
            if colon < 0:
                break
            if not held[:colon].isdigit() or colon > 4:
                held = held[1:]
                continue
            end = colon + 1 + int(held[:colon])
            if len(held) <= end:
                break
            payload = held[colon + 1 : end]
            if held[end] != ord(","):
                held = held[1:]
                continue
            if crc and binascii.crc_hqx(payload[:-3], 0xFFFF).to_bytes(2, "big") != payload[-2:]:
                held = held[1:]
                continue
            item = 0
            while item < len(payload) and payload[item] in codes:
                code = codes[payload[item]]
                if item + 1 + code.size > len(payload):
                    break
                values[payload[item]] = code.unpack_from(payload, item + 1)
                item += 1 + code.size
            held = held[end + 1 :]


class Program:
    def __init__(self, command):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def mb_per_s(self, who, schema, stream, piece):
        repeats = 1
        while True:
            pipe = self.process.stdin
            pipe.write(b"%s time %d %d 1 %d\n" % (who.encode(), repeats, len(schema), len(stream)))
            pipe.write(schema + struct.pack("=I", piece) + stream)
            pipe.flush()
            ns = int(self.process.stdout.readline())
            if ns > 10_000_000:
                return len(stream) * repeats / ns * 1e3
            # The system counts in steps of some milliseconds: a first 0 says little.
            repeats = min(10 * repeats, max(2 * repeats, int(repeats * 12_000_000 / max(ns, 1000))))


def build(folder):
    objects = []
    for compiler, source in [
        ("gcc -std=c99 -O2 -D_POSIX_C_SOURCE=199309L -DDECODERS_C_FRAMES=2", "tests/decoders/c.c"),
        ("gcc -std=c99 -O2 -D_POSIX_C_SOURCE=199309L", "tests/decoders/main.c"),
        *(("gcc -std=c99 -O2", f"crates/firmware-c/runtime/up_{name}.c") for name in ["decode", "encode", "memo", "schema"]),
        ("g++ -std=c++98 -O2", "tests/decoders/cpp.cpp"),
    ]:
        objects.append(f"{folder}/{pathlib.Path(source).stem}.o")
        includes = [f"-I{ROOT}/crates/firmware-c/runtime", f"-I{ROOT}/crates/host-cpp/runtime"]
        subprocess.run([*compiler.split(), *includes, "-c", ROOT / source, "-o", objects[-1]], check=True)
    subprocess.run(["g++", *objects, "-o", f"{folder}/decoders"], check=True)
    cargo = "cargo build -q --release -p sensedsl-wire --example decode_time --message-format json"
    built = subprocess.run(cargo.split(), cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    rust = [line.split('"executable":"')[1].split('"')[0] for line in built.splitlines() if '"executable":"' in line]
    return Program([f"{folder}/decoders"]), Program([rust[-1]])


def main():
    mib = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    pieces = [int(word) for word in sys.argv[2:]] or [1, 64, 512, 65536]
    random.seed(2014)
    sums, array = bad_sums()
    deep_sums = [(ord("a"), "uint8", array), *DEEP[1:]]
    rows = [
        ("Fig. 2", FIG2, False, reports(FIG2, False)),
        ("Fig. 2, crc16", FIG2, True, reports(FIG2, True)),
        ("26 bytes", BYTES_26, False, reports(BYTES_26, False)),
        ("26 bytes, crc16", BYTES_26, True, reports(BYTES_26, True)),
        ("random bytes", FIG2, False, random.randbytes(1 << 18)),
        ("`1111…`", DEEP, False, b"1" * (1 << 16)),
        ("`9:9:9:…`", [(57, "uint8", 1), *DEEP], False, b"9:" * (1 << 15)),
        ("`2999:a2999:a…`, 3 kB", DEEP, False, b"2999:a" * (1 << 14)),
        ("3 kB, comma wrong", DEEP, False, bad_commas()),
        ("3 kB, sums wrong", deep_sums, True, sums),
        ("254 identifiers", WIDE, False, long_walks()),
    ]
    with tempfile.TemporaryDirectory() as folder:
        c, rust = build(folder)
        print("| stream | pieces | memcpy | Rust | C | C++ | Python | C++ to Python | memcpy to C++ |")
        print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
        for name, items, crc, stream in rows:
            table = b"".join(struct.pack(">BBBH", i, TYPES.index(t), 0, n) for i, t, n in items)
            schema = bytes([crc]) + table
            stream = stream * max(1, int(mib * (1 << 20) / len(stream)))
            copied = c.mb_per_s("memcpy", schema, stream, 0)
            for piece in pieces:
                here = [
                    rust.mb_per_s("rust", schema, stream, piece),
                    c.mb_per_s("c", schema, stream, piece),
                    c.mb_per_s("cpp", schema, stream, piece),
                ]
                start, some = time.process_time(), stream[: 1 << 13]
                python_reader(items, crc, some, piece)
                python = len(some) / (time.process_time() - start) / 1e6
                figures = " | ".join(f"{figure:.3g}" for figure in here)
                ratios = f"{here[2] / python:.3g} | {copied / here[2]:.3g}"
                print(f"| {name} | {piece} | {copied:.3g} | {figures} | {python:.3g} | {ratios} |", flush=True)


if __name__ == "__main__":
    main()
