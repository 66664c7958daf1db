"""Meshes with known answers, made once."""

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
