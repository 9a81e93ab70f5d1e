"""C written by hand: the reference for generated code."""

from peers.common import HERE, OPTIMIZED, command, ready


def forms(task, variant, folder):
    name = "crusher" if task == "crusher" else "chain"
    source, library = HERE / "expert" / f"{name}.c", folder / "expert.so"
    size = [] if task == "crusher" else [f"-DN={task.removeprefix('chain')}"]
    words = [*OPTIMIZED, "-Wno-psabi", *size, "-o", library, source, "-lm"]
    yield ready("by hand, packed sines", library, 0.0, 0.0, command(words))
