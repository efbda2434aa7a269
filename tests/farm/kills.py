"""Kill tasks, slurmd and slurmctld at random while a farm renders, and count how often each frame is written."""
import ctypes
import os
import random
import signal
import struct
import time

IN_MOVED_TO = 0x80


class Landings:
    """Counts how often each frame's file was renamed into a folder, as reported by the kernel."""

    def __init__(self, folder):
        libc = ctypes.CDLL(None, use_errno=True)
        self.fd = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        if self.fd < 0 or libc.inotify_add_watch(self.fd, os.fsencode(folder), IN_MOVED_TO) < 0:
            raise OSError(ctypes.get_errno(), "inotify")
        self.counts = {}

    def read(self):
        while True:
            try:
                data = os.read(self.fd, 1 << 20)
            except BlockingIOError:
                return self.counts
            at = 0
            while at < len(data):
                _, mask, _, size = struct.unpack_from("iIII", data, at)
                name = data[at + 16:at + 16 + size].rstrip(b"\0").decode()
                at += 16 + size
                if mask & IN_MOVED_TO and name.endswith(".exr"):
                    self.counts[name] = self.counts.get(name, 0) + 1
                assert mask & 0x4000 == 0, "events were lost"


class Killer:
    """Kills running processes in turn, and restarts daemons after a while, like an init system."""

    def __init__(self, cluster, seed):
        self.cluster = cluster
        self.random = random.Random(seed)
        self.down = {}  # daemon: time of its restart
        self.done = {"task": 0, "slurmd": 0, "slurmctld": 0}

    def total(self):
        return sum(self.done.values())

    def revive(self, everything=False):
        for name, when in list(self.down.items()):
            if everything or time.monotonic() > when:
                self.cluster.start(name)
                del self.down[name]
        # A controller that restarts before the killed one's port is free exits at once; an init system tries again.
        for name in self.cluster.ended():
            self.cluster.start(name)

    def strike(self):
        """Kill one process: usually a task, sometimes a daemon."""
        kind = self.random.choices(("task", "slurmd", "slurmctld"), (6, 3, 1))[0]
        if kind == "task":
            victims = [pid for pid, command in self.cluster.below() if command == "relume"]
            if not victims:
                return
            try:
                os.kill(self.random.choice(victims), signal.SIGKILL)
            except ProcessLookupError:
                return
        else:
            names = [
                n for n in (self.cluster.nodes if kind == "slurmd" else ["slurmctld"]) if n in self.cluster.daemons
            ]
            if not names:
                return
            name = self.random.choice(names)
            self.cluster.kill(name)
            # Usually back at once; a node that stays away longer than SlurmdTimeout is given up and its task restarted.
            away = 15 if kind == "slurmd" and self.random.random() < 0.2 else self.random.uniform(0.2, 2)
            self.down[name] = time.monotonic() + away
        self.done[kind] += 1


def campaign(cluster, killer, landings, folder, relume, n_kills, end_s, pause=(0.2, 1.5)):
    """Kill until there were n_kills or all work is done, with `relume farm retry` every few seconds, as a person would
    type it; then restart everything and retry until all frames are complete. Returns the number of retries that started
    tasks. Kills begin when the first frame has been written.
    """
    retries = 0
    end = time.monotonic() + end_s
    next_retry = 0
    while not landings.read():
        assert time.monotonic() < end, "no frame ever landed"
        time.sleep(0.05)
    while True:
        assert time.monotonic() < end, f"not done after {end_s} s, {killer.done}\n{cluster.run('squeue', '-r').stdout}"
        killer.revive(everything=killer.total() >= n_kills)
        if killer.total() < n_kills:
            killer.strike()
        time.sleep(killer.random.uniform(*pause))
        # Slurm's commands wait for a missing controller, which is restarted here.
        if time.monotonic() < next_retry or "slurmctld" in killer.down or cluster.queue() is None:
            continue
        next_retry = time.monotonic() + 5
        if cluster.run(relume, "farm", "status", folder, timeout=300).returncode == 0:
            killer.revive(everything=True)
            return retries  # the caller checks the number of kills
        retries += "\nrender " in cluster.run(relume, "farm", "retry", folder, timeout=300).stdout
