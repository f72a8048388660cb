"""Run Slurm on this machine for tests, with its own keys, ports and folder, on the loopback address only."""

import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable
from contextlib import suppress
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
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SlurmdParameters=config_overrides
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
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 RealMemory=4000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing() -> list[str]:
    """Return the names of requirements of Slurm that this machine lacks."""
    rights = [] if os.geteuid() == 0 else ["the rights of root"]
    return rights + [command for command in (*DAEMONS, *COMMANDS, "mungekey") if not shutil.which(command)]


def until(true: Callable[[], object], what: str) -> None:
    """Wait until a condition is true, which takes at most minutes on any machine."""
    end = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < end, f"waited {PATIENCE} s for {what}"
        time.sleep(0.1)


class Slurm:
    """Daemons of Slurm, and its commands."""

    def __init__(self, folder: Path):
        self.folder, self.bin, self.config = folder, folder / "bin", folder / "slurm.conf"
        for made in (self.bin, folder / "spool", folder / "state"):
            made.mkdir(parents=True)
        free = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
        controller_port, node_port = (one.getsockname()[1] for one in free)
        for one in free:
            one.close()
        host = socket.gethostname().split(".")[0]
        ports = {"controller_port": controller_port, "node_port": node_port}
        self.config.write_text(CONFIG.format(folder=folder, host=host, **ports))
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
        run("slurmctld", "-f", self.config)
        until(lambda: "UP" in self("scontrol", "ping"), "the scheduler")
        run("slurmd", "-f", self.config)
        until(lambda: self("sinfo", "--noheader", "--format=%T") == "idle", "the node")

    def stop(self) -> None:
        """End all jobs in any state, then all daemons."""
        self("scancel", "--full", "--user=root")
        until(lambda: not self("squeue", "--noheader"), "the end of all jobs")
        for name in ("slurmd.pid", "slurmctld.pid", "munge.pid-file"):
            with suppress(OSError, ValueError):  # it has not started, or has ended
                os.kill(int((self.folder / name).read_text()), signal.SIGKILL)

    def __call__(self, *command) -> str:
        """Return the output of a Slurm command, or an empty text if the command fails."""
        command = [self.bin / command[0], *command[1:]]
        return subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE).stdout.strip()


def run(*command):
    subprocess.run([*map(str, command)], check=True, timeout=PATIENCE, stdin=subprocess.DEVNULL)
