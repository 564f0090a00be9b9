"""A cart on a spring, as a part of a simulated world: a line of JSON in, a line of JSON out.

The motor pulls with up to 2 N, the spring has 20 N/m, the cart 0.1 kg; friction takes 0.4 Ns/m.
"""

import json
import sys

MASS, SPRING, FRICTION, PULL = 0.1, 20.0, 0.4, 2.0

at, place, speed = 0.0, 0.0, 0.0
for line in sys.stdin:
    asked = json.loads(line)
    # What was not set yet is null.
    force = PULL * (asked["set"].get("Pull") or 0.0) / 100.0
    while at < asked["t"] - 1e-9:
        step = min(0.001, asked["t"] - at)
        speed += step * (force - SPRING * place - FRICTION * speed) / MASS
        place += step * speed
        at += step
    print(json.dumps({"sensors": {"Cart": 100.0 + 1000.0 * place}}), flush=True)
