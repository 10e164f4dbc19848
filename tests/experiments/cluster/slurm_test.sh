#!/bin/bash
# A study through the Slurm profile on a real Slurm of one node, which this sets up in a temporary folder on the loopback address
# (slurmctld, slurmd and munged of Debian) and takes down at its end. A job is killed twice: its process, then the job. Tables must be those of
# one process, with all jobs in one folder and with folders of their own. Needs root, as slurmd does. Minutes.
#
# usage: tests/experiments/cluster/slurm_test.sh [CONFIG.json]     SSRLAB names the program; default: build/release/ssrlab
set -euo pipefail
cd "$(dirname "$0")/../../.."
. experiments/setup.sh
ssrlab=$(realpath "${SSRLAB:-build/release/ssrlab}")
study=$(realpath "${1:-tests/experiments/cluster/slurm_test.json}")
[ "$(id -u)" -eq 0 ] || die "slurmd needs root"
install_packages "${cluster_packages[@]}"

work=$(mktemp -dt ssrlab-slurm.XXXXXX)
export SLURM_CONF=$work/slurm.conf SSRLAB_TIMING_LOCK=$work/timing.lock
own_processes=()
clean_up() {
    local status=$?
    scancel --user=root >/dev/null 2>&1 || true
    for process in "${own_processes[@]}"; do kill "$process" 2>/dev/null || true; done
    wait
    if [ "$status" -eq 0 ]; then rm -rf "$work"; else echo "left for a look: $work"; fi
}
trap clean_up EXIT

# wait_until SECONDS WHAT COMMAND...: until COMMAND succeeds.
wait_until() {
    local end=$((SECONDS + $1)) what=$2
    shift 2
    until "$@" >/dev/null 2>&1; do
        [ $SECONDS -lt $end ] || die "waited in vain for $what; logs: $work"
        sleep 0.2
    done
}

start_slurm() {
    local node
    node=$(hostname -s)
    mkdir -p "$work"/{munge,state,spool}
    head -c 128 /dev/urandom >"$work/munge/key"
    chmod 600 "$work/munge/key"
    # /tmp is everybody's, which munged accepts with --force only; the folder below it is not.
    munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" --pid-file="$work/munge/pid" \
        --seed-file="$work/munge/seed" --log-file="$work/munge/log" >"$work/munge/out" 2>&1 &
    own_processes+=($!)
    # No cgroups and no accounts: a container may have neither. Jobs that have ended are listed in a text file.
    cat >"$SLURM_CONF" <<END
ClusterName=ssrlab
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$work/ended_jobs
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=2
ReturnToService=2
KillWait=5
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(free --mebi | awk '/^Mem/ {print int($2 * 0.9)}') State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
    wait_until 20 munged test -S "$work/munge/socket"
    slurmctld -D >"$work/slurmctld.out" 2>&1 &
    own_processes+=($!)
    wait_until 60 slurmctld sh -c 'scontrol ping | grep -q "is UP"'
    slurmd -D -N "$node" >"$work/slurmd.out" 2>&1 &
    own_processes+=($!)
    wait_until 60 slurmd sh -c 'sinfo --noheader --format=%t | grep -q idle'
    say "Slurm $(sinfo --version | cut -d' ' -f2): $(sinfo --noheader --format='%D node, %c cores, %m MiB, %t')"
}

# through_slurm OUT [KEY=VALUE...]
through_slurm() {
    local out=$1
    shift
    snakemake --snakefile experiments/studies/cluster/Snakefile --profile experiments/studies/cluster/profiles/slurm --latency-wait 10 \
        --config study="$study" out="$out" cache="$work/cache" ssrlab="$ssrlab" minutes=0.2 threads=1 "$@"
}

# The number of the running job whose name begins with $1.
running_job() { squeue --noheader --states=RUNNING --format='%i %j' | awk -v name="$1" 'index($2, name) == 1 {print $1; exit}'; }
is_running() { [ -n "$(running_job "$1")" ]; }
is_running_or_over() { is_running "$1" || ! kill -0 "$snakemake"; }
process_of() {
    scontrol listpids "$1" 2>/dev/null | awk 'NR > 1 {print $1}' | while read -r process; do
        [ "$(readlink "/proc/$process/exe")" != "$ssrlab" ] || echo "$process"
    done | head -1
}
has_process() { [ -n "$(process_of "$1")" ]; }

# Kills the first job of renders that runs: first its process, as the kernel does when memory is short, then the job.
kill_a_job_twice() {
    local job name
    wait_until 600 "a job of renders" is_running_or_over renders
    is_running renders || die "Snakemake ended before any"
    job=$(running_job renders)
    name=$(squeue --noheader --job="$job" --format=%j)
    wait_until 60 "its process" has_process "$job"
    kill -9 "$(process_of "$job")"
    echo "kill -9 of the process of job $job ($name)"
    wait_until 60 "its end" sh -c "! squeue --noheader --states=RUNNING --job=$job --format=%i | grep -q ."
    wait_until 120 "its second attempt" is_running "$name"
    job=$(running_job "$name")
    wait_until 60 "its process" has_process "$job"
    scancel "$job"
    echo "scancel of job $job ($name)"
}

compare() {
    local table
    for table in results splits effects summary; do
        cmp "$work/alone/$table.csv" "$1/$table.csv" || die "$table.csv differs"
    done
    echo "results.csv, splits.csv, effects.csv, summary.csv: equal"
}

ended_jobs() {
    sed -E 's/.*JobId=([0-9]+).* Name=([^ ]+) JobState=([A-Z]+).*StartTime=[^T]*T([^ ]+) EndTime=[^T]*T([^ ]+).*/\1 \4 \5 \3 \2/' "$work/ended_jobs" |
        column -t
}

say "One process"
"$ssrlab" run "$study" --out "$work/alone" --cache "$work/cache_of_one" >"$work/alone.log" 2>&1 || die "see $work/alone.log"
tail -1 "$work/alone.log"
start_slurm

say "Through Slurm, in one folder, with a job killed twice"
through_slurm "$work/shared" folders=shared >"$work/shared.log" 2>&1 &
snakemake=$!
own_processes+=($snakemake)
kill_a_job_twice
wait "$snakemake" || die "Snakemake failed: see $work/shared.log"
grep -E "Trying to restart|steps \(100%\)" "$work/shared.log"
ended_jobs
compare "$work/shared"
[ "$(ended_jobs | grep -cE ' (FAILED|CANCELLED) ')" -eq 2 ] || die "not two jobs failed"

say "Through Slurm, each job in a folder of its own"
: >"$work/ended_jobs"
through_slurm "$work/own" folders=own >"$work/own.log" 2>&1 || die "Snakemake failed: see $work/own.log"
ended_jobs
compare "$work/own"
say "Done"
