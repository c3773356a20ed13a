"""The page "Singular values of J, notes 5.152"."""
