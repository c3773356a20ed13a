"""Print the path of a browser that really renders: one that is there, else Playwright's, else Debian's as root."""

import glob
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator

NAMES = (
    "chromium-headless-shell",  # without windows, whose frames a software renderer would paint, too
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "chrome",
    "microsoft-edge",
    "msedge",
    "brave-browser",
)
ON_A_MAC = (
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Microsoft Edge.app/Contents/MacOS/Microsoft Edge",
)
ON_WINDOWS = (r"Google\Chrome\Application\chrome.exe", r"Microsoft\Edge\Application\msedge.exe")
ASK_PLAYWRIGHT = """
from playwright.sync_api import sync_playwright
with sync_playwright() as p:
    print(p.chromium.executable_path)
"""
SECONDS = 40.0

SOFTWARE = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PAGE = (
    "data:text/html,<p></p><script>document.querySelector('p').textContent = "
    "document.createElement('canvas').getContext('webgl2') ? 'it-renders' : 'no'</script>"
)

DEBIAN = (("chromium-headless-shell", "chromium-common"), ("chromium",), ("chromium-browser",))
"""What to install; the headless shell finds its software renderer in the common package but does not ask for it."""


def main() -> int:
    """Print the path, or say in one line what to do."""
    path = next(filter(renders, installed()), None)
    for install in (with_playwright, with_apt):
        if path is None:
            install()
            path = next(filter(renders, installed()), None)
    if path is None:
        print(
            "armlab: no Chrome, Chromium or Edge was found and none could be installed; "
            "install one, or set ARMLAB_BROWSER to its path.",
            file=sys.stderr,
        )
        return 1
    print(path)
    return 0


def installed() -> Iterator[str]:
    """Yield browsers that may be there."""
    if os.environ.get("ARMLAB_BROWSER"):
        yield os.environ["ARMLAB_BROWSER"]
    yield from filter(None, map(shutil.which, NAMES))
    candidates = list(ON_A_MAC) if sys.platform == "darwin" else []
    if os.name == "nt":
        bases = filter(None, map(os.environ.get, ("PROGRAMFILES", "PROGRAMFILES(X86)", "LOCALAPPDATA")))
        candidates = [os.path.join(base, name) for base in bases for name in ON_WINDOWS]
    asked = subprocess.run([sys.executable, "-c", ASK_PLAYWRIGHT], capture_output=True, text=True)
    candidates += asked.stdout.split("\n")[:1]
    yield from (path for path in candidates if path and glob.glob(glob.escape(path)))


def renders(path: str) -> bool:
    """Return whether the browser has WebGL: its version alone is also printed by stubs and broken installations."""
    command = [path, "--headless", "--no-sandbox", "--no-first-run", "--dump-dom", *SOFTWARE]
    try:
        result = subprocess.run([*command, PAGE], capture_output=True, timeout=SECONDS)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return b"<p>it-renders" in result.stdout


def with_playwright() -> None:
    """Have Playwright download its own Chromium, where its server can be reached."""
    subprocess.run([sys.executable, "-m", "playwright", "install", "chromium"], capture_output=True)


def with_apt() -> None:
    """Install Debian's Chromium, as root."""
    if not os.path.exists("/etc/debian_version") or not hasattr(os, "geteuid") or os.geteuid() != 0:
        return
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run(["apt-get", "update", "-qq"], env=quiet, stdout=sys.stderr)
    for packages in DEBIAN:
        command = ["apt-get", "install", "-y", "-qq", "--no-install-recommends", *packages, "fonts-dejavu-core"]
        if subprocess.run(command, env=quiet, stdout=sys.stderr).returncode == 0:
            return


if __name__ == "__main__":
    sys.exit(main())
