"""The mutated copy of the tree: its files, its build and the mutants that it holds."""
import concurrent.futures
import dataclasses
import hashlib
import json
import multiprocessing
import os
import pathlib
import pickle
import re
import shutil
import subprocess
import sys

import places
import schemata

HERE = pathlib.Path(__file__).resolve().parent
BLOCK = 4096  # numbers of places that a file may use
ROUNDS = 30  # until all mutants that do not compile are dropped; an error often hides others


@dataclasses.dataclass
class Mutant:
    id: str
    path: str
    line: int
    function: str
    operator: str
    before: str
    after: str
    number: int  # of the place in the whole tree
    alternative: int

    @property
    def room(self):
        return self.path.split('/')[0]


def say(text):
    print(f'mutation: {text}', file=sys.stderr, flush=True)


def write_if_changed(path, data):
    """Writes a file unless it has this content already, so that the build does not compile it again."""
    if path.exists() and path.read_bytes() == data:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(path.name + '.partial')
    partial.write_bytes(data)
    partial.replace(path)


def places_of(arguments):
    """Parses one unit; headers that a unit with the same processor options has shown are not walked again."""
    entry, root, rooms, seen = arguments
    prefixes = tuple(f'{root}/{room}/' for room in rooms)
    options = ' '.join(word for word in entry['command'].split() if word.startswith('-m'))
    known = set(seen.get(options, ()))
    found, errors = places.places_of_unit(
        entry, lambda path: os.path.normpath(path).startswith(prefixes) and path not in known)
    if not errors:
        seen[options] = tuple(known | set(found))
    return found, errors


