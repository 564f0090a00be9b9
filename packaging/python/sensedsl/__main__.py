"""Runs the program that was installed with this package."""

import os
import subprocess
import sys
import sysconfig


def program() -> str:
    """The path of the program.

    Raises ``FileNotFoundError`` if the package was installed without it.
    """
    name = "sensedsl" + (sysconfig.get_config_var("EXE") or "")
    schemes = [sysconfig.get_default_scheme(), sysconfig.get_preferred_scheme("user")]
    places = [sysconfig.get_path("scripts", scheme) for scheme in schemes]
    # `pip install --target` puts programs beside the packages.
    places.append(os.path.join(os.path.dirname(os.path.dirname(__file__)), "bin"))
    for place in places:
        path = os.path.join(place, name)
        if os.path.isfile(path):
            return path
    raise FileNotFoundError(f"there is no {name} in {', '.join(places)}: install the package again")


def main() -> int:
    """Runs the program with the arguments of this process; its exit status."""
    command = [program(), *sys.argv[1:]]
    if os.name == "posix":
        os.execv(command[0], command)
    return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
