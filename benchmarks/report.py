"""Run benchmarks and print what they measured. Each is a file here with ``TITLE`` and ``measure() -> lines``."""

import importlib
import os
import platform
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent


def main(arguments: list[str]) -> int:
    names = [name for name in arguments if name != "--tiny"]
    sys.path.append(str(HERE.parent / "tests"))
    known = sorted(path.stem for path in HERE.glob("*.py") if "\nTITLE = " in path.read_text(encoding="utf-8"))
    unknown = [name for name in names if name not in known]
    if unknown:
        print(f"benchmarks: no benchmark {unknown[0]!r}; there are {', '.join(known)}", file=sys.stderr)
        return 2
    print(f"Python {platform.python_version()}, {os.cpu_count()} cores, {platform.machine()}.")
    for name in names or known:
        module = importlib.import_module(name)
        print(f"\n## {module.TITLE}\n\n`python3 benchmarks {name}`\n", flush=True)
        for line in module.measure():
            print(line, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
