"""What the network sees: pages, tokens, limits, and the WebSocket passed through to the labs on loopback."""
