#!/usr/bin/env python3
"""Checks that each header includes only files of its own folder and of folders above it in LAYERS, and that a user of
the compiled library who extracts skeletons parses no OpenMesh, which costs half a second a source file.

usage: check_layers.py SOURCE_DIR
"""
import pathlib
import re
import sys

LAYERS = ["base", "mesh", "repair", "slice", "center", "collapse", "skeleton", "solid", "limbs", "arcs", "refine",
          "thesis", "segment", "rig", "io", "samples", "render", "view"]
TOP = len(LAYERS)  # headers directly in include/mspskel, and the pipeline, see every folder


def layer(path):
    """The place in LAYERS of 'mspskel/<folder>/...'; None for a folder that the list does not know."""
    parts = path.split("/")
    if len(parts) == 2 or parts[1] == "pipeline":
        return TOP
    return LAYERS.index(parts[1]) if parts[1] in LAYERS else None


def violations(root):
    include = root / "include"
    for header in sorted(include.rglob("*.h")):
        name = header.relative_to(include).as_posix()
        own = layer(name)
        if own is None:
            yield f"{name}: the folder has no place among {', '.join(LAYERS)}"
            continue
        for number, line in enumerate(header.read_text(encoding="utf-8").splitlines(), 1):
            match = re.match(r'\s*#\s*include\s*[<"]((?:mspskel/)?[^">]*)[">]', line)
            if match is None:
                continue
            target = match.group(1)
            if target.startswith("CGAL/"):
                yield f"{name}:{number}: public headers are free of CGAL, not {target}"
            if target.startswith("mspskel/"):
                seen = layer(target)
                if seen is None or seen > own:
                    yield f"{name}:{number}: may not include {target}"
            elif (header.parent / target).exists():
                yield f"{name}:{number}: include {target} by its full name, mspskel/..."


def includes_when_compiled(header):
    """What the header includes where MSPSKEL_COMPILED is set."""
    hidden = []  # a flag for each open #if: the branch at hand is for header-only use
    for line in header.read_text(encoding="utf-8").splitlines():
        directive = re.match(r'\s*#\s*(ifdef|ifndef|if|else|endif|include)\b\s*(.*)', line)
        if directive is None:
            continue
        word, rest = directive.groups()
        if word in ("if", "ifdef", "ifndef"):
            hidden.append(word == "ifndef" and rest.strip() == "MSPSKEL_COMPILED")
        elif word == "else":
            hidden[-1] = not hidden[-1]
        elif word == "endif":
            hidden.pop()
        elif not any(hidden):
            yield rest.strip().strip('<>"')


def reaches_openmesh(root, start):
    include = root / "include"
    seen, waiting = set(), [start]
    while waiting:
        name = waiting.pop()
        if name in seen:
            continue
        seen.add(name)
        for target in includes_when_compiled(include / name):
            if target.startswith("OpenMesh/"):
                yield f"{name}: {start} is to be read without {target} where the library is compiled"
            elif target.startswith("mspskel/"):
                waiting.append(target)


def main():
    root = pathlib.Path(sys.argv[1])
    found = list(violations(root)) + list(reaches_openmesh(root, "mspskel/extract_skeleton.h"))
    print("\n".join(found) if found else "every header includes only its own folder and those above")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
