"""``armlab errata``: the list of the errata, printed or written to a file."""


def test_one_erratum_is_printed_with_both_residuals(typed):
    status, out, err = typed("errata", "4.110")
    assert (status, err) == (0, "")
    assert "### 4.110 Newton's step is taken for the new point" in out
    assert "* Printed 2" in out
    assert "correct 2.2·10⁻¹⁶: x after 6 steps, against the square root." in out
    assert "4.116" not in out


def test_a_page_is_written_to_a_file(typed, tmp_path):
    file = tmp_path / "errata.html"
    status, out, err = typed("errata", "1.58", "--format", "html", "--out", str(file), "--seed", "3")
    assert (status, out, err) == (0, "", "")
    text = file.read_text(encoding="utf-8")
    assert text.startswith("<!doctype html>")
    assert "(seed 3)" in text


def test_an_erratum_that_is_not_there_is_one_line(typed):
    status, out, err = typed("errata", "1.85")
    assert (status, out) == (1, "")
    assert err.startswith("armlab: erratum: unknown name '1.85'; did you mean '1.58'?")


def test_a_seed_below_zero_is_one_line(typed):
    status, out, err = typed("errata", "1.58", "--seed", "-1")
    assert (status, out) == (1, "")
    assert err.startswith("armlab: --seed: ")
