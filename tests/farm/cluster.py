"""A private Slurm cluster on this machine: munge, slurmctld and one slurmd for each node, all in a scratch folder.

Every daemon is Debian's real one. Ports are free ones of the loopback interface, munge has its own key and socket, and
nothing in /etc is read or written, so an existing cluster is neither needed nor disturbed. Each node has one core,
which its slurmd and all its tasks are bound to.
"""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel")
SEARCH = os.environ["PATH"] + ":/usr/sbin:/sbin"


def missing_programs():
    return [p for p in PROGRAMS if not shutil.which(p, path=SEARCH)]


def free_ports(count):
    """Unused ports, all held at once, so that they differ."""
    held = [socket.socket() for _ in range(count)]
    for s in held:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in held]
    for s in held:
        s.close()
    return ports


def parents():
    """{pid: (parent, command)} of every process."""
    found = {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            text = stat.read_text(errors="replace")
        except OSError:
            continue  # it has already ended
        name, fields = text[text.index("(") + 1:text.rindex(")")], text[text.rindex(")") + 2:].split()
        if fields[0] not in "ZX":
            found[int(stat.parent.name)] = (int(fields[1]), name)
    return found


class Cluster:
    """Started and stopped by `with`. `env` is the environment for Slurm's commands."""

    def __init__(self, folder, n_nodes=2, gres=None, settings=()):
        self.folder = pathlib.Path(folder)
        self.nodes = [f"n{i + 1}" for i in range(n_nodes)]
        self.daemons = {}  # name: Popen
        self.gres = gres
        self.settings = settings
        self.config = self.folder / "slurm.conf"
        self.env = dict(os.environ, PATH=SEARCH, SLURM_CONF=str(self.config))

    def __enter__(self):
        self.folder.mkdir(parents=True, mode=0o755)
        try:
            self._configure()
            self._start_munge()
            self.start("slurmctld")
            for node in self.nodes:
                self.start(node)
            self.wait_ready()
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *exc):
        self.close()

    def _configure(self):
        controller, *ports = free_ports(1 + len(self.nodes))
        host = socket.gethostname().partition(".")[0]
        for sub in ("state", "munge"):
            (self.folder / sub).mkdir(mode=0o700)
        user = "root" if os.getuid() == 0 else os.environ.get("USER", str(os.getuid()))
        gres = f" Gres={self.gres}" if self.gres else ""
        lines = [
            "ClusterName=test",
            f"SlurmctldHost={host}(127.0.0.1)",
            f"SlurmUser={user}",
            f"SlurmdUser={user}",
            f"SlurmctldPort={controller}",
            f"AuthInfo=socket={self.folder}/munge/socket,cred_expire=10",
            f"StateSaveLocation={self.folder}/state",
            f"SlurmdSpoolDir={self.folder}/spool.%n",
            f"SlurmctldPidFile={self.folder}/slurmctld.pid",
            f"SlurmdPidFile={self.folder}/%n.pid",
            "ProctrackType=proctrack/linuxproc",
            "TaskPlugin=task/none",
            "MpiDefault=none",
            "SelectType=select/cons_tres",
            "SelectTypeParameters=CR_Core",
            "SchedulerParameters=batch_sched_delay=0,sched_min_interval=1000,bf_interval=1",
            "SlurmdParameters=config_overrides",
            "SlurmdTimeout=10",
            "KillWait=2",
            "ReturnToService=2",
            "MessageTimeout=5",
            "JobRequeue=1",
            *self.settings,
            *(["GresTypes=gpu"] if self.gres else []),
            *(f"NodeName={n} NodeHostname={host} NodeAddr=127.0.0.1 Port={p} CPUs=1 State=UNKNOWN{gres}"
              for n, p in zip(self.nodes, ports)),
            "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP",
        ]
        self.config.write_text("\n".join(lines) + "\n")
        # No control groups: a slurmd that detects them automatically does not start if /sys/fs/cgroup is not mounted.
        (self.folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        if self.gres:
            # Slurm only requires device files of the right kind.
            (self.folder / "gres.conf").write_text("Name=gpu File=/dev/null\n")

    def _start_munge(self):
        key = self.folder / "munge" / "key"
        key.touch(mode=0o600)
        key.write_bytes(os.urandom(128))
        munge = self.folder / "munge"
        self._spawn("munged", ["munged", "--foreground", "--force", f"--key-file={key}", f"--socket={munge}/socket",
                               f"--pid-file={munge}/pid", f"--seed-file={munge}/seed", f"--log-file={munge}/log"])
        self._wait(lambda: (munge / "socket").exists(), 20, "munged has no socket")
        # Accessible to other users: the folder's permissions decide.
        munge.chmod(0o711)

    def _spawn(self, name, command):
        log = open(self.folder / f"{name}.log", "ab")
        self.daemons[name] = subprocess.Popen(command, env=self.env, stdin=subprocess.DEVNULL, stdout=log,
                                              stderr=subprocess.STDOUT)
        log.close()

    def start(self, name):
        """Start or restart slurmctld or the slurmd of a node."""
        if name == "slurmctld":
            self._spawn(name, ["slurmctld", "-D", "-f", self.config])
        else:
            core = self.nodes.index(name) % os.cpu_count()
            self._spawn(name, ["taskset", "-c", str(core), "slurmd", "-D", "-N", name, "-f", self.config])

    def kill(self, name):
        """SIGKILL a daemon, like a crash; its children survive."""
        daemon = self.daemons.pop(name)
        daemon.kill()
        daemon.wait()

    def ended(self):
        """Daemons that ended unexpectedly."""
        return [name for name, daemon in self.daemons.items() if daemon.poll() is not None]

    def run(self, *command, timeout=60, **more):
        return subprocess.run([str(c) for c in command], env=self.env, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, errors="replace", timeout=timeout, **more)

    def _wait(self, ready, seconds, what):
        end = time.monotonic() + seconds
        while not ready():
            dead = [n for n, d in self.daemons.items() if d.poll() is not None]
            if dead or time.monotonic() > end:
                logs = "\n".join(
                    (self.folder / f"{n}.log").read_text(errors="replace")[-2000:] for n in dead or self.daemons)
                raise RuntimeError(f"{what}{', ended: ' + ', '.join(dead) if dead else ''}\n{logs}")
            time.sleep(0.1)

    def wait_ready(self):
        """Every node is idle or at work."""
        def ready():
            done = self.run("sinfo", "-h", "-N", "-o", "%N %t")
            states = dict(line.split() for line in done.stdout.splitlines()) if done.returncode == 0 else {}
            return all(states.get(n) in ("idle", "mix", "alloc", "comp") for n in self.nodes)
        self._wait(ready, 60, "the nodes are not ready")

    def queue(self):
        """Lines of squeue: job, task, state; None while the controller does not respond."""
        try:
            done = self.run("squeue", "-h", "-r", "-o", "%A %K %T", timeout=15)
        except subprocess.TimeoutExpired:
            return None
        return None if done.returncode else [line.split() for line in done.stdout.splitlines()]

    def wait_empty(self, seconds):
        """Wait until no task waits or runs in two successive queries: a single one could fall between two states of a
        task.
        """
        self._wait(lambda: self.queue() == [] and not time.sleep(0.5) and self.queue() == [], seconds,
                   "jobs are left in the queue")

    def story(self, job):
        """Report on a job's tasks for a failed test: Slurm's states and the end of each log."""
        states = self.run("scontrol", "-o", "show", "job").stdout
        logs = "".join(f"--- {log.name}\n{log.read_text(errors='replace')[-1500:]}\n"
                       for log in sorted((pathlib.Path(job) / "log").glob("*")))
        nodes = "".join(f"--- {name}\n{(self.folder / f'{name}.log').read_text(errors='replace')[-1500:]}\n"
                        for name in self.daemons)
        return f"{states}\n{logs}{nodes}"

    def below(self, name=None):
        """Processes below this cluster's daemons, and step daemons that left them: [(pid, command)]."""
        table = parents()
        daemons = {d.pid for d in self.daemons.values()}

        def with_children(found):
            more = {p for p, (parent, _) in table.items() if parent in found} - found
            return with_children(found | more) if more else found

        # A slurmstepd leaves the process tree of a killed slurmd (in Slurm 24 at once), and overwrites its environment
        # with its title; the environment of its task identifies the cluster.
        strays = {p for p in table.keys() - with_children({os.getpid()}) if self._is_ours(p)}
        steps = {table[p][0] for p in strays if table.get(table[p][0], (0, ""))[1] == "slurmstepd"}
        return [(p, table[p][1])
                for p in with_children(daemons | strays | steps) - daemons
                if name in (None, table[p][1])]

    def _is_ours(self, pid):
        try:
            return f"SLURM_CONF={self.config}".encode() in pathlib.Path(f"/proc/{pid}/environ").read_bytes()
        except OSError:
            return False

    def close(self):
        for pid, _ in self.below():
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                pass
        for daemon in reversed(list(self.daemons.values())):
            daemon.kill()
            daemon.wait()
        self.daemons.clear()
