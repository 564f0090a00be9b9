"""A peer of ROS 2 that shares no code with the monitor: DDS by CycloneDDS, definitions of messages by rosbags.

ros2_peer.py DISTRO DOMAIN TOPIC=TYPE... [TOPIC:TYPE:DATA...]
Prints each message as `TOPIC JSON`. `TOPIC:TYPE:DATA` is sent with that `data`, as soon as somebody listens.
"""

import dataclasses
import json
import sys
import time
import types as pytypes

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct, types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from rosbags.typesys import Stores, get_typestore

BASES = {
    "bool": bool,
    "byte": types.uint8,
    "char": types.uint8,
    "uint8": types.uint8,
    "int8": types.int8,
    "uint16": types.uint16,
    "int16": types.int16,
    "uint32": types.uint32,
    "int32": types.int32,
    "uint64": types.uint64,
    "int64": types.int64,
    "float32": types.float32,
    "float64": types.float64,
    "octet": types.uint8,
    "string": str,
}


class Definitions:
    def __init__(self, distro):
        stores = {"jazzy": Stores.ROS2_JAZZY, "humble": Stores.ROS2_HUMBLE}
        self.fields = get_typestore(stores[distro]).fielddefs
        self.made = {}

    def kind(self, description):
        node, rest = int(description[0]), description[1]
        if node == 1:
            return BASES[rest[0]]
        if node == 2:
            return self.message(rest)
        inner, length = self.kind(rest[0]), rest[1]
        return types.array[inner, length] if node == 3 else types.sequence[inner]

    def message(self, name):
        if name not in self.made:
            package, _, short = name.split("/")
            fields = {field: self.kind(of) for field, of in self.fields[name][1]}
            body = {"__annotations__": fields, "__module__": __name__}
            dds = f"{package}::msg::dds_::{short}_"
            made = pytypes.new_class(f"{package}_{short}", (IdlStruct,), {"typename": dds}, lambda space: space.update(body))
            self.made[name] = dataclasses.dataclass(made)
        return self.made[name]


def main():
    distro, domain, *rest = sys.argv[1:]
    definitions = Definitions(distro)
    participant = DomainParticipant(int(domain))
    reliable = Qos(Policy.Reliability.Reliable(10**9), Policy.History.KeepAll)
    readers, sends = {}, []
    for one in rest:
        if "=" in one:
            topic, name = one.split("=")
            kind = definitions.message(name)
            readers[topic] = DataReader(participant, Topic(participant, f"rt/{topic}", kind), qos=reliable)
        else:
            topic, name, data = one.split(":", 2)
            kind = definitions.message(name)
            writer = DataWriter(participant, Topic(participant, f"rt/{topic}", kind), qos=reliable)
            data = json.loads(data)
            if isinstance(data, list):
                layout = definitions.message("std_msgs/msg/MultiArrayLayout")(dim=[], data_offset=0)
                sends.append((writer, kind(layout=layout, data=data)))
            else:
                sends.append((writer, kind(data=data)))
    print("ready", flush=True)
    while True:
        time.sleep(0.01)
        for topic, reader in readers.items():
            for message in reader.take(N=100):
                if dataclasses.is_dataclass(message):
                    print(topic, json.dumps(dataclasses.asdict(message)), flush=True)
        if sends and sends[0][0].get_matched_subscriptions():
            writer, message = sends.pop(0)
            writer.write(message)
            time.sleep(0.2)


main()
