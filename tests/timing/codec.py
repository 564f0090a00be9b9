"""Compares the codec of the paper's Fig. 2 with nanopb: bytes of program and instructions of an emulated Cortex-M4.

    cargo test --workspace --test all -- firmware::core::runs_on_the_host_with_gcc
    python3 tests/timing/codec.py [SCRATCH]

Ours is what that test has generated for the vectors of Fig. 2, for both ends of the link. Needs arm-none-eabi-gcc,
qemu-system-arm, apt, and a network: nanopb 0.4.7 comes from the Debian mirror of this machine, its generator from PyPI.
Nothing of it is kept here. Ends with 1 when the codec is larger or slower than promised.
"""

import hashlib
import os
import pathlib
import subprocess
import sys
import tarfile
import tempfile
import urllib.parse
import urllib.request
import venv

NANOPB = "nanopb_0.4.7.orig.tar.gz"
NANOPB_SHA256 = "e1d89b166367a3c42d42311bdc2ed57ff78f86aede9a66828516e45490d48c81"
ROOT = pathlib.Path(__file__).resolve().parents[2]
TARGET = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
OURS = ["up_encode.c", "up_decode.c", "up_wire.c"]
THEIRS = ["pb_encode.c", "pb_decode.c", "pb_common.c"]
# What the compiler is told of Fig. 2's wire, as the generated Makefile does.
LEFT_OUT = [f"-DUP_WIRE_{part}=0" for part in ("CHECKSUMS", "STAMPS", "BOOLS", "MEMO")]
CORTEX = ["-std=c11", "-O2", "-mcpu=cortex-m4", "-mthumb", "-ffunction-sections", "-fdata-sections"]
# Functions that are the codec's; hellos, health and the rest of these files are not.
CODEC = {"put_report", "report_item", "take_report", "sense_reports", "up_encode_values", "close_frame", "open_frame",
         "up_decoder_init", "up_decoder_feed", "run"}
MOST_BYTES, MOST_ENCODE, MOST_DECODE = 1500, 1000, 1600


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, **options).stdout


def codec_of_fig2(folder):
    folder.mkdir()
    for source in (TARGET / "tmp/firmware/codecs").glob("fig2_*"):
        text = source.read_text().replace("fig2_", "sense_").replace("FIG2_", "SENSE_")
        (folder / source.name.replace("fig2_", "sense_")).write_text(text)
    return folder


def fetch(folder):
    archive = folder / "nanopb.tar.gz"
    # The source is beside the package.
    package = run("apt-get", "download", "--print-uris", "libnanopb-dev").split("'")[1]
    urllib.request.urlretrieve(urllib.parse.urljoin(package, NANOPB), archive)
    if hashlib.sha256(archive.read_bytes()).hexdigest() != NANOPB_SHA256:
        sys.exit("nanopb's archive is another one")
    with tarfile.open(archive) as tar:
        tar.extractall(folder, filter="data")
    venv.create(folder / "venv", with_pip=True)
    run(folder / "venv/bin/pip", "install", "-q", "nanopb==0.4.9.1", "grpcio-tools")
    for name in ("fig2.proto", "fig2.options"):
        (folder / name).write_bytes((ROOT / "tests/timing/codec" / name).read_bytes())
    run(folder / "venv/bin/nanopb_generator", "fig2.proto", cwd=folder)
    return folder / "nanopb-0.4.7"


def counts(program, sources, flags):
    start = ROOT / "tests/firmware/vectors_cortex_m.c"
    link = ["--specs=rdimon.specs", "-Wl,--section-start=.isr_vector=0x0", "-Wl,-Tdata=0x20000000"]
    run("arm-none-eabi-gcc", *CORTEX, *flags, *link, *sources, start, "-o", program)
    said = run("qemu-system-arm", "-M", "mps2-an386", "-nographic", "-monitor", "none", "-serial", "none",
               "-semihosting-config", "enable=on,target=native", "-icount", "shift=0,sleep=off", "-kernel", program)
    return {name: int(number) for name, number in (line.split() for line in said.split("\n") if line)}


def size(program, wanted):
    total = 0
    for line in run("arm-none-eabi-nm", "-S", program).splitlines():
        words = line.split()
        if len(words) == 4 and words[2] in "TtRr" and wanted(words[3].split(".")[0]):
            total += int(words[1], 16)
    return total


def main():
    scratch = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else tempfile.mkdtemp()).resolve()
    scratch.mkdir(exist_ok=True)
    codec, nanopb = codec_of_fig2(scratch / "ours"), fetch(scratch)
    bench, core = ROOT / "tests/timing/codec", ROOT / "crates/firmware-c/runtime"
    ours = counts(scratch / "ours.elf", [bench / "ours.c", codec / "sense_codec.c", *(core / name for name in OURS),
                                         core / "up_health.c"], [f"-I{core}", f"-I{codec}", f"-I{bench}", *LEFT_OUT])
    theirs = counts(scratch / "theirs.elf", [bench / "theirs.c", scratch / "fig2.pb.c", *(nanopb / name for name in THEIRS)],
                    [f"-I{nanopb}", f"-I{scratch}", f"-I{bench}"])
    # CSWTCH is what the compiler makes of a switch.
    ours["bytes"] = size(scratch / "ours.elf", lambda name: name in CODEC or name == "CSWTCH")
    theirs["bytes"] = size(scratch / "theirs.elf", lambda name: name.startswith(("pb_", "Report_", "encode_", "decode_",
                           "buf_", "read_", "advance_", "load_", "default_", "allocate_", "iter_", "safe_", "check_")))
    print("| | SenseDSL | nanopb 0.4.7 |\n| --- | ---: | ---: |")
    for name, what in (("bytes", "bytes of program"), ("encode", "instructions to encode"), ("decode", "instructions to decode")):
        print(f"| {what} | {ours[name]:,} | {theirs[name]:,} |")
    sys.exit(ours["bytes"] >= MOST_BYTES or ours["encode"] >= MOST_ENCODE or ours["decode"] >= MOST_DECODE)


if __name__ == "__main__":
    main()
