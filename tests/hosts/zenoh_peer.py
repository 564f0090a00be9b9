"""Another program of a Zenoh network, for the tests of the monitor's sink.

    zenoh_peer.py MODE ENDPOINT [set:KEY=VALUE…]

MODE is `router`, which listens at the endpoint, or `client`, which connects to it. It prints what it hears under
`sensedsl/**`, a line each: `sample KEY JSON`, `alive KEY`, `gone KEY`. A line `get` of the standard input asks for the
latest of everything, `got KEY JSON` each, then `end`; a line `KEY VALUE` is sent as a sample.
"""

import json
import sys

import zenoh


def say(*words):
    print(*words, flush=True)


def main():
    mode, endpoint = sys.argv[1:3]
    config = zenoh.Config()
    config.insert_json5("mode", json.dumps(mode))
    config.insert_json5("scouting/multicast/enabled", "false")
    side = "listen" if mode == "router" else "connect"
    config.insert_json5(f"{side}/endpoints", json.dumps([endpoint]))
    with zenoh.open(config) as session:
        if mode == "router":
            say("ready")
            sys.stdin.read()
            return

        def heard(sample):
            say("sample", sample.key_expr, sample.payload.to_string())

        def presence(sample):
            say("alive" if sample.kind == zenoh.SampleKind.PUT else "gone", sample.key_expr)

        samples = session.declare_subscriber("sensedsl/**", heard)
        tokens = session.liveliness().declare_subscriber("sensedsl/**", presence, history=True)
        say("ready")
        for line in sys.stdin:
            if line.strip() == "get":
                for reply in session.get("sensedsl/**"):
                    say("got", reply.ok.key_expr, reply.ok.payload.to_string())
                say("end")
            else:
                key, value = line.rstrip("\n").split(" ", 1)
                session.put(key, value)
        samples.undeclare()
        tokens.undeclare()


main()
