#!/bin/sh
# How often the mortar hits the cylinder of the platform, the power that crushing takes, and the force on the ground, over the speed of the
# debalance.
#
#     sh examples/maps/layered_crusher_over_speed.sh FOLDER [SPEEDS] [TIME]
#
# The machine starts at rest; its first half is left out.
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
speeds=${2:-41}
time=${3:-2}
here=$(dirname "$0")
$lagrangian sweep "$here/../../machines/contacts/layered_crusher.machine" --vary "w=80..180:$speeds" --until "$time" \
    --after "$(echo "$time" | awk '{ print $1 / 2 }')" \
    --reduce 'impacts = frequency(outer impact)' \
    --reduce 'strokes = frequency(bed closes)' \
    --reduce 'crushing = power(bed)' \
    --reduce 'ground = rms(ground_force)' \
    --out "$out/layered_crusher.csv"
$lagrangian map "$out/layered_crusher.csv" --of impacts,crushing,ground --plot "$out/layered_crusher.svg" --report "$out/layered_crusher.html"
