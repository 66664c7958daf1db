#!/usr/bin/env python3
"""Files are read back by the programs that they are for: VTK, networkx, and strict checkers of SWC, glTF and
polylines.

usage: readers.py PROGRAM SOURCE_DIR CACHE_DIR
Exits with 77 and a word where the readers cannot be installed.
"""
import pathlib
import subprocess
import sys
import tempfile
import venv

SKIP = 77
PACKAGES = ["vtk>=9.3,<10", "networkx>=3,<4", "numpy<3"]


def python_with_readers(cache):
    """A Python that has them, in an environment of its own."""
    python = cache / "bin" / "python"
    ready = cache / "ready"
    if ready.is_file() and ready.read_text() == " ".join(PACKAGES):
        return python
    try:
        venv.create(cache, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "-q", *PACKAGES], check=True, capture_output=True, timeout=400)
    except (OSError, subprocess.SubprocessError) as error:
        print(f"skipped: the readers could not be installed: {error}")
        return None
    ready.write_text(" ".join(PACKAGES))
    return python


def main():
    program, source, cache = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    python = python_with_readers(cache)
    if python is None:
        return SKIP
    with tempfile.TemporaryDirectory(prefix="mspskel-readers-") as name:
        folder = pathlib.Path(name)
        files = [folder / f"a.{ending}" for ending in ("skel", "vtp", "swc", "graphml", "json", "obj", "glb", "cgal", "polylines.txt")]
        for mesh in ("data/quadruped.off", "handles.off"):
            if mesh == "handles.off":
                subprocess.run([program, "sample", "plate", folder / mesh], check=True)
                path = folder / mesh
            else:
                path = source / mesh
            subprocess.run([program, path, *files, "-q"], check=True, timeout=120)
            checks = source / "tests" / "cli" / "read_back.py"
            status = subprocess.run([python, checks, folder], timeout=120).returncode
            if status != 0:
                return status
        return subprocess.run([python, source / "tests" / "cli" / "written_by_vtk.py", program, folder], timeout=300).returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
