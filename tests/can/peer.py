#!/usr/bin/env python3
"""A VESC on a simulated CAN bus, made of python-can and cantools alone: `peer.py DBC TERMINAL`.

It says each frame that it understands on a line of its own, and sends its status ten times a second.
"""

import sys
import time

import can
import cantools


def main():
    database = cantools.database.load_file(sys.argv[1])
    known = {(one.frame_id, one.is_extended_frame): one for one in database.messages}
    bus = can.Bus(interface="slcan", channel=sys.argv[2], sleep_after_open=0)
    print("on the bus", flush=True)
    status = {
        "VESC_Status1": {"Status_Rpm": -4321, "Status_Current": 12.3, "Status_Duty": -45.6},
        "VESC_Status5": {"Status_Tachometer": 77, "Status_Voltage": 46.5},
    }
    due = time.monotonic()
    while True:
        if time.monotonic() >= due:
            due += 0.1
            for name, values in status.items():
                message = database.get_message_by_name(name)
                bus.send(can.Message(arbitration_id=message.frame_id, is_extended_id=message.is_extended_frame,
                                     data=message.encode(values)))
        heard = bus.recv(0.02)
        if heard is None:
            continue
        message = known.get((heard.arbitration_id, heard.is_extended_id))
        if message is None:
            print(f"an unknown frame: {heard}", flush=True)
            continue
        values = message.decode(heard.data)
        print(message.name, " ".join(f"{name}={value:g}" for name, value in values.items()), flush=True)


if __name__ == "__main__":
    main()
