"""The page that a browser shows: dock and tabs, overlay, search, lessons, and the lab that serves them."""
