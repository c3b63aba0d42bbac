#!/usr/bin/env python3
"""mutate.py MODULE.sv MODULE.mutants OUTPUT.sv: one module with all its mutants.

Each line of the list is an expression that occurs once in the module, " --> ", and its replacement; lines that begin
with # are comments. The output has two more ports: `mutant` selects a mutant (0: none), `mutants` is their number.
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


def mutated(text, by_original, count, where):
    for original, mutants in by_original.items():
        if text.count(original) != 1:
            sys.exit(f"{where}: {original!r} occurs {text.count(original)} times in the module; it must occur once")
        choices = "".join(f"mutant == 8'd{n} ? ({replacement}) : " for n, replacement in mutants)
        text = text.replace(original, f"({choices}({original}))")
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
    module, mutants, output = map(pathlib.Path, sys.argv[1:])
    by_original, count = read_mutants(mutants)
    output.write_text(mutated(module.read_text(), by_original, count, mutants))


main()
