#!/bin/sh
# Prints whether a Slurm job is running, success or failed, for Snakemake. Uses the controller alone,
# which forgets a job some minutes after its end (MinJobAge): then it counts as failed, and its next attempt finds what it did.
id=${1%%;*}  # sbatch may print ID;CLUSTER
state=$(scontrol --oneliner show job "$id" 2>&1 | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
case $state in
COMPLETED) echo success ;;
BOOT_FAIL | CANCELLED | DEADLINE | FAILED | NODE_FAIL | OUT_OF_MEMORY | PREEMPTED | TIMEOUT) echo failed ;;
?*) echo running ;;
*)
    # Not known, or no controller to ask: without an answer nothing is known of the job.
    if scontrol ping 2>&1 | grep -q 'is UP'; then echo failed; else echo running; fi
    ;;
esac
