"""The GoogleTest programs of the mutated tree: their tests, how long each takes, and the places that each reaches."""
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import threading
import time

from tree import say

LARGEST_FILE = 1 << 30  # bytes that a mutant may write into one file


@dataclasses.dataclass
class Run:
    code: int
    seconds: float  # processor time, with child processes
    wall: float
    output: str


def run(command, environment, cpu_seconds, wall_seconds, folder):
    """Runs a program in a process group of its own and ends the group after `cpu_seconds` or `wall_seconds`."""
    def limits():
        os.setsid()
        resource.setrlimit(resource.RLIMIT_CPU, (int(cpu_seconds) + 1, int(cpu_seconds) + 2))
        resource.setrlimit(resource.RLIMIT_FSIZE, (LARGEST_FILE, resource.getrlimit(resource.RLIMIT_FSIZE)[1]))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with tempfile.TemporaryDirectory(dir=folder) as temporary, tempfile.TemporaryFile(dir=folder) as output:
        os.chmod(temporary, 0o755)  # some tests read their folder as an ordinary user
        begin = time.monotonic()
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                   cwd=temporary, env={**os.environ, **environment, 'TMPDIR': temporary}, preexec_fn=limits)

        def end_group():
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

        timer = threading.Timer(wall_seconds, end_group)
        timer.start()
        _, status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        end_group()
        process.returncode = os.waitstatus_to_exitcode(status)
        wall = time.monotonic() - begin
        output.seek(0)
        text = output.read(200000).decode('latin-1')
    return Run(process.returncode, usage.ru_utime + usage.ru_stime, wall, text)


@dataclasses.dataclass
class Test:
    program: str
    name: str
    seconds: float = 0.0  # without the start of its program
    wall: float = 0.0
    reached: frozenset = frozenset()

    @property
    def label(self):
        return f'{self.program} {self.name}'


def list_tests(program):
    text = subprocess.run([str(program), '--gtest_list_tests'], check=True, capture_output=True, text=True).stdout
    names, suite = [], ''
    for line in text.splitlines():
        if not line.startswith(' '):
            suite = line.split()[0] if line.strip().endswith('.') or '.  #' in line else suite
        elif 'DISABLED_' not in line and 'DISABLED_' not in suite:
            names.append(suite + line.split()[0])
    return names


class Suite:
    """The tests of the mutated tree that pass without a mutant."""

    def __init__(self, tree, programs):
        self.tree, self.names = tree, programs
        self.folder = tree.work / 'running'
        self.folder.mkdir(exist_ok=True)
        self.tests = []
        self.start = {}  # seconds of processor time until a program runs its first test
        self.by_place = {}
        self.skipped = []

    def path(self, program):
        return self.tree.build / 'tests' / program

    def digest(self, program):
        digest = hashlib.sha256(self.path(program).read_bytes())
        for beside in sorted((self.tree.build / 'bin').glob('godobject-*')) if 'command' in program else ():
            digest.update(beside.read_bytes())
        return digest.hexdigest()

    def record(self):
        """Runs each test once; programs that have not changed are not run again."""
        folder = self.tree.work / 'reached'
        folder.mkdir(exist_ok=True)
        todo, known = [], {}
        self.digests = {program: self.digest(program) for program in self.names}
        for program in self.names:
            file = folder / (program + '.json')
            stored = json.loads(file.read_text()) if file.exists() else {}
            is_known = stored.get('digest') == self.digests[program] and 'start' in stored
            known[program] = stored['tests'] if is_known else {}
            self.start[program] = stored['start'] if is_known else self.seconds_to_start(program)
            todo += [(program, name) for name in list_tests(self.path(program)) if name not in known[program]]
        left = {program: sum(1 for p, _ in todo if p == program) for program in self.names}
        with concurrent.futures.ThreadPoolExecutor(self.tree.jobs) as pool:
            for done, (program, name, entry) in enumerate(pool.map(lambda job: self.record_one(*job), todo), 1):
                known[program][name] = entry
                left[program] -= 1
                if left[program] == 0:
                    text = json.dumps({'digest': self.digests[program], 'start': self.start[program], 'tests': known[program]})
                    partial = folder / (program + '.partial')
                    partial.write_text(text)
                    partial.replace(folder / (program + '.json'))
                if done % 50 == 0 or done == len(todo):
                    say(f'{done}/{len(todo)} tests run without a mutant')
        for program in self.names:
            for name, entry in known[program].items():
                if entry['code'] != 0:
                    self.skipped.append(f'{program} {name}')
                    continue
                seconds = max(0.0, entry['seconds'] - self.start[program])
                self.tests.append(Test(program, name, seconds, entry['wall'], frozenset(entry['reached'])))
        for test in self.tests:
            for place in test.reached:
                self.by_place.setdefault(place, []).append(test)
        for tests in self.by_place.values():
            tests.sort(key=lambda test: max(test.seconds, test.wall))

    def seconds_to_start(self, program):
        command = [str(self.path(program)), '--gtest_filter=-*']
        return min(run(command, {}, 60, 60, self.folder).seconds for _ in range(3))

    def record_one(self, program, name):
        with tempfile.NamedTemporaryFile(dir=self.folder) as map_:
            map_.truncate(self.tree.size)
            result = run([str(self.path(program)), f'--gtest_filter={name}'], {'GODOBJECT_MUTANT_REACHED': map_.name},
                         600, 600, self.folder)
            reached = [at for at, byte in enumerate(pathlib.Path(map_.name).read_bytes()) if byte]
        code = result.code if '[  SKIPPED ]' not in result.output else 77
        return program, name, {'code': code, 'seconds': result.seconds, 'wall': result.wall, 'reached': reached}

    def digest_of_all(self):
        return hashlib.sha256(json.dumps(sorted(self.digests.items())).encode()).hexdigest()[:16]


FAILED = re.compile(r'\[  FAILED  \] (\S+)')
TIERS = (0.02, 0.2, 2.0, 20.0, float('inf'))  # seconds: tests up to these run together


def batches(tests):
    """Groups tests, shortest first: (program, tests) of about equal duration."""
    begin = 0.0
    for end in TIERS:
        programs = {}
        for test in tests:
            if begin <= max(test.seconds, test.wall) < end:
                programs.setdefault(test.program, []).append(test)
        yield from sorted(programs.items(), key=lambda item: sum(test.seconds for test in item[1]))
        begin = end


def kills(suite, mutant, program, tests):
    """Runs the tests against the mutant; returns the name of the one that fails and how, or None."""
    seconds = 10 * (suite.start[program] + sum(test.seconds for test in tests)) + 2
    wall = 20 * sum(test.wall for test in tests) + 30 + seconds
    command = [str(suite.path(program)), '--gtest_fail_fast', '--gtest_brief=1',
               '--gtest_filter=' + ':'.join(test.name for test in tests)]
    result = run(command, {'GODOBJECT_MUTANT': f'{mutant.number}:{mutant.alternative}'}, seconds, wall, suite.folder)
    if result.code == 0:
        return None
    failed = FAILED.search(result.output)
    if failed:
        return failed.group(1).rstrip(','), 'fails'
    if result.seconds >= seconds or result.wall >= wall:
        return tests[0].name, 'takes too long'
    return tests[0].name, f'ends with {result.code}'
