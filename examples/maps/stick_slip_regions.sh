#!/bin/sh
# Where a block on a belt sticks again and again, and where it slips for ever: the greatest of its speeds as a share of the belt's, over
# the speed of the belt and the damping. It is 1 where the block sticks.
#
#     sh examples/maps/stick_slip_regions.sh FOLDER [SIDE]
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
side=${2:-60}
here=$(dirname "$0")
$lagrangian sweep "$here/damped_stick_slip.machine" --vary "v_b=0.1..2:$side" --vary "d=0.02..0.4:$side" \
    --until 60 --after 40 --reduce 'share = max(der(x)/v_b)' --out "$out/stick.csv"
$lagrangian map "$out/stick.csv" --of share --plot "$out/stick.svg" --report "$out/stick.html"
