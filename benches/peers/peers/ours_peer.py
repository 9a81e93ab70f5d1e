"""Our own code: `lagrangian library`."""

import os

from peers.common import HERE, command, ready


def forms(task, variant, folder):
    root = HERE.parent.parent
    size = []
    if task == "crusher":
        spec = root / "machines" / "crusher9.machine" if variant == "par" else HERE / "crusher_const.machine"
    elif task == "arm":
        spec = root / "machines" / "six_joint_arm.machine"
    else:
        spec, size = HERE / "chain.machine", ["--const", f"N={task.removeprefix('chain')}"]
    library = folder / "libmachine.so"
    call = [os.environ["LAGRANGIAN"], "library", spec, *size, "--out", library]
    spent = command(call)
    derive = command([os.environ["LAGRANGIAN"], "derive", spec, *size, "--as", "rust", "--out", folder / "machine.rs"])
    command([*call, "--lanes", "4,8"])  # the timed library has eight lanes in addition to the four of every peer
    yield ready("`lagrangian library`", library, derive, 0.0, spent - derive)
