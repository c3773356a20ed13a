"""``armlab formulas``: the formulas in LaTeX, or as a page to print."""


def test_the_formulas_are_printed_in_latex(typed):
    status, out, err = typed("formulas")
    assert (status, err) == (0, "")
    assert out.startswith("\\documentclass[a4paper,10pt]{article}\n")
    assert out.endswith("\\end{document}\n")
    assert out.count("\\newpage") == 1


def test_a_page_is_written_to_a_file(typed, tmp_path):
    file = tmp_path / "formulas.html"
    assert typed("formulas", "--format", "html", "--out", str(file)) == (0, "", "")
    assert file.read_text(encoding="utf-8").startswith("<!doctype html>")
