"""The array job of the guide, by a `sbatch` that runs it here one after another."""

import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import COMMAND

import ozols

GUIDE = (Path(__file__).parents[2] / "src/guide/python.md").read_text()

#: Runs what it is given as Slurm would: an array job once for each number, its dependencies being done.
SBATCH = """#!/usr/bin/env bash
set -euo pipefail
last=1 job=
for word in "$@"; do
    case "$word" in
    --parsable) ;;
    --dependency=afterok:4711) ;;
    --wrap=*) exec bash -euo pipefail -c "${word#--wrap=}" ;;
    -*) echo "sbatch: unknown option $word" >&2; exit 1 ;;
    *) job=$word ;;
    esac
done
last=$(sed -nE 's/^#SBATCH.*--array=1-([0-9]+).*/\\1/p' "$job")
for i in $(seq "$last"); do
    SLURM_ARRAY_JOB_ID=4711 SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_COUNT=$last bash -euo pipefail "$job" >&2
done
echo 4711
"""

THREE = (r"--array=1-\d+", "--array=1-3")


def scripts():
    """The job scripts of the guide by their names, and the commands that send them."""
    jobs = {}
    for block in GUIDE.split("```")[1::2]:
        name = re.search(r"^# (\w+\.sbatch)$", block, re.MULTILINE)
        if name:
            jobs[name[1]] = block.removeprefix("text\n")
    sent = re.findall(r"^(jobs?=\$\(sbatch .*|sbatch .*)$", GUIDE, re.MULTILINE)
    return jobs, sent


@pytest.fixture
def cluster(in_tmp):
    """An environment with the command and a `sbatch`."""
    bin = in_tmp / "bin"
    bin.mkdir()
    (bin / "sbatch").write_text(SBATCH)
    (bin / "sbatch").chmod(0o755)
    (bin / "ozols").symlink_to(COMMAND)
    return {**os.environ, "PATH": f"{bin}:{os.environ['PATH']}"}


def run(cluster, name, *changes):
    """A job of the guide, some of its numbers changed for smaller ones."""
    jobs, sent = scripts()
    script = jobs[name]
    for number, smaller in changes:
        script, found = re.subn(number, smaller, script)
        assert found == 1, number
    Path(name).write_text(script)
    lines = [line for line in sent if name in line]
    lines += [line for line in sent if name.split(".")[0] in line and name not in line]
    assert len(lines) == 2, lines
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", "\n".join(lines)], env=cluster, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_catalogue_by_an_array_job_has_the_rows_of_one_process(cluster):
    Path("grippers.toml").write_text('links = "4..6"\nsymmetries = ["mirror"]\nideas = 2\n')
    run(cluster, "grippers.sbatch", THREE)
    spec = {"links": "4..6", "symmetries": ["mirror"], "ideas": 2}
    with ozols.catalog.build(spec, out="alone.db") as alone, ozols.catalog.open("grippers.db") as made:
        assert len(alone) == len(made) > 0
        assert made.digest() == alone.digest()
    # The same parts by the same command again: nothing is left to do.
    before = Path("grippers.db").read_bytes()
    run(cluster, "grippers.sbatch", THREE)
    assert Path("grippers.db").read_bytes() == before
