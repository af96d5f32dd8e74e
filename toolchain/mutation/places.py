"""Finds the places of a C++ file that mutants change: a walk over the compiler's syntax tree (libclang)."""
import dataclasses
import pathlib
import re
import shlex
import sys

try:
    import clang.cindex as cindex
except ImportError:  # an interpreter that is not Debian's does not look there
    sys.path.append('/usr/lib/python3/dist-packages')
    try:
        import clang.cindex as cindex
    except ImportError:
        cindex = None

KIND = cindex.CursorKind if cindex else None
MISSING = 'no libclang for Python; install the Debian package python3-clang-14'


@dataclasses.dataclass
class Place:
    """Text from `start` to `end` of a file, with the texts that may replace it."""
    start: int
    end: int
    form: str  # 'ternary', 'lambda', 'statement' or 'insert'
    function: str
    alternatives: list = dataclasses.field(default_factory=list)  # (operator, before, after, text)

    def add(self, operator, before, after, text=None):
        text = after if text is None else text
        if all(text != other[3] for other in self.alternatives):
            self.alternatives.append((operator, before, after, text))


RELATIONS = {'<': ('<=', '>='), '<=': ('<', '>'), '>': ('>=', '<='), '>=': ('>', '<'), '==': (None, '!='), '!=': (None, '==')}
ARITHMETIC = {'+': '-', '-': '+', '*': '/', '/': '*', '%': '/', '&': '|', '|': '&', '^': '|', '<<': '>>', '>>': '<<'}
LOGICAL = {'&&': '||', '||': '&&'}
COMPOUND = {'+=': '-=', '-=': '+=', '*=': '/=', '/=': '*=', '|=': '&=', '&=': '|=', '<<=': '>>=', '>>=': '<<='}
INFIX = {*RELATIONS, *ARITHMETIC, *LOGICAL, *COMPOUND, '=', ','}
EXCHANGED = {'min': 'max', 'max': 'min', 'sin': 'cos', 'cos': 'sin', 'floor': 'ceil', 'ceil': 'floor',
             'minCoeff': 'maxCoeff', 'maxCoeff': 'minCoeff', 'cwiseMin': 'cwiseMax', 'cwiseMax': 'cwiseMin'}
DROPPED_FUNCTIONS = {'abs', 'fabs', 'clamp', 'sqrt'}
DROPPED_METHODS = {'inverse', 'conjugate', 'transpose', 'normalized', 'cwiseAbs', 'inverse_direction'}
COMMUTATIVE = {'min', 'max', 'hypot', 'swap', 'dot', 'fma', 'exchange', 'clamp'}
LOGGED = ('basic_string', 'basic_ostream', 'format', 'path')


def is_number(type_):
    kind = type_.get_canonical().kind
    return kind.value in range(3, 24) or kind in (cindex.TypeKind.ENUM, cindex.TypeKind.HALF)


def is_real(type_):
    return type_.get_canonical().kind in (cindex.TypeKind.FLOAT, cindex.TypeKind.DOUBLE, cindex.TypeKind.LONGDOUBLE)


def is_bool(type_):
    return type_.get_canonical().kind == cindex.TypeKind.BOOL


def fits_ternary(type_):
    return is_number(type_) or type_.get_canonical().kind in (cindex.TypeKind.VECTOR, cindex.TypeKind.POINTER)


