"""Small changes of the source, each of which some test should notice: all of them built into one library with a switch.

    python3 tests/mutants/mutants.py [--again] [--planted] [FILE | FOLDER]...

cargo-mutants names the changes. A function that has some is written, in a copy of the source below target/mutants, as
`match crate::mutants::chosen(7) { 17 => { its body with change 17 }, 18 => ..., _ => { its body } }`, so that one build
holds them all; a change of a constant stands as a constant of that name in the functions that use it. Changes that do
not compile are taken out. Each test then runs once by itself, which tells its time and the functions that it reaches; and
each mutant runs the tests that reach its function, the quick ones first, until one fails. A test that takes six times the
processor time that it takes without the mutant has timed out, which is noticed too.

Without a word: the rooms that decide what is true. `--planted` adds the list planted.txt beside this file, each mutant of
which runs the tests that the list names for it; with no other word it stands alone. `--again` tries what survived in the
last run. Results: target/mutants/results.tsv, a line as soon as it is known. Ends with 1 if some survived.
"""

import collections
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(os.environ.get("MUTANTS_WORK", ROOT / "target" / "mutants"))
COPY = WORK / "source"
RESULTS = WORK / "results.tsv"
ROOMS = ["src/certificate/", "src/solve/uniqueness/existence.rs", "src/solve/rigid/", "src/surface/mortar.rs",
         "src/ffi/args.rs", "src/law/", "src/reduce/"]
TESTS = os.environ.get("MUTANTS_TESTS", "lib certificate law problem proof reduce model flexibility operator surface "
                       "solve families").split()
# Processor seconds: of a test that is tried at all, and of all tests of a mutant.
LONGEST = float(os.environ.get("MUTANTS_LONGEST", "20"))
AT_MOST = float(os.environ.get("MUTANTS_SECONDS", "120"))
ENVIRONMENT = dict(os.environ, CARGO_TARGET_DIR=str(WORK / "target"), SIGNORINI_PROPERTY_CASES="600",
                   SIGNORINI_FAR_GAPS="1000")
MEMORY = 6 << 30

SWITCH = """
mod mutants {
    use std::io::Write;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicBool, Ordering};

    static NUMBER: OnceLock<u32> = OnceLock::new();
    static RECORD: OnceLock<Option<String>> = OnceLock::new();
    static REACHED: [AtomicBool; FUNCTIONS] = [const { AtomicBool::new(false) }; FUNCTIONS];

    fn read(name: &str) -> Option<String> {
        std::env::var(name).ok()
    }

    #[inline]
    pub(crate) fn chosen(function: usize) -> u32 {
        let number = *NUMBER.get_or_init(|| read("MUTANT").and_then(|text| text.parse().ok()).unwrap_or(0));
        if number == 0 {
            record(function);
        }
        number
    }

    #[cold]
    fn record(function: usize) {
        let Some(path) = RECORD.get_or_init(|| read("MUTANTS_REACHED")) else { return };
        if !REACHED[function].swap(true, Ordering::Relaxed) {
            let file = std::fs::OpenOptions::new().append(true).create(true).open(path);
            file.and_then(|mut file| file.write_all(format!("{function}\\n").as_bytes())).expect(path);
        }
    }
}
"""
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|.', re.S)
# A result that is told by a trait, at the end of a head: the bodies of its arms are of different types.
IMPL = re.compile(r"-> impl ([^{]*?)(?: \+ use<('\w+)[^{]*>)?\s*$")


def of_a_box(result):
    head = result.string[result.string.rindex("fn "):]
    lifetime = result[2] or ("'_" if "'" not in result[1] or "(&self" in head else "")
    return f"-> Box<dyn {result[1]}{lifetime and ' + '}{lifetime}> "


class Source:
    """A file of the library: its text, and the bodies of its functions, none of which is within another."""

    def __init__(self, name):
        self.name, self.text, self.bodies = name, (ROOT / name).read_text(), {}
        self.lines = [0]
        for line in self.text.splitlines(keepends=True):
            self.lines.append(self.lines[-1] + len(line))

    def place(self, point):
        return self.lines[point["line"] - 1] + point["column"] - 1

    def range(self, span):
        return self.place(span["start"]), self.place(span["end"])

    def add_function(self, span):
        """The brace that opens the body is the first one outside of parentheses."""
        start, end = self.range(span)
        depth = 0
        for token in TOKEN.finditer(self.text, self.text.index("fn ", start), end):
            depth += {"(": 1, "[": 1, ")": -1, "]": -1}.get(token[0], 0)
            if token[0] == "{" and depth == 0:
                self.bodies[token.start()] = end
                return

    def body(self, place):
        """The outermost body that holds a place."""
        return min(((start, end) for start, end in self.bodies.items() if start <= place < end), default=None)


