"""Packages that tests take from npm's registry, in a folder of the build."""
import shutil
import subprocess


def missing(cache, name, version):
    """Installs the package into the folder if it is not there; why it cannot be had, or None."""
    if (cache / "node_modules" / name).is_dir():
        return None
    npm = shutil.which("npm")
    if not npm:
        return f"no npm to install {name} with"
    cache.mkdir(parents=True, exist_ok=True)
    install = [npm, "install", "--prefix", str(cache), "--ignore-scripts", "--no-audit", "--no-fund", f"{name}@{version}"]
    if subprocess.run(install, capture_output=True, timeout=120).returncode != 0:
        return f"npm could not install {name}"
    return None