class Walk:
    """Collects the places of one file in one translation unit."""

    def __init__(self, text):
        self.text = text
        self.macros = []  # [(start, end)] of macro uses in the file
        self.guards = set()  # ranges of conditions that are forced: their negation is no mutant of its own
        self.places = {}
        self.function = ''
        self.returns = None

    # texts and ranges
    def range(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def slice(self, cursor):
        start, end = self.range(cursor)
        return self.text[start:end]

    def in_macro(self, cursor):
        start, end = self.range(cursor)
        return any(start < e and s < end and not (start <= s and e <= end and (start, end) != (s, e))
                   for s, e in self.macros)

    def place(self, start, end, form):
        key = (start, end)
        if key not in self.places:
            self.places[key] = Place(start, end, form, self.function)
        elif self.places[key].form == 'ternary' and form == 'lambda':
            self.places[key].form = form
        return self.places[key]

    def expression(self, cursor):
        start, end = self.range(cursor)
        return self.place(start, end, 'ternary' if fits_ternary(cursor.type) else 'lambda')

    # declarations
    def declaration(self, cursor):
        """Visits a declaration of this file and those inside."""
        if cursor.kind in (KIND.FUNCTION_DECL, KIND.CXX_METHOD, KIND.FUNCTION_TEMPLATE, KIND.CONSTRUCTOR,
                           KIND.DESTRUCTOR, KIND.CONVERSION_FUNCTION):
            self.walk_function(cursor)
        elif cursor.kind == KIND.FIELD_DECL:
            self.walk_field(cursor)
        elif cursor.kind not in (KIND.STATIC_ASSERT, KIND.VAR_DECL, KIND.ENUM_DECL, KIND.TYPE_ALIAS_DECL):
            for child in cursor.get_children():
                self.declaration(child)

    def walk_function(self, cursor):
        outer = self.function
        parents, parent = [cursor.spelling], cursor.semantic_parent
        while parent is not None and parent.kind != KIND.TRANSLATION_UNIT:
            if parent.kind != KIND.NAMESPACE and parent.spelling:
                parents.insert(0, parent.spelling)
            parent = parent.semantic_parent
        self.function = '::'.join(parents)
        self.returns = cursor.result_type
        if ' consteval ' not in ' ' + self.text[slice(*self.range(cursor))].split('(')[0]:
            for child in cursor.get_children():
                if child.kind == KIND.COMPOUND_STMT:
                    self.body(child, cursor)
                elif cursor.kind == KIND.CONSTRUCTOR and child.kind.is_expression():
                    self.visit(child, cursor)
        self.function = outer

    def body(self, block, function):
        """Visits a function's body; a void function may also return before its first statement."""
        statements = list(block.get_children())
        if self.returns.kind == cindex.TypeKind.VOID and len(statements) > 1 and not self.in_macro(statements[0]):
            start = block.extent.start.offset + 1
            self.place(start, start, 'insert').add('body dropped', '{ ... }', 'return;')
        self.visit(block, function)

    def walk_field(self, cursor):
        """Visits a default member initialiser."""
        self.function = cursor.semantic_parent.spelling + '::' + cursor.spelling
        for child in cursor.get_children():
            before = self.text[:child.extent.start.offset].rstrip()
            if child.kind.is_expression() and before.endswith(('=', '{')):
                self.visit(child, cursor)

    # statements
    def is_statement(self, child, parent, index, children):
        """Tells whether an expression is a statement of its own."""
        if parent.kind in (KIND.COMPOUND_STMT, KIND.DEFAULT_STMT, KIND.LABEL_STMT):
            return True
        if parent.kind == KIND.CASE_STMT:
            return index > 0
        if parent.kind in (KIND.FOR_STMT, KIND.WHILE_STMT, KIND.CXX_FOR_RANGE_STMT):
            return index == len(children) - 1
        if parent.kind == KIND.DO_STMT:
            return index == 0
        if parent.kind == KIND.IF_STMT:
            condition = self.condition(parent, children)
            return condition is not None and index > condition
        return False

    def condition(self, cursor, children):
        """Returns the index of the condition among the children of an if or a while."""
        for index, child in enumerate(children[:-1]):
            between = self.text[child.extent.end.offset:children[index + 1].extent.start.offset].strip()
            if between.startswith(')'):
                return index
        return None

    def visit(self, cursor, parent):
        kind = cursor.kind
        if kind == KIND.STATIC_ASSERT or kind == KIND.TYPE_ALIAS_DECL or kind == KIND.TYPEDEF_DECL:
            return
        if kind in (KIND.STRUCT_DECL, KIND.CLASS_DECL):
            return
        if kind == KIND.VAR_DECL and self.is_constant(cursor):
            return
        if kind == KIND.IF_STMT and re.match(r'if\s+constexpr', self.slice(cursor)):
            for child in list(cursor.get_children())[1:]:
                self.visit(child, cursor)
            return
        if not self.in_macro(cursor):
            self.mutate(cursor, parent)
        children = list(cursor.get_children())
        for index, child in enumerate(children):
            if self.skips(cursor, child, index):
                continue
            if child.kind.is_expression() and self.is_statement(child, cursor, index, children):
                self.statement(child)
            self.visit(child, cursor)

    def skips(self, cursor, child, index):
        if cursor.kind == KIND.CASE_STMT and index == 0:
            return True
        start = child.extent.start.offset
        return cursor.kind in (KIND.VAR_DECL, KIND.FIELD_DECL) and self.text[:start].endswith('[')

    def is_constant(self, cursor):
        """Tells whether a variable is constant for the compiler, so that no choice at run time can change it."""
        head = self.text[cursor.extent.start.offset:cursor.extent.end.offset].split('=')[0]
        if re.search(r'\b(constexpr|static|consteval)\b', head):
            return True
        if not cursor.type.is_const_qualified() or is_real(cursor.type) or not is_number(cursor.type):
            return False
        return not any(c.kind in (KIND.DECL_REF_EXPR, KIND.CALL_EXPR, KIND.MEMBER_REF_EXPR, KIND.CXX_THIS_EXPR)
                       for c in cursor.walk_preorder())

    def statement(self, cursor):
        """Adds the mutants of an expression statement."""
        if self.in_macro(cursor):
            return
        start, end = self.range(cursor)
        semicolon = re.match(r'\s*;', self.text[end:])
        text = self.text[start:end]
        if not semicolon or cursor.type.spelling == 'NoTag' or text.startswith(('static_cast<void>', 'assert')):
            return
        place = self.place(start, end + semicolon.end(), 'statement')
        infix = self.infix(cursor)
        if cursor.kind == KIND.CALL_EXPR and not infix and text.endswith(')'):
            operator = 'call skipped'
        else:
            operator = 'assignment skipped'
        place.add(operator, text + ';', '', ';')
        if infix and infix[1] in COMPOUND:
            left, symbol, right = infix
            if symbol in ('+=', '-=') or is_number(cursor.type) and symbol in ('*=', '/=', '|=', '&='):
                place.add('compound assignment', text, self.join(left, COMPOUND[symbol], right), None)
                operator, before, after, _ = place.alternatives[-1]
                place.alternatives[-1] = (operator, before, after, after + ';')
        for mark, other in (('++', '--'), ('--', '++')):
            if text.startswith(mark):
                place.add('step reversed', text, other + text[2:], other + text[2:] + ';')
            elif text.endswith(mark):
                place.add('step reversed', text, text[:-2] + other, text[:-2] + other + ';')
        if cursor.kind == KIND.CALL_EXPR:
            for after in self.swapped_arguments(cursor):
                place.add('arguments swapped', text, after, after + ';')

    # expressions
    def mutate(self, cursor, parent):
        kind = cursor.kind
        if kind in (KIND.INTEGER_LITERAL, KIND.FLOATING_LITERAL):
            self.literal(cursor)
        elif kind == KIND.CXX_BOOL_LITERAL_EXPR:
            other = 'false' if self.slice(cursor) == 'true' else 'true'
            self.expression(cursor).add('constant', self.slice(cursor), other)
        elif kind == KIND.DECL_REF_EXPR:
            self.named_constant(cursor)
        elif kind in (KIND.IF_STMT, KIND.CONDITIONAL_OPERATOR, KIND.WHILE_STMT):
            self.guard(cursor)
        elif kind == KIND.RETURN_STMT:
            self.result(cursor)
        elif kind in (KIND.BREAK_STMT, KIND.CONTINUE_STMT):
            start, end = self.range(cursor)
            semicolon = re.match(r'\s*;', self.text[end:])
            if semicolon:
                text = self.text[start:end]
                self.place(start, end + semicolon.end(), 'statement').add(f'{text} dropped', text + ';', '', ';')
        elif kind.is_expression():
            self.operation(cursor, parent)

    def literal(self, cursor):
        text = self.slice(cursor)
        start, end = self.range(cursor)
        if self.text[start - 1:start] == '<' or self.text[end:end + 1] == '>' or not text[:1].isdigit() and text[:1] != '.':
            return
        place = self.expression(cursor)
        suffix = re.search(r'(?i)[ul]*$', text).group() if cursor.kind == KIND.INTEGER_LITERAL else \
            ('f' if text[-1] in 'fF' and not text.startswith('0x') else '')
        try:
            if cursor.kind == KIND.INTEGER_LITERAL:
                value = int(text[:len(text) - len(suffix)].replace("'", ''), 0)
                place.add('constant', text, f'{value + 1}{suffix}')
                if value > 0:
                    place.add('constant', text, f'{value - 1}{suffix}')
            else:
                value = float(text.rstrip('fFlL').replace("'", ''))
                others = (1.0,) if value == 0.0 else (1000 * value,) if value <= 1e-6 else (2 * value, value / 2)
                for other in others:
                    place.add('constant', text, f'{other!r}{suffix}')
        except ValueError:
            return

    def named_constant(self, cursor):
        """Scales a named constant of real type where it is used."""
        target = cursor.referenced
        if target is None or target.kind != KIND.VAR_DECL or not is_real(cursor.type):
            return
        if not re.match(r'k[A-Z]', target.spelling):
            return
        text = self.slice(cursor)
        start, end = self.range(cursor)
        if text.split('::')[-1] == target.spelling and self.text[end:end + 1] not in ('>', '{'):
            self.expression(cursor).add('constant', text, f'(2 * {text})')

    def guard(self, cursor):
        children = list(cursor.get_children())
        index = 0 if cursor.kind == KIND.CONDITIONAL_OPERATOR else self.condition(cursor, children)
        if index is None or not children:
            return
        condition = children[index]
        if self.in_macro(condition) or not condition.kind.is_expression():
            return
        if not (is_bool(condition.type) or is_number(condition.type) or condition.type.kind == cindex.TypeKind.POINTER):
            return
        if self.slice(condition) in ('true', 'false'):
            return
        place = self.expression(condition)
        text = self.slice(condition)
        if cursor.kind != KIND.WHILE_STMT:
            place.add('guard always', text, 'true')
        place.add('guard never', text, 'false')
        if cursor.kind != KIND.WHILE_STMT:
            self.guards.add(self.range(condition))

    def result(self, cursor):
        children = list(cursor.get_children())
        if not children or self.in_macro(children[0]) or self.returns is None:
            return
        value = children[0]
        text = self.slice(value)
        if is_bool(value.type) and is_bool(self.returns) and text not in ('true', 'false'):
            self.expression(value).add('result negated', text, f'!({text})')
        if value.type.get_canonical().spelling.endswith('::Status') and not text.endswith('kOk'):
            name = value.type.get_canonical().spelling
            self.expression(value).add('status ignored', text, f'::{name}::kOk')

    def infix(self, cursor):
        """Returns (left text, operator, right text) of an infix expression, also of an overloaded or dependent one."""
        start, end = self.range(cursor)
        operands = [c for c in cursor.get_children() if c.kind.is_expression() and self.slice(c) not in INFIX]
        if len(operands) != 2:
            return None
        (a, b), (c, d) = self.range(operands[0]), self.range(operands[1])
        symbol = re.sub(r'//[^\n]*', '', self.text[b:c]).strip()
        if (a, d) != (start, end) or b > c or symbol not in INFIX:
            return None
        self.operands = operands
        return self.text[a:b], symbol, self.text[c:d]

    @staticmethod
    def join(left, symbol, right):
        return f'{left} {symbol} {right}'

    def operation(self, cursor, parent):
        if cursor.kind in (KIND.UNEXPOSED_EXPR, KIND.PAREN_EXPR):
            children = list(cursor.get_children())
            if len(children) == 1 and (cursor.kind == KIND.PAREN_EXPR or
                                       self.range(children[0]) == self.range(cursor)):
                return
        spelled = cursor.type.get_canonical().spelling
        infix = self.infix(cursor)
        if infix:
            self.binary(cursor, infix, spelled)
            return
        text = self.slice(cursor)
        operands = [c for c in cursor.get_children() if c.kind.is_expression() and self.slice(c) not in ('-', '!', '~')]
        if len(operands) == 1 and operands[0].extent.end.offset == cursor.extent.end.offset:
            if text.startswith('-') and not text.startswith('--'):
                self.expression(cursor).add('sign', text, f'({text[1:]})')
                return
            if text.startswith('!'):
                if self.range(cursor) in self.guards:
                    return
                self.expression(cursor).add('not dropped', text, f'static_cast<bool>({text[1:]})')
                return
        if cursor.kind == KIND.CALL_EXPR:
            self.call(cursor, text, spelled)

    def loses_sign(self, cursor):
        """Tells whether only the length of the expression is used: then its operands may be swapped."""
        start, end = self.range(cursor)
        before, after = self.text[max(0, start - 5):start], self.text[end:end + 20]
        if re.match(r'\.(norm|squaredNorm)\(\)', after):
            return True  # of a call
        in_brackets = re.search(r'(^|[^\w>])\($', before) and re.match(r'\)\.(norm|squaredNorm)\(\)', after)
        return bool(in_brackets or re.search(r'\babs\($', before) and after.startswith(')'))

    def binary(self, cursor, infix, spelled):
        left, symbol, right = infix
        operands = self.operands
        text = self.slice(cursor)
        numbers = all(is_number(o.type) for o in operands)
        if symbol in RELATIONS:
            boundary, negation = RELATIONS[symbol]
            reals = any(is_real(o.type) for o in operands)
            place = self.expression(cursor)
            if boundary and (not reals or re.fullmatch(r'-?0\.0f?', right.strip()) or re.fullmatch(r'0\.0f?', left)):
                place.add('boundary', text, self.join(left, boundary, right))
            if self.range(cursor) not in self.guards:
                place.add('relation', text, self.join(left, negation, right))
        elif symbol in LOGICAL:
            place = self.expression(cursor)
            place.add('logical', text, self.join(f'({left})', LOGICAL[symbol], f'({right})'))
            place.add('condition dropped', text, f'static_cast<bool>({left})')
            place.add('condition dropped', text, f'static_cast<bool>({right})')
        elif symbol in ARITHMETIC:
            if any(word in spelled for word in LOGGED):
                return
            # vectors of numbers, element by element; what depends on a template's argument is taken for such a vector
            are_vectors = cursor.type.get_canonical().kind in (cindex.TypeKind.VECTOR, cindex.TypeKind.DEPENDENT)
            if symbol in ('<<', '>>', '&', '|', '^', '%') and not numbers and not are_vectors:
                return
            place = self.expression(cursor)
            if symbol in ('+', '-'):
                place.add('sign', text, self.join(left, ARITHMETIC[symbol], right))
            elif symbol in ('*', '/') and not are_vectors and not numbers and not is_number(operands[1].type):
                if is_number(operands[0].type):
                    return  # a number commutes
                place.add('operands swapped', text, self.join(f'({right})', symbol, f'({left})'))
                return
            else:
                place.add('arithmetic', text, self.join(left, ARITHMETIC[symbol], right))
            if symbol == '-' and left != right and not self.loses_sign(cursor):
                place.add('operands swapped', text, f'({right}) {symbol} ({left})')

    def arguments(self, cursor):
        children = list(cursor.get_children())
        count = len(list(cursor.get_arguments()))
        return children[len(children) - count:] if count > 0 else children[1:]

    def swapped_arguments(self, cursor):
        """Yields the call with two neighbouring arguments of one type swapped."""
        name = cursor.spelling or ''
        if name in COMMUTATIVE or name.startswith('operator'):
            return
        arguments = self.arguments(cursor)
        start, end = self.range(cursor)
        for one, two in zip(arguments, arguments[1:]):
            if not (one.kind.is_expression() and two.kind.is_expression()):
                continue
            (a, b), (c, d) = self.range(one), self.range(two)
            if not (start < a < b < c < d < end) or self.text[b:c].strip() != ',' or self.text[a:b] == self.text[c:d]:
                continue
            if one.type.get_canonical().spelling.removeprefix('const ') == \
                    two.type.get_canonical().spelling.removeprefix('const '):
                yield self.text[start:a] + self.text[c:d] + self.text[b:c] + self.text[a:b] + self.text[d:end]

    def call(self, cursor, text, spelled):
        name = cursor.spelling or ''
        if any(word in spelled for word in LOGGED) or name.startswith('operator'):
            return
        match = re.match(r'(?s)(.*?)(\w+)\((.*)\)$', text)
        children = list(cursor.get_children())
        if not match or not children:
            return
        callee = self.slice(children[0])
        function = re.search(r'(\w+)(<[^<>]*>)?$', callee)
        function = function.group(1) if function else ''
        arguments = self.arguments(cursor)
        inner = [self.slice(a) for a in arguments]
        is_void = cursor.type.kind == cindex.TypeKind.VOID
        if function in EXCHANGED and callee.endswith(function):
            self.expression(cursor).add('function', text, callee[:-len(function)] + EXCHANGED[function] +
                                        text[len(callee):])
        if function in DROPPED_FUNCTIONS and inner and 'std::' in callee:
            self.expression(cursor).add('function dropped', text, f'({inner[0]})')
        method = re.match(r'(?s)(.*)(?:\.|->)\w+$', callee)
        if method and not is_void:
            if function in DROPPED_METHODS and not inner:
                self.expression(cursor).add('frame', text, f'({method.group(1)})')
            if function == 'cross' and len(inner) == 1 and not self.loses_sign(cursor):
                self.expression(cursor).add('operands swapped', text, f'({inner[0]}).cross({method.group(1)})')
            if function == 'allFinite':
                self.expression(cursor).add('guard always', text, 'true')
        if function in ('isfinite', 'all_finite', 'is_finite'):
            self.expression(cursor).add('guard always', text, 'true')
        if spelled.endswith('::Status') and cursor.type.get_canonical().kind == cindex.TypeKind.ENUM:
            self.expression(cursor).add('status ignored', text, f'::{spelled}::kOk')
        if not is_void:
            for after in self.swapped_arguments(cursor):
                self.expression(cursor).add('arguments swapped', text, after)


def arguments_of(entry):
    """Returns the compiler arguments of an entry of compile_commands.json that libclang understands."""
    words = entry.get('arguments') or shlex.split(entry['command'])
    kept, take = [], False
    for word in words[1:]:
        if take:
            kept.append(word)
            take = False
        elif word in ('-I', '-isystem', '-D', '-include'):
            kept.append(word)
            take = True
        elif re.match(r'-(I|D|std=|m|isystem)', word) and not word.startswith('-mprefer'):
            kept.append(word)
    return kept


def places_of_unit(entry, wanted):
    """Parses one translation unit; returns {path: [Place]} of the files for which wanted(path) holds."""
    index = cindex.Index.create()
    options = cindex.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD
    unit = index.parse(entry['file'], args=arguments_of(entry), options=options)
    errors = [d for d in unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
    files = {entry['file']} | {i.include.name for i in unit.get_includes()}
    walks = {path: Walk(pathlib.Path(path).read_bytes().decode('latin-1')) for path in files if wanted(path)}
    declarations = []
    for cursor in unit.cursor.get_children():  # first all macros
        file = cursor.location.file
        walk = walks.get(file.name) if file is not None else None
        if walk is None:
            continue
        if cursor.kind == KIND.MACRO_INSTANTIATION:
            walk.macros.append((cursor.extent.start.offset, cursor.extent.end.offset))
        elif not cursor.kind.is_preprocessing():
            declarations.append((walk, cursor))
    for walk, cursor in declarations:
        walk.declaration(cursor)
    found = {path: [p for p in walk.places.values() if p.alternatives] for path, walk in walks.items()}
    return found, [str(e) for e in errors[:3]]