class Mutant:
    """A change: the text from `start` to `end` of a file becomes `new`. The tests to be tried: rooms with words of names."""

    def __init__(self, name, source, start, end, new, tests):
        self.name, self.source, self.start, self.end, self.new = name, source, start, end, new
        self.tests = tests
        self.result = None

    def tries(self, room, name):
        """True if the test bears on the change: it is of such a room, and has one of the words, if there are some."""
        return any(room == own and any(word in name for word in words or [""]) for own, *words in self.tests)

    def bodies(self, sources):
        """The bodies with the change, each with its source and its place."""
        text = self.source.text
        body = self.source.body(self.start)
        if body:
            start, end = body
            return [(self.source, body, text[start:self.start] + self.new + text[self.end:end])]
        line = text.rindex("\n", 0, self.start) + 1
        item = re.compile(r"(pub(?:\(\w+\))? )?(?:const|static) (\w+):[^;]*;").match(text, line)
        if not item or item.end() < self.end:
            return []
        changed = text[line:self.start] + self.new + text[self.end:item.end()]
        changed = changed[len(item[1] or ""):]
        word = re.compile(rf"(?<![\w:]){item[2]}\b")
        return [(source, (start, end), "{ " + changed + source.text[start:end] + " }")
                for source in (sources if item[1] else [self.source]) for start, end in source.bodies.items()
                if source.body(start) == (start, end) and word.search(source.text, start, end)]


def read_mutants(words, planted):
    """The sources by name, and the mutants."""
    listed = subprocess.run(["cargo", "mutants", "--list", "--json"], cwd=ROOT, check=True, capture_output=True, text=True)
    listed = json.loads(listed.stdout)
    sources = {name: Source(name) for name in {mutant["file"] for mutant in listed}}
    for mutant in listed:
        if mutant["function"]:
            sources[mutant["file"]].add_function(mutant["function"]["span"])
    mutants = []
    for mutant in (mutant for word in words for mutant in listed if mutant["file"].startswith(word)):
        source = sources[mutant["file"]]
        mutants.append(Mutant(mutant["name"], source, *source.range(mutant["span"]), mutant["replacement"],
                              [[room] for room in TESTS]))
    return sources, read_planted(sources) * planted + mutants


def read_planted(sources):
    """The mutants of planted.txt."""
    mutants = []
    for block in (ROOT / "tests/mutants/planted.txt").read_text().split("\n\n"):
        lines = [line for line in block.splitlines() if line and not line.startswith("#")]
        if not lines:
            continue
        old, new = ("\n".join(line[2:] for line in lines if line.startswith(sign)) for sign in "-+")
        source = sources[lines[0]]
        start = source.text.find(old)
        name = f"planted {lines[0]}: {old.strip()} -> {new.strip() or 'nothing'}".replace("\n", " ")
        tests = [line[2:].split() for line in lines if line.startswith(">")]
        mutants.append(Mutant(name, source, start, start + len(old), new, tests))
        if source.text.count(old) != 1:
            mutants[-1].result = "does not apply"
    return mutants


def write_copy(sources, mutants):
    """Writes the changed files. Returns the lines of each arm, and the function of each body."""
    groups = collections.defaultdict(list)
    for number, mutant in enumerate(mutants, 1):
        if mutant.result is None:
            for source, body, text in mutant.bodies(sources.values()):
                groups[source.name, body].append((number, text))
    functions = {body: index for index, body in enumerate(sorted(groups))}
    arms, written = collections.defaultdict(list), {}
    for name, source in sources.items():
        text, end = "", 0
        for (file, body), group in sorted(groups.items()):
            if file != name:
                continue
            head, boxed = IMPL.subn(of_a_box, source.text[end:body[0]])
            before, after = ("Box::new(", ")") if boxed else ("", "")
            text += head + "{ match crate::mutants::chosen(" + str(functions[file, body]) + ") {\n"
            for number, changed in group:
                first = text.count("\n") + 1
                text += f"{number} => {before}{changed}{after},\n"
                arms[name].append((first, text.count("\n"), number))
            text += "_ => " + before + source.text[slice(*body)] + after + "\n} }"
            end = body[1]
        written[name] = text + source.text[end:]
    head = "#![allow(warnings, unconditional_panic, arithmetic_overflow, unconditional_recursion)]\n"
    switch = SWITCH.replace("FUNCTIONS", str(len(functions) + 1))
    written.setdefault("src/lib.rs", (ROOT / "src/lib.rs").read_text())
    written["src/lib.rs"] = head + written["src/lib.rs"] + switch
    for name, text in written.items():
        if (COPY / name).read_text() != text:
            (COPY / name).write_text(text)
    return arms, functions


def copy_source():
    """Copies all that is built, without what was built."""
    shutil.rmtree(COPY, ignore_errors=True)
    names = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=ROOT, check=True,
                           capture_output=True, text=True).stdout.splitlines()
    for name in names:
        if (ROOT / name).is_file():
            (COPY / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, COPY / name)


