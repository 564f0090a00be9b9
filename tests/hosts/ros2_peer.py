"""A peer of ROS 2 that shares no code with the monitor: DDS by CycloneDDS, definitions of messages by rosbags.

ros2_peer.py DISTRO DOMAIN TOPIC=TYPE... [TOPIC:TYPE:DATA...] [NODE?RMW]
Prints each message as `TOPIC JSON`. `TOPIC:TYPE:DATA` is sent with that `data`, as soon as somebody listens. With
`NODE?RMW` it asks for parameters of that node, in the form in which a middleware of ROS 2 sends requests: a line
`SERVICE JSON` of the standard input is a request, its answer is printed in the same form.
"""

import dataclasses
import json
import math
import queue
import sys
import threading
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
        self.fields = get_typestore(Stores[f"ROS2_{distro.upper()}"]).fielddefs
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
            self.made[name] = struct(f"{package}::msg::dds_::{short}_", fields)
        return self.made[name]


def struct(dds, fields):
    body = {"__annotations__": fields, "__module__": __name__}
    made = pytypes.new_class(dds.replace(":", "_"), (IdlStruct,), {"typename": dds}, lambda space: space.update(body))
    return dataclasses.dataclass(made)


def plain(value):
    """What JSON has no number for is a text."""
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


class Parameters:
    """The services of a node's parameters, after the .srv files of rcl_interfaces."""

    # What rmw_cyclonedds_cpp puts before a request and its answer; rmw_fastrtps_cpp has that beside them.
    HEADER = {"guid": types.uint64, "seq": types.int64}

    def __init__(self, definitions, participant, qos, node, rmw):
        message = lambda name: definitions.message(f"rcl_interfaces/msg/{name}")
        texts = types.sequence[str]
        self.message, self.clients, self.sent = message, {}, 0
        self.header = self.HEADER if rmw == "cyclonedds" else {}
        for service, kind, request, answer in [
            ("get_parameters", "GetParameters", {"names": texts}, {"values": types.sequence[message("ParameterValue")]}),
            ("get_parameter_types", "GetParameterTypes", {"names": texts}, {"types": types.sequence[types.uint8]}),
            (
                "describe_parameters",
                "DescribeParameters",
                {"names": texts},
                {"descriptors": types.sequence[message("ParameterDescriptor")]},
            ),
            (
                "list_parameters",
                "ListParameters",
                {"prefixes": texts, "depth": types.uint64},
                {"result": message("ListParametersResult")},
            ),
            (
                "set_parameters",
                "SetParameters",
                {"parameters": types.sequence[message("Parameter")]},
                {"results": types.sequence[message("SetParametersResult")]},
            ),
            (
                "set_parameters_atomically",
                "SetParametersAtomically",
                {"parameters": types.sequence[message("Parameter")]},
                {"result": message("SetParametersResult")},
            ),
        ]:
            asked = struct(f"rcl_interfaces::srv::dds_::{kind}_Request_", {**self.header, **request})
            told = struct(f"rcl_interfaces::srv::dds_::{kind}_Response_", {**self.header, **answer})
            writer = DataWriter(participant, Topic(participant, f"rq/{node}/{service}Request", asked), qos=qos)
            reader = DataReader(participant, Topic(participant, f"rr/{node}/{service}Reply", told), qos=qos)
            self.clients[service] = (asked, writer, reader)

    def parameter(self, name, value):
        """As `ros2 param set` types what it reads."""
        sorts = {bool: (1, "bool_value"), int: (2, "integer_value"), float: (3, "double_value"), str: (4, "string_value")}
        arrays = {bool: (6, "bool_array_value"), int: (7, "integer_array_value"), float: (8, "double_array_value")}
        code, field = arrays[type(value[0])] if isinstance(value, list) else sorts[type(value)]
        empty = {"type": code, "bool_value": False, "integer_value": 0, "double_value": 0.0, "string_value": ""}
        for one in ("byte", "bool", "integer", "double", "string"):
            empty[f"{one}_array_value"] = []
        return self.message("Parameter")(name=name, value=self.message("ParameterValue")(**{**empty, field: value}))

    def ask(self, service, request):
        asked, writer, reader = self.clients[service]
        while not (writer.get_matched_subscriptions() and reader.get_matched_publications()):
            time.sleep(0.01)
        # The other side's end of the answers may find this reader a little later than this one finds it.
        time.sleep(0.3)
        if service.startswith("set"):
            request = {"parameters": [self.parameter(name, value) for name, value in request.items()]}
        self.sent += 1
        header = {"guid": 0x0123456789ABCDEF, "seq": self.sent} if self.header else {}
        writer.write(asked(**header, **request))
        until = time.monotonic() + 10
        while time.monotonic() < until:
            for answer in reader.take(N=10):
                found = {field: getattr(answer, field) for field in header}
                if found == header:
                    print(service, json.dumps(plain(dataclasses.asdict(answer))), flush=True)
                    return
            time.sleep(0.01)
        print(service, "none", flush=True)


def main():
    distro, domain, *rest = sys.argv[1:]
    definitions = Definitions(distro)
    participant = DomainParticipant(int(domain))
    reliable = Qos(Policy.Reliability.Reliable(10**9), Policy.History.KeepAll)
    readers, sends, parameters, asked = {}, [], None, queue.Queue()
    for one in rest:
        if "?" in one:
            parameters = Parameters(definitions, participant, reliable, *one.split("?"))
            threading.Thread(target=lambda: [asked.put(line) for line in sys.stdin], daemon=True).start()
        elif "=" in one:
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
                if isinstance(message, IdlStruct):
                    print(topic, json.dumps(plain(dataclasses.asdict(message))), flush=True)
        if sends and sends[0][0].get_matched_subscriptions():
            writer, message = sends.pop(0)
            writer.write(message)
            time.sleep(0.2)
        if not asked.empty():
            service, request = asked.get().split(" ", 1)
            parameters.ask(service, json.loads(request))


main()
