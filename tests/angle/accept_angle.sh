#!/bin/sh
# `make accept` runs the accept_* scripts, with GN_FULL=1: here it is all of the same.
exec tests/angle/check_angle.sh
