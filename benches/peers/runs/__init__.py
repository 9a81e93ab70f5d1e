"""One module for each program that takes part in work_precision.py: `Peer(run)` has `tools`, `settings(tool)` and `call(tool, setting)`."""
