#!/usr/bin/env python3
"""The committed page is the bundle of the committed sources.

usage: bundle_test.py SOURCE_DIR
"""
import hashlib
import pathlib
import re
import sys


def hash_of_sources(viewer):
    """What viewer/build.mjs writes into the page."""
    names = [f"src/{path.name}" for path in (viewer / "src").iterdir()] + ["build.mjs", "package-lock.json", "package.json"]
    digest = hashlib.sha256()
    for name in sorted(names):
        digest.update(name.encode() + b"\0" + (viewer / name).read_bytes() + b"\0")
    return digest.hexdigest()


def main():
    viewer = pathlib.Path(sys.argv[1]) / "viewer"
    page = (viewer / "dist" / "page.html").read_text(encoding="utf-8")
    stated = re.search(r"<!-- sources ([0-9a-f]{64}) -->", page)
    if stated is None or stated.group(1) != hash_of_sources(viewer):
        print("viewer/dist/page.html is not built from these sources: cd viewer && npm ci --ignore-scripts && npm run build")
        return 1
    licence = (viewer / "dist" / "LICENSE.three").read_text(encoding="utf-8").strip()
    if licence not in page:
        print("viewer/dist/page.html lacks the licence of three.js")
        return 1
    for mark in ("@MSPSKEL_TITLE@", "@MSPSKEL_DESCRIPTION@", "@MSPSKEL_DATA@"):
        if page.count(mark) != 1:
            print(f"viewer/dist/page.html has the mark {mark} {page.count(mark)} times, not once")
            return 1
    print("the page is built from its sources")
    return 0


if __name__ == "__main__":
    sys.exit(main())
