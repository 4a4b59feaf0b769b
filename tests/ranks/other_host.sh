#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# mpirun's remote shell (plm_rsh_agent): runs a command on this machine under another host's name.
host=$1
shift
exec unshare --uts sh -c "hostname $host && exec sh -c \"\$*\"" sh "$@"
