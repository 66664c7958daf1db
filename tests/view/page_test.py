#!/usr/bin/env python3
"""Drives a page that the program wrote in headless Chromium. Exits with 77 and a word where that cannot be had.

usage: page_test.py PROGRAM SOURCE_DIR CACHE_DIR
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIP = 77
PLAYWRIGHT = "playwright-core@1.65.1"


def find(*names):
    return next((found for found in map(shutil.which, names) if found), None)


def skip(why):
    print(f"skipped: {why}")
    return SKIP


def main():
    program, source, cache = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    chromium, node, npm = find("chromium", "chromium-browser"), find("node", "nodejs"), find("npm")
    if not chromium or not node:
        return skip("no chromium or no node")
    if not (cache / "node_modules" / "playwright-core").is_dir():
        if not npm:
            return skip("no npm to install playwright-core with")
        cache.mkdir(parents=True, exist_ok=True)
        install = [npm, "install", "--prefix", str(cache), "--ignore-scripts", "--no-audit", "--no-fund", PLAYWRIGHT]
        if subprocess.run(install, capture_output=True, timeout=120).returncode != 0:
            return skip("npm could not install playwright-core")
    with tempfile.TemporaryDirectory(prefix="mspskel-page-") as folder:
        page = pathlib.Path(folder) / "quadruped.html"
        subprocess.run([program, str(source / "data" / "quadruped.off"), str(page), "-q"], check=True, timeout=120)
        shutil.copy(source / "tests" / "view" / "drive_page.mjs", cache / "drive_page.mjs")
        drive = [node, str(cache / "drive_page.mjs"), chromium, str(page)]
        return subprocess.run(drive, timeout=400).returncode


if __name__ == "__main__":
    sys.exit(main())
