"""python -m mspskel batch IN OUT"""

import sys


def main() -> int:
    if sys.argv[1:2] != ["batch"]:
        print("usage: python -m mspskel batch IN OUT [options]; --help lists them", file=sys.stderr)
        return 1
    from .batch.command import run

    return run(sys.argv[2:])


if __name__ == "__main__":
    sys.exit(main())
