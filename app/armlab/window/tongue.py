"""The language of one page: chosen when the page is built, and kept as long as it is there."""

from __future__ import annotations

import json

import viser

from armlab.content.languages import ENGLISH, preferred
from armlab.session.parts.language import LanguagePart
from armlab.session.session import Session
from armlab.ui import adapter
from armlab.ui.door import Door
from armlab.ui.html import tag
from armlab.ui.speech import speech_in
from armlab.window.script_words import SCRIPT_WORDS


class Tongue:
    """The language of the page of one browser.

    A page in English is left alone. When its student chooses another language, the page is told to load itself anew.

    Attributes
    ----------
    language : str
        Its key.

    Parameters
    ----------
    client : viser.ClientHandle
    session : Session
    accepted : str
        The languages that the browser asks for, as in the header ``Accept-Language``.
    """

    def __init__(self, client: viser.ClientHandle, session: Session, accepted: str) -> None:
        self._client, self._session, self._of_browser = client, session, preferred(accepted)
        self.language, self._told = self._wanted(), False
        if self.language == ENGLISH:
            return
        speech = speech_in(self.language)
        adapter.speak(client, Door(speech))
        said = json.dumps({text: speech.text(text) for text in SCRIPT_WORDS})
        client.gui.add_html(str(tag("i", id="al-words", hidden=True, lang=self.language, data_words=said)))

    def _wanted(self) -> str:
        return self._session.state[LanguagePart].read_in(self._of_browser)

    def show(self) -> None:
        """Let the page load itself anew, once, if another language has been chosen."""
        if not self._told and self._wanted() != self.language:
            self._told = True
            self._client.gui.add_html(str(tag("i", id="al-anew", hidden=True)))
