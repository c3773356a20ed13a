"""``python3 benchmarks [NAME ...] [--write]``: measure against the peers, as Markdown.

Without a name, everything is measured and written into docs/figures.md.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "app"))

import bootstrap  # noqa: E402

python = bootstrap.ensure(ROOT, ("bench", "test"))
browser = subprocess.run([str(python), str(ROOT / "tests" / "find_browser.py")], stdout=subprocess.PIPE, text=True)
if browser.returncode:
    sys.exit(browser.returncode)
os.environ["ARMLAB_BROWSER"] = browser.stdout.strip()
sys.exit(subprocess.call([str(python), str(ROOT / "benchmarks" / "report.py"), *sys.argv[1:]]))
