"""Runs mutants against the tests that reach them, and stores the results so that a stopped run continues."""
import collections
import concurrent.futures
import json
import threading
import time

import tests as suites
from tree import say


class Results:
    """One line of JSON a mutant. A result counts only for the test programs that it was measured with; with other
    programs it tells which test to try first."""

    def __init__(self, path, digest):
        self.path, self.digest = path, digest
        self.lock = threading.Lock()
        self.valid, self.earlier = {}, {}
        for line in path.read_text().splitlines() if path.exists() else ():
            try:
                entry = json.loads(line)
            except ValueError:
                continue  # the run was stopped while it wrote this line
            self.earlier[entry['id']] = entry
            if entry['digest'] == digest:
                self.valid[entry['id']] = entry

    def store(self, entry):
        entry['digest'] = self.digest
        with self.lock, self.path.open('a') as file:
            file.write(json.dumps(entry) + '\n')
            self.valid[entry['id']] = entry


class Runner:
    def __init__(self, suite, results):
        self.suite, self.results = suite, results
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
        first = self.first(mutant, reaching)
        others = [test for test in reaching if test not in first]
        for program, tests in [(test.program, [test]) for test in first] + list(suites.batches(others)):
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
