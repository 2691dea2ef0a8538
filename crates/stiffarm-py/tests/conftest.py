"""Figures without a screen, and the program to compare with."""

import json
import os
import signal
import subprocess
from pathlib import Path

import pytest
from sweeps import client, done, small  # noqa: F401

os.environ.setdefault("MPLBACKEND", "Agg")
# A shell that starts a test run in the background has it ignore Ctrl-C, and all that it starts.
signal.signal(signal.SIGINT, signal.default_int_handler)
ROOT = Path(__file__).resolve().parents[3]


def path_of_program():
    """STIFFARM_PROGRAM says where it is."""
    path = os.environ.get("STIFFARM_PROGRAM", str(ROOT / "target" / "debug" / "stiffarm"))
    assert Path(path).is_file(), f"{path} is not there: cargo build, or set STIFFARM_PROGRAM"
    return path


@pytest.fixture(scope="session")
def refusal():
    """What the program says where it refuses."""

    def run(*arguments):
        ended = subprocess.run([path_of_program(), *arguments], capture_output=True, text=True)
        assert ended.returncode == 2, ended
        return ended.stderr

    return run


@pytest.fixture(scope="session")
def program():
    """The JSON that the program prints."""
    path = path_of_program()

    def run(*arguments):
        command = [path, *arguments, "--format", "json", "--quiet"]
        ended = subprocess.run(command, capture_output=True, text=True, check=True)
        return json.loads(ended.stdout)

    return run
