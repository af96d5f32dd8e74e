"""Runs mutants against the tests that reach them, and stores the results so that a stopped run continues."""
import collections
import concurrent.futures
import itertools
import json
import threading
import time

import tests as suites
from tree import say


class Results:
    """One line of JSON a mutant. A killed mutant stays killed while the program that killed it is unchanged. One that
    survived is run again with other programs, or with tests of more `seconds`. An old result tells which test to try
    first."""

    def __init__(self, path, suite, seconds):
        self.path, self.suite, self.digest = path, suite, suite.digest_of_all()
        self.lock = threading.Lock()
        self.valid, self.earlier = {}, {}
        for line in path.read_text().splitlines() if path.exists() else ():
            try:
                entry = json.loads(line)
            except ValueError:
                continue  # the run was stopped while it wrote this line
            self.earlier[entry['id']] = entry
            if self.is_valid(entry, seconds):
                self.valid[entry['id']] = entry

    def is_valid(self, entry, seconds):
        if entry['state'] == 'killed':
            return entry['digest'] == self.suite.digests.get(entry['by'].split()[0])
        return entry['digest'] == self.digest and entry.get('seconds', float('inf')) >= seconds

    def store(self, entry):
        entry['digest'] = self.suite.digests[entry['by'].split()[0]] if entry['state'] == 'killed' else self.digest
        with self.lock, self.path.open('a') as file:
            file.write(json.dumps(entry) + '\n')
            self.valid[entry['id']] = entry


class Runner:
    def __init__(self, suite, results, seconds):
        self.suite, self.results, self.seconds = suite, results, seconds
        self.killers = collections.defaultdict(collections.Counter)
        self.by_label = {test.label: test for test in suite.tests}
        for entry in results.earlier.values():
            if entry.get('by') in self.by_label:
                self.killers[entry['path']][entry['by']] += 1

    def first(self, mutant, reaching):
        """Returns the test that killed the mutant earlier, and the best killers of its file."""
        labels = {test.label: test for test in reaching}
        earlier = self.results.earlier.get(mutant.id, {}).get('by')
        names = [earlier] + [label for label, _ in self.killers[mutant.path].most_common(40)]
        chosen = []
        for name in names:
            if name in labels and labels[name] not in chosen and (name == earlier or labels[name].seconds < 0.3):
                chosen.append(labels[name])
        return chosen[:3]

    def try_mutant(self, mutant):
        if mutant.id in self.results.valid:
            return self.results.valid[mutant.id]
        reaching = self.suite.by_place.get(mutant.number, [])
        entry = {'id': mutant.id, 'path': mutant.path, 'state': 'survived' if reaching else 'not reached', 'tests': len(reaching)}
        if self.seconds < float('inf'):
            entry['seconds'] = self.seconds
        first = self.first(mutant, reaching)
        others = [test for test in reaching if test not in first]
        left = self.seconds
        for program, tests in [(test.program, [test]) for test in first] + list(suites.batches(others)):
            left -= self.suite.start[program]
            tests = [test for test, sum_ in zip(tests, itertools.accumulate(t.seconds for t in tests)) if sum_ <= left]
            if not tests:
                left += self.suite.start[program]
                continue
            left -= sum(test.seconds for test in tests)
            killed = suites.kills(self.suite, mutant, program, tests)
            if killed:
                label = f'{program} {killed[0]}'
                entry.update(state='killed', by=label, how=killed[1])
                if label in self.by_label:
                    self.killers[mutant.path][label] += 1
                break
        self.results.store(entry)
        return entry

    def run(self, mutants):
        begin, told = time.monotonic(), 0.0
        survived = 0
        with concurrent.futures.ThreadPoolExecutor(self.suite.tree.jobs) as pool:
            for done, entry in enumerate(pool.map(self.try_mutant, mutants), 1):
                survived += entry['state'] != 'killed'
                if time.monotonic() - told > 20 or done == len(mutants):
                    told = time.monotonic()
                    say(f'{done}/{len(mutants)} mutants run in {told - begin:.0f} s, {survived} survive')
