"""The command ``ozols``, also as ``python -m ozols``."""

import signal
import sys

from . import _native


def main() -> None:
    # The command has its own handler of signals, and Python's would hide it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_native.command(["ozols", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
