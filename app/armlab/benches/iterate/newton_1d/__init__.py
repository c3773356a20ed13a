"""The page "Notes 4.106-4.110; printed there without x_n"."""
