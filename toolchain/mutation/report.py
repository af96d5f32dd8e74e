"""The mutation score and the survivors, as text, CSV and Markdown."""
import csv
import io
import math
import os


def wilson(killed, count):
    """Returns the 95 % confidence interval of a share that a sample of `count` mutants estimates."""
    if count == 0:
        return 0.0, 1.0
    z, share = 1.96, killed / count
    centre = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return max(0.0, centre - half), min(1.0, centre + half)


def score_line(name, entries, equivalent, total):
    """One line: the score of the mutants (Mutant, result) of a room; `total`: how many mutants the room has."""
    argued = [e for m, e in entries if m.id in equivalent and e['state'] != 'killed']
    counted = len(entries) - len(argued)
    killed = sum(1 for _, e in entries if e['state'] == 'killed')
    unreached = sum(1 for m, e in entries if e['state'] == 'not reached' and m.id not in equivalent)
    if counted == 0:
        return f'{name:<10} no mutant was run'
    text = f'{name:<10} {100 * killed / counted:5.1f} %  {killed} of {counted} killed'
    if len(entries) < total:
        low, high = wilson(killed, counted)
        text += f' (95 % interval {100 * low:.1f} to {100 * high:.1f} %, sample of {total} mutants)'
    return text + f'; {len(argued)} equivalent, {unreached} reached by no test'


def shortened(text, length=110):
    return text if len(text) <= length else text[:length - 3] + '...'


def survivor_line(mutant, entry):
    reach = 'no test reaches it' if entry['state'] == 'not reached' else f'{entry["tests"]} tests reach it'
    return (f'{mutant.path}:{mutant.line} [{mutant.id}] {mutant.operator}: {shortened(mutant.before)} -> '
            f'{shortened(mutant.after) or "(nothing)"} ({mutant.function}; {reach})')


def write(path, text):
    partial = path.with_name(path.name + '.partial')
    partial.write_text(text, encoding='utf-8')
    os.replace(partial, path)


def report(pairs, totals, equivalent, rooms, folder):
    """Prints the score and the survivors; writes both to `folder`."""
    lines = []
    for room in rooms:
        lines.append(score_line(room, [p for p in pairs if p[0].room == room], equivalent, totals[room]))
    if len(rooms) > 1:
        lines.append(score_line('together', pairs, equivalent, sum(totals[room] for room in rooms)))
    survivors = sorted(((m, e) for m, e in pairs if e['state'] != 'killed' and m.id not in equivalent),
                       key=lambda pair: (pair[0].path, pair[0].line))
    listed = [survivor_line(m, e) for m, e in survivors]
    print('\n'.join(listed + lines))
    table = io.StringIO()
    rows = csv.writer(table)
    rows.writerow(('id', 'file', 'line', 'function', 'operator', 'before', 'after', 'state', 'killed by', 'how'))
    for m, e in sorted(pairs, key=lambda pair: (pair[0].path, pair[0].line)):
        state = 'equivalent' if m.id in equivalent and e['state'] != 'killed' else e['state']
        rows.writerow((m.id, m.path, m.line, m.function, m.operator, m.before, m.after, state, e.get('by', ''), e.get('how', '')))
    write(folder / 'mutants.csv', table.getvalue())
    page = ['# Mutation score', '', *[f'- {line}' for line in lines], '', '## Survivors', '', *[f'- `{line}`' for line in listed]]
    write(folder / 'mutants.md', '\n'.join(page) + '\n')
    return survivors
