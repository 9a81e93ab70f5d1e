"""``python -m lagrangian``: the command ``lagrangian``."""

import sys

from ._command import main

sys.exit(main())
