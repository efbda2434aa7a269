"""Places in C sources where a small change makes a mutant: constants changed slightly, operators and comparisons
swapped, branches disabled, arguments dropped. Found from tokens, without a parser; a change that does not compile is
discarded."""
import dataclasses
import hashlib
import re

TOKEN = re.compile(r"""(?P<skip>/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|^[ \t]*\#(?:\\\n|[^\n])*)
|(?P<number>(?:0[xX][0-9a-fA-F]+|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?)[uUlLfF]*)
|(?P<name>[A-Za-z_]\w*)
|(?P<sign><<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%&|^<>=!?:;,(){}\[\]~.])""", re.S | re.M | re.X)
OPERATORS = {"+": "-", "-": "+", "*": "/", "/": "*", "<<": ">>", ">>": "<<", "&": "|", "|": "&", "+=": "-=", "-=": "+="}
COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
KINDS = ("constant", "operator", "comparison", "branch", "argument")
WORDS = {"if", "for", "while", "switch", "return", "sizeof", "case", "else", "do", "goto", "default"}
PROMISES = {"assert", "_Static_assert", "static_assert"}  # always true


@dataclasses.dataclass
class Site:
    path: str
    kind: str
    begin: int
    end: int
    instead: str
    line: int = 0
    column: int = 0
    was: str = ""
    id: str = ""

    def described(self):
        return f"{self.path}:{self.line}:{self.column}: {self.kind} `{self.was}` -> `{self.instead}`"


def tokens_of(text):
    return [m for m in TOKEN.finditer(text) if m.lastgroup != "skip"]


def closing(tokens, at):
    """Index of the parenthesis that closes the one at `at`."""
    depth = 0
    for i in range(at, len(tokens)):
        depth += (tokens[i][0] in "([{") - (tokens[i][0] in ")]}")
        if depth == 0:
            return i
    return len(tokens) - 1


def off_by_a_little(number):
    digits = number.rstrip("uUlL") if number[:2].lower() == "0x" else number.rstrip("uUlLfF")
    suffix = number[len(digits):]
    if digits == "1":
        return "0" + suffix  # any other nonzero value is equally true
    if digits[:2].lower() == "0x":
        return f"{int(digits, 16) + 1:#x}{suffix}"
    if digits.isdigit():
        return f"{int(digits) + 1}{suffix}"
    text = f"{float(digits) * 1.02 or 0.02:.9g}"
    return text + ("" if "." in text or "e" in text else ".0") + suffix


def declares_size(tokens, i):
    """`struct x name[8]`: a longer array changes nothing."""
    return (i >= 3 and tokens[i - 1][0] == "[" and tokens[i - 2].lastgroup == "name"
            and tokens[i - 3].lastgroup == "name" and tokens[i - 3][0] not in WORDS)


def arguments(tokens, opened):
    """(begin, end) of each argument of a call, as token indices."""
    end, depth, begin = closing(tokens, opened), 0, opened + 1
    for i in range(opened, end + 1):
        depth += (tokens[i][0] in "([{") - (tokens[i][0] in ")]}")
        if (depth == 1 and tokens[i][0] == ",") or i == end:
            if i > begin:
                yield begin, i
            begin = i + 1


def of_text(path, text):
    tokens, stack, since, quiet = tokens_of(text), [], 0, -1
    for i, token in enumerate(tokens):
        word, before = token[0], tokens[i - 1] if i else None
        if word == "{":
            head = [t[0] for t in tokens[since:i]]
            stack.append("type" if {"struct", "union", "enum"} & set(head) and not {"(", "="} & set(head) else "code")
            since = i + 1
        elif word == "}" and stack:
            stack.pop()
            since = i + 1
        elif word == ";":
            since = i + 1
        if word in PROMISES and i + 1 < len(tokens):
            quiet = closing(tokens, i + 1)
        if not stack or "type" in stack or i <= quiet:
            continue
        operand = before and before.lastgroup in ("name",
                                                  "number") and before[0] not in WORDS or before and before[0] in ")]"
        if token.lastgroup == "number" and not declares_size(tokens, i):
            yield Site(path, "constant", token.start(), token.end(), off_by_a_little(word))
        elif word in OPERATORS and operand:
            yield Site(path, "operator", token.start(), token.end(), OPERATORS[word])
        elif word in COMPARISONS:
            yield Site(path, "comparison", token.start(), token.end(), COMPARISONS[word])
        elif word == "if" and i + 1 < len(tokens) and tokens[i + 1][0] == "(":
            first, last = tokens[i + 1].end(), tokens[closing(tokens, i + 1)].start()
            yield Site(path, "branch", first, last, f"({text[first:last]}) && 0")
        elif token.lastgroup == "name" and word not in WORDS and i + 1 < len(tokens) and tokens[i + 1][0] == "(":
            for begin, end in arguments(tokens, i + 1):
                first, last = tokens[begin].start(), tokens[end - 1].end()
                if text[first:last] not in ("0", "NULL", "void"):
                    yield Site(path, "argument", first, last, "0")


def find(root, path, seed):
    """The sites of a file, each with a name that stays valid until its line changes."""
    text, seen = (root / path).read_text(), {}
    for site in of_text(path, text):
        begin, end = text.rfind("\n", 0, site.begin) + 1, text.find("\n", site.end)
        site.line, site.column, site.was = text.count("\n", 0,
                                                      site.begin) + 1, site.begin - begin + 1, text[site.begin:site.end]
        key = (path, text[begin:end].strip(), site.begin - begin, site.kind, site.instead)
        seen[key] = seen.get(key, 0) + 1
        site.id = hashlib.sha256(repr((seed, key, seen[key])).encode()).hexdigest()[:12]
        yield site