class Tree:
    """A mutated copy of `root` in `work`/tree, built in `work`/build."""

    def __init__(self, root, work, rooms, jobs):
        self.root, self.work, self.rooms, self.jobs = root, work, rooms, jobs
        self.copy, self.build = work / 'tree', work / 'build'
        self.alone = work / 'alone'  # a build that is never run: it tells how to compile each file alone
        self.object = work / 'schemata.o'
        self.found = {}
        self.dropped = {}  # path -> {(place, alternative)}
        self.owners = {}
        self.unread = None  # units that the compiler has not yet read without an error

    def files(self):
        if not (self.root / '.git').exists():
            return [str(path.relative_to(self.root)) for path in self.root.rglob('*') if path.is_file()]
        listed = subprocess.run(['git', '-C', str(self.root), 'ls-files', '-co', '--exclude-standard', '-z'],
                                check=True, capture_output=True).stdout.decode().split('\0')
        return [name for name in listed if name and (self.root / name).is_file()]

    def is_mutated(self, name):
        return name.startswith(tuple(room + '/' for room in self.rooms)) and name.endswith(('.h', '.cc'))

    def prepare(self):
        names = self.files()
        for name in names:
            source, target = self.root / name, self.copy / name
            if self.is_mutated(name) and target.exists():
                continue
            write_if_changed(target, source.read_bytes())
            shutil.copymode(source, target)
        listed = set(names)
        for path in [p for p in self.copy.rglob('*') if p.is_file()]:
            if str(path.relative_to(self.copy)) not in listed:
                path.unlink()
        self.sources = sorted(name for name in names if self.is_mutated(name))
        self.base = {name: at * BLOCK for at, name in enumerate(self.sources)}
        self.size = len(self.sources) * BLOCK
        flags = ['g++', '-O1', '-std=c++20', f'-DMUTANT_PLACES={self.size}', f'-I{HERE.parent.parent}', '-c', str(HERE / 'schemata.cc'), '-o', str(self.object)]
        mark = self.work / 'schemata.key'
        key = ' '.join(flags) + (HERE / 'schemata.cc').read_text() + (HERE / 'schemata.h').read_text()
        if not self.object.exists() or not mark.exists() or mark.read_text() != key:
            subprocess.run(flags, check=True)
            mark.write_text(key)
            write_if_changed(self.work / 'schemata.h', (HERE / 'schemata.h').read_bytes())
        self.configure(self.alone, '-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON')
        self.configure(self.build, '-DCMAKE_UNITY_BUILD=ON', '-DCMAKE_UNITY_BUILD_BATCH_SIZE=10')

    def configure(self, build, *options):
        subprocess.run(['cmake', '-S', str(self.copy), '-B', str(build), '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release',
                        '-DCMAKE_CXX_FLAGS=-w -DEIGEN_INITIALIZE_MATRICES_BY_NAN -fdiagnostics-color=never -fno-diagnostics-show-caret -ftemplate-backtrace-limit=0',
                        # the assertions of Eigen and of the standard library and bounds of arrays find most accesses out of range
                        '-DCMAKE_CXX_FLAGS_RELEASE=-O1 -D_GLIBCXX_ASSERTIONS -fsanitize=bounds-strict '
                        '-fsanitize-undefined-trap-on-error', f'-DCMAKE_EXE_LINKER_FLAGS={self.object}', *options],
                       check=True, stdout=subprocess.DEVNULL)

    def units(self):
        """Returns how to compile each mutated file alone."""
        listed = json.loads((self.alone / 'compile_commands.json').read_text())
        wanted = {str(self.copy / name) for name in self.sources}
        return [entry for entry in listed if entry['file'] in wanted]

    def find(self):
        """Finds the places of all files; units whose files have not changed are not parsed again."""
        entries = [{**e, 'command': e['command'].replace(str(self.copy), str(self.root)),
                    'file': e['file'].replace(str(self.copy), str(self.root))} for e in self.units()]
        digest = hashlib.sha256((HERE / 'places.py').read_bytes())
        for name in self.sources:
            digest.update((self.root / name).read_bytes())
        cache = self.work / 'places.pickle'
        if cache.exists():
            key, found = pickle.loads(cache.read_bytes())
            if key == digest.hexdigest():
                self.found = found
                return
        with multiprocessing.Manager() as manager, concurrent.futures.ProcessPoolExecutor(self.jobs) as pool:
            seen = manager.dict()
            jobs = [(entry, str(self.root), self.rooms, seen) for entry in entries]
            for done, (found, errors) in enumerate(pool.map(places_of, jobs), 1):
                say(f'{done}/{len(jobs)} files parsed')
                if errors:
                    say(f'{entries[done - 1]["file"]}: {errors[0]}')
                for path, list_ in found.items():
                    name = os.path.relpath(os.path.normpath(path), self.root)
                    merged = self.found.setdefault(name, {})
                    for place in list_:
                        merged.setdefault((place.start, place.end), place)
        self.found = {name: schemata.ordered(merged.values()) for name, merged in self.found.items()}
        cache.write_bytes(pickle.dumps((digest.hexdigest(), self.found)))

    def write(self):
        """Writes the mutated files."""
        for name in self.sources:
            text = (self.root / name).read_bytes().decode('latin-1')
            places_ = self.found.get(name, [])
            if len(places_) > BLOCK:
                raise SystemExit(f'mutation: {name} has {len(places_)} places, more than {BLOCK}; split the file')
            if not places_:
                write_if_changed(self.copy / name, text.encode('latin-1'))
                continue
            writer = schemata.Writer(text, places_, self.base[name], self.dropped.get(name, set()))
            rendered = writer.render(self.work / 'schemata.h')
            self.owners[str(self.copy / name)] = writer.owner
            write_if_changed(self.copy / name, rendered.encode('latin-1'))

    def compile(self, programs):
        """Builds the test programs; drops mutants that do not compile and builds again. The compiler first reads each
        mutated file alone and makes no code: most mutants that do not compile are found so, in a tenth of the time."""
        kept = self.work / 'dropped.pickle'
        key = hashlib.sha256(pickle.dumps(sorted(self.found.items(), key=lambda x: x[0]))).hexdigest()
        if kept.exists():
            old, dropped = pickle.loads(kept.read_bytes())
            if old == key:
                self.dropped = dropped
        for what, run in (('reading the files', self.read), ('building', lambda log: self.make(programs, log))):
            for number in range(1, ROUNDS + 1):
                self.write()
                say(f'{what}, round {number}')
                log = self.work / 'build.log'
                if run(log):
                    break
                self.drop(log)
                kept.write_bytes(pickle.dumps((key, self.dropped)))
                say(f'{sum(map(len, self.dropped.values()))} mutants dropped that do not compile')
            else:
                raise SystemExit(f'mutation: does not compile after {ROUNDS} rounds; see {log}')

    def read(self, log):
        """Lets the compiler read each mutated file until it has read it without an error. A mutant that is dropped later
        cannot cause one. Does nothing if the files are those that were read last."""
        def one(entry):
            command = re.sub(r' -o \S+ -c ', ' -fsyntax-only ', entry['command'])
            return subprocess.run(command, shell=True, cwd=entry['directory'], capture_output=True, text=True, errors='replace')

        mark = self.work / 'read.key'
        key = hashlib.sha256(b''.join((self.copy / name).read_bytes() for name in self.sources)).hexdigest()
        if self.unread is None:
            self.unread = [] if mark.exists() and mark.read_text() == key else self.units()
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            results = list(pool.map(one, self.unread))
        log.write_text(''.join(result.stderr for result in results))
        self.unread = [entry for entry, result in zip(self.unread, results) if result.returncode]
        if not self.unread:
            mark.write_text(key)
        return not self.unread

    def make(self, programs, log):
        with log.open('w') as output:
            return subprocess.run(['cmake', '--build', str(self.build), '--parallel', str(self.jobs), '--target', *programs,
                                   '--', '-k', '0'], stdout=output, stderr=subprocess.STDOUT).returncode == 0

    def drop(self, log):
        """Drops the mutants that are to blame for the errors in the log."""
        found, unresolved = schemata.culprits(log.read_text(errors='replace'), self.owners)
        if not found:
            raise SystemExit(f'mutation: the mutated tree does not compile: {(unresolved or ["see " + str(log)])[0]}')
        for path, place, alternative in found:
            name = os.path.relpath(path, self.copy)
            known = self.dropped.setdefault(name, set())
            if alternative > 0:
                known.add((place, alternative))
            else:
                known.update((place, at) for at in range(1, len(self.found[name][place].alternatives) + 1))

    def programs(self, pattern):
        """Returns the test programs whose names match the whole pattern."""
        listed = subprocess.run(['ninja', '-C', str(self.build), '-t', 'targets', 'all'], check=True,
                                capture_output=True, text=True).stdout
        return sorted(name for name in re.findall(r'(?m)^(\w+): ', listed) if re.fullmatch(pattern, name))

    def mutants(self):
        found = []
        for name in self.sources:
            text = (self.root / name).read_bytes().decode('latin-1')
            for id_, number, at, place, (operator, before, after, _) in schemata.identify(name, self.found.get(name, [])):
                if (number, at) in self.dropped.get(name, set()):
                    continue
                found.append(Mutant(id_, name, text.count('\n', 0, place.start) + 1, place.function, operator,
                                    ' '.join(before.split()), ' '.join(after.split()), self.base[name] + number, at))
        return found

