"""How fast the decoders of generated hosts are: Fig. 2's frames, with the value of each message read.

    cargo build -p sensedsl && python3 benches/hosts.py [PIECE...]

Generates the hosts, compiles them as a user does, optimised, and prints a table in Markdown: MB/s of processor time by
the size of the pieces that the stream is fed in, the best of five. All must have read the same sum of values.
"""
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
FRAMES = 1_000_000


def stream():
    """Frames with the four values of Fig. 2, and the messages and the sum of the values in them."""
    random.seed(2014)
    frames, total = [], 0
    for _ in range(FRAMES):
        front, right, rear, wheel = (random.randrange(1 << bits) for bits in (12, 12, 8, 32))
        payload = struct.pack(">BHBHBBBI", 17, front, 18, right, 19, rear, 20, wheel)
        frames.append(b"%d:%s," % (len(payload), payload))
        total += front + right + rear + wheel
    return b"".join(frames), 4 * FRAMES, total


def rust(folder):
    host = folder / "out/host/rust"
    shutil.copy(ROOT / "tests/hosts/time.rs", host / "examples/time.rs")
    build = "cargo build --quiet --release --offline --no-default-features --example time --target-dir".split()
    subprocess.run([*build, folder / "target"], cwd=host, check=True)
    return folder / "target/release/examples/time"


def c(folder):
    host = folder / "out/host/c"
    board = host / "fig2_STM32F4DiscoveryBoard.c"
    sources = [ROOT / "tests/hosts/time.c", host / "sensedsl.c", board]
    subprocess.run(["gcc", "-std=c99", "-O2", f"-I{host}", *sources, "-o", folder / "c"], check=True)
    return folder / "c"


HOSTS = {"rust": rust, "c": c}


def main():
    pieces = [int(word) for word in sys.argv[1:]] or [1, 64, 512, 65536]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        generate = [ROOT / "target/debug/sensedsl", "generate", "-q", "--without", "firmware", "--host", *HOSTS]
        subprocess.run([*generate, "-o", folder / "out", "--", ROOT / "examples/fig2.sense"], check=True)
        data, messages, total = stream()
        (folder / "stream").write_bytes(data)
        print("| host |", " | ".join(f"{piece} B" for piece in pieces), "|")
        print("| --- |", " | ".join("---:" for _ in pieces), "|")
        for host, build in HOSTS.items():
            program, row = build(folder), []
            for piece in pieces:
                times = []
                for _ in range(5):
                    ran = subprocess.run([program, folder / "stream", str(piece)], check=True, capture_output=True)
                    ns, *read = map(int, ran.stdout.split())
                    assert read == [messages, total], f"{host}: {read}"
                    times.append(ns)
                row.append(f"{len(data) / min(times) * 1e3:.3g}")
            print(f"| `{host}` |", " | ".join(row), "|", flush=True)


if __name__ == "__main__":
    main()
