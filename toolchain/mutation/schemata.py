"""Writes a C++ file so that each of its mutants can be chosen at run time."""
import hashlib
import re


def identify(path, places):
    """Returns [(id, place number, alternative number, place, alternative)] in the order of the file.

    An id survives changes elsewhere: it hashes the function, the operator, the texts and the number among equal ones."""
    seen, mutants = {}, []
    for number, place in enumerate(places):
        for at, alternative in enumerate(place.alternatives, 1):
            operator, before, after, _ = alternative
            words = '\0'.join((path, place.function, operator, ' '.join(before.split()), ' '.join(after.split())))
            seen[words] = seen.get(words, 0) + 1
            digest = hashlib.sha256(f'{words}\0{seen[words]}'.encode('latin-1', 'replace')).hexdigest()[:10]
            mutants.append((digest, number, at, place, alternative))
    return mutants


class Writer:
    """Renders one file. `owner` gives for each line of the result the mutant that stands on it."""

    def __init__(self, text, places, base, dropped):
        self.text = text
        self.places = places  # sorted by start, then by falling end
        self.base = base
        self.dropped = dropped  # {(place number, alternative number)} that do not compile
        self.parts = []
        self.line = 1
        self.owner = {}  # line -> (place number, alternative number); alternative 0: the original

    def write(self, text, owner=None):
        for at in range(self.line, self.line + text.count('\n') + 1):
            if owner is not None:
                self.owner.setdefault(at, owner)
        self.parts.append(text)
        self.line += text.count('\n')

    def render(self, header):
        self.write(f'#include "{header}"\n')
        at = self.span(0, len(self.text), 0)
        assert at == len(self.places)
        return ''.join(self.parts)

    def span(self, begin, end, at, owner=None):
        """Writes the text from begin to end, with the places from number `at` on; returns the next place's number."""
        while at < len(self.places) and self.places[at].start < end:
            place = self.places[at]
            if place.end > end:
                raise ValueError(f'places overlap at {place.start}: {self.text[place.start:place.end][:80]}')
            self.write(self.text[begin:place.start], owner)
            begin = place.end
            at = self.choice(at)
        self.write(self.text[begin:end], owner)
        return at

    def choice(self, at):
        place, choose = self.places[at], f'::mutant::at({self.base + at})'
        kept = [(number, alternative[3]) for number, alternative in enumerate(place.alternatives, 1)
                if (at, number) not in self.dropped]
        if not kept:
            return self.span(place.start, place.end, at + 1)
        if place.form == 'insert':
            self.write(f'if ({choose}) {kept[0][1]}', (at, 1))
            return self.span(place.start, place.end, at + 1)
        if place.form == 'statement':
            return self.statement(place, at, choose, kept)
        if place.form == 'lambda':
            return self.call(place, at, choose, kept)
        self.write(f'(!{choose} ? ')
        following = self.span(place.start, place.end, at + 1, (at, 0))
        for number, text in kept[:-1]:
            self.write(f'\n: {choose} == {number} ? {text}\n', (at, number))
        self.write(f'\n: {kept[-1][1]}\n', (at, kept[-1][0]))
        self.write(')')
        return following

    def statement(self, place, at, choose, kept):
        self.write(f'if (!{choose}) {{ ')
        following = self.span(place.start, place.end, at + 1, (at, 0))
        for number, text in kept:
            self.write(f'\n}} else if ({choose} == {number}) {{ {text}\n', (at, number))
        self.write('} else {}')
        return following

    def call(self, place, at, choose, kept):
        """Alternatives of class type; one that does not compile becomes the original."""
        self.write(f'::mutant::pick({choose}, [&] {{ return ::mutant::value(', (at, 0))
        following = self.span(place.start, place.end, at + 1, (at, 0))
        self.write('); }')
        texts = dict(kept)
        for number in range(1, max(texts) + 1):
            if number in texts:
                self.write(f'\n, [&] {{ return ::mutant::value({texts[number]}); }}\n', (at, number))
            else:
                self.write(f'\n, [&] {{ return ::mutant::value({self.text[place.start:place.end]}); }}\n')
        self.write(')')
        return following


def overlapping(places):
    """Returns the places without those that only partly overlap an earlier one."""
    kept, open_ends = [], []
    for place in places:
        while open_ends and open_ends[-1] <= place.start and not (place.start == place.end == open_ends[-1]):
            open_ends.pop()
        if open_ends and place.end > open_ends[-1]:
            continue
        kept.append(place)
        open_ends.append(place.end)
    return kept


def ordered(places):
    """Returns the places so that an outer one comes before those inside it."""
    return overlapping(sorted(places, key=lambda p: (p.start, p.form != 'insert', -p.end, p.form != 'statement')))


ERROR = re.compile(r'^(?P<path>/[^:\n]+):(?P<line>\d+):(?:\d+:)?\s+(?P<what>.*)$')


def culprits(log, owners):
    """Returns {(path, place, alternative)} that the compiler's messages blame; owners: {path: {line: owner}}."""
    found, context, unresolved = set(), [], []
    for text in log.splitlines():
        match = ERROR.match(text)
        if not match:
            continue
        path, line = match['path'], int(match['line'])
        owner = owners.get(path, {}).get(line)
        if 'error:' not in match['what']:
            if 'required from' in match['what'] or 'In instantiation' in match['what'] or 'in ' == match['what'][:3]:
                context.append((path, owner))
            continue
        candidates = [(path, owner)] + context[::-1]
        named = [c for c in candidates if c[1] is not None]
        best = next((c for c in named if c[1][1] > 0), named[0] if named else None)
        if best is None:
            unresolved.append(text)
        else:
            found.add((best[0], *best[1]))
        context = []
    return found, unresolved
