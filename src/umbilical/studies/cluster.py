"""The Dask engine: members on the workers of a cluster, this machine's or another's."""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from itertools import islice
from typing import Any

from umbilical import __version__
from umbilical.errors import FileError, MissingPartnerError
from umbilical.studies.engines import Engine, run_packed
from umbilical.studies.members import Draws, Member
from umbilical.studies.rows import Row

_RETRIES = 10
"""Workers a member may lose before its study gives up."""


def dask(address: str, jobs: int) -> Engine:
    """Workers of a Dask cluster. One that is killed costs its members in flight, which others run again.

    Args:
        address: of a scheduler, e.g. ``tcp://host:8786``, or ``local`` for a cluster of ``jobs`` processes here.
        jobs: workers of a local cluster.
    """

    def run(draws: Draws, members: Iterable[Member]) -> Iterator[Row]:
        with connect(address, jobs) as client:
            yield from on_client(client, draws, members)

    return run


@contextmanager
def connect(address: str, jobs: int) -> Iterator[Any]:
    """A client of the cluster, whose workers have this version of Umbilical; a local one ends with it.

    Raises:
        MissingPartnerError: dask.distributed is not installed.
        FileError: there is no scheduler, or its workers have another version.
    """
    try:
        import dask.config
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise MissingPartnerError(
            "a cluster needs dask.distributed, which is not installed; get it with `pip install umbilical[cluster]`"
        ) from error
    dask.config.set({"distributed.scheduler.allowed-failures": _RETRIES})
    if address == "local":
        quiet: dict[str, Any] = {"dashboard_address": ":0", "silence_logs": 50}
        with (
            LocalCluster(n_workers=jobs, threads_per_worker=1, processes=True, **quiet) as cluster,
            Client(cluster) as client,
        ):
            yield client
        return
    try:
        client = Client(address, timeout="10s")
    except (OSError, TimeoutError, ValueError) as error:
        raise FileError(f"{address}: there is no Dask scheduler that answers ({error})") from error
    with client:
        _check_versions(client, address)
        yield client


def on_client(client: Any, draws: Draws, members: Iterable[Member]) -> Iterator[Row]:
    """Rows from a cluster's workers, two members for each of their threads under way."""
    from distributed import as_completed

    packed, waiting = pickle.dumps(draws.study), iter(members)
    window = 2 * max(sum(client.nthreads().values()), 1)

    def submit(member: Member) -> Any:
        return client.submit(run_packed, packed, member, pure=False, retries=_RETRIES)

    under_way = as_completed([submit(member) for member in islice(waiting, window)])
    for future in under_way:
        yield future.result()
        for member in islice(waiting, 1):
            under_way.add(submit(member))


def _check_versions(client: Any, address: str) -> None:
    for worker, version in client.run(_version).items():
        if version != __version__:
            raise FileError(f"{address}: worker {worker} has Umbilical {version}, this is {__version__}")


def _version() -> str:
    from umbilical import __version__ as version

    return version
