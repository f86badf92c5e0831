"""The Dask engine: members on the workers of a cluster, this machine's or another's."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from umbilical import __version__
from umbilical.errors import FileError, MissingPartnerError
from umbilical.studies.engines import Pool

_RETRIES = 10
"""Workers a member may lose before its study gives up."""


@contextmanager
def dask(address: str, jobs: int) -> Iterator[Pool]:
    """Workers of a Dask cluster. One that is killed costs its members in flight, which others run again.

    Args:
        address: of a scheduler, e.g. ``tcp://host:8786``, or ``local`` for a cluster of ``jobs`` processes here.
        jobs: workers of a local cluster.

    Raises:
        MissingPartnerError: dask.distributed is not installed.
        FileError: there is no scheduler, or its workers have another version of Umbilical.
    """
    with connect(address, jobs) as client:
        at_once = max(sum(client.nthreads().values()), 1)
        yield Pool(at_once, lambda: client.get_executor(pure=False, retries=_RETRIES))


@contextmanager
def connect(address: str, jobs: int) -> Iterator[Any]:
    """A client of the cluster, whose workers have this version of Umbilical; a local one ends with it.

    Raises:
        MissingPartnerError, FileError: as :func:`dask`.
    """
    try:
        import dask.config
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise MissingPartnerError(
            "a cluster needs dask.distributed, which is not installed; get it with `pip install umbilical[cluster]`"
        ) from error
    dask.config.set({"distributed.scheduler.allowed-failures": _RETRIES})
    alone: dict[str, Any] = {"set_as_default": False}  # else xarray would take its locks from the cluster
    if address == "local":
        quiet: dict[str, Any] = {"dashboard_address": ":0", "silence_logs": 50}
        with LocalCluster(n_workers=jobs, threads_per_worker=1, **quiet) as own, Client(own, **alone) as client:
            yield client
        return
    try:
        client = Client(address, timeout="10s", **alone)
    except (OSError, TimeoutError, ValueError) as error:
        raise FileError(f"{address}: there is no Dask scheduler that answers ({error})") from error
    with client:
        versions: Any = client.run(_version)
        for worker, version in versions.items():
            if version != __version__:
                raise FileError(f"{address}: worker {worker} has Umbilical {version}, this is {__version__}")
        yield client


def _version() -> str:
    """Of the worker that is asked, which imports this file as its own."""
    return __version__
