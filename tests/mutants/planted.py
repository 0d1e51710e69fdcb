"""Plants mutants one by one, each of which a test must notice: the list is planted.txt beside this file.

    python3 tests/mutants/planted.py [WORD]...

A word chooses the mutants whose file, text or tests hold it. Each is planted in a copy of the source below
target/mutants, the library and the named tests are built, and the tests are run. It prints `killed`, `SURVIVED`, or
`DOES NOT APPLY` where the text does not stand exactly once in the file, and ends with 1 unless all are killed.
"""

import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
COPY = ROOT / "target" / "mutants" / "planted"
TARGET = ROOT / "target" / "mutants" / "target"


def read_list():
    """The mutants: dictionaries of file, old text, new text and tests, in the order of the list."""
    mutants = []
    for block in (ROOT / "tests/mutants/planted.txt").read_text().split("\n\n"):
        lines = [line for line in block.splitlines() if line and not line.startswith("#")]
        if not lines:
            continue
        file, *rest = lines
        old = "\n".join(line[2:] for line in rest if line.startswith("- "))
        new = "\n".join(line[2:] for line in rest if line.startswith("+ "))
        tests = [line[2:].split() for line in rest if line.startswith("> ")]
        mutants.append({"file": file, "old": old, "new": new, "tests": tests})
    return mutants


def copy_source():
    """Copies all that is built, without what was built."""
    shutil.rmtree(COPY, ignore_errors=True)
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.splitlines()
    for name in names:
        if (ROOT / name).is_file():
            (COPY / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, COPY / name)


def run(room, *words):
    """The result of the tests of a room whose names hold one of the words; all of them without a word."""
    environment = dict(os.environ, CARGO_TARGET_DIR=str(TARGET))
    test = ["--lib"] if room == "lib" else ["--test", room]
    command = ["cargo", "test", "--locked", "--profile", "daily", *test]
    built = subprocess.run([*command, "--no-run"], cwd=COPY, env=environment, capture_output=True, text=True)
    if built.returncode != 0:
        return "not compiled"
    try:
        ran = subprocess.run([*command, "--", *words], cwd=COPY, env=environment, capture_output=True, text=True,
                             timeout=600)
    except subprocess.TimeoutExpired:
        return "timed out"
    if " 0 passed; 0 failed" in ran.stdout:
        return "no such test"
    return "passed" if ran.returncode == 0 else "failed"


def judge(mutant):
    """What became of a mutant."""
    place = COPY / mutant["file"]
    source = place.read_text()
    if source.count(mutant["old"]) != 1:
        return "DOES NOT APPLY"
    place.write_text(source.replace(mutant["old"], mutant["new"]))
    try:
        results = [run(*test) for test in mutant["tests"]]
    finally:
        place.write_text(source)
    if any(result in ("failed", "timed out") for result in results):
        return "killed"
    return "SURVIVED" if all(result == "passed" for result in results) else "NOT TRIED: " + ", ".join(results)


def main():
    chosen = [mutant for mutant in read_list()
              if not sys.argv[1:] or any(word in str(mutant) for word in sys.argv[1:])]
    copy_source()
    killed = 0
    for mutant in chosen:
        result = judge(mutant)
        killed += result == "killed"
        print(f"{result:10} {mutant['file']}: {mutant['old'].strip()} -> {mutant['new'].strip() or 'nothing'}",
              flush=True)
    print(f"{killed} of {len(chosen)} killed")
    return 0 if killed == len(chosen) else 1


if __name__ == "__main__":
    sys.exit(main())
