"""The exceptions, one a kind of fault; messages are those of the command line."""


class Error(Exception):
    """What every exception of this package is."""

    exit_status = 5  #: of the command line for such a fault


class UsageError(Error, ValueError):
    """An option or argument is wrong."""

    exit_status = 1


class ReadError(Error):
    """A file cannot be read or parsed."""

    exit_status = 2


class MeshError(Error, ValueError):
    """The mesh is not usable: it encloses nothing, or must not be mended."""

    exit_status = 3


class WriteError(Error):
    """A file cannot be written."""

    exit_status = 4


class NoSkeletonError(Error):
    """No skeleton, or one whose pieces or cycles are not the mesh's or that lies outside (``keep_failed=True`` returns it)."""

    exit_status = 5


class Cancelled(Error):
    """The time limit is over, or the progress callback returned False."""

    exit_status = 6


class SkeletonWarning(UserWarning):
    """What the command line prints as a warning."""
