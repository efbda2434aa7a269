"""Which files of a program does `relume ci --when-changed` watch? Each file that the program opens, as listed by
strace, is touched in turn."""
import os
import pathlib
import re
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SYSTEM = ("/proc", "/sys", "/dev")
OPENED = re.compile(r'(openat\(AT_FDCWD, |open\(|execve\()"([^"]+)"(.*) = \d+$', re.M)
NOT_WATCHED = "other files that the program opens are not watched: name them with --data"


def on_display(*command, cwd, **more):
    return subprocess.run([ROOT / "tests/xvfb.sh", *map(str, command)], cwd=cwd, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=300, **more)


def opened(command, cwd):
    """Regular files that a program reads and does not write, by their real paths."""
    log = cwd / "opened"
    done = on_display("strace", "-f", "-e", "trace=open,openat,execve", "-o", log, *command, cwd=cwd)
    assert done.returncode == 0, done.stdout
    calls = OPENED.findall(log.read_text(errors="replace"))
    written = {os.path.realpath(cwd / path) for _, path, how in calls if re.search("O_(WRONLY|RDWR|CREAT)", how)}
    read = {os.path.realpath(cwd / path) for _, path, _ in calls} - written
    return sorted(path for path in read
                  if os.path.isfile(path) and not path.startswith(SYSTEM) and not path.startswith(str(log)))


def own_mounts():
    """Command prefix that runs another command in a mount namespace of its own, or None if this system forbids it."""
    command = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-rm"]
    return command if subprocess.run([*command, "mount", "--bind", "/bin", "/bin"], stderr=subprocess.DEVNULL,
                                     check=False).returncode == 0 else None


class Touched:
    """A program that `relume ci` has recorded once, in a scratch folder."""

    def __init__(self, relume, folder, *command):
        self.relume, self.folder, self.command = relume, folder, command
        self.mounts = own_mounts()
        self.run()
        self.inputs = (self.kept / "p/inputs").read_text()
        self.watched = {os.path.realpath(folder / path) for path in re.findall(r'^file \w+ "(.*)"$', self.inputs, re.M)}

    @property
    def kept(self):
        return self.folder / "kept"

    def run(self, before=()):
        """Run with one file replaced by another; `before` is the command that mounts the replacement."""
        return on_display(*before, self.relume, "ci", "--when-changed", "-n", "p", "-f", "1", "-k", self.kept, "--",
                          *self.command, cwd=self.folder).stdout

    def can_touch(self, path):
        return self.mounts or os.access(path, os.W_OK) and path.startswith(str(self.folder))

    def verdict(self, path):
        """"" if the verdict is right, else a description of the fault. With `path` None, nothing is touched."""
        whole = self.folder / "whole"
        shutil.rmtree(whole, ignore_errors=True)
        shutil.copytree(self.kept, whole)
        if path is None:
            said = self.run()
        elif self.mounts:
            other = self.folder / "other"
            shutil.copy(path, other)
            with open(other, "ab") as file:
                file.write(b"\n")
            said = self.run((*self.mounts, "sh", "-c", 'mount --bind "$0" "$1" && shift && exec "$@"', other, path))
        else:
            before = pathlib.Path(path).read_bytes()
            pathlib.Path(path).write_bytes(before + b"\n")
            said = self.run()
            pathlib.Path(path).write_bytes(before)
        shutil.rmtree(self.kept)
        whole.rename(self.kept)
        return self.judge(path, said)

    def judge(self, path, said):
        why = re.search(r"^p: record 1 frames?: (.*)$", said, re.M)
        if path in self.watched:
            right = why and os.path.realpath(self.folder / why[1].removesuffix(" has changed")) == path
            return "" if right else f"is watched; said: {why[1] if why else said}"
        right = not why and "p: recorded nothing" in said and NOT_WATCHED in said
        return "" if right else f"is not watched; said: {why[1] if why else said}"
