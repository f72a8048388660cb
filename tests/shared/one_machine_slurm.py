"""Run Slurm on this machine for tests, with its own keys, ports and folder, on the loopback address only."""

import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

DAEMONS = "munged", "slurmctld", "slurmd"
COMMANDS = "sacct", "sbatch", "scancel", "scontrol", "sinfo", "squeue", "srun"
PATIENCE = 300
"""Maximum waiting time [s], about ten times longer than needed on a loaded machine."""
CONFIG = """
ClusterName=local
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmdParameters=config_overrides
ReturnToService=2
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmdSpoolDir={folder}/spool
StateSaveLocation={folder}/state
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=bf_interval=1,sched_interval=1,sched_min_interval=0,batch_sched_delay=0
KillWait=2
MessageTimeout=5
SlurmctldTimeout=5
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing() -> list[str]:
    """Return the names of requirements of Slurm that this machine lacks."""
    rights = [] if os.geteuid() == 0 else ["the rights of root"]
    return rights + [command for command in (*DAEMONS, *COMMANDS, "mungekey") if not shutil.which(command)]


def until(true: Callable[[], object], what: str):
    """Wait until a condition is true, which takes at most minutes on any machine."""
    end = time.monotonic() + PATIENCE
    while not (found := true()):
        assert time.monotonic() < end, f"waited {PATIENCE} s for {what}"
        time.sleep(0.1)
    return found


class Slurm:
    """Daemons of Slurm, and its commands."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.bin = folder / "bin"
        self.config = folder / "slurm.conf"
        for made in (self.bin, folder / "spool", folder / "state"):
            made.mkdir(parents=True)
        controller_port, node_port = free_ports(2)
        self.config.write_text(
            CONFIG.format(
                folder=folder,
                host=socket.gethostname().split(".")[0],
                controller_port=controller_port,
                node_port=node_port,
            )
        )
        for command in COMMANDS:  # the plugin of Snakemake drops SLURM_CONF from the environment of its jobs
            path = self.bin / command
            path.write_text(f'#!/bin/sh\nSLURM_CONF={self.config} exec {shutil.which(command)} "$@"\n')
            path.chmod(0o755)
        self.path = f"{self.bin}:{os.environ['PATH']}"

    def start(self) -> None:
        """Start all daemons, and wait until the node accepts jobs."""
        key = self.folder / "munge.key"
        run("mungekey", "--create", f"--keyfile={key}")
        files = {"key-file": key} | {name: self.folder / f"munge.{name}" for name in ("socket", "pid-file", "log-file")}
        seed = f"--seed-file={self.folder / 'munge.seed'}"
        run("munged", "--force", seed, *(f"--{option}={path}" for option, path in files.items()))
        self.start_controller()
        run("slurmd", "-f", self.config)
        until(lambda: self("sinfo", "--noheader", "--format=%T") == "idle", "the node")

    def start_controller(self) -> None:
        run("slurmctld", "-f", self.config)
        until(lambda: "UP" in self("scontrol", "ping"), "the scheduler")

    def stop_controller(self) -> None:
        end(self.folder / "slurmctld.pid")

    def stop(self) -> None:
        """End all daemons and all jobs in any state."""
        self("scancel", "--full", "--signal=KILL", "--user=root")
        for name in ("slurmd.pid", "slurmctld.pid", "munge.pid-file"):
            end(self.folder / name)

    def __call__(self, *command) -> str:
        """Return the output of a Slurm command, or an empty text if the command fails."""
        said = subprocess.run(
            [self.bin / command[0], *command[1:]], capture_output=True, text=True, check=False, timeout=PATIENCE
        )
        return said.stdout.strip()

    def running(self) -> list[str]:
        """Return the numbers of running jobs; each task of an array has its own number."""
        return self("squeue", "--noheader", "--array", "--states=RUNNING", "--format=%i").split()


def run(*command):
    subprocess.run([*map(str, command)], check=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)


def end(pid_file):
    """End the process of a pid file if it is alive, and kill it if it does not end."""
    if not pid_file.exists() or not (text := pid_file.read_text().strip()):
        return
    pid = int(text)
    for patience, sent in ((30, signal.SIGTERM), (30, signal.SIGKILL)):
        give_up = time.monotonic() + patience
        while time.monotonic() < give_up:
            try:
                os.kill(pid, sent)
            except ProcessLookupError:
                return
            time.sleep(0.2)


def free_ports(count: int) -> list[int]:
    """Return ports on which no process listens."""
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports
