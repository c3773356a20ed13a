"""Run benchmarks, print what they measured, and write it into docs/figures.md."""

import argparse
import importlib
import sys

import figures


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser("python3 benchmarks", description="Measure against the peers, as Markdown.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"what to measure, all when left out: {known()}")
    parser.add_argument("--write", action="store_true", help="also replace the sections of these in docs/figures.md")
    parser.add_argument("--tiny", action="store_true", help="only fill the tables, with figures that mean nothing")
    options = parser.parse_args(arguments)
    unknown = [name for name in options.names if name not in figures.known()]
    if unknown:
        print(f"benchmarks: no benchmark {unknown[0]!r}; there are {known()}", file=sys.stderr)
        return 2
    if options.tiny and options.write:
        print("benchmarks: figures of --tiny mean nothing and are not written", file=sys.stderr)
        return 2
    sys.path.append(str(figures.HERE.parent / "tests"))
    for name in options.names or figures.known():
        lines = []
        for line in figures.section(name, importlib.import_module(name)):
            lines.append(line)
            print(line, flush=True)
        print(flush=True)
        if options.write or not (options.names or options.tiny):
            figures.keep(lines)
    return 0


def known() -> str:
    return ", ".join(figures.known())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
