"""Everything the network sees: pages, tokens, limits, and WebSockets passed through to the labs on loopback."""
