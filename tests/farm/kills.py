"""Kill tasks, slurmd and slurmctld at random while a farm renders, and count how often each frame lands."""
import ctypes
import os
import random
import signal
import struct
import time

IN_MOVED_TO = 0x80


class Landings:
    """How often each frame's file was renamed into a folder, as the kernel tells it."""

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
    """Kills by turns what is there, and starts daemons again after a while, as an init system does."""

    def __init__(self, cluster, seed):
        self.cluster = cluster
        self.random = random.Random(seed)
        self.down = {}  # daemon: when it is to be started again
        self.done = {"task": 0, "slurmd": 0, "slurmctld": 0}

    def total(self):
        return sum(self.done.values())

    def revive(self, everything=False):
        for name, when in list(self.down.items()):
            if everything or time.monotonic() > when:
                self.cluster.start(name)
                del self.down[name]
        # A controller that comes back before the port of the killed one is free ends at once; an init system tries
        # again.
        for name in self.cluster.ended():
            self.cluster.start(name)

    def strike(self):
        """Kill one thing. Tasks are most often hit, daemons now and then."""
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
            # Mostly back at once; a node that stays away longer than SlurmdTimeout is given up and its task started
            # again.
            away = 15 if kind == "slurmd" and self.random.random() < 0.2 else self.random.uniform(0.2, 2)
            self.down[name] = time.monotonic() + away
        self.done[kind] += 1


def campaign(cluster, killer, landings, folder, relume, n_kills, end_s, pause=(0.2, 1.5)):
    """Strike until there were n_kills or nothing is left to do, with `relume farm retry` every few seconds, as a person
    would type it; then bring everything back and retry until all frames are whole. Returns how many retries started
    tasks. Kills begin when the first frame has landed.
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
        # Slurm's commands wait for a controller that does not answer, and it is brought back here.
        if time.monotonic() < next_retry or "slurmctld" in killer.down or cluster.queue() is None:
            continue
        next_retry = time.monotonic() + 5
        if cluster.run(relume, "farm", "status", folder, timeout=300).returncode == 0:
            killer.revive(everything=True)
            return retries  # the caller sees how many kills there were
        retries += "\nrender " in cluster.run(relume, "farm", "retry", folder, timeout=300).stdout
