#!/bin/sh
# After how long one of the links of a double pendulum flips over, from rest at any two angles: a fractal.
#
#     sh examples/maps/flip_time.sh FOLDER [SIDE] [SECONDS]
#
# A side of 1000 is a million runs. What has not flipped has the colour of the end.
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
side=${2:-1000}
seconds=${3:-20}
here=$(dirname "$0")
$lagrangian sweep "$here/../../machines/double_pendulum.machine" --vary "start(theta1)=-3.1..3.1:$side" --vary "start(theta2)=-3.1..3.1:$side" \
    --until "$seconds" --tolerance 1e-6 --until-event 'flip=cos(theta1/2)*cos(theta2/2)' --out "$out/flips.parquet"
$lagrangian map "$out/flips.parquet" --of t --plot "$out/flips.svg" --report "$out/flips.html"