def cargo(command):
    """What cargo tells, a dictionary each, and if all was built."""
    run = subprocess.run(["cargo", *command, "--locked", "--profile", "daily", "--message-format=json"], cwd=COPY,
                         env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return [json.loads(line) for line in run.stdout.splitlines() if line.startswith("{")], run.returncode == 0


def in_source(span):
    """Where a span stands: one of a macro, where that is called."""
    while span["expansion"]:
        span = span["expansion"]["span"]
    return span


def build(sources, mutants):
    """Builds what compiles. Returns the functions, and the program of each room of tests."""
    rooms = sorted({room for mutant in mutants for room, *_ in mutant.tests})
    programs = [f"--test={room}" if room != "lib" else "--lib" for room in rooms]
    while True:
        arms, functions = write_copy(sources, mutants)
        told, built = cargo(["test", "--no-run", *programs])
        if built:
            break
        errors = [message["message"] for message in told if message["reason"] == "compiler-message"
                  and message["message"]["level"].startswith("error")]
        spans = [in_source(span) for error in errors for span in error["spans"] if span["is_primary"]]
        wrong = {number for span in spans for first, last, number in arms[span["file_name"]]
                 if first <= span["line_start"] <= last}
        if not wrong:
            sys.exit("mutants: not built:\n" + "\n".join(error["rendered"] for error in errors[:5]))
        print(f"{len(wrong)} do not compile", flush=True)
        for number in wrong:
            mutants[number - 1].result = "not compiled"
    programs = {("lib" if "lib" in message["target"]["kind"] else message["target"]["name"]): message["executable"]
                for message in told if message["reason"] == "compiler-artifact" and message.get("executable")}
    return functions, programs


def run(test, seconds, **environment):
    """Runs a test: what came of it, and its processor time."""
    program, name = test

    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    process = subprocess.Popen([program, "--exact", name, "--test-threads=1"], cwd=COPY, preexec_fn=limit,
                               env=dict(ENVIRONMENT, **environment), stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    alarm = signal.signal(signal.SIGALRM, lambda *_: process.kill())
    signal.alarm(int(30 * seconds) + 30)
    _, status, used = os.wait4(process.pid, 0)
    signal.alarm(0)
    signal.signal(signal.SIGALRM, alarm)
    process.returncode = status
    stopped = os.WIFSIGNALED(status) and os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGKILL)
    return "timed out" if stopped else "killed" if status else "passed", used.ru_utime + used.ru_stime


def measure(programs, mutants):
    """The time of each test that some mutant tries, and the functions that it reaches."""
    times, reached = {}, {}
    record = WORK / "reached.txt"
    for room, program in programs.items():
        listed = subprocess.run([program, "--list"], cwd=COPY, capture_output=True, text=True, check=True)
        names = re.findall(r"^(.*): test$", listed.stdout, re.M)
        for name in (name for name in names if any(mutant.tries(room, name) for mutant in mutants)):
            record.write_text("")
            result, time = run((program, name), LONGEST, MUTANT="0", MUTANTS_REACHED=str(record))
            if result == "passed":
                times[program, name] = time
                reached[program, name] = {int(line) for line in record.read_text().split()}
            else:
                print(f"left out: {room} {name}: {result}, {time:.1f} s", flush=True)
    return times, reached


def judge(number, tests, times, quick):
    """What became of a mutant: the result, and the test that noticed."""
    left = AT_MOST
    for test in sorted(tests, key=lambda test: (test not in quick, times[test])):
        if left < times[test]:
            break
        result, time = run(test, 2 + 6 * times[test], MUTANT=str(number))
        left -= time
        if result != "passed":
            quick.insert(0, test)
            del quick[3:]
            return result, test[1]
    return ("survived" if tests else "not reached"), ""


def main():
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    planted = "--planted" in sys.argv
    sources, mutants = read_mutants(words or ([] if planted else ROOMS), planted)
    if "--again" in sys.argv:
        last = dict(line.split("\t")[1::-1] for line in RESULTS.read_text().splitlines())
        mutants = [mutant for mutant in mutants if last.get(mutant.name) in ("survived", "not reached")]
    copy_source()
    functions, programs = build(sources, mutants)
    times, reached = measure(programs, mutants)
    room_of = {program: room for room, program in programs.items()}
    print(f"{len(mutants)} mutants, {len(times)} tests, {sum(times.values()):.0f} s", flush=True)
    quick = collections.defaultdict(list)
    with RESULTS.open("w") as results:
        for number, mutant in enumerate(mutants, 1):
            test = ""
            if mutant.result is None:
                keys = [(source.name, body) for source, body, _ in mutant.bodies(sources.values())]
                places = {functions[key] for key in keys}
                tests = [(program, test) for (program, test), reached_places in reached.items()
                         if places & reached_places and mutant.tries(room_of[program], test)]
                mutant.result, test = judge(number, tests, times, quick[tuple(keys)]) if keys else ("not tried", "")
            print(mutant.result, mutant.name, test, sep="\t", file=results, flush=True)
    survived = print_table(mutants)
    return 1 if survived else 0


def print_table(mutants):
    """Prints the counts of each room, and returns how many survived."""
    counts = collections.defaultdict(collections.Counter)
    for mutant in mutants:
        counts[mutant.name.split(":")[0].rpartition("/")[0]][mutant.result] += 1
    for room, results in sorted(counts.items()):
        print(f"{room}: {sum(results.values())}: " + ", ".join(f"{count} {name}" for name, count in results.items()))
    left = ("survived", "not reached", "does not apply")
    return sum(results[name] for results in counts.values() for name in left)


if __name__ == "__main__":
    sys.exit(main())
