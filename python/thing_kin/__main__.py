"""`python -m thing_kin` is `thing-kin`."""

import sys

from thing_kin.cli import main

if __name__ == "__main__":
    sys.exit(main())
