"""``python3 app``: install once, then open the lab."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "app"))

import bootstrap  # noqa: E402

sys.exit(bootstrap.run(ROOT, "armlab", sys.argv[1:]))
