# SPDX-License-Identifier: Apache-2.0
"""Bugs drawn by a seed: places in C++ sources where one small change makes one.

  relation   < for <=, > for >=, == for !=, and back
  sign       + for -, += for -=, and back
  constant   n + 1 for an integer n, 0 for 1; true for false, and back
  clause     the right side of && or || is left out
  return     a function returns before this statement

The kinds take turns, a line of each is drawn by the hash of the seed, its file and its text: all lines are alike, and a
change elsewhere draws no others. Sources are formatted by clang-format: a binary operator has blanks on both sides, the bracket of a template has
none. Left out are constants of the compiler, invariants (STICTION_CHECK never fails in a right program) and capacities.
"""

import bisect
import hashlib
import itertools
import re
from collections import namedtuple

# In text[begin:end] stands what `mutated` replaces. form: expression, statement, or early, which is put before it.
Site = namedtuple("Site", "kind begin end mutated form")
Token = namedtuple("Token", "text begin end before after")  # before, after: blanks there

RELATIONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "=="}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
LEVELS = ({"||"}, {"&&"}, {"|"}, {"^"}, {"&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"<=>"}, {"<<", ">>"}, {"+", "-"},
          {"*", "/", "%"})
LEVEL = {name: level for level, names in enumerate(LEVELS) for name in names}
ASSIGNMENTS = {"=", "+=", "-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="}
STOPS = {",", ";", "?", ":"} | ASSIGNMENTS
WORDS = {"return", "throw", "case", "else", "if", "for", "while", "switch", "do", "break", "continue", "delete", "new", "goto",
         "default"}
NO_STATEMENT = {"const", "auto", "static", "constexpr", "constinit", "inline", "using", "typedef", "struct", "class", "enum",
                "template", "namespace", "case", "default", "else", "public", "private", "protected", "friend", "extern", "do",
                "mutable", "union", "switch"}
SKIPPED = re.compile(r"\b(constexpr|static_assert|STICTION_CHECK|STICTION_ASSERT|reserve|template|requires|concept|enum|case"
                     r"|using|alignas)\b")
TOKEN = re.compile(r"[A-Za-z_]\w*|\d(?:[eE][+-]|[\w.'])*|<<=|>>=|<=>|->|\+\+|--|&&|\|\||[<>=!+\-*/%&|^]=|<<|>>|::|\S")
MASKED = re.compile(r'R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*(?:.|\n)*?\*/'
                    r"|^[ \t]*#(?:\\\n|[^\n])*", re.M)


def mask(text):
    """The text as long as it is, comments and directives blank, the inside of strings x."""
    def blank(match):
        found = match[0]
        if found[0] in "\"'R":
            return found[0] + re.sub(r"[^\n]", "x", found[1:-1]) + found[-1]
        return re.sub(r"[^\n]", " ", found)

    return MASKED.sub(blank, text)


class Source:
    """The tokens of a file, and the partner of each bracket."""

    def __init__(self, text):
        self.text, self.masked = text, mask(text)
        self.tokens = [self.token(match) for match in TOKEN.finditer(self.masked)]
        self.begins = [token.begin for token in self.tokens]
        self.partner = {}
        self.templates = set()  # tokens in brackets of templates
        self.match_brackets()

    def token(self, match):
        begin, end = match.span()
        return Token(match[0], begin, end, self.masked[begin - 1:begin].isspace(), self.masked[end:end + 1].isspace())

    def match_brackets(self):
        open_, angles = [], [[]]
        for i, token in enumerate(self.tokens):
            if token.text in "([{" and len(token.text) == 1:
                open_.append(i)
                angles.append([])
            elif token.text in ")]}" and len(token.text) == 1 and open_:
                self.partner[i], self.partner[open_[-1]] = open_[-1], i
                open_.pop()
                angles.pop()
            elif token.text == "<" and not token.after:
                angles[-1].append(i)
            elif token.text in (">", ">>") and not token.before:
                for _ in token.text:
                    if angles[-1]:
                        first = angles[-1].pop()
                        self.partner[i], self.partner[first] = first, i
                        self.templates.update(range(first, i))
            elif token.text == ";":
                angles[-1].clear()

    def is_binary(self, i):
        token = self.tokens[i]
        return token.text in LEVEL and token.before and token.after

    def is_stop(self, i):
        text = self.tokens[i].text
        return text in STOPS or text in WORDS

    def left(self, i, level):
        """The first token of the left side of the operator i."""
        j = i - 1
        while j >= 0:
            text = self.tokens[j].text
            if text in ("(", "[", "{", "}") or self.is_stop(j) or self.is_binary(j) and LEVEL[text] < level:
                break
            j = self.partner.get(j, j) - 1
        return j + 1

    def right(self, i, level):
        """The token behind the right side of the operator i."""
        j = i + 1
        while j < len(self.tokens):
            text = self.tokens[j].text
            if text in (")", "]", "}") or self.is_stop(j) or self.is_binary(j) and LEVEL[text] <= level:
                break
            if text == "{" and self.tokens[j].before and self.tokens[j - 1].text not in (",", "(", "]"):
                break
            j = self.partner.get(j, j) + 1
        return j

    def statement(self, i):
        """(first, behind last) of the statement that the token i is in; None if it is a declaration or a head of one."""
        j = i - 1
        while j >= 0:
            text = self.tokens[j].text
            if text in (";", "}") or text == "{" and self.tokens[j].before and self.tokens[j].after or text == ":" and \
                    self.tokens[j - 1].text in ("default", "public", "private", "protected"):
                break
            if text == "(" and self.tokens[j - 1].text in ("if", "for", "while", "switch"):
                return None
            j = (self.partner.get(j, j) if text in (")", "]") else j) - 1
        first = j + 1
        if not self.tokens[first].text[0].isidentifier() and self.tokens[first].text not in ("*", "++", "--", "("):
            return None
        last = i
        while last < len(self.tokens) and self.tokens[last].text != ";":
            if self.tokens[last].text == "{" and self.tokens[last].before and self.tokens[last - 1].text in (")", "else"):
                return None
            last = self.partner.get(last, last) + 1 if self.tokens[last].text in ("(", "[", "{") else last + 1
        behind = self.tokens[last + 1].text if last + 1 < len(self.tokens) else ""
        if last >= len(self.tokens) or behind == "else" or self.declares(first):
            return None
        inside = self.masked[self.tokens[first].begin:self.tokens[last].end]
        whole = all(inside.count(left) == inside.count(right) for left, right in ("()", "[]", "{}"))
        return (first, last + 1) if whole else None  # the end of a list, or of the head of a loop, is none

    def declares(self, first):
        """Two names without an operator between them."""
        i = first
        if self.tokens[i].text in NO_STATEMENT or self.tokens[i].text == "[":
            return True
        if not self.tokens[i].text[0].isidentifier() or self.tokens[i].text in WORDS:
            return False
        while i + 1 < len(self.tokens):
            i += 1
            text = self.tokens[i].text
            if text == "::":
                i += 1
            elif text == "<" and i in self.partner:
                i = self.partner[i]
            elif text not in ("&", "*"):
                return text[0].isidentifier()
        return False

    def piece(self, begin, end):
        """On one line, so that the lines of the file keep their numbers; None if there is a comment in it."""
        text = self.text[begin:end]
        masked = self.masked[begin:end]
        if any(x != y and y == " " for x, y in zip(text, masked)) or 'R"' in text:
            return None
        return re.sub(r"\s*\n\s*", " ", text)

    def changed(self, kind, i, new, span, form):
        """The site that has `new` for the token i, within the tokens of the span."""
        token, begin, end = self.tokens[i], self.tokens[span[0]].begin, self.tokens[span[1] - 1].end
        before, after = self.piece(begin, token.begin), self.piece(token.end, end)
        if before is None or after is None:
            return None
        return Site(kind, begin, end, before + new + after, form)

    def site(self, i):
        """What can be changed in the token i, without its statement; None if nothing."""
        token = self.tokens[i]
        text = token.text
        if self.is_binary(i) and text in (*RELATIONS, "&&", "||", "+", "-"):
            level = LEVEL[text]
            span = self.left(i, level), self.right(i, level)
            if span[0] == i or span[1] == i + 1 or '"' in self.masked[self.tokens[span[0]].begin:self.tokens[span[1] - 1].end] and \
                    text in SIGNS:
                return None
            if text in RELATIONS:
                return self.changed("relation", i, RELATIONS[text], span, "expression")
            if text in SIGNS:
                return self.with_statement("sign", i, SIGNS[text], span)
            begin, end = self.tokens[span[0]].begin, self.tokens[span[1] - 1].end
            left = self.piece(begin, token.begin)
            return left and Site("clause", begin, end, left.strip(), "expression")
        if text in ("+=", "-="):
            if self.tokens[i + 1].text[0] in "\"'" or "fmt::format" in self.text[token.end:self.text.find(";", token.end)]:
                return None  # text
            return self.with_statement("sign", i, SIGNS[text], None)
        if text in ("true", "false") or re.fullmatch(r"\d+", text):
            if i in self.templates:
                return None
            new = {"true": "false", "false": "true", "1": "0"}.get(text) or str(int(text) + 1)
            return self.with_statement("constant", i, new, (i, i + 1))
        return None

    def with_statement(self, kind, i, new, span):
        """In two statements if it is in one: both may have types of their own then."""
        statement = self.statement(i)
        if statement:
            return self.changed(kind, i, new, statement, "statement")
        return self.changed(kind, i, new, span, "expression") if span else None

    def sites(self):
        """By line, from 1."""
        starts = [0, *(match.end() for match in re.finditer("\n", self.text))]
        lines = self.masked.split("\n")
        by_line = {}
        for i, token in enumerate(self.tokens):
            line = bisect.bisect_right(starts, token.begin)
            if SKIPPED.search(lines[line - 1]):
                continue
            site = self.site(i)
            if site:
                by_line.setdefault(line, []).append(site)
        for number in range(2, len(lines) + 1):
            site = self.early(lines, number, starts)
            if site:
                by_line.setdefault(number, []).append(site)
        return by_line

    def early(self, lines, number, starts):
        """A return before a statement of the outer block of a function whose head begins its line."""
        line = lines[number - 1]
        if not re.match(r"  [A-Za-z_+-]", line) or SKIPPED.search(line):
            return None
        above = next((one for one in reversed(lines[:number - 1]) if one.strip()), "")
        if not re.search(r"[;{}]\s*$", above):
            return None
        first = bisect.bisect_left(self.begins, starts[number - 1])
        if self.declares(first):
            return None
        head = next((k for k in range(number - 2, -1, -1) if re.match(r"\S", lines[k])), None)
        while head is not None and head > 0 and re.match(r"[){]", lines[head]):
            head -= 1
        if head is None or not re.match(r"[A-Za-z]", lines[head]) or re.match(r"(namespace|struct|class|enum)\b", lines[head]):
            return None
        is_void = re.match(r"(static |inline )*void\b", lines[head]) or re.match(r"(\w+)(<\w+>)?::\1\(", lines[head])
        begin = self.tokens[first].begin
        return Site("return", begin, begin, "return;" if is_void else "return {};", "early")


def digest(*parts):
    return hashlib.sha256("\0".join(map(str, parts)).encode()).hexdigest()


def draw(texts, seed):
    """Yields (file, line, site) in the order of the seed; texts: by file."""
    by_kind = {}
    for file, text in sorted(texts.items()):
        seen, split = {}, text.split("\n")
        for line, sites in sorted(Source(text).sites().items()):
            content = split[line - 1].strip()
            seen[content] = seen.get(content, 0) + 1
            for kind in sorted({site.kind for site in sites}):
                hashed = digest(seed, kind, file, content, seen[content])
                chosen = [site for site in sites if site.kind == kind]
                by_kind.setdefault(kind, []).append((hashed, file, line, chosen[int(hashed[:8], 16) % len(chosen)]))
    drawn = [sorted(lines, key=lambda item: item[0]) for _, lines in sorted(by_kind.items())]
    for turn in itertools.zip_longest(*drawn):
        yield from (item[1:] for item in turn if item)
