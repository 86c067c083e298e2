# SPDX-License-Identifier: Apache-2.0
"""A private Slurm on this machine runs the scripts of `stiction slurm`: a task is killed, a node dies, and what is merged
is what one search finds. As root; it needs slurmctld, slurmd, slurm-client and munge, and starts and ends them itself.

cluster.py PATH_TO_STICTION
"""

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
SHARDS = 8
PORT = 27800
PROBLEMS = 6_000_000
CAMPAIGN = {"format": "stiction-campaign", "version": 1, "seed": 4, "generators": ["small", "psd"], "contacts": [2, 3],
            "unit_problems": 2000}
CONFIGURATION = """ClusterName=stiction
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
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
    return subprocess.run(list(map(str, words)), capture_output=True, text=True, check=True, timeout=300, **options).stdout


def wait_until(holds, what, seconds=300):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if holds():
            return
        time.sleep(0.2)
    raise SystemExit(f"cluster: {what}: not within {seconds} s")


class Cluster:
    """munged, slurmctld and a slurmd for each node, all on the loopback, with files in one folder."""

    def __init__(self, folder):
        self.folder, self.nodes, self.others = folder, {}, []
        for name in ("etc", "state", "spool", "log", "run", "munge"):
            (folder / name).mkdir(parents=True)
        folder.chmod(0o755)
        (folder / "munge").chmod(0o755)
        host = socket.gethostname().split(".")[0]
        text = CONFIGURATION.format(host=host, port=PORT, node_port=PORT + 1, folder=folder)
        for node in range(NODES):
            (folder / "spool" / f"n{node}").mkdir()
            text += (f"NodeName=n{node} NodeHostname={host} NodeAddr=127.0.0.1 Port={PORT + 10 + node} CPUs=1 "
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
        wait_until((munge / "socket").exists, "munged is up", 20)
        self.others.append(self.spawn("slurmctld", "-D", "-c"))
        for node in range(NODES):
            self.start_node(node)
        wait_until(lambda: self.idle() == NODES, "all nodes are up", 60)

    def spawn(self, *words):
        log = open(self.folder / "log" / f"{words[0]}-{len(self.others)}-{len(self.nodes)}.out", "w", encoding="utf-8")
        with log:
            return subprocess.Popen(words, stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def start_node(self, node):
        self.nodes[node] = self.spawn("slurmd", "-D", "-N", f"n{node}")

    def idle(self):
        try:
            return int(call("sinfo", "-h", "-t", "idle", "-o", "%D").strip() or 0)
        except subprocess.CalledProcessError:
            return -1

    def kill_node(self, node):
        """The daemon of a node, and what it runs."""
        self.nodes[node].kill()
        self.nodes[node].wait()
        for pid in descendants_on(f"n{node}"):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def stop(self):
        for process in [*self.nodes.values(), *reversed(self.others)]:
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def variables_of(pid):
    try:
        entries = Path(f"/proc/{pid}/environ").read_bytes().split(b"\0")
    except OSError:
        return {}
    return dict(entry.decode(errors="replace").split("=", 1) for entry in entries if b"=" in entry)


def processes():
    return [int(path.name) for path in Path("/proc").iterdir() if path.name.isdigit()]


def ours(pid, node):
    variables = variables_of(pid)
    return variables.get("SLURM_CONF") == os.environ["SLURM_CONF"] and variables.get("SLURMD_NODENAME") == node


def descendants_on(node):
    return [pid for pid in processes() if ours(pid, node)]


def searches(program):
    """The searches that run in this cluster: process, node."""
    found = []
    for pid in processes():
        try:
            words = Path(f"/proc/{pid}/cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        variables = variables_of(pid)
        if words[:2] == [program.encode(), b"search"] and variables.get("SLURM_CONF") == os.environ["SLURM_CONF"]:
            found.append((pid, variables.get("SLURMD_NODENAME")))
    return found


def content(store):
    db = sqlite3.connect(f"file:{store}?mode=ro", uri=True)
    try:
        return db.execute("SELECT * FROM findings ORDER BY signature").fetchall()
    finally:
        db.close()


def main():
    program = os.path.abspath(sys.argv[1])
    for name in ("slurmctld", "slurmd", "sbatch", "munged"):
        if shutil.which(name) is None:
            sys.exit(f"cluster: {name} is not installed")
    folder = Path(tempfile.mkdtemp(prefix="stiction-cluster-"))
    campaign, array = folder / "campaign.json", folder / "array"
    campaign.write_text(json.dumps(CAMPAIGN))
    call(program, "slurm", campaign, "--shards", SHARDS, "--problems", PROBLEMS, "-o", array)
    cluster = Cluster(folder / "slurm")
    try:
        cluster.start()
        print(f"cluster: {NODES} nodes are up", flush=True)
        print("cluster:", call(array / "submit.sh").strip(), flush=True)

        wait_until(lambda: len(searches(program)) >= 2, "tasks run", 60)
        pid, node = searches(program)[0]
        os.kill(pid, signal.SIGKILL)
        print(f"cluster: killed a search on {node}", flush=True)
        log = lambda: "".join(path.read_text() for path in (array / "logs").glob("*.log"))
        wait_until(lambda: "once more" in log(), "the killed task is queued again", 60)

        wait_until(lambda: any(on != node for _, on in searches(program)), "tasks run on another node", 120)
        dead = int(next(on for _, on in searches(program) if on != node)[1:])
        cluster.kill_node(dead)
        print(f"cluster: node n{dead} is dead", flush=True)
        wait_until(lambda: f"n{dead}" in call("sinfo", "-h", "-N", "-t", "down", "-o", "%N"), "the node is missed", 120)

        wait_until((array / "report" / "SHA256SUMS").exists, "everything is merged", 900)
        wait_until(lambda: call("squeue", "-h").strip() == "", "the queue is empty", 120)
    except BaseException:
        for path in sorted([*(array / "logs").glob("*.log"), *(folder / "slurm" / "log").glob("*")]):
            print(f"---- {path.name}\n{path.read_text(errors='replace')[-3000:]}", file=sys.stderr)
        raise
    finally:
        cluster.stop()
    plain = folder / "plain.store"
    call(program, "search", campaign, "--store", plain, "--problems", PROBLEMS)
    call(program, "search", "--store", plain, "--finish")
    call(program, "report", plain, "-o", folder / "plain")
    assert content(plain) == content(array / "merged.store"), "the findings are others"
    tables = sorted(path.name for path in (folder / "plain").glob("*.csv"))
    for name in tables:
        assert (folder / "plain" / name).read_bytes() == (array / "report" / name).read_bytes(), name
    shutil.rmtree(folder)
    print(f"cluster: passed: {SHARDS} shards, a killed task, a dead node; {len(tables)} tables are those of one search")


if __name__ == "__main__":
    main()
