"""A page of the lab as it is known before anybody opens it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Export:
    """A file or text to take away from a page, so that it can be found before the page is opened.

    Parameters
    ----------
    at : str
        Cell of its control, such as ``"csv"``; or, after ``copy``, the name of a button that copies: ``"copy LaTeX"``.
    title : str
    about : tuple of str
        Other words by which it is found.
    after : str
        What has to be done on the page before the control is there; empty for nothing.
    """

    at: str
    title: str
    about: tuple[str, ...] = ()
    after: str = ""


@dataclass(frozen=True)
class Page:
    """The constant ``PAGE`` of the package of a page; its panel is imported when it is first opened.

    Parameters
    ----------
    package : str
        ``__name__`` of the package.
    key, title : str
    icon : str
        Name of one of `viser.Icon`, such as ``"ROBOT"``.
    order : int
        Place among the tabs, or among the pages of its tab.
    tab : str
        Key of the page whose tab it shares as one of its pages; empty for a tab of its own.
    page : str
        What it is called among the pages of its tab where that is not its title, which a first page lends to its tab.
    about : tuple of str
        What the index finds it by: sections and equations of the notes, rows of the inventory, words.
    always : bool
        Whether it may be read also while a question of a lesson hides the arm or its values.
    exports : tuple of Export
    """

    package: str
    key: str
    title: str
    icon: str
    order: int
    tab: str = ""
    page: str = ""
    about: tuple[str, ...] = ()
    always: bool = False
    exports: tuple[Export, ...] = ()

    @property
    def name(self) -> str:
        """The name among the pages of its tab."""
        return self.page or self.title

    @property
    def scope(self) -> str:
        """The class under which the stylesheets of its tab hold: ``b-`` and the name of the tab's folder."""
        return f"b-{self.package.split('.')[-2]}"
