"""A study through Snakemake on local cores, one of whose jobs is killed between two cells, has the tables of one process. Its name and that
of its folder look like commands of a shell, and stay names.

usage: snakemake_test.py SSRLAB SNAKEFILE
As SSRLAB of that Snakefile it is called by itself, to kill the first job that has several cells: see run_and_kill().
"""

import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import types

import snakemake.utils
import yaml

STUDY = {
    "shots": [{"scene": ["mirror_pillars", "fence"], "resolution": [48, 27]}],
    "reference": {"samples": 16},
    "techniques": [
        {"technique": "none"},
        {"technique": "mcguire_dda", "baseline": True},
        {"technique": "mcguire_dda", "preset": "best"},
    ],
    "seeds": 2,
    "timing": {"frames": 0},
}
FORGED = "forged"  # the file that the names of study and folder would make, were they run
COMMAND = f"$(touch {FORGED}) `touch {FORGED}`; touch {FORGED}"
TABLES = ("results.csv", "splits.csv", "effects.csv", "summary.csv")


def check(is_true, what):
    if not is_true:
        sys.exit(f"snakemake_test: {what}")


def read(path):
    with open(path, "rb") as stream:
        return stream.read()


def run_and_kill(program, arguments):
    """Runs ssrlab, and kills it once all of its cells but the last are done: of that one the claim is held, so that
    ssrlab can but wait for it. Only the first job of several cells, in the environment's SSRLAB_TEST_KILLED."""
    cells = re.findall("cell=([0-9a-f]+)", " ".join(arguments))
    marker = os.environ["SSRLAB_TEST_KILLED"]
    try:
        note = len(cells) > 1 and open(marker, "x", encoding="utf-8")
    except FileExistsError:
        note = None
    if not note:
        os.execv(program, [program, *arguments])
    folder = os.path.join(arguments[arguments.index("--out") + 1], "cells")
    os.makedirs(folder, exist_ok=True)
    with note, open(os.path.join(folder, cells[-1] + ".claim"), "w", encoding="utf-8") as claim:
        fcntl.flock(claim, fcntl.LOCK_EX)
        process = subprocess.Popen([program, *arguments], close_fds=True)
        while not all(os.path.exists(os.path.join(folder, cell + ".json")) for cell in cells[:-1]):
            check(process.poll() is None, "ssrlab ended before it was killed")
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        note.write(f"{len(cells) - 1} of {len(cells)} cells were done")
        sys.exit(128 + abs(process.wait()))


def main(ssrlab, snakefile, folder):
    study, alone, jobs = (os.path.join(folder, name) for name in (f"it's {COMMAND}.json", "alone", f"jobs {COMMAND}"))
    with open(study, "w", encoding="utf-8") as stream:
        json.dump(STUDY, stream)
    subprocess.run([ssrlab, "run", study, "--out", alone, "--cache", folder + "/cache"], check=True, capture_output=True)

    killer = os.path.join(folder, "killer")
    with open(killer, "w", encoding="utf-8") as stream:
        stream.write(f'#!/bin/sh\nexec "{sys.executable}" -B "{os.path.abspath(__file__)}" kill "{ssrlab}" "$@"\n')
    os.chmod(killer, 0o755)
    marker = os.path.join(folder, "killed")
    command = ["snakemake", "--snakefile", snakefile, "--profile", os.path.dirname(snakefile) + "/profiles/local"]
    command += ["--cores", "2", "--config", f"study={study}", f"out={jobs}", f"ssrlab={killer}", "threads=1"]
    environment = os.environ | {"SSRLAB_TEST_KILLED": marker}
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    said = done.stdout + done.stderr
    check(done.returncode == 0, f"snakemake failed:\n{said}")
    check(os.path.exists(marker) and read(marker) == b"2 of 3 cells were done", "no job was killed in its middle")
    check(said.count("Trying to restart job") == 1, f"the job that was killed was not restarted once:\n{said}")
    logs = [read(os.path.join(jobs, "cluster", name)) for name in os.listdir(os.path.join(jobs, "cluster")) if ".log" in name]
    check(sum(b"1 cells done, 2 found done before" in log for log in logs) == 1, "its second attempt did more than was left")
    for table in TABLES:
        check(read(os.path.join(alone, table)) == read(os.path.join(jobs, table)), f"{table} differs")
    check(len(read(os.path.join(jobs, "results.csv"))) > 1000, "the tables are empty")
    profiles = [os.path.join(os.path.dirname(snakefile), "profiles", "slurm", name) for name in ("config.yaml", "config.v8+.yaml")]
    for profile, key in zip(profiles, ("cluster", "cluster-generic-submit-cmd")):
        check_submission(profile, key, os.path.join(jobs, "cluster", "times.log"), folder)
    check_alike(*profiles)
    check(not os.path.exists(os.path.join(folder, FORGED)), "the name of a study was run as a command")


def check_alike(profile, later):
    """Snakemake 8 and 9, which cannot be run here, get what 7 gets, by the names of their plugin."""
    with open(profile, encoding="utf-8") as stream, open(later, encoding="utf-8") as stream_of_later:
        old, new = yaml.safe_load(stream), yaml.safe_load(stream_of_later)
    names = {"cluster": "cluster-generic-submit-cmd", "cluster-status": "cluster-generic-status-cmd", "cluster-cancel": "cluster-generic-cancel-cmd"}
    check({names.get(key, key): value for key, value in old.items()} | {"executor": "cluster-generic"} == new, f"{later} differs from {profile}")


def check_submission(profile, key, log, folder):
    """What the shell makes of the Slurm profile's sbatch."""
    with open(profile, encoding="utf-8") as stream:
        command = yaml.safe_load(stream)[key]
    made = snakemake.utils.format(command, rule="times", wildcards="1_shot", threads=1, resources=types.SimpleNamespace(mem_mb=1, runtime=1, slurm=""), log=[log])
    said = subprocess.run(["sh", "-c", made.replace("sbatch", "printf '%s\\n'", 1)], cwd=folder, capture_output=True, text=True, check=True).stdout
    check(f"--output={log}.%j" in said.splitlines(), f"sbatch gets: {said}")


if __name__ == "__main__":
    if sys.argv[1] == "kill":
        run_and_kill(sys.argv[2], sys.argv[3:])
    with tempfile.TemporaryDirectory() as temporary:
        main(sys.argv[1], os.path.abspath(sys.argv[2]), temporary)
