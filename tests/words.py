"""Compare the catalogue of a language with what the pages say: ``python tests/words.py it``, from the checkout.

It opens every page of the lab, and the docks of lessons, without a browser, presses what can be pressed with
``--deep``, and lists texts without a translation and messages that nothing says any more. With ``--write`` the
catalogue gets the former, to be filled in, and loses the latter; where each message is said stands beside it.
"""

import argparse
import asyncio
import sys
from dataclasses import replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "app"), str(ROOT / "tests")]

from armlab.content.po import Message, read_po, write_po  # noqa: E402
from support.docks import LESSON, every_dock  # noqa: E402
from support.saying import Listener, every_example, every_kind_of_arm, every_page, known_before, pressed, stale  # noqa: E402


async def main(options):
    """Compare and tell; pages are shown where a loop runs, as in the lab, since some ask it to come back to them."""
    file = ROOT / "app/armlab/languages" / f"{options.language}.po"
    header, messages = read_po(file.name, file.read_text(encoding="utf-8"))
    listener = Listener(messages)
    known_before(listener)
    for page in every_page(listener):
        for message in listener.used:
            listener.opened.add(message)
        if options.deep:
            pressed(listener, page)
    if options.deep:
        every_example(listener)
    every_kind_of_arm(listener)
    every_dock(listener)
    listener.opened.update(source for source, places in listener.used.items() if LESSON in places)
    old = stale(messages, listener)
    for source in listener.missing:
        print(f"no translation: {source!r}")
    for message in old:
        print(f"{file.name}:{message.line}: said no more: {message.source!r}")
    print(f"{len(messages)} messages, {len(listener.missing)} missing, {len(old)} said no more")
    if options.write:
        kept = [placed(message, listener) for message in messages if message.text and message not in old]
        kept += [Message(source, "", tuple(sorted(places))) for source, places in listener.missing.items()]
        kept.sort(key=lambda message: (message.source.lower(), message.source))
        file.write_text(write_po(header, kept), encoding="utf-8")
    return 1 if listener.missing or old else 0


def placed(message, listener):
    """Return a message with the places that say it as they open; one that they do not say has none."""
    places = listener.used.get(message.source, ()) if message.source in listener.opened else ()
    return replace(message, places=tuple(sorted(places)))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("language", help="such as it")
    parser.add_argument("--deep", action="store_true", help="also press and choose everything; takes minutes")
    parser.add_argument("--write", action="store_true", help="renew the catalogue")
    sys.exit(asyncio.run(main(parser.parse_args())))
