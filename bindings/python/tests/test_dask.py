"""Dask: the counts of one process, from a local cluster of two, also if one of them is killed on the way."""

import os
import signal

import pytest

import unfair_toss as ut

distributed = pytest.importorskip("distributed")

FIG4 = ut.Space.named("paper-fig4")
PLAN = ut.Plan.random(400_000_000, seed=9)

pytestmark = pytest.mark.filterwarnings("ignore")


def test_the_counts_of_a_cluster_are_those_of_one_process_also_after_a_kill(tmp_path):
    whole = ut.probability(FIG4, PLAN)
    killed = []
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):

        def kill_one(done: int, _: int) -> None:
            if not killed:
                process = next(iter(client.run(os.getpid).values()))
                killed.append(process)
                os.kill(process, signal.SIGKILL)

        found = ut.probability(
            FIG4, PLAN, executor=client.get_executor(retries=3), shards=16, progress=kill_one, folder=tmp_path
        )
    assert len(killed) == 1 and len(list(tmp_path.iterdir())) == 16
    assert (found.heads, found.tails, found.interval) == (whole.heads, whole.tails, whole.interval)
