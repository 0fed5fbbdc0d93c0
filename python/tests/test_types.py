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


def test_the_stubs_are_those_of_the_library(tmp_path):
    pytest.importorskip("mypy")
    # Names of types are in the stubs alone.
    (tmp_path / "allowed").write_text("".join(f"squeezefilm._squeezefilm.{name}\n" for name in ("__all__", "Axes", "How", "Told")))
    command = [sys.executable, "-m", "mypy.stubtest", "squeezefilm._squeezefilm", "--concise", "--allowlist", str(tmp_path / "allowed")]
    checked = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert checked.returncode == 0, checked.stdout
