#!/usr/bin/env python3
"""Shows our comments to Doxygen: // above a declaration becomes /*! */, // behind a member becomes ///<.

A paragraph with a line that starts with four blanks is a drawing and stays as it is.
"""
import itertools
import re
import sys

MARKUP = str.maketrans({"\\": "\\\\", "@": "\\@", "<": "\\<", ">": "\\>", "#": "\\#"})


def text(line):
    """A line of prose; `::` would ask for a link."""
    return line.translate(MARKUP).replace("::", "\\::")


def comment_block(lines):
    """One block comment for consecutive // lines, given without their slashes."""
    yield "/*!"
    for blank, paragraph in itertools.groupby(lines, key=lambda line: not line.strip()):
        paragraph = [line.replace("*/", "* /") for line in paragraph]
        if not blank and any(line.startswith("    ") for line in paragraph):
            yield from ["\\verbatim", *paragraph, "\\endverbatim"]
        else:
            yield from (text(line) for line in paragraph)
    yield "*/"


def code_line(line):
    behind = re.match(r"^(\s*\S.*?[;,}])\s+// ?(.*)$", line)
    if behind and not behind.group(1).lstrip().startswith("}"):
        return f"{behind.group(1)}  ///< {text(behind.group(2))}"
    return line


def main():
    with open(sys.argv[1], encoding="utf-8") as source:
        lines = source.read().split("\n")
    print("/// \\file")  # the first comment is the file's own
    for is_comment, group in itertools.groupby(lines, key=lambda line: re.match(r"^\s*//", line) is not None):
        if is_comment:
            print("\n".join(comment_block([re.sub(r"^\s*// ?", "", line) for line in group])))
        else:
            print("\n".join(code_line(line) for line in group))


if __name__ == "__main__":
    main()
