"""MuJoCo: its compiled engine, called from C through its own library."""

from pathlib import Path

import mujoco

import tasks
from peers.common import HERE, Clock, command, ready


def chain(n):
    return chain_of(tasks.chain_links(n))


def chain_of(links):
    """Length, mass, distance of the mass centre and inertia about it, for each link."""
    # In the plane x, z; a rotation about -y takes the downward vertical towards +x.
    nested, ends = [], []
    before = 0.0
    for length, mass, centre, inertia in links:
        nested.append(
            f'<body pos="0 0 {-before!r}"><joint type="hinge" axis="0 -1 0"/>'
            f'<inertial pos="0 0 {-centre!r}" mass="{mass!r}" diaginertia="{inertia!r} {inertia!r} {inertia!r}"/>'
        )
        ends.append("</body>")
        before = length
    return "".join(nested + ends)


def arm():
    axes = {"y": "0 1 0", "z": "0 0 1"}
    nested, ends = [], []
    for axis, shift, mass, centre, inertia in tasks.ARM_LINKS:
        words = lambda numbers: " ".join(repr(float(x)) for x in numbers)
        nested.append(
            f'<body pos="{words(shift)}"><joint type="hinge" axis="{axes[axis]}" damping="{tasks.ARM["friction"]}"/>'
            f'<inertial pos="{words(centre)}" mass="{tasks.ARM[mass]}" fullinertia="{words(inertia)}"/>'
        )
        ends.append("</body>")
    return "".join(nested + ends)


def forms(task, variant, folder):
    clock = Clock()
    body = arm() if task == "arm" else chain(tasks.Task(task).n)
    text = (
        '<mujoco><compiler angle="radian" autolimits="true"/><option gravity="0 0 -9.81">'
        '<flag contact="disable" constraint="disable"/></option>'
        f"<worldbody>{body}</worldbody></mujoco>"
    )
    emit = clock.lap()
    model = folder / "model.xml"
    model.write_text(text)
    mujoco.MjModel.from_xml_path(str(model))
    load = clock.lap()
    package = Path(mujoco.__file__).resolve().parent
    engine = next(package.glob("libmujoco.so*"))
    library = folder / "smooth.so"
    source = HERE / "peers" / "mujoco_shim.c"
    words = ["gcc", "-O2", "-shared", "-fPIC", f'-DMODEL="{model}"', f"-DABSOLUTE={int(task != 'arm')}"]
    command([*words, f"-I{package}/include", "-o", library, source, engine, f"-Wl,-rpath,{package}"])
    yield ready("smooth forward dynamics", library, 0.0, emit, load)
