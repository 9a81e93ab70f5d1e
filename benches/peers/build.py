"""Builds every form of one task with one peer; prints a line of JSON for each.

    python build.py PEER TASK VARIANT FOLDER
"""

import importlib
import json
import sys
import time
from pathlib import Path

from peers.common import TooLong


def main():
    peer, task, variant, folder = sys.argv[1:]
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    module = importlib.import_module(f"peers.{peer}_peer")
    say = lambda entry: print(json.dumps({"peer": peer, "task": task, "variant": variant, **entry}), flush=True)
    try:
        for form in module.forms(task, variant, folder):
            say(form)
    except TooLong as limit:
        say({"left_out": str(limit)})


if __name__ == "__main__":
    main()
