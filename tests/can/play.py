#!/usr/bin/env python3
"""Sends every message of a DBC file with drawn values, by python-can and cantools alone: `play.py DBC TERMINAL SEED`.

It says each signal with its physical value, `all` at the end of them, and then sends the frames until it is ended.
"""

import os
import random
import sys
import time

import can
import cantools


def drawn(chance, signal):
    if signal.is_float:
        return chance.choice([1.5, -0.125, 3.0e6])
    low = -(1 << signal.length - 1) if signal.is_signed else 0
    return chance.choice([low, low + (1 << signal.length) - 1, low + chance.getrandbits(signal.length)])


def physical(signal, raw):
    return raw * signal.conversion.scale + signal.conversion.offset


def frames(message, chance):
    selectors = [one for one in message.signals if one.is_multiplexer]
    pages = {page for one in message.signals for page in one.multiplexer_ids or []}
    for page in sorted(pages) or [None]:
        raw = {}
        for signal in message.signals:
            if signal.is_multiplexer:
                raw[signal.name] = page
            elif signal.multiplexer_ids is None or page in signal.multiplexer_ids:
                raw[signal.name] = drawn(chance, signal)
        for signal in message.signals:
            if signal.name in raw and signal not in selectors:
                print(signal.name, repr(float(physical(signal, raw[signal.name]))))
        data = message.encode(raw, scaling=False, strict=False)
        yield can.Message(arbitration_id=message.frame_id, is_extended_id=message.is_extended_frame, data=data)


def main():
    database = cantools.database.load_file(sys.argv[1])
    chance = random.Random(int(sys.argv[3]))
    everything = [frame for message in database.messages for frame in frames(message, chance)]
    bus = can.Bus(interface="slcan", channel=sys.argv[2], sleep_after_open=0)
    print("all", flush=True)
    try:
        while True:
            for frame in everything:
                bus.send(frame)
            time.sleep(0.05)
    except can.CanError:
        # The board is gone, and so is what it would be told at the end.
        os._exit(0)


if __name__ == "__main__":
    main()
