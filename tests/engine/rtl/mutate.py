#!/usr/bin/env python3
"""mutate.py MODULE.sv MODULE.mutants OUTPUT.sv [PART.sv...]: one module with all its mutants.

Each line of the list is an expression that occurs once in the module, " --> ", and its replacement; lines that begin
with # are comments. A header beside the module that has such an expression is inlined. An expression that the module
lacks is looked for in the parts, modules that it may instantiate; the output has those that are mutated, too. It has
two more ports: `mutant` selects a mutant (0: none), `mutants` is their number.
"""

import pathlib
import re
import sys


def read_mutants(path):
    by_original = {}
    number = 0
    for line in path.read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        original, arrow, replacement = line.partition(" --> ")
        if not arrow:
            sys.exit(f"{path}: {line!r} has no ' --> '")
        number += 1
        by_original.setdefault(original.strip(), []).append((number, replacement.strip()))
    return by_original, number


def with_headers(module, originals):
    def text_of(include):
        header = module.parent / include[1]
        text = header.read_text() if header.exists() else ""
        return text if any(original in text for original in originals) else include[0]

    return re.sub(r'^`include "(.+)"\n', text_of, module.read_text(), flags=re.MULTILINE)


def replaced(text, by_original, selector):
    for original, mutants in by_original.items():
        choices = "".join(f"{selector} == 8'd{n} ? ({replacement}) : " for n, replacement in mutants)
        text = text.replace(original, f"({choices}({original}))")
    return text


def with_ports(text, count, where):
    ports = re.search(r"^(module \w+|\)) \(\n", text, re.MULTILINE)
    if not ports:
        sys.exit(f"{where}: the module's ports do not begin behind a line that ends with ' ('")
    end_of_ports = text.index("\n);\n", ports.end()) + len("\n);\n")
    return (
        text[: ports.end()]
        + "    input  logic [7:0] mutant,\n    output logic [7:0] mutants,\n"
        + text[ports.end() : end_of_ports]
        + f"  assign mutants = 8'd{count};\n"
        + text[end_of_ports:]
    )


def main():
    module, mutants, output, *parts = map(pathlib.Path, sys.argv[1:])
    by_original, count = read_mutants(mutants)
    texts = [with_headers(module, by_original), *(path.read_text() for path in parts)]
    in_text = [{} for _ in texts]
    for original, choices in by_original.items():
        occurrences = [text.count(original) for text in texts]
        found = 0 if occurrences[0] else next((n for n, times in enumerate(occurrences) if times), 0)
        if occurrences[found] != 1:
            sys.exit(f"{mutants}: {original!r} occurs {occurrences[found]} times in the module; it must occur once")
        in_text[found][original] = choices
    text = with_ports(replaced(texts[0], in_text[0], "mutant"), count, mutants)
    for part, of_part in zip(texts[1:], in_text[1:]):
        if of_part:
            text += replaced(part, of_part, f"{module.stem}.mutant")
    output.write_text(text)


main()
