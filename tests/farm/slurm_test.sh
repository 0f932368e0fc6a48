#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright Contributors to the Regain project

# slurm_test.sh PROGRAM: a render and a bake in seven parts, under a real slurmctld and slurmd on this
# machine, with one part killed while it runs; the results are those of one run, to the bit. All
# that it makes is in a folder of its own. Exit code 77 where Slurm is not installed.

set -euo pipefail

program=$(readlink -f -- "$1")
script=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../../tools/farm" && pwd)/regain.slurm

# Daemons may be in a folder that is no user's.
export PATH=$PATH:/usr/sbin:/sbin
for needed in slurmctld slurmd sbatch squeue scontrol pgrep; do
    if ! command -v $needed >/dev/null; then
        echo "skipped: there is no $needed (Debian: slurm-wlm, procps)"
        exit 77
    fi
done

work=$(mktemp -d "${TMPDIR:-/tmp}/regain-slurm-XXXXXX")
daemons=()
finish() {
    local code=$?
    ((${#daemons[@]} == 0)) || kill "${daemons[@]}" 2>/dev/null || true
    wait || true
    if ((code != 0 && code != 77)); then
        tail -n 20 "$work"/*.log "$work"/*.out 2>/dev/null || true
    fi
    rm -rf -- "$work"
}
trap finish EXIT

fail() {
    echo "FAILED: $*" >&2
    exit 1
}

free_port() {
    local port
    while port=$((20000 + RANDOM % 12000)); (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do :; done
    echo "$port"
}

# --- a cluster of one node -------------------------------------------------------------------------

export SLURM_CONF=$work/slurm.conf
mkdir "$work/state" "$work/spool"
cat >"$SLURM_CONF" <<END
ClusterName=regain
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/none
CredType=cred/none
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
NodeName=regain NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
slurmctld -D -c >"$work/slurmctld.out" 2>&1 &
daemons+=($!)
slurmd -D -N regain >"$work/slurmd.out" 2>&1 &
daemons+=($!)

# until_true SECONDS COMMAND...
until_true() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        ((SECONDS < end)) || return 1
        sleep 0.05
    done
}
is_idle() { [[ $(sinfo -h -o %T 2>/dev/null) == idle ]]; }
until_true 30 is_idle || fail "the node is not idle after half a minute"

has_ended() { [[ -z $(squeue -h -j "$1" 2>/dev/null) ]]; }
field() { scontrol -o show job "$1" | grep -o " $2=[^ ]*" | head -n 1 | cut -d= -f2; }
submit() { sbatch --parsable --chdir="$work" --output="$work/%x-%j.log" "$@"; }
export REGAIN=$program

# --- one run ---------------------------------------------------------------------------------------

render=(render --size 240x160 --spp 64 --alpha '0.2,0.6' --quiet)
bake=(bake ggx_E_ss ggx_E_avg)
"$program" "${render[@]}" -o "$work/whole.exr"
"$program" "${bake[@]}" -o "$work/whole" >/dev/null 2>&1

# --- a render, with one part killed ----------------------------------------------------------------

parts=$(submit --array=1-7 "$script" "${render[@]}" -o gold.exr)
merge=$(submit --dependency=afterok:"$parts" "$script" "${render[@]}" -o gold.exr \
    --merge 'gold.part-*-of-7')

# The program is told by where it runs: there may be others.
running_part() {
    local pid
    for pid in $(pgrep -f -- "^$program .* --part 3/7$"); do
        if [[ $(readlink "/proc/$pid/cwd") == "$work" ]]; then
            victim=$pid
            return 0
        fi
    done
    return 1
}
until_true 60 running_part || fail "part 3 never ran"
kill -KILL "$victim"
echo "part 3 of 7 was killed"
[[ ! -e $work/gold.part-3-of-7 ]] || fail "part 3 was done before it was killed"

# Slurm waits two minutes before it runs a job again; a test does not.
waits_again() { [[ $(field "${parts}_3" Restarts) == 1 && $(field "${parts}_3" Reason) == BeginTime ]]; }
until_true 60 waits_again || fail "part 3 was not queued again"
[[ $(field "$merge" JobState) == PENDING ]] || fail "the merge did not wait for part 3"
scontrol update JobId="${parts}_3" StartTime=now
until_true 60 has_ended "$merge" || fail "the merge did not end"
cmp "$work/whole.exr" "$work/gold.exr" || fail "the merged picture differs"
cmp "$work/whole.png" "$work/gold.png" || fail "the merged PNG differs"
echo "the merged render is the one of one run"

# --- a bake, one part of which was forgotten -------------------------------------------------------

export REGAIN_PARTS=7
most=$(submit --array=1-4,6-7 "$script" "${bake[@]}" -o tables)
last=$(submit --array=5 "$script" "${bake[@]}" -o tables)
unset REGAIN_PARTS
merge=$(submit --dependency=afterok:"$most:$last" "$script" "${bake[@]}" -o tables \
    --merge 'tables/ggx_E_ss.part-*-of-7')
until_true 90 has_ended "$merge" || fail "the merge did not end"
for table in ggx_E_ss ggx_E_avg; do
    cmp "$work/whole/$table.exr" "$work/tables/$table.exr" || fail "the merged $table differs"
done
echo "the merged tables are those of one run"

# --- what would fail again is not run again --------------------------------------------------------

bad=$(submit --array=1-2 "$script" "${render[@]}" --gamma x -o bad.exr)
merge=$(submit --dependency=afterok:"$bad" "$script" "${render[@]}" -o bad.exr --merge 'bad.part-*')
some=$(submit --array=2-3 "$script" "${render[@]}" -o some.exr)
until_true 60 has_ended "$bad,$merge,$some" || fail "jobs of bad input did not end"
[[ $(field "${bad}_1" JobState) == FAILED && $(field "${bad}_1" ExitCode) == 2:0 &&
    $(field "${bad}_1" Restarts) == 0 ]] || fail "bad input is $(field "${bad}_1" JobState)"
[[ $(field "$merge" JobState) == CANCELLED ]] || fail "a merge of nothing is $(field "$merge" JobState)"
[[ $(field "${some}_2" ExitCode) == 2:0 ]] || fail "an array of some parts was taken for all"
echo "bad input fails at once"
