"""Processes of a build."""


def stopped() -> list[str]:
    """A line with those below this one that wait for a signal to go on, as after SIGSTOP, if there are any."""
    import psutil  # here, because most builds never ask

    waiting = []
    for process in psutil.Process().children(recursive=True):
        try:
            if process.status() == psutil.STATUS_STOPPED:
                waiting.append(str(process.pid))
        except psutil.NoSuchProcess:  # it has ended meanwhile
            continue
    return [f"Stopped by a signal, not by the build; to go on: kill -CONT {' '.join(waiting)}"] if waiting else []
