"""How deep the stacks of generated firmware get, against what is generated. Needs arm-none-eabi-gcc and CHIBIOS, a
ChibiOS 21.11 tree.

    python3 tests/timing/stacks.py target/debug/sensedsl [FOLDER] [DESIGN ...]

Builds each design of tests/timing/stacks in both modes and adds up the frames that GCC states (-fcallgraph-info) along
the deepest path of each thread. Where a table names the function that is called, TARGETS says which can be; a call
that it does not know is an error. Ends with 1 when a stack has less than a quarter to spare.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

SPARE = 1.25
OPTIONS = "-Os -ggdb -fomit-frame-pointer -fcallgraph-info=su"
SERIAL = r"hal_(serial|serial_lld|serial_usb|usart\w*)\.c:\w+"
FORMULAS = r"up_formula\w*\.c:\w+"
# What the functions of a file call through a pointer, as file and function. A user's transform has bytes of its own, which
# are not counted here.
TARGETS = {
    "up_chip.c": rf"up_(i2c|spi)_bus\.c:\w+|up_rt\.c:on_value|{FORMULAS}",
    "up_adc.c": FORMULAS,
    "up_rt.c": r"up_filter\.c:up_filter_apply",
    "up_filter.c": r"up_filter_double\.c:\w+",
    "up_message.c": r"up_uart\.c:on_value",
    "up_uart.c": SERIAL,
    "up_reporter.c": r"up_link\.c:\w+",
    "up_decode.c": r"up_reporter\.c:on_\w+|sense_codec\.c:\w+",
    "up_encode.c": r"up_reporter\.c:row_of|sense_codec\.c:\w+",
    "up_link.c": SERIAL,
    "up_link_serial.c": SERIAL,
    "up_link_usb.c": SERIAL,
    "up_shell.c": SERIAL,
    "up_doctor.c": r"up_shell\.c:say_finding|up_i2c_bus\.c:up_i2c_answers",
    "chprintf.c": r"up_shell\.c:stream_\w+",
    "shell.c": r"up_shell\.c:(stream|command)_\w+|shell_cmd\.c:cmd_\w+",
    "shell_cmd.c": r"up_shell\.c:stream_\w+",
    "hal_queues.c": SERIAL,
    "hal_buffers.c": SERIAL,
    "chschd.c": r"chschd\.c:\w*wakeup",
    "chvt.c": r"chschd\.c:\w*wakeup",
}


def graph(path):
    """The frame of each function, where it is, and whom it calls in which file."""
    frames, places, calls = {}, {}, {}
    for line in path.read_text().splitlines():
        node = re.match(r'node: \{ title: "([^"]+)" label: "([^"]*)"', line)
        if node:
            bytes_ = re.search(r"(\d+) bytes \((\w+)", node[2])
            frames[node[1]] = int(bytes_[1]) if bytes_ else 0
            file = re.search(r"([\w.]+):\d+:\d+", node[2])
            places[node[1]] = f"{file[1] if file else '?'}:{plain(node[1])}"
        edge = re.match(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"(?: label: "([^"]+)")?', line)
        if edge:
            calls.setdefault(edge[1], set()).add((edge[2], pathlib.Path((edge[3] or "?").split(":")[0]).name))
    return frames, places, calls


def plain(title):
    return re.split(r"\.(?:lto_priv|constprop|isra|part|cold)", title.split(":")[-1])[0]


class Depths:
    def __init__(self, graphs):
        self.frames, self.places, self.calls, self.known, self.unknown = {}, {}, {}, {}, set()
        for frames, places, calls in graphs:
            self.frames.update(frames)
            self.places.update(places)
            for caller, called in calls.items():
                self.calls.setdefault(caller, set()).update(called)

    def called(self, title):
        for target, file in self.calls.get(title, ()):
            if target != "__indirect_call":
                yield target
            elif plain(title) == "up_put":
                continue  # the user's transform
            elif file.endswith("_lld.c"):
                continue  # callbacks of interrupts
            elif file not in TARGETS:
                self.unknown.add(f"{plain(title)} ({file})")
            else:
                yield from (one for one, place in self.places.items() if re.fullmatch(TARGETS[file], place))

    def of(self, title, above=()):
        if title in above:
            return 0, []
        if title not in self.known:
            deepest = max((self.of(one, (*above, title)) for one in self.called(title)), default=(0, []))
            own = self.frames.get(title, 0)
            self.known[title] = own + deepest[0], [f"{plain(title)} {own}", *deepest[1]]
        return self.known[title]

    def named(self, name):
        return next((title for title in self.frames if plain(title) == name), None)


def rows(board, mode):
    folder = board / "build" / mode
    depths = Depths([graph(path) for path in folder.glob("*.ci")])
    hardware = (board / "generated/sense_hw.c").read_text()
    stacks = dict(re.findall(r"THD_WORKING_AREA\((\w+)_stack, (\d+)U", hardware))
    task = depths.frames.get(depths.named("run_task"), 0) + depths.frames.get(depths.named("_port_thread_start"), 0)
    for function, work in re.findall(r"\.cycle = (\w+),\s*\.work = &(\w+),", hardware):
        bytes_, path = depths.of(depths.named(function))
        yield function, work, bytes_ + task, int(stacks[work]), path
    if shell := depths.named("shellThread"):
        bytes_, path = depths.of(shell)
        source = (board / "uproxy/chibios/up_shell.c").read_text()
        yield "shell", "shell", bytes_, int(re.search(r"STACK_BYTES (\d+)U", source)[1]), path
    bytes_, path = depths.of(depths.named("main"))
    makefile = (board / "Makefile").read_text()
    yield "main", "main", bytes_, int(re.search(r"PROCESS_STACKSIZE +\?= (\w+)", makefile)[1]), path
    if depths.unknown:
        sys.exit(f"calls that TARGETS does not know: {sorted(depths.unknown)}")


def main():
    binary = pathlib.Path(sys.argv[1]).resolve()
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp())
    designs = sorted((pathlib.Path(__file__).parent / "stacks").glob("*.sense"))
    designs = [file for file in designs if not sys.argv[3:] or file.stem in sys.argv[3:]]
    is_short = False
    print("| design | mode | thread | deepest | generated |\n| --- | --- | --- | ---: | ---: |")
    for file in designs:
        subprocess.run([binary, "generate", file, "-o", folder / file.stem, "-q", "--without", "host"], check=True)
        board = next((folder / file.stem / "firmware").iterdir())
        for mode in ("production", "development"):
            make = ["make", "-s", "-j2", "-C", board, f"CHIBIOS={os.environ['CHIBIOS']}", f"UP_MODE={mode}", f"USE_OPT={OPTIONS}"]
            subprocess.run(make, check=True, stdout=subprocess.DEVNULL)
            for function, work, deepest, generated, path in rows(board, mode):
                is_short = is_short or deepest * SPARE > generated
                print(f"| `{file.stem}` | {mode} | `{work}` | {deepest} | {generated} |", flush=True)
                if os.environ.get("PATHS"):
                    print("   ", " > ".join(path))
    sys.exit(is_short)


if __name__ == "__main__":
    main()
