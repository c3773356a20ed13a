"""``python3 tests``: install once, find a browser, then pass all tests, two at a time; or what pytest is told."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "app"))

import bootstrap  # noqa: E402


def find_browser(python):
    """Tell the tests which browser to drive; one is installed when there is none."""
    script = str(ROOT / "tests" / "find_browser.py")
    found = subprocess.run([str(python), script], stdout=subprocess.PIPE, universal_newlines=True)
    if found.returncode:
        sys.exit(found.returncode)
    os.environ["ARMLAB_BROWSER"] = found.stdout.strip()


TWO_AT_A_TIME = ["-n", "2", "--dist", "worksteal"]

os.chdir(str(ROOT))
arguments = sys.argv[1:] or TWO_AT_A_TIME
sys.exit(bootstrap.run(ROOT, "pytest", arguments, extras=("test",), prepare=find_browser))
