"""The page Share of the lab."""

from armlab.page import Page

PAGE = Page(__name__, "share", "Share", "SHARE", 61, tab="picture", about=("link", "QR code", "save", "worksheet"))
