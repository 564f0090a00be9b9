"""An OD4 peer that shares no code with the hosts: pycluon and protobuf.

od4_peer.py CID ODVD [NUMBER:MESSAGE:FIELD=VALUE,...]...
Prints a line for each message, `NUMBER STAMP FIELD=VALUE ...`. The messages given are sent once the first
message has come, so that the host is known to listen.
"""

import pathlib
import sys
import time

import pycluon
from pycluon.importer import import_odvd


def main():
    cid, odvd, *sends = sys.argv[1:]
    module = import_odvd(pathlib.Path(odvd))
    names = {}
    number = None
    for line in pathlib.Path(odvd).read_text(encoding="utf-8").splitlines():
        if line.startswith("message "):
            name, rest = line.removeprefix("message ").split(" ", 1)
            number = int(rest.split("=")[1].split("]")[0])
            names[number] = name.replace(".", "_")
    heard = []

    def on_message(envelope):
        message = getattr(module, names[envelope.data_type])()
        message.ParseFromString(envelope.serialized_data)
        fields = [f"{f.name}={getattr(message, f.name)}" for f in message.DESCRIPTOR.fields]
        print(envelope.data_type, envelope.sender_stamp, *fields, flush=True)
        heard.append(envelope)

    session = pycluon.OD4Session(int(cid))
    for number in names:
        session.add_data_trigger(number, on_message)
    print("ready", flush=True)
    while True:
        time.sleep(0.01)
        if heard and sends:
            number, name, fields = sends.pop(0).split(":")
            message = getattr(module, name)()
            for field in fields.split(","):
                key, value = field.split("=")
                kind = type(getattr(message, key))
                setattr(message, key, value == "True" if kind is bool else kind(value))
            envelope = pycluon.Envelope()
            envelope.data_type = int(number)
            envelope.serialized_data = message.SerializeToString()
            session.send(envelope)


main()
