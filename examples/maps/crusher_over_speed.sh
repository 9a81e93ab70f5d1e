#!/bin/sh
# Amplitude of the crusher's platform, and the power that crushing takes, over the speed of the debalance.
#
#     sh examples/maps/crusher_over_speed.sh FOLDER [SPEEDS]
#
# Crushing is what the material between mortar and pestle takes: its damping along the line of centres, and its drag.
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
speeds=${2:-101}
here=$(dirname "$0")
$lagrangian sweep "$here/../../machines/cushioned_crusher.machine" --vary "omega=60..180:$speeds" --until 4 --after 2 \
    --reduce 'amplitude = max(norm(platform.at))' \
    --reduce 'power = mean(d2*der(s2)^2 + drag2*pestle_slip^2)' \
    --reduce 'force = max(crushing_force)' \
    --out "$out/crusher.csv"
$lagrangian map "$out/crusher.csv" --of amplitude,power,force --plot "$out/crusher.svg" --report "$out/crusher.html"
