# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""Sixty names that something on their way might run, obey, misread or choke on.

Whatever a name would run makes a file OWNED..., or starts a command that is a trap (program.py). `works`: a printable
name, which has to be accepted as that of a class; the others may be refused, in one line.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Name:
    tag: str
    text: bytes
    works: bool

    def as_file(self, most=180):
        """The nearest name that a file can have; None for those of which nothing is left."""
        name = self.text.replace(b"\0", b"").replace(b"/", b"_")[:most]
        return None if name in (b"", b".", b"..") else name


def _names(works, *rows):
    return [Name(tag, text.encode("utf-8") if isinstance(text, str) else text, works) for tag, text in rows]


NAMES = _names(
    True,
    ("back-quotes", "cup`touch OWNED_backquote`"),
    ("back-quotes, redirection alone", "`>OWNED_redirected`"),
    ("octal back-quotes", r"\140touch OWNED_octal\140"),
    ("dollar and brackets", "$(touch OWNED_dollar)"),
    ("variable", "${HOME}$PATH"),
    ("semicolons", "cup; touch OWNED_semicolon; cup"),
    ("pipe behind", "cup | touch OWNED_pipe"),
    ("pipe ahead", "|touch OWNED_output"),
    ("ampersands", "a && touch OWNED_and & b"),
    ("data from a pipe", "<touch OWNED_input"),
    ("gnuplot's shell", "!touch OWNED_shell"),
    ("gnuplot's macro", "@OWNED"),
    ("gnuplot's system, double quotes", "\"; system(\"touch OWNED_double\"); \""),
    ("gnuplot's system, single quotes", "'; system('touch OWNED_single'); '"),
    ("gnuplot's comment", "cup # touch"),
    ("gnuplot's markup", "a_b^c{/Symbol x}&{space}"),
    ("single quote", "it's"),
    ("two single quotes", "''"),
    ("double quote", 'seventeen" screen'),
    ("backslash at the end", "cup\\"),
    ("backslash n", "cup\\ncup"),
    ("windows path", "C:\\Users\\x"),
    ("formula", "=1+1"),
    ("formula that starts a program", "=cmd|' /C calc'!A0"),
    ("plus", "+1+cmd|' /C calc'!A0"),
    ("minus", "-2+3+cmd|' /C calc'!A0"),
    ("at sign", "@SUM(1+1)*cmd|' /C calc'!A0"),
    ("lone minus", "-"),
    ("number", "1e3"),
    ("script", "</script><script>alert(1)</script>"),
    ("attribute", "\" onload=\"alert(1)"),
    ("entity", "&lt;&amp;&#0;"),
    ("above", "../../../OWNED_above"),
    ("absolute path", "/etc/passwd"),
    ("format of fmt", "{}{0}{:>99999}"),
    ("format of printf", "%s%n%99999d%x"),
    ("sql, single quote", "'; DROP TABLE trials; --"),
    ("sql, double quote", "\"; DELETE FROM trials; --"),
    ("yaml alias", "*a"),
    ("yaml anchor", "&a"),
    ("yaml tag", "!!python/object/apply:os.system [touch OWNED_yaml]"),
    ("yaml comment and colon", "cup: {a: [b # c"),
    ("yaml null", "null"),
    ("yaml yes", "yes"),
    ("markdown", "[x](javascript:alert(1)) | **b** | `c`"),
    ("comma and quote", 'a,"b",c'),
    ("emoji", "\U0001f600 cup"),
    ("other script", "чашка 杯子"),
) + _names(
    False,
    ("blanks around", "  cup  "),
    ("tab", "cup\tcup"),
    ("line end", "cup\n!touch OWNED_line\nsystem 'touch OWNED_line2'\n"),
    ("carriage return", "cup\r=1+1"),
    ("escape sequence", "\x1b[2J\x1b[31mred\x1b[0m"),
    ("title of the terminal", "\x1b]0;mine\x07cup"),
    ("C1 controls", "\u009b31mcup\u0085"),
    ("NUL", "cup\0cup"),
    ("no UTF-8", b"cup\xff\xfe\xc3("),
    ("right to left", "cup\u202egnp.exe\u200f\u2066"),
    ("zero width", "c\u200bu\ufeffp\u2028\u2029"),
    ("10 kB", "long" * 2560),
)
assert len(NAMES) == 60, len(NAMES)
