#!/bin/sh
# Where a pendulum with a shaken pivot stands upside down: how far it leaves the vertical, over amplitude and frequency of its pivot.
#
#     sh examples/maps/upright_pendulum.sh FOLDER [SIDE]
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
side=${2:-200}
here=$(dirname "$0")
$lagrangian sweep "$here/../../machines/kapitza_pendulum.machine" --vary "a=0.02..0.2:$side" --vary "omega=20..150:$side" \
    --start theta=0.01 --until 10 --until-event 'fallen=cos(theta)' --reduce 'tilt = max(abs(theta))' --out "$out/upright.csv"
$lagrangian map "$out/upright.csv" --of tilt --over omega,a --plot "$out/upright.svg" --report "$out/upright.html"
