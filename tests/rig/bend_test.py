#!/usr/bin/env python3
"""Limbs of rigged .glb files bend in three.js as docs/rigging.md says. 77: no chromium, node or packages.

usage: bend_test.py PROGRAM CACHE_DIR SHARED_MESHES
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import npm_package  # noqa: E402

PACKAGES = [("playwright-core", "1.65.1"), ("three", "0.187.0")]
SAMPLES = ["quadruped", "octoped"]
MESHES = ["models/horse.off", "models/hand.off", "models/octopus.off", "psb/off/10.off", "psb/off/390.off", "wild/body.obj",
          "wild/character_open.obj"]


def skip(why):
    print(f"skipped: {why}")
    return 77


def main():
    program, cache, shared = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    node, chromium = (next(filter(None, map(shutil.which, names)), None)
                      for names in (("node", "nodejs"), ("chromium", "chromium-browser")))
    if not node or not chromium:
        return skip("no chromium or no node")
    for package in PACKAGES:
        why = npm_package.missing(cache, *package)
        if why:
            return skip(why)
    shutil.copy(pathlib.Path(__file__).resolve().parent / "bend_in_three.mjs", cache / "bend_in_three.mjs")
    pictures = cache / "pictures"
    pictures.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="mspskel-bend-") as folder:
        meshes = [pathlib.Path(folder) / f"{name}.off" for name in SAMPLES]
        for mesh in meshes:
            subprocess.run([program, "sample", mesh.stem, str(mesh)], check=True)
        meshes += [shared / name for name in MESHES if (shared / name).is_file()]
        files = [pictures / f"{mesh.stem}.glb" for mesh in meshes]
        for mesh, file in zip(meshes, files):
            subprocess.run([program, str(mesh), str(file), "-q", "--rig"], check=True, timeout=200)
        bend = [node, str(cache / "bend_in_three.mjs"), chromium, str(cache / "node_modules"), "0", *map(str, files)]
        return 1 if subprocess.run(bend, timeout=1200).returncode else 0


if __name__ == "__main__":
    sys.exit(main())
