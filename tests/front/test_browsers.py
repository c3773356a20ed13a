"""Who has sockets, and who is still known."""

import asyncio

from armlab.front import browsers as module
from armlab.front.browsers import Browsers
from armlab.front.limits import Limits
from support.student import run


def test_there_is_room_for_so_many_sockets_of_each_and_of_all():
    async def main():
        found = Browsers(Limits(sockets_each=2, sockets=3))
        for token in ("one", "one", "another"):
            assert found.have_room_for(token)
            found.come(token)
        assert not found.have_room_for("a third")
        found.go("another")
        assert (found.have_room_for("one"), found.have_room_for("another")) == (False, True)

    run(main())


def test_a_browser_is_known_for_a_while_after_its_last_socket_only(monkeypatch):
    monkeypatch.setattr(module, "REMEMBERED", 0.2)

    async def main():
        found = Browsers(Limits())
        meter = found.meter("one")
        for _ in range(6):  # the time begins anew with each socket
            found.come("one")
            found.go("one")
            await asyncio.sleep(0.05)
            assert found.meter("one") is meter
        found.come("one")
        await asyncio.sleep(0.3)
        assert found.meter("one") is meter, "it is here"
        found.go("one")
        await asyncio.sleep(0.3)
        assert not found.knows("one")

    run(main())
