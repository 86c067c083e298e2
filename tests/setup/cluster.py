# SPDX-License-Identifier: Apache-2.0
"""A private Slurm on this machine runs the scripts of `stiction slurm`: a task is killed, a node dies, and what is merged
of 1, 4 and 16 shards is what one search finds. It starts and ends its own slurmctld, slurmd and munged, on ports that are
free and in a folder of its own, and leaves none of them. SKIPPED, with the reason, where they cannot run.

cluster.py PATH_TO_STICTION
"""

import ctypes
import json
import os
import shutil
import signal
import socket
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NODES = 3
ARRAYS = (1, 4, 16)  # shards; those of the last are hurt
PROBLEMS = 300_000
ENDLESS = 10**12
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 4, "generators": ["small", "duplicates"],
            "contacts": [2, 3], "first_unit_problems": 2000, "unit_problems": 2000}
PATIENCE = 600  # seconds, for what takes a few where nothing else runs
# Stands for the program: the first attempts of two shards go on until somebody ends them.
ENDURING = """#!/bin/bash
[[ "$*" =~ "--shard "([01])/{shards}" " ]] && mkdir "{folder}/met-${{BASH_REMATCH[1]}}" 2>/dev/null &&
  exec "{program}" "${{@/%{problems}/{endless}}}"
exec "{program}" "$@"
"""
CONFIGURATION = """ClusterName=stiction
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/run/slurmctld.pid
SlurmdPidFile={folder}/run/slurmd-%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0,sched_min_interval=0
JobRequeue=1
ReturnToService=2
SlurmctldTimeout=10
SlurmdTimeout=5
KillWait=2
PropagateResourceLimits=NONE
"""


