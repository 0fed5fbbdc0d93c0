import subprocess
import sys
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[1] / "squeezefilm"


def test_the_types_hold():
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--cache-dir", "/dev/null", "--ignore-missing-imports"]
    checked = subprocess.run([*command, str(SOURCE)], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout
