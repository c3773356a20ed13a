"""``python3 tests``: install once, find a browser, then pass all tests, four at a time; or what pytest is told.

``python3 tests --quick`` leaves out browsers, processes of their own and what takes long, for an answer in a minute.
"""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "app"))

import bootstrap  # noqa: E402


def find_browser(python):
    """Tell the tests which browser to drive; one is installed when there is none."""
    script = str(ROOT / "tests" / "find_browser.py")
    found = subprocess.run([str(python), script], stdout=subprocess.PIPE, universal_newlines=True)
    if found.returncode:
        sys.exit(found.returncode)
    os.environ["ARMLAB_BROWSER"] = found.stdout.strip()


TWO_AT_A_TIME = ["-n", "2", "--dist", "worksteal"]

FOUR_AT_A_TIME = ["-n", "4", "--dist", "worksteal"]
"""Twice as many as there are processors at least: what talks to a lab, or drives a browser, waits half of its time."""

NOT_QUICK = """
    architecture/test_benches architecture/test_growing benches/control/test_control
    benches/control/test_exponential benches/iterate/test_basins benches/motion/test_motion_steps_data
    benches/motion/test_plan_* benches/workspace/test_* benches/*/test_*_panel benchmarks browser
    content/test_lesson_mistakes content/test_resources benches/view/test_worksheet content/test_write_robot front
    kin/control/test_plant kin/control/test_run kin/motion/test_time_optimal kin/test_all_solutions_special
    kin/test_assignment kin/test_basins kin/test_closed_forms kin/test_dimension kin/test_general_6r kin/test_ik
    kin/test_ik_reachable kin/test_ik_solve kin/test_peers kin/test_solve_all kin/test_structure
    kin/test_structure_parts kin/test_volume_trial kin/test_workspace_* session/test_edits session/test_facts
    benches/motion/test_motion_lesson session/test_share teaching/test_trips start ui/test_asking ui/test_bad_manners
    ui/test_lesson_* ui/test_manners window/test_lesson_* window/test_live window/test_opening window/test_player
"""
"""Folders, and files without their ending, that `--quick` leaves out: what takes long, and what opens a whole lab."""

os.chdir(str(ROOT))
if os.environ.pop("PYTHONDONTWRITEBYTECODE", None):
    print("armlab: tests keep compiled modules, since they start Python a hundred times")
arguments, prepare = sys.argv[1:] or FOUR_AT_A_TIME, find_browser
if arguments[0] == "--quick":
    left_out = ["--ignore-glob=tests/%s%s" % (name, "" if "test_" not in name else ".py") for name in NOT_QUICK.split()]
    arguments, prepare = TWO_AT_A_TIME + left_out + arguments[1:], None
sys.exit(bootstrap.run(ROOT, "pytest", arguments, extras=("test",), prepare=prepare))