def call(*words, **options):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True, timeout=PATIENCE, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def wait_until(holds, what, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise RuntimeError(f"{what}: not within {seconds} s")
        time.sleep(0.2)


def say(text):
    print(f"cluster: {time.strftime('%H:%M:%S')} {text}", flush=True)


class CannotStart(Exception):
    """There can be no Slurm here."""


def free_ports(count):
    """The first of so many ports in a row that nobody listens on."""
    for first in range(21000 + os.getpid() % 1000, 32000, count):
        try:
            for port in range(first, first + count):
                with socket.socket() as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
    raise CannotStart(f"no {count} ports in a row are free")


def dies_with_its_parent():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


class Cluster:
    """munged, slurmctld and a slurmd for each node, all on the loopback, with files in one folder."""

    def __init__(self, folder):
        self.folder, self.nodes, self.others = folder, {}, []
        for name in ("etc", "state", "spool", "log", "run", "munge"):
            (folder / name).mkdir(parents=True)
        folder.chmod(0o755)
        (folder / "munge").chmod(0o755)
        host = socket.gethostname().split(".")[0]
        port = free_ports(NODES + 2)
        text = CONFIGURATION.format(host=host, port=port, node_port=port + 1, folder=folder)
        for node in range(NODES):
            (folder / "spool" / f"n{node}").mkdir()
            text += (f"NodeName=n{node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port + 2 + node} CPUs=1 "
                     "RealMemory=200 State=UNKNOWN\n")
        text += f"PartitionName=main Nodes=n[0-{NODES - 1}] Default=YES MaxTime=INFINITE State=UP\n"
        (folder / "etc" / "slurm.conf").write_text(text)
        (folder / "etc" / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        os.environ["SLURM_CONF"] = str(folder / "etc" / "slurm.conf")

    def start(self):
        munge = self.folder / "munge"
        (munge / "key").write_bytes(os.urandom(128))
        (munge / "key").chmod(0o400)
        self.others.append(self.spawn("munged", "--foreground", "--force", f"--key-file={munge}/key",
                                      f"--socket={munge}/socket", f"--pid-file={munge}/pid", f"--log-file={munge}/log",
                                      f"--seed-file={munge}/seed", "--num-threads=2"))
        self.wait_for(munge / "socket", "munged")
        self.others.append(self.spawn("slurmctld", "-D", "-c"))
        self.wait_for(self.folder / "run" / "slurmctld.pid", "slurmctld")
        for node in range(NODES):
            self.start_node(node)
        wait_until(lambda: self.idle() == NODES, "all nodes are up")

    def wait_for(self, file, daemon):
        """Until the last daemon that was started is up; what ends at once cannot run here."""
        def up_or_ended():
            if self.others[-1].poll() is not None:
                said = "".join(log.read_text(errors="replace") for log in self.log_of(daemon)).strip().splitlines()
                raise CannotStart(f"{daemon} ended at once: {said[-1] if said else 'without a word'}")
            return file.exists()

        wait_until(up_or_ended, f"{daemon} is up")

    def log_of(self, daemon):
        return sorted((self.folder / "log").glob(f"{daemon}*.out"))

    def spawn(self, *words):
        log = open(self.folder / "log" / f"{words[0]}-{len(self.others)}-{len(self.nodes)}.out", "w", encoding="utf-8")
        with log:
            return subprocess.Popen(words, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                    preexec_fn=dies_with_its_parent)

    def start_node(self, node):
        self.nodes[node] = self.spawn("slurmd", "-D", "-N", f"n{node}")

    def idle(self):
        try:
            return int(call("sinfo", "-h", "-t", "idle", "-o", "%D").strip() or 0)
        except RuntimeError:  # not up yet
            return -1

    def kill_node(self, node):
        """The daemon of a node, and what it runs."""
        self.nodes[node].kill()
        self.nodes[node].wait()
        for pid in ours(f"n{node}"):
            kill(pid)

    def stop(self):
        """The daemons, and whatever they have started."""
        for process in [*self.nodes.values(), *reversed(self.others)]:
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        while left := ours():
            for pid in left:
                kill(pid)
            time.sleep(0.1)


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def variables_of(pid):
    try:
        entries = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
    except OSError:
        return {}
    return dict(entry.decode(errors="replace").split("=", 1) for entry in entries if b"=" in entry)


def ours(node=None):
    """Processes of this cluster, or of one of its nodes."""
    found = []
    for pid in (int(path.name) for path in Path("/proc").iterdir() if path.name.isdigit()):
        variables = variables_of(pid)
        on_node = node is None or variables.get("SLURMD_NODENAME") == node
        if pid != os.getpid() and variables.get("SLURM_CONF") == os.environ["SLURM_CONF"] and on_node:
            found.append(pid)
    return found


def enduring(program):
    """shard -> process and node of the searches that go on until they are ended."""
    found = {}
    for pid in ours():
        try:
            words = Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
        except OSError:
            continue
        if words[0] == program and str(ENDLESS) in words:
            shard = int(words[words.index("--shard") + 1].split("/")[0])
            found[shard] = (pid, variables_of(pid).get("SLURMD_NODENAME"))
    return found


# ---- The test ------------------------------------------------------------------------------------------------


def content(store):
    db = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
    try:
        return db.execute("SELECT * FROM findings ORDER BY signature").fetchall()
    finally:
        db.close()


def tables(report):
    """All but of work.csv, which says how long the processors took."""
    return {path.name: path.read_bytes() for path in Path(report).glob("*.csv") if path.name != "work.csv"}


def write_arrays(program, folder):
    """shards -> the folder of its scripts."""
    campaign, arrays = folder / "campaign.json", {}
    campaign.write_text(json.dumps(CAMPAIGN))
    for shards in ARRAYS:
        arrays[shards] = folder / f"array-of-{shards}"
        call(program, "slurm", campaign, "--shards", shards, "--problems", PROBLEMS, "-o", arrays[shards])
    return campaign, arrays


def hurt(program, cluster, array):
    """Kills a search, which runs again, and then the node of another one."""
    def log():
        return "".join(path.read_text() for path in (array / "logs").glob("task-*.log"))

    wait_until(lambda: len(enduring(program)) == 2, "two tasks run")
    running = enduring(program)
    pid, node = running[0]
    os.kill(pid, signal.SIGKILL)
    say(f"killed a search on {node}")
    wait_until(lambda: "shard 0: stiction ended with status 137: once more" in log(), "the killed task is queued again")
    dead = running[1][1]
    cluster.kill_node(int(dead[1:]))
    say(f"node {dead} is dead")
    wait_until(lambda: dead in call("sinfo", "-h", "-N", "-t", "down", "-o", "%N"), "the node is missed")


def run_arrays(program, cluster, folder, arrays):
    wrapper = folder / "stiction"
    wrapper.write_text(ENDURING.format(shards=ARRAYS[-1], folder=folder, program=program, problems=PROBLEMS, endless=ENDLESS))
    wrapper.chmod(0o755)
    os.environ["STICTION"] = str(wrapper)  # sbatch hands it on
    for shards in sorted(ARRAYS, reverse=True):
        say(f"{shards} shards: {call(arrays[shards] / 'submit.sh').strip()}")
    hurt(program, cluster, arrays[ARRAYS[-1]])
    for shards, array in arrays.items():
        wait_until((array / "report" / "SHA256SUMS").exists, f"{shards} shards are merged")
        say(f"{shards} shards are merged")
    wait_until(lambda: call("squeue", "-h").strip() == "", "the queue is empty")


def compare(program, folder, campaign, arrays):
    plain = folder / "plain.store"
    call(program, "search", campaign, "--store", plain, "--problems", PROBLEMS, "--finishing", 100)
    call(program, "report", plain, "-o", folder / "plain")
    expected = tables(folder / "plain")
    assert len(expected) > 5 and content(plain), "there is nothing to compare"
    for shards, array in arrays.items():
        assert content(plain) == content(array / "merged.store"), f"{shards} shards: the findings are others"
        assert expected == tables(array / "report"), f"{shards} shards: the tables are others"
        left = {path.name for path in (array / "shards").iterdir()} - {".keep", *(f"{i}.store" for i in range(shards))}
        assert not left, f"{shards} shards: left behind: {left}"
    return len(expected)


def show_logs(folder):
    for path in sorted([*folder.glob("array-*/logs/*.log"), *folder.glob("slurm/log/*")]):
        print(f"---- {path.name}\n{path.read_text(errors='replace')[-3000:]}", file=sys.stderr)


def require_slurm():
    if os.geteuid() != 0:
        raise CannotStart("its daemons are started by root")
    for name in ("slurmctld", "slurmd", "sbatch", "munged"):
        if shutil.which(name) is None:
            raise CannotStart(f"{name} is not installed")


def run(program, folder):
    cluster = None
    try:
        require_slurm()
        campaign, arrays = write_arrays(program, folder)
        cluster = Cluster(folder / "slurm")
        cluster.start()
        say(f"{NODES} nodes are up")
        run_arrays(program, cluster, folder, arrays)
    except CannotStart as reason:
        print(f"SKIPPED: there can be no Slurm here: {reason}")
        return
    except BaseException:
        show_logs(folder)
        raise
    finally:
        if cluster is not None:
            cluster.stop()
    assert not ours(), "processes are left"
    count = compare(program, folder, campaign, arrays)
    say(f"passed: {', '.join(map(str, ARRAYS))} shards, a killed task, a dead node; {count} tables are those of one search")


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("cluster: told to end"))
    with tempfile.TemporaryDirectory(prefix="stiction-cluster-", ignore_cleanup_errors=True) as folder:
        run(os.path.abspath(sys.argv[1]), Path(folder))


if __name__ == "__main__":
    main()
