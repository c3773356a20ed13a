"""Make the private environment of a checkout, once, and run a module in it.

Standard library only, and parseable by Pythons too old to run the lab, so that they can say so.
"""

import contextlib
import hashlib
import os
import subprocess
import sys
import time
from pathlib import Path

OLDEST = (3, 11)
NO_NETWORK = (
    "Failed to establish",
    "NewConnectionError",
    "Name or service not known",
    "Temporary failure in name resolution",
    "ProxyError",
    "Network is unreachable",
    "timed out",
)
FOREIGN_VARIABLES = ("PYTHONPATH", "PYTHONHOME", "PIP_TARGET", "PIP_PREFIX", "PIP_USER", "VIRTUAL_ENV")


class Problem(SystemExit):
    """A reason to stop: one line on standard error, exit status 1."""

    def __init__(self, text):
        SystemExit.__init__(self, "armlab: " + text)


def run(root, module, arguments, extras=(), prepare=None):
    """Run ``python -m module arguments`` in the environment of a checkout; does not return on POSIX.

    ``prepare`` is called with the environment's Python before the module runs.
    """
    python = ensure(root, extras)
    if prepare is not None:
        prepare(python)
    # -P: the working folder never shadows a module.
    command = [str(python), "-P", "-m", module] + list(arguments)
    if os.name != "nt":
        sys.stdout.flush()
        # The same process goes on: signals, exit status and Ctrl-C are as they should be.
        os.execv(command[0], command)
    try:
        return subprocess.call(command)
    except KeyboardInterrupt:
        return 130


def ensure(root, extras=()):
    """Return the Python of the environment, made or brought up to date if it has to be."""
    if sys.version_info < OLDEST:
        found = "%s (%s)" % (sys.version.split()[0], sys.executable)
        raise Problem("Python %d.%d or newer is needed; this is %s." % (OLDEST[0], OLDEST[1], found))
    environment = place(root)
    python = environment / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    stamp = Stamp(root, environment, python)
    if stamp.holds(extras):
        return python
    try:
        with locked(environment.parent / (environment.name + ".lock")):
            if not stamp.holds(extras):
                install(root, environment, python, stamp.wanted(extras), anew=not stamp.same_python())
                stamp.write(stamp.wanted(extras))
    except PermissionError as error:
        text = "cannot write %s; set ARMLAB_VENV to a folder that can be written." % error.filename
        raise Problem(text) from None
    return python


STAMP = ".armlab"
"""Name of the file by which an environment is known as one of the lab's."""


class Stamp:
    """What the environment was made of; written last, so that an installation cut short is done again."""

    def __init__(self, root, environment, python):
        self._path, self._python = environment / STAMP, python
        self._interpreter = digest(str(sys.version_info[:2]), sys.platform)
        self._project = digest((root / "pyproject.toml").read_text(encoding="utf-8"), str(root))

    def _lines(self):
        try:
            return self._path.read_text().split() if self._python.exists() else []
        except OSError:
            return []

    def same_python(self):
        """Whether it was made by this Python."""
        return self._lines()[:1] == [self._interpreter]

    def holds(self, extras):
        """Whether it is up to date and has these extras."""
        lines = self._lines()
        return lines[:2] == [self._interpreter, self._project] and set(extras) <= set(lines[2:])

    def wanted(self, extras):
        """Return these extras and those it has already."""
        return sorted(set(extras) | set(self._lines()[2:]))

    def write(self, extras):
        """Note that it is complete, with these extras."""
        self._path.write_text("\n".join((self._interpreter, self._project) + tuple(extras)))


def place(root):
    """Return the environment's folder: in the checkout, or in the user's cache when that cannot be written."""
    if os.environ.get("ARMLAB_VENV"):
        return Path(os.environ["ARMLAB_VENV"])
    if os.access(str(root), os.W_OK):
        return root / ".venv"
    base = os.environ.get("LOCALAPPDATA" if os.name == "nt" else "XDG_CACHE_HOME")
    if base is None:
        base = Path.home() / ("Library/Caches" if sys.platform == "darwin" else ".cache")
    return Path(base) / "armlab" / ("venv-" + digest(str(root))[:12])


@contextlib.contextmanager
def locked(path):
    """Let one start at a time install; the lock dies with its process."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(str(path), "a+b") as file:
        told = False
        while not _try_lock(file):
            if not told:
                print("armlab: another start is installing; waiting for it ...", file=sys.stderr)
                told = True
            time.sleep(0.3)
        yield


def _try_lock(file):
    try:
        if os.name == "nt":
            import msvcrt

            file.seek(0)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True


def install(root, environment, python, extras, anew):
    """Make the environment if it has to be anew, and install the checkout into it, editable."""
    print("armlab: installing into %s (about half a minute, once) ..." % environment, file=sys.stderr)
    if anew:
        refuse_to_erase(environment)
        make_environment(environment)
    target = str(root) + ("[%s]" % ",".join(extras) if extras else "")
    command = [str(python), "-m", "pip", "install", "-q", "--disable-pip-version-check", "--no-input"]
    clean = {name: value for name, value in os.environ.items() if name not in FOREIGN_VARIABLES}
    # One retry: pip's default takes minutes to find out that there is no network.
    status, output = captured(command + ["--retries", "1", "-e", target], clean)
    if status == 0:
        return
    if any(words in output for words in NO_NETWORK):
        raise Problem("the packages could not be downloaded; is there a network?")
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    raise Problem("pip failed: " + " ".join(errors[-3:] or lines[-1:]))


def refuse_to_erase(environment):
    """Refuse a folder that somebody has chosen and in which something else lies: making an environment empties it."""
    chosen = os.environ.get("ARMLAB_VENV") is not None
    if chosen and environment.exists() and not (environment / STAMP).exists() and any(environment.iterdir()):
        text = "ARMLAB_VENV: %s holds other files, which would be lost; choose an empty or a new folder." % environment
        raise Problem(text)


def make_environment(environment):
    """Make an empty environment with this Python."""
    try:
        import ensurepip  # noqa: F401  (Debian splits it off)
        import venv  # noqa: F401
    except ImportError:
        version = "python%d.%d-venv" % sys.version_info[:2]
        text = "this Python has no venv module. On Debian or Ubuntu: sudo apt install " + version
        raise Problem(text) from None
    # From inside another environment, use the Python below it.
    base = getattr(sys, "_base_executable", None) or sys.executable
    status, output = captured([base, "-m", "venv", "--clear", str(environment)], None)
    if status:
        raise Problem("making the environment failed: " + " ".join(output.split())[-400:])
    # From now on it is known as our own, also when the installation is cut short.
    (environment / STAMP).write_text("")


def captured(command, variables):
    """Return exit status and all output of a command."""
    result = subprocess.run(
        command, env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True
    )
    return result.returncode, result.stdout


def digest(*parts):
    """Return a short hash of texts."""
    h = hashlib.sha256()
    for part in parts:
        h.update(part.encode() + b"\0")
    return h.hexdigest()[:32]
