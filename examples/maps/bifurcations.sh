#!/bin/sh
# The rate of a driven pendulum at every period of its torque, over the torque: one dot where it repeats each period, two where it
# repeats every second, a band where it never does.
#
#     sh examples/maps/bifurcations.sh FOLDER [TORQUES]
set -eu
lagrangian=${LAGRANGIAN:-lagrangian}
out=$1
torques=${2:-401}
here=$(dirname "$0")
$lagrangian sweep "$here/driven_pendulum.machine" --vary "g=0.9..1.5:$torques" --until 900 --after 600 \
    --event 'period=sin(omega*t/2)' --record event=period --out "$out/pendulum.csv"
$lagrangian map "$out/pendulum.csv" --samples --of 'der(theta)' --plot "$out/pendulum.svg" --report "$out/pendulum.html"
