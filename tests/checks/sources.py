"""The C++ sources of the tree and the list of exceptions, for the checks of this folder."""
import pathlib
import re

ROOMS = ('core', 'hal', 'sim', 'firmware', 'toolchain', 'tests')
INCLUDE = re.compile(r'^[^\S\n]*#[^\S\n]*include.*$', re.MULTILINE)


def sources_below(root, rooms=ROOMS):
    """Yields (path from root, path) of each source and header in the rooms."""
    for path in sorted(p for room in rooms for p in (root / room).rglob('*') if p.suffix in ('.cc', '.h')):
        yield path.relative_to(root).as_posix(), path


def includes_of(path):
    """Yields (line number, line) of each #include of a source."""
    text = path.read_text()
    number, counted = 1, 0
    for found in INCLUDE.finditer(text):
        number += text.count('\n', counted, found.start())
        counted = found.start()
        yield number, found.group()


def exceptions_of(name, check):
    """The places that a list of exceptions excepts from a check, with a reason, and the number of each one's line."""
    rows = (line.split('#')[0].split(None, 2) for line in pathlib.Path(name).read_text().splitlines())
    return {row[1]: number for number, row in enumerate(rows, 1) if len(row) == 3 and row[0] == check}
