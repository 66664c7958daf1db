#!/usr/bin/env python3
"""The Khronos validator finds no error and no warning in .glb files. 77: no node, or the validator cannot be had.

usage: gltf_test.py PROGRAM CACHE_DIR SHARED_MESHES
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import npm_package  # noqa: E402

VALIDATOR = ("gltf-validator", "2.0.0-dev.3.10")
SAMPLES = ["quadruped", "torus", "capsule", "chain"]
MESHES = ["models/horse.off", "models/hand.off", "models/octopus.off", "psb/off/10.off", "psb/off/390.off", "wild/body.obj",
          "wild/character_open.obj"]
SCRIPT = """
const validator = require('gltf-validator'), fs = require('fs');
(async () => {
  let failed = 0;
  for (const file of process.argv.slice(2)) {
    const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
    if (issues.numErrors + issues.numWarnings === 0) continue;
    failed += 1;
    console.log(file, JSON.stringify(issues.messages.slice(0, 5)));
  }
  process.exit(failed ? 1 : 0);
})();
"""


def skip(why):
    print(f"skipped: {why}")
    return 77


def main():
    program, cache, shared = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    node = shutil.which("node")
    if not node:
        return skip("no node")
    why = npm_package.missing(cache, *VALIDATOR)
    if why:
        return skip(why)
    (cache / "validate.cjs").write_text(SCRIPT, encoding="ascii")
    with tempfile.TemporaryDirectory(prefix="mspskel-gltf-") as folder:
        meshes, files = [], []
        for name in SAMPLES:
            meshes.append(pathlib.Path(folder) / f"{name}.off")
            subprocess.run([program, "sample", name, str(meshes[-1])], check=True)
        meshes += [shared / name for name in MESHES if (shared / name).is_file()]
        for mesh in meshes:
            for options in [[], ["--rig", "--pose", "root=1,2,3,40"]]:
                files.append(f"{folder}/{len(files)}-{mesh.stem}.glb")
                subprocess.run([program, str(mesh), files[-1], "-q", *options], check=True, timeout=200)
        return subprocess.run([node, str(cache / "validate.cjs"), *files], timeout=200).returncode


if __name__ == "__main__":
    sys.exit(main())
