"""Absolute encoders: resolution, Gray code against plain binary, and a sensor that is out of line."""

import math

import numpy as np
import pytest

from armlab.errors import InputError
from armlab.kin.sensors.absolute import Disk, changes, gray_of, number_of, resolution, words_of


def test_the_resolutions_of_the_notes(truth):
    case = truth["C2.3-abs-encoder"]
    found = [math.degrees(resolution(tracks)) for tracks in case["inputs"]["N_t"]]
    np.testing.assert_allclose(found, case["expected"]["resolution_deg"], rtol=0, atol=case["tol"])


def test_the_gray_code_of_four_tracks(truth):
    case = truth["C2.3-gray"]
    assert gray_of(case["inputs"]["n"]).tolist() == case["expected"]["gray"]
    assert words_of("gray", case["inputs"]["N_t"]).tolist() == case["expected"]["gray"]


@pytest.mark.parametrize("tracks", [1, 2, 3, 8, 12])
def test_gray_changes_one_bit_everywhere_and_binary_up_to_all_of_them(tracks):
    """The printed reading of the notes, plain binary, changes eight bits of eight at once: 7 more than Gray."""
    assert set(changes("gray", tracks).tolist()) == {1}
    binary = changes("binary", tracks)
    assert binary.max() == tracks
    assert binary[-1] == binary[2 ** (tracks - 1) - 1] == tracks  # at the end, and at half a turn
    assert binary.sum() == 2 * (2**tracks - 1)  # track j changes 2^j times in a turn


def test_gray_words_are_all_there_once_and_lead_back_to_their_numbers():
    numbers = np.arange(2**12)
    words = gray_of(numbers)
    assert len(set(words.tolist())) == 2**12
    np.testing.assert_array_equal(number_of(words), numbers)
    large = np.array([2**40 + 12345, 2**52 - 1])
    np.testing.assert_array_equal(number_of(gray_of(large)), large)


@pytest.mark.parametrize("code", ["gray", "binary"])
def test_with_all_sensors_in_line_every_sector_reads_as_itself(code):
    disk = Disk(7, code)
    angles = (np.arange(-300, 300) + 0.5) * disk.width
    np.testing.assert_array_equal(disk.read(angles), np.arange(-300, 300) % 128)
    edges = np.arange(128) * disk.width  # an edge belongs to the sector that it begins
    np.testing.assert_array_equal(disk.read(edges), np.arange(128))
    assert disk.pieces.worst == 0
    assert disk.pieces.wrong == 0.0


def test_a_binary_sensor_out_of_line_misreads_by_the_weight_of_its_bit():
    """By hand: the highest bit of eight, seen early by a tenth of a sector, makes 011 of 3 read as 111."""
    disk = Disk(3, "binary", 1, 0.1 * resolution(3))
    at = 3.95 * disk.width
    assert (disk.sector(at), disk.word(at), disk.read(at), disk.error(at)) == (3, 0b111, 7, -4)
    # Twice in a turn, at the two edges of that bit, for a tenth of a sector of eight.
    assert disk.pieces.wrong == pytest.approx(2 * 0.1 / 8, abs=1e-12)
    assert disk.pieces.worst == 4


@pytest.mark.parametrize("tracks", [3, 5, 8])
def test_gray_is_off_by_one_at_most_while_the_sensor_is_out_of_line_by_no_more_than_a_sector(tracks, rng):
    for track in range(1, tracks + 1):
        for part in (*rng.uniform(-1.0, 1.0, 4), -1.0, 1.0, 1e-3):
            gray = Disk(tracks, "gray", track, part * resolution(tracks)).pieces
            binary = Disk(tracks, "binary", track, part * resolution(tracks)).pieces
            assert gray.worst == 1
            assert binary.worst == 2 ** (tracks - track)
    # A bit of Gray code is read mirrored at its edge: a sector and a half before it, three sectors too far.
    assert Disk(tracks, "gray", 1, 1.5 * resolution(tracks)).pieces.worst == 3
    assert Disk(tracks, "gray", tracks, 1.5 * resolution(tracks)).pieces.worst == 1


@pytest.mark.parametrize("code", ["gray", "binary"])
def test_the_pieces_of_a_turn_agree_with_many_single_readings(code, rng):
    disk = Disk(6, code, 3, 0.37 * resolution(6))
    angles = rng.uniform(0.0, 2.0 * np.pi, 200_000)
    read, error = disk.read(angles), disk.error(angles)
    edges, of_pieces, errors = disk.pieces
    piece = np.searchsorted(edges, angles, side="right") - 1
    np.testing.assert_array_equal(of_pieces[piece], read)
    np.testing.assert_array_equal(errors[piece], error)
    assert disk.pieces.wrong == pytest.approx(np.mean(error != 0), abs=7e-3)  # six standard errors of the share


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: resolution(0), r"tracks: expected a whole number, at least 1, got 0"),
        (lambda: resolution(30), r"tracks: expected at most 24, got 30"),
        (lambda: Disk(4, "grey"), r"code: unknown name 'grey'; did you mean 'gray'"),
        (lambda: Disk(4, "gray", 5), r"track: expected 1 to 4, got 5"),
        (lambda: Disk(4, "gray", 1, math.nan), r"offset: expected a finite number in radians, got nan"),
        (lambda: gray_of([-1]), r"words: expected whole numbers, not below 0"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, text):
    with pytest.raises(InputError, match=text):
        make()
