"""The list of mutants that no test can kill, each with an argument."""
import re

LINE = re.compile(r'^([0-9a-f]{10})\s+(\S.*)$')


def read(path):
    """Returns {id: argument}. A line is an id and a sentence; '#' begins a comment line."""
    found = {}
    for number, line in enumerate(path.read_text(encoding='utf-8').splitlines() if path.exists() else (), 1):
        if not line.strip() or line.startswith('#'):
            continue
        match = LINE.match(line)
        if not match:
            raise SystemExit(f'mutation: {path}:{number}: expected an id of ten digits and an argument: {line}')
        if match[1] in found:
            raise SystemExit(f'mutation: {path}:{number}: {match[1]} is listed twice')
        found[match[1]] = match[2]
    return found


def complaints(path, listed, mutants, results):
    """Returns a message for each entry that no mutant has any more, and for each that a test kills."""
    ids = {mutant.id for mutant in mutants}
    gone = [f'{path}: {id_} is no mutant any more; remove the line' for id_ in listed if id_ not in ids]
    killed = [f'{path}: a test kills {id_}; remove the line' for id_ in listed
              if results.get(id_, {}).get('state') == 'killed']
    return gone + killed
