"""Prints the values of STM32F4DiscoveryBoard: `python -m sense_fig2 [DEVICE | RECORDING]`. Generated."""

from __future__ import annotations

import os
import sys

from . import DeviceError, OtherFirmware, STM32F4DiscoveryBoard


def main() -> int:
    """The exit status: 1 for other firmware, 2 for a device that cannot be opened."""
    path = sys.argv[1] if len(sys.argv) > 1 else None
    try:
        is_file = path is not None and os.path.isfile(path)
        board = STM32F4DiscoveryBoard.play(str(path)) if is_file else STM32F4DiscoveryBoard.open(path)
        with board:
            for message in board:
                print(message, flush=True)
            print("%d frames, %d bytes dropped" % (board.frames, board.dropped_bytes), file=sys.stderr)
    except OtherFirmware as error:
        print(error, file=sys.stderr)
        return 1
    except DeviceError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
