"""Right-hand sides as text: a graph in which equal operations are one node, with the names of heyoka's expressions.

A value that is used once stands inside the expression that uses it; every other one has a name.
"""

# Characters of an expression that may still stand inside another one: nesting is parsed recursively.
INSIDE = 400


class Value:
    """A node of a graph in which equal operations are one node."""

    def __init__(self, graph, text, operands=()):
        self.graph, self.text, self.operands, self.uses = graph, text, operands, 0

    def of(self, symbol, other, turned=False):
        return self.graph.operation(symbol, *((other, self) if turned else (self, other)))

    def __add__(self, other):
        return self if is_nothing(other) else self.of("+", other)

    def __sub__(self, other):
        return self if is_nothing(other) else self.of("-", other)

    def __mul__(self, other):
        return 0 if is_nothing(other) else self if is_one(other) else self.of("*", other)

    def __truediv__(self, other):
        return self.of("/", other)

    def __radd__(self, other):
        return self + other

    def __rmul__(self, other):
        return self * other

    def __rsub__(self, other):
        return -self if is_nothing(other) else self.of("-", other, turned=True)

    def __rtruediv__(self, other):
        return self.of("/", other, turned=True)

    def __neg__(self):
        return self.of("*", -1.0)

    def __pow__(self, power):
        return self * self if power == 2 else NotImplemented


def is_nothing(x):
    return isinstance(x, int) and x == 0


def is_one(x):
    return isinstance(x, int) and x == 1


class Graph:
    """The expressions by the names of heyoka."""

    def __init__(self):
        self.nodes = {}
        self.time = self.node("t")

    def node(self, text, *operands):
        key = text, *map(id, operands)
        if key not in self.nodes:
            self.nodes[key] = Value(self, text, operands)
            for operand in operands:
                operand.uses += 1
        return self.nodes[key]

    def value(self, x):
        return x if isinstance(x, Value) else self.node(repr(float(x)))

    def operation(self, symbol, left, right):
        return self.node(symbol, self.value(left), self.value(right))

    def make_vars(self, *names):
        # diffsol knows no underscores, and has the name `u` itself.
        return [self.node(f"state{name}") for name in names]

    def sin(self, x):
        return self.node("sin", x)

    def cos(self, x):
        return self.node("cos", x)

    def sqrt(self, x):
        return self.node("sqrt", x)

    def expression(self, x):
        return self.node(repr(float(x)))

    @staticmethod
    def sum(terms):
        return sum(terms, start=0)

    def text(self, pairs, named):
        """Pairs of name and expression for what is used more than once, in order, and the rates; `named` are texts of variables."""
        texts, lines = {}, []

        def text(node):
            if id(node) not in texts:
                inner = [text(operand) for operand in node.operands]
                if not inner:
                    made = named.get(node.text, f"({node.text})" if node.text.startswith("-") else node.text)
                elif len(inner) == 1:
                    made = f"{node.text}({inner[0]})"
                else:
                    made = f"({inner[0]} {node.text} {inner[1]})"
                if inner and (node.uses > 1 or len(made) > INSIDE):
                    lines.append((f"value{len(lines)}", made))
                    made = lines[-1][0]
                texts[id(node)] = made
            return texts[id(node)]

        rates = [text(self.value(rate)) for _, rate in pairs]
        return lines, rates
