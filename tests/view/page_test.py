#!/usr/bin/env python3
"""Drives a page that the program wrote in headless Chromium. Exits with 77 and a word where that cannot be had.

usage: page_test.py PROGRAM SOURCE_DIR CACHE_DIR
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "support"))
import npm_package  # noqa: E402

SKIP = 77
PLAYWRIGHT = ("playwright-core", "1.65.1")


def find(*names):
    return next((found for found in map(shutil.which, names) if found), None)


def skip(why):
    print(f"skipped: {why}")
    return SKIP


def main():
    program, source, cache = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    chromium, node = find("chromium", "chromium-browser"), find("node", "nodejs")
    if not chromium or not node:
        return skip("no chromium or no node")
    why = npm_package.missing(cache, *PLAYWRIGHT)
    if why:
        return skip(why)
    with tempfile.TemporaryDirectory(prefix="mspskel-page-") as folder:
        page = pathlib.Path(folder) / "quadruped.html"
        subprocess.run([program, str(source / "data" / "quadruped.off"), str(page), "-q"], check=True, timeout=120)
        fine = pathlib.Path(folder) / "octoped.html"
        subprocess.run([program, "sample", "octoped", "octoped.off", "--resolution", "12000"], cwd=folder, check=True, timeout=120)
        subprocess.run([program, "octoped.off", str(fine), "-q"], cwd=folder, check=True, timeout=120)
        shutil.copy(source / "tests" / "view" / "drive_page.mjs", cache / "drive_page.mjs")
        drive = [node, str(cache / "drive_page.mjs"), chromium, str(page), str(fine)]
        return subprocess.run(drive, timeout=400).returncode


if __name__ == "__main__":
    sys.exit(main())
