"""Meshes with known answers, made once."""

import os

import pytest

import mspskel


@pytest.fixture(scope="session")
def quadruped():
    return mspskel.sample("quadruped", resolution=2500)


@pytest.fixture(scope="session")
def torus():
    return mspskel.sample("torus", resolution=600)


@pytest.fixture(scope="session")
def animal(quadruped):
    """A tree."""
    return mspskel.skeletonize(quadruped)


@pytest.fixture(scope="session")
def ring(torus):
    """A loop."""
    return mspskel.skeletonize(torus)


@pytest.fixture(scope="session")
def client():
    """A cluster of the user's, whose workers know the hooks of these tests."""
    from distributed import Client, LocalCluster

    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join([os.path.dirname(__file__), os.environ.get("PYTHONPATH", "")]))
        cluster = LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=":0")
    with cluster, Client(cluster) as client:
        yield client
