"""The one program that gets all values of a fleet, for `cargo xtask fleet`: nothing of this project, and Zenoh alone.

    subscriber.py ENDPOINT

It subscribes to `**` behind the router at the endpoint, and keeps each sample with the time at which it came. It says
`ready`, and then answers lines of the standard input with a line each:

    count       ALIVE SAMPLES: how many tokens there are, and how many samples came
    gone        COUNT NANOSECONDS: how many tokens were taken back so far, and when the last of them was, since 1970
    write FILE  writes all samples: nanoseconds since 1970, key, text, with tabs between; answers with their number
"""

import gc
import json
import sys
import time

import zenoh


def main():
    config = zenoh.Config()
    config.insert_json5("mode", '"client"')
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("connect/endpoints", json.dumps([sys.argv[1]]))
    samples, tokens, gone = [], set(), []
    # Samples hold nothing that holds them: looking for such circles would only stop the subscriber now and then.
    gc.disable()

    def heard(sample):
        samples.append((time.time_ns(), str(sample.key_expr), sample.payload.to_bytes()))

    def presence(sample):
        key = str(sample.key_expr)
        if sample.kind == zenoh.SampleKind.PUT:
            tokens.add(key)
        else:
            tokens.discard(key)
            gone.append(time.time_ns())

    with zenoh.open(config) as session:
        values = session.declare_subscriber("**", heard)
        alive = session.liveliness().declare_subscriber("**", presence, history=True)
        print("ready", flush=True)
        for line in sys.stdin:
            word, *rest = line.split(maxsplit=1)
            if word == "count":
                print(len(tokens), len(samples), flush=True)
            elif word == "gone":
                print(len(gone), gone[-1] if gone else 0, flush=True)
            elif word == "write":
                taken = samples[:]
                with open(rest[0].strip(), "wb") as file:
                    for at, key, payload in taken:
                        file.write(b"%d\t%s\t%s\n" % (at, key.encode(), payload))
                print(len(taken), flush=True)
        values.undeclare()
        alive.undeclare()


main()
